//! Vectors of three reals in single or double precision.

use glam::{DVec3, Vec3, Vec3A};

use super::{Real, VectorSpace};

/// glam's `Vec3`, `Vec3A` or `DVec3`.
pub trait Vector: VectorSpace {
    /// From its coordinates.
    fn from_array(coordinates: [Self::Scalar; 3]) -> Self;
    /// Its coordinates.
    fn to_array(self) -> [Self::Scalar; 3];
    /// Vector product.
    fn cross(self, other: Self) -> Self;

    /// The nearest vector to one in double precision.
    fn from_dvec3(vector: DVec3) -> Self {
        Self::from_array(vector.to_array().map(Self::Scalar::from_f64))
    }
    /// The same vector in double precision.
    fn to_dvec3(self) -> DVec3 {
        DVec3::from_array(self.to_array().map(Self::Scalar::to_f64))
    }
}

macro_rules! vector {
    ($vector:ident, $real:ident) => {
        impl Vector for $vector {
            #[inline]
            fn from_array(coordinates: [$real; 3]) -> Self {
                $vector::from_array(coordinates)
            }
            #[inline]
            fn to_array(self) -> [$real; 3] {
                $vector::to_array(&self)
            }
            #[inline]
            fn cross(self, other: Self) -> Self {
                $vector::cross(self, other)
            }
        }
    };
}

vector!(Vec3, f32);
vector!(Vec3A, f32);
vector!(DVec3, f64);
