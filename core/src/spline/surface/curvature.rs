//! How a surface bends.

use super::SurfaceJet;
use crate::math::{Real, Vector};

/// How a surface bends at a point, in one over meters; above 0 where it bends towards its front.
///
/// All are zero where the surface has no tangent plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Curvature<R> {
    /// The product of the principal curvatures: above 0 on a dome, below on a saddle.
    pub gaussian: R,
    /// The mean of the principal curvatures.
    pub mean: R,
    /// The largest and the smallest curvature of all sections along the normal.
    pub principal: [R; 2],
}

impl<V: Vector> SurfaceJet<V> {
    /// The curvatures: `K = (l n - m^2) / (e g - f^2)` and `H = (e n - 2 f m + g l) / 2 (e g - f^2)` of both fundamental
    /// forms. Do Carmo, "Differential Geometry of Curves and Surfaces", section 3.3.
    pub fn curvature(&self) -> Curvature<V::Scalar> {
        let two = V::Scalar::from_f64(2.0);
        let cross = self.du.cross(self.dv);
        let area_squared = cross.length_squared();
        if area_squared.partial_cmp(&V::Scalar::ZERO).is_none_or(core::cmp::Ordering::is_le) {
            return Curvature::default();
        }
        let normal = cross / area_squared.sqrt();
        let [e, f, g] = [self.du.dot(self.du), self.du.dot(self.dv), self.dv.dot(self.dv)];
        let [l, m, n] = [self.duu, self.duv, self.dvv].map(|second| second.dot(normal));
        let gaussian = (l * n - m * m) / area_squared;
        let mean = (e * n - two * f * m + g * l) / (two * area_squared);
        let half_spread = (mean * mean - gaussian).max(V::Scalar::ZERO).sqrt();
        Curvature { gaussian, mean, principal: [mean + half_spread, mean - half_spread] }
    }
}
