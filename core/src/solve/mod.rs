//! The radiosity equation `b = e + rho F b`: six ways to the same solution, from any start.

mod chebyshev;
mod conjugate_gradient;
mod decay;
mod gauss_seidel;
mod jacobi;
mod over_relaxation;
mod solver;
mod southwell;
mod start;
mod system;

pub use chebyshev::*;
pub use conjugate_gradient::*;
pub use decay::*;
pub use gauss_seidel::*;
pub use jacobi::*;
pub use over_relaxation::*;
pub use solver::*;
pub use southwell::*;
pub use start::*;
pub use system::*;
