//! The knots of Bezier curves.

use crate::math::Real;
use crate::spline::{KnotVector, MAX_DEGREE, SplineError};

impl<R: Real> KnotVector<'static, R> {
    /// The knots of a Bezier curve: as many zeros and ones as it has points.
    ///
    /// # Errors
    ///
    /// Where the degree is above [`MAX_DEGREE`].
    pub fn bezier(degree: usize) -> Result<Self, SplineError> {
        let spare = MAX_DEGREE.checked_sub(degree).ok_or(SplineError::Degree { degree })?;
        Ok(Self::trusted(&R::STEP[spare..spare + 2 * (degree + 1)], degree))
    }
}
