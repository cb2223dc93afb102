//! The exchange area `A_i F_ij` of all pairs of polygons.

use radiosity::form_factor::Estimate;

use crate::blocking::{blockers_between, possible_blockers};
use crate::geometry::{Geometry, Piece};
use crate::method::{Method, Way};

/// `A_i F_ij = A_j F_ji` of all pairs of parts, and how they were found.
#[derive(Debug)]
pub struct Exchange {
    /// Of parts `i` and `j < i` at `i (i - 1) / 2 + j`.
    areas: Vec<Estimate<f64>>,
    /// Pairs that face each other with nothing between.
    pub open_pairs: usize,
    /// Pairs that face each other with something that may stand between.
    pub blocked_pairs: usize,
}

impl Exchange {
    /// Of two parts, in any order; nothing for a part with itself.
    pub fn between(&self, i: usize, j: usize) -> Estimate<f64> {
        let (high, low) = (i.max(j), i.min(j));
        if high == low { Estimate::default() } else { self.areas[high * (high - 1) / 2 + low] }
    }
}

/// Computes the pairs that `is_asked` names.
pub fn exchange(
    geometry: &Geometry,
    method: Method,
    accuracy: f64,
    is_asked: impl Fn(usize, usize) -> bool,
) -> Exchange {
    let parts = &geometry.parts;
    let mut exchange = Exchange { areas: Vec::new(), open_pairs: 0, blocked_pairs: 0 };
    let possible = possible_blockers(geometry);
    let way = method.way();
    let rows = match way {
        Way::Pairs(_) => Vec::new(),
        Way::Rows(rows) => rows(geometry, accuracy),
    };
    for i in 0..parts.len() {
        for j in 0..i {
            if !is_asked(i, j) || !see_each_other(&parts[i], &parts[j]) {
                exchange.areas.push(Estimate::default());
                continue;
            }
            let blockers = blockers_between(&possible, &parts[i], &parts[j]);
            match blockers[..] {
                [] => exchange.open_pairs += 1,
                _ => exchange.blocked_pairs += 1,
            }
            // From the smaller one to the larger: an error of its share is the same error of less area.
            let [a, b] = if parts[i].polygon.area > parts[j].polygon.area { [j, i] } else { [i, j] };
            exchange.areas.push(match way {
                Way::Pairs(share) => area(share(&parts[a].polygon, &parts[b].polygon, &blockers, accuracy), &parts[a]),
                Way::Rows(_) => mean(area(rows[a][b], &parts[a]), area(rows[b][a], &parts[b])),
            });
        }
    }
    exchange
}

fn see_each_other(a: &Piece, b: &Piece) -> bool {
    a.polygon.faces(&b.polygon) && b.polygon.faces(&a.polygon)
}

fn area(share: Estimate<f64>, sender: &Piece) -> Estimate<f64> {
    Estimate { value: share.value * sender.polygon.area, error: share.error * sender.polygon.area }
}

/// Of the same exchange, seen from both sides.
fn mean(a: Estimate<f64>, b: Estimate<f64>) -> Estimate<f64> {
    Estimate { value: 0.5 * (a.value + b.value), error: 0.5 * (a.error + b.error) }
}
