//! The whole way from the text of an input to its view factors.

use std::ops::Range;
use std::time::Instant;

use crate::exchange::{Exchange, exchange};
use crate::factors::ViewFactors;
use crate::flaw::Flaw;
use crate::geometry::{Geometry, geometry};
use crate::method::Method;
use crate::vs3::{Control, Input, parse};

/// Of a view factor, where neither the user nor the file says another.
const ACCURACY: f64 = 1e-6;
/// An enclosure whose row sums differ more from 1 has a hole, or surfaces that cross or face outward.
const LEAK: f64 = 1e-3;

/// All that is known in the end.
#[derive(Debug)]
pub struct Solution {
    pub input: Input,
    pub geometry: Geometry,
    pub exchange: Exchange,
    /// As computed.
    pub factors: ViewFactors,
    /// For an enclosure: with rows that sum to 1.
    pub closed: Option<ViewFactors>,
    /// For gray surfaces: Hottel's total exchange.
    pub total: Option<ViewFactors>,
    pub warnings: Vec<Flaw>,
    pub method: Method,
    pub accuracy: f64,
    /// What computing the exchange of all pairs took.
    pub seconds: f64,
}

/// Computes what an input asks for. Without an accuracy the smaller of 1e-6 and that of the input counts.
pub fn solve(text: &str, method: Method, accuracy: Option<f64>) -> Result<Solution, Flaw> {
    let mut input = parse(text)?;
    let mut geometry = geometry(&input, method.cutting())?;
    let accuracy = accuracy.unwrap_or(input.control.accuracy.unwrap_or(ACCURACY).min(ACCURACY));
    let [row, column] = [input.control.row, input.control.column].map(|number| selection(&geometry, number));
    let start = Instant::now();
    let [of_rows, of_columns] = [row, column].map(|range| parts_of(&geometry, range));
    let is_asked = |i: usize, j: usize| (of_rows[i] && of_columns[j]) || (of_rows[j] && of_columns[i]);
    let exchange = exchange(&geometry, method, accuracy, is_asked);
    let seconds = start.elapsed().as_secs_f64();
    let factors = ViewFactors::new(&geometry, &exchange);
    let is_whole = input.control.row == 0;
    let mut warnings = std::mem::take(&mut input.warnings);
    warnings.append(&mut geometry.warnings);
    let closed = if is_whole && input.control.is_enclosure { close(&factors, &mut warnings) } else { None };
    let emissivities: Vec<f64> = geometry.reported.iter().map(|surface| surface.emissivity).collect();
    let black = closed.as_ref().unwrap_or(&factors);
    let total = (is_whole && input.control.is_gray).then(|| black.total_exchange(&emissivities)).flatten();
    let mut solution =
        Solution { input, geometry, exchange, factors, closed, total, warnings, method, accuracy, seconds };
    solution.judge();
    Ok(solution)
}

impl Solution {
    /// The rows that are asked for.
    pub fn rows(&self) -> Range<usize> {
        selection(&self.geometry, self.input.control.row)
    }

    /// The columns that are asked for.
    pub fn columns(&self) -> Range<usize> {
        selection(&self.geometry, self.input.control.column)
    }

    /// Warns of results that are not what the user may take them for.
    fn judge(&mut self) {
        let Control { row, is_enclosure, is_gray, .. } = self.input.control;
        if is_gray && row == 0 && self.total.is_none() {
            let what =
                "nothing absorbs what is emitted, so there is no total exchange; give some surface an emissivity";
            self.warnings.push(Flaw::new(1, what));
        }
        let blocked = self.exchange.blocked_pairs;
        if blocked > 0 && !self.method.sees_blockers() {
            let what = format!("method {} does not see what may stand between {blocked} pairs", self.method.name());
            self.warnings.push(Flaw::new(1, format!("{what}; use `--method auto`")));
        } else if is_enclosure && row == 0 {
            let leaks = (0..self.factors.count).filter_map(|i| self.leak(i)).collect::<Vec<_>>();
            self.warnings.extend(leaks);
        }
    }

    /// A surface of an enclosure that sees more or less than all, by more than it may for other reasons.
    fn leak(&self, i: usize) -> Option<Flaw> {
        let (sum, number) = (self.factors.row_sum(i), self.geometry.reported[i].numbers[0]);
        let line = self.input.surfaces[number - 1].line;
        let what = format!("surface {number} sees a share of {sum:.4}; with `encl=1` it should be 1");
        let remedy = "close the holes, turn surfaces inward, or write `encl=0`";
        let is_leak = (sum - 1.0).abs() > LEAK.max(self.factors.errors[i]);
        is_leak.then(|| Flaw::new(line, format!("{what}: {remedy}")))
    }
}

/// Rows that sum to 1, if there are.
fn close(factors: &ViewFactors, warnings: &mut Vec<Flaw>) -> Option<ViewFactors> {
    let closed = factors.closed().map_err(|error| warnings.push(Flaw::new(1, format!("rows are not scaled: {error}"))));
    closed.ok()
}

/// The reported surface that holds a number of the input; all of them for 0.
fn selection(geometry: &Geometry, number: usize) -> Range<usize> {
    match geometry.reported.iter().position(|surface| surface.numbers.contains(&number)) {
        Some(row) => row..row + 1,
        None => 0..geometry.reported.len(),
    }
}

/// Whether each part belongs to one of these surfaces.
fn parts_of(geometry: &Geometry, reported: Range<usize>) -> Vec<bool> {
    let mut belongs = vec![false; geometry.parts.len()];
    let surfaces = geometry.reported[reported].iter();
    surfaces.flat_map(|surface| &surface.weights).for_each(|&(part, _)| belongs[part] = true);
    belongs
}
