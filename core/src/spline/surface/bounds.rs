//! Boxes around surfaces.

use super::{BSplineSurface, SurfacePoint};
use crate::spline::split::hull;

impl<P: SurfacePoint> BSplineSurface<'_, P> {
    /// The lowest and the highest corner of a box around the control points, and so around the surface.
    pub fn bounds(&self) -> [P::Point; 2] {
        hull(self.points())
    }
}
