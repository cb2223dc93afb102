//! The radiosity equation `b = e + rho F b`: three ways to the same solution, from any start.
//!
//! All solvers work on slices and are generic over the bands of light. `b` and `e` may be radiosities or radiances:
//! the factor pi between them cancels.

mod chebyshev;
mod gauss_seidel;
mod jacobi;
mod sparse;

pub use chebyshev::*;
pub use gauss_seidel::*;
pub use jacobi::*;

use crate::math::Real;
use crate::spectrum::Spectrum;

/// The form factors of a system, a row on demand.
pub trait FormFactors {
    /// Single or double precision.
    type Scalar: Real;

    /// Calls `entry` with `j` and `F_ij` for each `j` that patch `i` sees, in a fixed order.
    fn row(&self, i: usize, entry: impl FnMut(usize, Self::Scalar));

    /// `sum_j F_ij b_j`: what patch `i` receives.
    fn receive<S: Spectrum<Scalar = Self::Scalar>>(&self, i: usize, radiosity: &[S]) -> S {
        let mut sum = S::default();
        self.row(i, |j, factor| sum += radiosity[j] * factor);
        sum
    }
}

/// A full square matrix, row after row.
#[derive(Clone, Copy, Debug)]
pub struct Dense<'a, R> {
    /// Of one row, and of one column.
    pub count: usize,
    /// `count x count` form factors; `F_ij` stands at `i x count + j`.
    pub factors: &'a [R],
}

impl<R: Real> FormFactors for Dense<'_, R> {
    type Scalar = R;

    fn row(&self, i: usize, mut entry: impl FnMut(usize, R)) {
        let row = &self.factors[i * self.count..(i + 1) * self.count];
        row.iter().enumerate().for_each(|(j, &factor)| entry(j, factor));
    }
}

/// A radiosity system: what the patches emit and reflect. All slices have one entry for each patch.
#[derive(Clone, Copy, Debug)]
pub struct System<'a, S, F> {
    /// Exitance `e` of each patch.
    pub exitance: &'a [S],
    /// Reflectance `rho` of each patch, in `[0, 1)`.
    pub reflectance: &'a [S],
    /// `F`, with rows that sum to at most 1.
    pub form_factors: &'a F,
}

impl<S: Spectrum, F: FormFactors<Scalar = S::Scalar>> System<'_, S, F> {
    /// The right-hand side `e_i + rho_i sum_j F_ij b_j`.
    fn update(&self, i: usize, radiosity: &[S]) -> S {
        self.exitance[i] + self.reflectance[i] * self.form_factors.receive(i, radiosity)
    }

    /// The largest reflectance of any patch in any band: it bounds how fast the light dies out.
    fn largest_reflectance(&self) -> S::Scalar {
        self.reflectance.iter().fold(S::Scalar::ZERO, |largest, rho| largest.max(rho.max_abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Bands;

    type Solver<S> = fn(&System<S, Dense<f32>>, &mut [S], &mut [S], f32, usize) -> usize;

    /// Form factors between the walls of a cube: 0.1998 to the opposite wall, the rest shared by the other four.
    fn cube() -> [f32; 36] {
        let opposite = 0.199_824_9;
        let adjacent = (1.0 - opposite) / 4.0;
        core::array::from_fn(|k| match (k / 6, k % 6) {
            (i, j) if i == j => 0.0,
            (i, j) if i / 2 == j / 2 => opposite,
            _ => adjacent,
        })
    }

    fn solvers<S: Spectrum<Scalar = f32>>() -> [Solver<S>; 3] {
        [
            |system, b, scratch, tolerance, sweeps| jacobi(system, b, scratch, tolerance, sweeps),
            |system, b, _, tolerance, sweeps| gauss_seidel(system, b, tolerance, sweeps),
            |system, b, scratch, tolerance, sweeps| chebyshev(system, b, scratch, tolerance, sweeps),
        ]
    }

    /// In a closed enclosure of uniform rho and e, every patch ends at b = e / (1 - rho).
    #[test]
    fn white_furnace_from_any_start() {
        let factors = cube();
        let system = System {
            exitance: &[1.0; 6],
            reflectance: &[0.75; 6],
            form_factors: &Dense { count: 6, factors: &factors },
        };
        for solve in solvers::<f32>() {
            for start in [0.0, 3.0, 100.0] {
                let (mut b, mut scratch) = ([start; 6], [0.0; 12]);
                solve(&system, &mut b, &mut scratch, 1e-6, 200);
                assert!(b.iter().all(|b| (b - 4.0).abs() < 1e-4), "{b:?}");
            }
        }
    }

    /// Bands do not mix: three bands at once are three systems of one band.
    #[test]
    fn each_band_on_its_own() {
        let factors = cube();
        let reflectance: [Bands<3>; 6] = core::array::from_fn(|i| Bands([0.1, 0.5, 0.9 - 0.1 * i as f32]));
        let exitance: [Bands<3>; 6] = core::array::from_fn(|i| Bands([i as f32, 1.0, (i == 2) as u8 as f32]));
        let mut together = [Bands::<3>::default(); 6];
        let system = System {
            exitance: &exitance,
            reflectance: &reflectance,
            form_factors: &Dense { count: 6, factors: &factors },
        };
        gauss_seidel(&system, &mut together, 1e-7, 400);
        for band in 0..3 {
            let (e, rho) = (exitance.map(|e| e.0[band]), reflectance.map(|rho| rho.0[band]));
            let system =
                System { exitance: &e, reflectance: &rho, form_factors: &Dense { count: 6, factors: &factors } };
            for solve in solvers::<f32>() {
                let (mut b, mut scratch) = ([0.0; 6], [0.0; 12]);
                solve(&system, &mut b, &mut scratch, 1e-7, 400);
                (0..6).for_each(|i| assert!((b[i] - together[i].0[band]).abs() < 1e-4));
            }
        }
    }

    /// Each sweep of Gauss-Seidel uses what it just found, so it needs fewer; Chebyshev fewer still at high rho.
    #[test]
    fn sweeps_are_ordered_as_in_theory() {
        let factors = cube();
        let system = System {
            exitance: &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            reflectance: &[0.9; 6],
            form_factors: &Dense { count: 6, factors: &factors },
        };
        let [jacobi, gauss_seidel, chebyshev] =
            solvers::<f32>().map(|solve| solve(&system, &mut [0.0; 6], &mut [0.0; 12], 1e-4, 1000));
        assert!(gauss_seidel < jacobi && chebyshev < jacobi, "{jacobi} {gauss_seidel} {chebyshev}");
    }
}
