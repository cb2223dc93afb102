//! From exchange areas of polygons to view factors of surfaces, closed rows and gray exchange.

use radiosity::form_factor::{Bins, DenseRows, MatrixError, repair_closure};
use radiosity::solve::{Stop, System, gauss_seidel};

use crate::exchange::Exchange;
use crate::geometry::{Geometry, Reported};

/// Light that has not died out after so many sweeps never will.
const MOST_SWEEPS: usize = 10_000;

/// The matrix `F_ij` of the reported surfaces.
#[derive(Clone, Debug)]
pub struct ViewFactors {
    pub count: usize,
    /// `F_ij` at `i x count + j`.
    factors: Vec<f64>,
    areas: Vec<f64>,
    /// Of each row: the estimated sum of the errors of its view factors.
    pub errors: Vec<f64>,
}

impl ViewFactors {
    /// Adds up the exchange of the parts.
    pub fn new(geometry: &Geometry, exchange: &Exchange) -> Self {
        let rows = &geometry.reported;
        let areas = rows.iter().map(|row| row.area).collect();
        let count = rows.len();
        let mut factors = Self { count, factors: vec![0.0; count * count], areas, errors: vec![0.0; count] };
        for i in 0..count {
            for j in 0..count {
                let (area, error) = sum(&rows[i], &rows[j], exchange);
                // What is less than nothing is rounding, where a part takes all of its base.
                factors.factors[i * count + j] = area.max(0.0) / rows[i].area;
                factors.errors[i] += error / rows[i].area;
            }
            for &(mask, area) in &rows[i].masks {
                factors.factors[i * count + mask] += area / rows[i].area;
            }
        }
        factors
    }

    /// Share of what leaves surface `i` that reaches surface `j`.
    pub fn factor(&self, i: usize, j: usize) -> f64 {
        self.factors[i * self.count + j]
    }

    pub fn row(&self, i: usize) -> &[f64] {
        &self.factors[i * self.count..(i + 1) * self.count]
    }

    pub fn row_sum(&self, i: usize) -> f64 {
        self.row(i).iter().sum()
    }

    /// Scaled so that all rows sum to 1 and reciprocity stays.
    pub fn closed(&self) -> Result<Self, MatrixError> {
        let mut closed = self.clone();
        let mut rows = DenseRows::new(self.count, &mut closed.factors)?;
        let (mut bins, mut scales) = (vec![Bins::default(); self.count], vec![1.0; self.count]);
        repair_closure(&self.areas, &mut rows, &mut bins, &mut scales)?;
        Ok(closed)
    }

    /// Hottel's total exchange: the share of the black-body power of `i` that `j` absorbs, reflections included.
    ///
    /// Row `i` solves the radiosity equation for one surface that emits; `j` absorbs `epsilon_j` of what it receives.
    /// Rows of an enclosure sum to the emissivity. Nothing, where light never dies out: in a room of mirrors. Hottel
    /// and Sarofim 1967, chapter 3.
    pub fn total_exchange(&self, emissivities: &[f64]) -> Option<Self> {
        let reflectance: Vec<f64> = emissivities.iter().map(|emissivity| 1.0 - emissivity).collect();
        let mut factors = self.factors.clone();
        let form_factors = DenseRows::new(self.count, &mut factors).expect("the matrix is square");
        let dark = vec![0.0; self.count];
        let room = System::new(&dark, &reflectance, &form_factors).look_ahead(&mut dark.clone(), MOST_SWEEPS);
        let mut total = self.clone();
        for i in 0..self.count {
            let mut exitance = dark.clone();
            exitance[i] = emissivities[i];
            let mut radiosity = exitance.clone();
            let system = System { exitance: &exitance, ..room };
            let stop = Stop { tolerance: 1e-12, most_steps: MOST_SWEEPS };
            if !gauss_seidel(&system, &mut radiosity, &stop).is_converged {
                return None;
            }
            for (j, emissivity) in emissivities.iter().enumerate() {
                let received: f64 =
                    self.row(j).iter().zip(&radiosity).map(|(factor, radiosity)| factor * radiosity).sum();
                total.factors[i * self.count + j] = self.areas[j] * emissivity * received / self.areas[i];
            }
        }
        Some(total)
    }
}

/// The exchange area of two surfaces and its error.
fn sum(a: &Reported, b: &Reported, exchange: &Exchange) -> (f64, f64) {
    let (mut area, mut error) = (0.0, 0.0);
    for &(part, weight) in &a.weights {
        for &(other, other_weight) in &b.weights {
            let between = exchange.between(part, other);
            area += weight * other_weight * between.value;
            error += between.error;
        }
    }
    (area, error)
}
