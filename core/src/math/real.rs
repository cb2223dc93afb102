//! Real numbers in single or double precision.

use core::fmt::Debug;
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use super::{double, single};

/// `f32` or `f64`.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
    + MulAssign
    + Div<Output = Self>
    + Neg<Output = Self>
    + Sum
{
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;
    /// The ratio of the circumference of a circle to its diameter.
    const PI: Self;
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;
    /// Larger than all numbers.
    const INFINITY: Self;
    /// 16 zeros, then 16 ones: in their middle lie the knots of Bezier curves up to degree 15.
    const STEP: &'static [Self; 32];

    /// The nearest number to `x`.
    fn from_f64(x: f64) -> Self;
    /// The same number in double precision.
    fn to_f64(self) -> f64;
    /// The nearest number to a count.
    fn from_usize(count: usize) -> Self;

    /// The whole part of a number; 0 below 0 and for NaN.
    fn to_usize(self) -> usize;

    /// Magnitude.
    fn abs(self) -> Self;
    /// Square root; NaN below 0.
    fn sqrt(self) -> Self;
    /// Sine of an angle in radians.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians.
    fn cos(self) -> Self;
    /// Tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Arc sine, in `[-pi/2, pi/2]`; NaN outside `[-1, 1]`.
    fn asin(self) -> Self;
    /// Arc cosine, in `[0, pi]`; NaN outside `[-1, 1]`.
    fn acos(self) -> Self;
    /// Arc tangent, in `[-pi/2, pi/2]`.
    fn atan(self) -> Self;
    /// The angle of the point `(x, self)`, in `[-pi, pi]`.
    fn atan2(self, x: Self) -> Self;
    /// `e` to the power of this.
    fn exp(self) -> Self;
    /// Natural logarithm; NaN below 0.
    fn ln(self) -> Self;
    /// `ln(1 + x)`, to full precision for small `x` too; NaN below -1.
    fn ln_1p(self) -> Self;
    /// The largest whole number that is not larger.
    fn floor(self) -> Self;

    /// The smaller one; the other one if this is NaN.
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    /// The larger one; the other one if this is NaN.
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    /// The nearest number in `[low, high]`.
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }
}

macro_rules! real {
    ($real:ident, $functions:ident, [$($name:ident),*]) => {
        impl Real for $real {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const PI: Self = core::$real::consts::PI;
            const EPSILON: Self = $real::EPSILON;
            const INFINITY: Self = $real::INFINITY;
            const STEP: &'static [Self; 32] = &[
                0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
                1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0,
            ];

            #[inline]
            fn from_f64(x: f64) -> Self {
                x as Self
            }
            #[inline]
            fn from_usize(count: usize) -> Self {
                count as Self
            }
            #[inline]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline]
            fn to_usize(self) -> usize {
                self as usize
            }
            #[inline]
            fn abs(self) -> Self {
                if self.is_sign_negative() { -self } else { self }
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                $functions::atan2(self, x)
            }
            $(
                #[inline]
                fn $name(self) -> Self {
                    $functions::$name(self)
                }
            )*
        }
    };
}

real!(f32, single, [sqrt, sin, cos, tan, asin, acos, atan, exp, ln, ln_1p, floor]);
real!(f64, double, [sqrt, sin, cos, tan, asin, acos, atan, exp, ln, ln_1p, floor]);
