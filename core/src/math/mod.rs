//! Float functions: those of std, or those of libm where the bits must be the same on every target.
//!
//! The functions here are those of `f32`. What has to be exact is generic over [`Real`], `f32` or `f64`, and over
//! [`Vector`], glam's `Vec3`, `Vec3A` or `DVec3`; what has no directions, over any [`VectorSpace`].

#[cfg(all(target_arch = "arm", target_abi = "eabihf", any(feature = "libm", not(feature = "std"))))]
mod hardware_sqrt;
mod real;
mod space;
mod vector;

pub use real::*;
pub use single::*;
pub use space::*;
pub use vector::*;

#[cfg(any(feature = "libm", not(feature = "std")))]
mod single {
    pub use libm::{
        acosf as acos, asinf as asin, atan2f as atan2, atanf as atan, ceilf as ceil, cosf as cos, exp2f as exp2,
        expf as exp, expm1f as exp_m1, floorf as floor, log1pf as ln_1p, log2f as log2, logf as ln, powf,
        roundf as round, sinf as sin, tanf as tan,
    };

    #[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
    pub use super::hardware_sqrt::sqrt;
    #[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
    pub use libm::sqrtf as sqrt;

    /// Sine and cosine of an angle in radians.
    pub fn sin_cos(x: f32) -> (f32, f32) {
        (sin(x), cos(x))
    }
}

#[cfg(any(feature = "libm", not(feature = "std")))]
mod double {
    pub use libm::{acos, asin, atan, atan2, cos, exp, floor, log as ln, log1p as ln_1p, sin, sqrt, tan};
}

#[cfg(all(feature = "std", not(feature = "libm")))]
macro_rules! of_std {
    ($real:ident: $($name:ident),*) => {
        $(
            #[doc = concat!("`", stringify!($real), "::", stringify!($name), "`")]
            #[inline]
            pub fn $name(x: $real) -> $real {
                x.$name()
            }
        )*

        /// The angle of the point `(x, y)`.
        #[inline]
        pub fn atan2(y: $real, x: $real) -> $real {
            y.atan2(x)
        }
    };
}

#[cfg(all(feature = "std", not(feature = "libm")))]
mod single {
    of_std!(f32: acos, asin, atan, ceil, cos, exp2, exp, exp_m1, floor, log2, ln, ln_1p, round, sin, sqrt, tan);

    /// `f32::powf`
    #[inline]
    pub fn powf(x: f32, exponent: f32) -> f32 {
        x.powf(exponent)
    }

    /// `f32::sin_cos`
    #[inline]
    pub fn sin_cos(x: f32) -> (f32, f32) {
        x.sin_cos()
    }
}

#[cfg(all(feature = "std", not(feature = "libm")))]
mod double {
    of_std!(f64: acos, asin, atan, cos, exp, floor, ln, ln_1p, sin, sqrt, tan);
}
