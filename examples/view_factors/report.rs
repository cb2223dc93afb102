//! What the user sees.

use std::fmt;

use crate::factors::ViewFactors;
use crate::solution::Solution;
use crate::vs3::Kind;

impl fmt::Display for Solution {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.header(f)?;
        if self.input.control.list >= 3 {
            self.corners(f)?;
        }
        self.surfaces(f)?;
        if self.input.control.list >= 2 && self.closed.is_some() {
            self.matrix(f, "View factors, as computed", &self.factors)?;
        }
        match &self.closed {
            Some(closed) => self.matrix(f, "View factors, scaled so that rows sum to 1", closed)?,
            None => self.matrix(f, "View factors", &self.factors)?,
        }
        match &self.total {
            Some(total) => self.matrix(f, "Total exchange (script F), with reflections", total),
            None => Ok(()),
        }
    }
}

impl Solution {
    fn header(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}\n", self.input.title)?;
        let (given, reported) = (self.input.surfaces.len(), self.geometry.reported.len());
        let obstructions = self.input.surfaces.iter().filter(|surface| surface.kind == Kind::Obstruction).count();
        writeln!(f, "{given} entries: {reported} surfaces to report, {obstructions} obstructions")?;
        let exchange = &self.exchange;
        writeln!(
            f,
            "{} pairs with an open view, {} with something between",
            exchange.open_pairs, exchange.blocked_pairs
        )?;
        writeln!(f, "method {}, accuracy {:.1e}, {:.3} ms\n", self.method.name(), self.accuracy, 1e3 * self.seconds)
    }

    fn corners(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for surface in &self.input.surfaces {
            write!(f, "{:>5} {:?}", surface.number, surface.kind)?;
            surface.corners.iter().try_for_each(|c| write!(f, "  ({}, {}, {})", c.x, c.y, c.z))?;
            writeln!(f)?;
        }
        writeln!(f)
    }

    fn surfaces(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [area, sum, rest] = ["area", "row sum", "1 - sum"];
        writeln!(f, "{:>5} {area:>16} emissivity {sum:>17} {rest:>9} est. error  name", "row")?;
        for i in self.rows() {
            let surface = &self.geometry.reported[i];
            let (sum, error) = (self.factors.row_sum(i), self.factors.errors[i]);
            write!(f, "{:>5} {:>16.9} {:>10.4}", i + 1, surface.area, surface.emissivity)?;
            write!(f, " {sum:>17.14} {:>9.1e} {error:>10.1e}  {}", 1.0 - sum, surface.name)?;
            match &surface.numbers[..] {
                [number] if *number == i + 1 => writeln!(f)?,
                numbers => {
                    writeln!(f, " (surfaces {})", numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(" "))?
                }
            }
        }
        Ok(())
    }

    fn matrix(&self, f: &mut fmt::Formatter, title: &str, factors: &ViewFactors) -> fmt::Result {
        writeln!(f, "\n{title}:")?;
        for i in self.rows() {
            write!(f, "{:>5}", i + 1)?;
            self.columns().try_for_each(|j| write!(f, " {:.14}", factors.factor(i, j)))?;
            writeln!(f)?;
        }
        Ok(())
    }
}
