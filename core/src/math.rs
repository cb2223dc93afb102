//! Float functions: those of std, or those of libm where the bits must be the same on every target.

#[cfg(any(feature = "libm", not(feature = "std")))]
mod functions {
    pub use libm::{
        acosf as acos, asinf as asin, atan2f as atan2, ceilf as ceil, cosf as cos, exp2f as exp2, expf as exp,
        floorf as floor, log2f as log2, logf as ln, powf, roundf as round, sinf as sin, sqrtf as sqrt, tanf as tan,
    };

    /// Sine and cosine of an angle in radians.
    pub fn sin_cos(x: f32) -> (f32, f32) {
        (sin(x), cos(x))
    }
}

#[cfg(all(feature = "std", not(feature = "libm")))]
mod functions {
    macro_rules! of_std {
        ($($name:ident => $method:ident),*) => {
            $(
                #[doc = concat!("`f32::", stringify!($method), "`")]
                #[inline]
                pub fn $name(x: f32) -> f32 {
                    x.$method()
                }
            )*
        };
    }

    of_std!(
        acos => acos, asin => asin, ceil => ceil, cos => cos, exp2 => exp2, exp => exp, floor => floor, log2 => log2,
        ln => ln, round => round, sin => sin, sqrt => sqrt, tan => tan
    );

    /// `f32::atan2`
    #[inline]
    pub fn atan2(y: f32, x: f32) -> f32 {
        y.atan2(x)
    }

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

pub use functions::*;
