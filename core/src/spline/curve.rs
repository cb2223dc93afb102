//! What all curves have in common.

use super::arc_length::integrate;
use crate::math::{Real, VectorSpace};

/// A point of a curve, with its first and second derivative by the parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet<V> {
    /// Position.
    pub point: V,
    /// The tangent, as long as the speed.
    pub first: V,
    /// The second derivative.
    pub second: V,
}

/// A curve with a parameter.
pub trait Curve {
    /// Where its points lie.
    type Point: VectorSpace;

    /// The first and the last parameter.
    fn domain(&self) -> [Parameter<Self>; 2];
    /// The point at a parameter of the domain, with its derivatives.
    fn at(&self, t: Parameter<Self>) -> Jet<Self::Point>;
    /// The point at a parameter of the domain.
    fn point(&self, t: Parameter<Self>) -> Self::Point {
        self.at(t).point
    }
    /// The speed at a parameter of the domain: the length of the first derivative.
    fn speed(&self, t: Parameter<Self>) -> Parameter<Self> {
        self.at(t).first.length()
    }
    /// The length between two parameters of the domain with no break between them, off by at most about `tolerance`.
    fn piece_length(&self, interval: [Parameter<Self>; 2], tolerance: Parameter<Self>) -> Parameter<Self>
    where
        Self: Sized,
    {
        integrate(self, interval, tolerance)
    }
    /// The next parameter after `t` at which one polynomial ends; the end of the domain after the last one.
    fn next_break(&self, _t: Parameter<Self>) -> Parameter<Self> {
        self.domain()[1]
    }
}

/// The number that a curve has for a parameter.
pub type Parameter<C> = <<C as Curve>::Point as VectorSpace>::Scalar;

impl<V: VectorSpace> Jet<V> {
    /// How strongly the curve bends: one over the radius of the circle that touches it best; 0 where it stands still.
    ///
    /// `|c' x c''| / |c'|^3`, with the length of the part of `c''` across `c'` for the product, in any dimension.
    pub fn curvature(&self) -> V::Scalar {
        let squared = self.first.length_squared();
        if squared > V::Scalar::ZERO {
            let along = self.first * (self.first.dot(self.second) / squared);
            (self.second - along).length() / squared
        } else {
            V::Scalar::ZERO
        }
    }
}

/// Evaluation by the methods of the curve itself, which can be called without the trait.
macro_rules! evaluated_by_itself {
    () => {
        #[inline]
        fn at(&self, t: $crate::spline::Parameter<Self>) -> $crate::spline::Jet<Self::Point> {
            self.at(t)
        }
        #[inline]
        fn point(&self, t: $crate::spline::Parameter<Self>) -> Self::Point {
            self.point(t)
        }
    };
}
pub(super) use evaluated_by_itself;
