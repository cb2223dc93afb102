//! What is carried by light: grey, RGB, or any number of wavelength bands, each on its own.

mod cornell;
mod srgb;

pub use cornell::*;
pub use srgb::*;

use core::ops::{Add, AddAssign, Mul, Sub};

use glam::{DVec3, Vec3, Vec3A};

use crate::math::Real;

/// A quantity with one number for each band. Products are band by band: bands do not mix in diffuse reflection.
pub trait Spectrum:
    Copy
    + Default
    + PartialEq
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<Self::Scalar, Output = Self>
    + Send
    + Sync
{
    /// The number of one band.
    type Scalar: Real;

    /// The same number in all bands.
    fn splat(value: Self::Scalar) -> Self;
    /// The largest magnitude of all bands.
    fn max_abs(self) -> Self::Scalar;
    /// Applies a function of two numbers band by band.
    fn zip(self, other: Self, apply: impl Fn(Self::Scalar, Self::Scalar) -> Self::Scalar) -> Self;
    /// The bands whose bit is set, from the lowest on; the others, and those beyond the 32nd, become zero.
    fn keep(self, bits: u32) -> Self;
}

macro_rules! gray {
    ($real:ident) => {
        impl Spectrum for $real {
            type Scalar = Self;

            fn splat(value: Self) -> Self {
                value
            }
            fn max_abs(self) -> Self {
                Real::abs(self)
            }
            fn zip(self, other: Self, apply: impl Fn(Self, Self) -> Self) -> Self {
                apply(self, other)
            }
            fn keep(self, bits: u32) -> Self {
                if bits & 1 == 1 { self } else { 0.0 }
            }
        }
    };
}

gray!(f32);
gray!(f64);

macro_rules! rgb {
    ($vector:ident, $real:ident) => {
        impl Spectrum for $vector {
            type Scalar = $real;

            fn splat(value: $real) -> Self {
                $vector::splat(value)
            }
            fn max_abs(self) -> $real {
                self.abs().max_element()
            }
            fn zip(self, other: Self, apply: impl Fn($real, $real) -> $real) -> Self {
                Self::new(apply(self.x, other.x), apply(self.y, other.y), apply(self.z, other.z))
            }
            fn keep(self, bits: u32) -> Self {
                let kept = |band: u32, value: $real| if bits >> band & 1 == 1 { value } else { 0.0 };
                Self::new(kept(0, self.x), kept(1, self.y), kept(2, self.z))
            }
        }
    };
}

rgb!(Vec3, f32);
rgb!(Vec3A, f32);
rgb!(DVec3, f64);

/// `N` wavelength bands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bands<const N: usize, R = f32>(pub [R; N]);

impl<const N: usize, R: Real> Default for Bands<N, R> {
    fn default() -> Self {
        Self([R::ZERO; N])
    }
}

impl<const N: usize, R: Real> Add for Bands<N, R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize, R: Real> AddAssign for Bands<N, R> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize, R: Real> Sub for Bands<N, R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize, R: Real> Mul for Bands<N, R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize, R: Real> Mul<R> for Bands<N, R> {
    type Output = Self;
    fn mul(self, factor: R) -> Self {
        Self(self.0.map(|a| a * factor))
    }
}

impl<const N: usize, R: Real> Spectrum for Bands<N, R> {
    type Scalar = R;

    fn splat(value: R) -> Self {
        Self([value; N])
    }
    fn max_abs(self) -> R {
        self.0.iter().fold(R::ZERO, |largest, &a| largest.max(a.abs()))
    }
    fn zip(self, other: Self, apply: impl Fn(R, R) -> R) -> Self {
        Self(core::array::from_fn(|band| apply(self.0[band], other.0[band])))
    }
    fn keep(self, bits: u32) -> Self {
        Self(core::array::from_fn(|band| if band < 32 && bits >> band & 1 == 1 { self.0[band] } else { R::ZERO }))
    }
}
