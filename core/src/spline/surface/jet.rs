//! A point of a surface with its derivatives, and the normal that they give.

use crate::math::{Real, Vector};

/// A point of a surface with its derivatives by `u` and `v`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceJet<V> {
    /// Position.
    pub point: V,
    /// By `u`.
    pub du: V,
    /// By `v`.
    pub dv: V,
    /// Twice by `u`.
    pub duu: V,
    /// By `u` and `v`.
    pub duv: V,
    /// Twice by `v`.
    pub dvv: V,
}

impl<V: Vector> SurfaceJet<V> {
    /// From `[a][b]`, the derivative `a` times by `u` and `b` times by `v`.
    pub fn new(derivatives: [[V; 3]; 3]) -> Self {
        let [[point, dv, dvv], [du, duv, _], [duu, ..]] = derivatives;
        Self { point, du, dv, duu, duv, dvv }
    }

    /// The normal of length 1; zero where the surface has none.
    ///
    /// Where an edge is collapsed to a point, `du x dv` vanishes. The normal is then the limit on the way to the inside,
    /// which `inwards` says in `u` and `v`: the direction in which `du x dv` grows (l'Hopital).
    pub fn normal(&self, inwards: [V::Scalar; 2]) -> V {
        let normal = self.du.cross(self.dv);
        let speed = self.du.length() + self.dv.length();
        // Nearer to a pole rounding errors of `du` are larger than what the limit leaves out.
        if normal.length() > V::Scalar::EPSILON.sqrt() * speed * speed {
            return normal.normalize_or_zero();
        }
        let [u, v] = inwards;
        let growth = (self.duu * u + self.duv * v).cross(self.dv) + self.du.cross(self.duv * u + self.dvv * v);
        growth.normalize_or_zero()
    }
}
