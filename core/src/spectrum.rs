//! What is carried by light: grey, RGB, or any number of wavelength bands, each on its own.

use core::ops::{Add, AddAssign, Mul, Sub};

use glam::Vec3;

/// A quantity with one number for each band. Products are band by band: bands do not mix in diffuse reflection.
pub trait Spectrum:
    Copy
    + Default
    + PartialEq
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f32, Output = Self>
{
    /// The largest magnitude of all bands.
    fn max_abs(self) -> f32;
}

impl Spectrum for f32 {
    fn max_abs(self) -> f32 {
        self.max(-self)
    }
}

impl Spectrum for Vec3 {
    fn max_abs(self) -> f32 {
        self.abs().max_element()
    }
}

/// `N` wavelength bands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bands<const N: usize>(pub [f32; N]);

impl<const N: usize> Bands<N> {
    fn zip(self, other: Self, apply: impl Fn(f32, f32) -> f32) -> Self {
        Self(core::array::from_fn(|band| apply(self.0[band], other.0[band])))
    }
}

impl<const N: usize> Default for Bands<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl<const N: usize> Add for Bands<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> AddAssign for Bands<N> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> Sub for Bands<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Bands<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Mul<f32> for Bands<N> {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self(self.0.map(|a| a * factor))
    }
}

impl<const N: usize> Spectrum for Bands<N> {
    fn max_abs(self) -> f32 {
        self.0.iter().fold(0.0, |largest, &a| largest.max(a.max(-a)))
    }
}
