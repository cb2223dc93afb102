//! What surfaces are made of: points in space, or points in space with weights.

use glam::{DVec3, Vec3, Vec3A};

use crate::math::{Real, Vector};
use crate::spline::{ControlPoint, Homogeneous};

/// A control point of a surface: a point in space, or a [`Homogeneous`] one.
pub trait SurfacePoint: ControlPoint<Point: Vector> {
    /// From the derivatives `[a][b]`, `a` times by `u` and `b` times by `v`, in the space of the control points, to those
    /// in the space where the surface lies; those with `a + b >= N` are zero.
    fn project_partials<const N: usize>(partials: [[Self; N]; N]) -> [[Self::Point; N]; N];

    /// The point moved by a vector, with the same weight.
    fn moved(self, by: Self::Point) -> Self;

    /// The point times its weight, and the weight.
    fn to_scaled(self) -> (Self::Point, Self::Scalar);
}

macro_rules! plain {
    ($($vector:ident),*) => {$(
        impl SurfacePoint for $vector {
            #[inline(always)]
            fn project_partials<const N: usize>(partials: [[Self; N]; N]) -> [[Self; N]; N] {
                partials
            }
            fn moved(self, by: Self) -> Self {
                self + by
            }
            #[inline(always)]
            fn to_scaled(self) -> (Self, Self::Scalar) {
                (self, 1.0)
            }
        }
    )*};
}

plain!(Vec3, Vec3A, DVec3);

impl<V: Vector> SurfacePoint for Homogeneous<V> {
    /// Leibniz's rule for `scaled = weight * point`, solved for the point: Piegl and Tiller, "The NURBS Book", equation
    /// 4.20.
    #[inline]
    fn project_partials<const N: usize>(partials: [[Self; N]; N]) -> [[V; N]; N] {
        let mut projected = [[V::default(); N]; N];
        let reciprocal = V::Scalar::ONE / partials[0][0].weight;
        for k in 0..N {
            for l in 0..N - k {
                let mut rest = partials[k][l].scaled;
                let mut of_k = V::Scalar::ONE;
                for i in 0..=k {
                    let mut of_both = of_k;
                    for j in 0..=l {
                        if i + j > 0 {
                            rest = rest - projected[k - i][l - j] * (of_both * partials[i][j].weight);
                        }
                        of_both = of_both * V::Scalar::from_usize(l - j) / V::Scalar::from_usize(j + 1);
                    }
                    of_k = of_k * V::Scalar::from_usize(k - i) / V::Scalar::from_usize(i + 1);
                }
                projected[k][l] = rest * reciprocal;
            }
        }
        projected
    }
    fn moved(self, by: V) -> Self {
        Self { scaled: self.scaled + by * self.weight, weight: self.weight }
    }
    #[inline(always)]
    fn to_scaled(self) -> (V, V::Scalar) {
        (self.scaled, self.weight)
    }
}
