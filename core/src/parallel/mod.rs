//! Work cut into chunks whose results come back in order, so that the number of threads changes nothing.

#[cfg(not(feature = "parallel"))]
mod sequential;
#[cfg(feature = "parallel")]
mod threads;

#[cfg(not(feature = "parallel"))]
pub use sequential::Workers;
#[cfg(feature = "parallel")]
pub use threads::Workers;
