//! Points and vectors of any dimension: what can be added, scaled and measured.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use glam::{DVec2, DVec3, DVec4, Vec2, Vec3, Vec3A, Vec4};

use super::Real;

/// A real number, or a vector of glam of two to four of them.
pub trait VectorSpace:
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
    /// What its coordinates are.
    type Scalar: Real;
    /// How many it has.
    const DIMENSION: usize;

    /// The vector that has these coordinates.
    fn from_fn(coordinate: impl FnMut(usize) -> Self::Scalar) -> Self;
    /// The coordinate along an axis below [`DIMENSION`](Self::DIMENSION); zero for other axes.
    fn coordinate(self, axis: usize) -> Self::Scalar;
    /// Scalar product.
    fn dot(self, other: Self) -> Self::Scalar;

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
    /// Whether no coordinate is infinite or no number.
    #[inline]
    fn is_finite(self) -> bool {
        (0..Self::DIMENSION).all(|axis| self.coordinate(axis).abs() < Self::Scalar::INFINITY)
    }
}

macro_rules! number {
    ($($real:ident),*) => {$(
        impl VectorSpace for $real {
            type Scalar = $real;
            const DIMENSION: usize = 1;

            #[inline]
            fn from_fn(mut coordinate: impl FnMut(usize) -> $real) -> Self {
                coordinate(0)
            }
            #[inline]
            fn coordinate(self, axis: usize) -> $real {
                [self].get(axis).copied().unwrap_or_default()
            }
            #[inline]
            fn dot(self, other: Self) -> $real {
                self * other
            }
        }
    )*};
}

macro_rules! space {
    ($($vector:ident of $dimension:literal $real:ident),*) => {$(
        impl VectorSpace for $vector {
            type Scalar = $real;
            const DIMENSION: usize = $dimension;

            #[inline]
            fn from_fn(coordinate: impl FnMut(usize) -> $real) -> Self {
                $vector::from_array(core::array::from_fn(coordinate))
            }
            #[inline]
            fn coordinate(self, axis: usize) -> $real {
                self.to_array().get(axis).copied().unwrap_or_default()
            }
            #[inline]
            fn dot(self, other: Self) -> $real {
                $vector::dot(self, other)
            }
        }
    )*};
}

number!(f32, f64);
space!(Vec2 of 2 f32, Vec3 of 3 f32, Vec3A of 3 f32, Vec4 of 4 f32, DVec2 of 2 f64, DVec3 of 3 f64, DVec4 of 4 f64);
