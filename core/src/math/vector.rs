//! Vectors of three reals in single or double precision.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use glam::{DVec3, Vec3};

use super::Real;

/// glam's `Vec3` or `DVec3`.
pub trait Vector:
    Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<Self::Scalar, Output = Self>
    + Div<Self::Scalar, Output = Self>
{
    /// What it has three of.
    type Scalar: Real;

    /// From its coordinates.
    fn from_array(coordinates: [Self::Scalar; 3]) -> Self;
    /// Its coordinates.
    fn to_array(self) -> [Self::Scalar; 3];
    /// Scalar product.
    fn dot(self, other: Self) -> Self::Scalar;
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
    /// Length.
    #[inline]
    fn length(self) -> Self::Scalar {
        self.dot(self).sqrt()
    }
    /// Square of the length.
    #[inline]
    fn length_squared(self) -> Self::Scalar {
        self.dot(self)
    }
    /// The direction, with length 1; zero where there is none.
    #[inline]
    fn normalize_or_zero(self) -> Self {
        let length = self.length();
        if length > Self::Scalar::ZERO { self / length } else { Self::default() }
    }
    /// The point at share `t` of the way to another.
    #[inline]
    fn lerp(self, other: Self, t: Self::Scalar) -> Self {
        self + (other - self) * t
    }
}

macro_rules! vector {
    ($vector:ident, $real:ident) => {
        impl Vector for $vector {
            type Scalar = $real;

            #[inline]
            fn from_array(coordinates: [$real; 3]) -> Self {
                $vector::from_array(coordinates)
            }
            #[inline]
            fn to_array(self) -> [$real; 3] {
                $vector::to_array(&self)
            }
            #[inline]
            fn dot(self, other: Self) -> $real {
                $vector::dot(self, other)
            }
            #[inline]
            fn cross(self, other: Self) -> Self {
                $vector::cross(self, other)
            }
        }
    };
}

vector!(Vec3, f32);
vector!(DVec3, f64);
