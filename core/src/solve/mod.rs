//! The radiosity equation `b = e + rho F b`: six ways to the same solution, from any start.
//!
//! Each patch has the radiosity that it emits and its reflectance times what it receives. Lecture notes at times print
//! the iteration without `rho_i`; then it does not converge in a closed room, where `F` alone loses no light. `b` and `e`
//! may be radiosities or radiances: the factor pi between them cancels.
//!
//! A [`System`] has slices of `e` and `rho`, and form factors that give a row on demand ([`FormFactors`]). Nothing is
//! allocated; the caller lends memory. All bands of light are solved at once, each as if it were alone.
//!
//! ```
//! use radiosity::solve::{Dense, Stop, System, gauss_seidel};
//!
//! // Two plates that see each other by 0.4; the first one glows.
//! let form_factors = Dense { count: 2, factors: &[0.0, 0.4, 0.4, 0.0] };
//! let system = System::new(&[1.0, 0.0], &[0.5, 0.5], &form_factors);
//! let mut radiosity = [0.0; 2];
//! let solution = gauss_seidel(&system, &mut radiosity, &Stop { tolerance: 1e-9, most_steps: 100 });
//! assert!(solution.is_converged && solution.bound < 1e-8);
//! assert!((radiosity[1] - 0.2_f64 / 0.96).abs() < 1e-9);
//! ```
//!
//! # Which one
//!
//! | | memory, in patches | needs | sweeps to 1e-4, `rho` 0.5, 0.8, 0.95 |
//! |---|---|---|---|
//! | [`jacobi`] | 1 | | 6, 22, 125 |
//! | [`gauss_seidel`] | 0 | patches in an order | 5, 14, 71 |
//! | [`over_relaxation`] | 0 | patches in an order; reciprocity | 4, 8, 20 |
//! | [`southwell`] | 1 | areas; reciprocity; one row for each shot | 3, 13, 70 |
//! | [`chebyshev`] | 2 | reciprocity, up to noise | 5, 10, 25 |
//! | [`conjugate_gradient`] | 3 | areas; reciprocity; sums over all patches | 4, 6, 9 |
//!
//! The picture is from `examples/convergence.rs`: a closed cube of 294 patches, lit by one of them, until the error is
//! certainly below 1e-6. Dashed is what theory says: `ln 1e-6 / ln rho` for Jacobi, and
//! `ln 2e6 / ln((1 + sqrt(1 - rho^2)) / rho)` for Chebyshev. As many shots as there are patches count as one sweep.
//!
//! <div style="max-width: 45em">
#![doc = include_str!("convergence.svg")]
//! </div>
//!
//! With form factors that obey reciprocity conjugate gradients win: they save a quarter of the sweeps of Chebyshev at
//! `rho` 0.5, half at 0.8 and seven eighths at 0.99. The bake uses Chebyshev all the same. Its form factors are counts
//! of rays, which obey reciprocity only up to noise: measured on rooms with hundreds of small boxes and `rho` 0.98,
//! conjugate gradients come to an error of 1e-3 in half the sweeps (19 to 25 against 42 to 56) and do not reach 1e-5
//! at all, where Chebyshev takes 68 to 103. Nor does it sum over patches, so that all rows can run in parallel with the
//! same bits for any number of threads. On one core, and without memory to spare, over-relaxation by
//! [`OverRelaxation::new`] is as fast. Shooting shows most of the light first: its first shots are those of the
//! lamps, and its ambient term ([`Southwell::ambient`]) stands in for what is still under way.
//!
//! # When it is done
//!
//! All stop on what is certain: with the residual `r = e + rho F b - b`,
//! `max |b - b*| <= max |r| / (1 - c)`, where `c = max_i rho_i sum_j F_ij <= rho_max` ([`Decay`]). In an open scene `c`
//! is below 1 even where `rho` is 1. In a closed one, patches that reflect all make `c = 1`; if light is absorbed
//! elsewhere there still is a solution, and [`System::look_ahead`] finds a bound that is finite. If nothing absorbs
//! there is none: what is emitted gathers forever. Then all solvers use up their steps, say that they are not
//! converged, and give an infinite bound.
//!
//! Each is also a [`Solver`] that goes step by step, for views that show what is there and for machines that have other
//! things to do; a [`GaussSeidelSweep`] stops after any number of patches. [`Reciprocal`] is a matrix in a quarter of its
//! memory, for small targets.

mod chebyshev;
mod conjugate_gradient;
mod decay;
mod exchanges;
mod gauss_seidel;
mod jacobi;
mod over_relaxation;
mod solver;
mod southwell;
mod sparse;
mod start;
mod system;

pub use chebyshev::*;
pub use conjugate_gradient::*;
pub use decay::*;
pub use exchanges::*;
pub use gauss_seidel::*;
pub use jacobi::*;
pub use over_relaxation::*;
pub use solver::*;
pub use southwell::*;
pub use start::*;
pub use system::*;
