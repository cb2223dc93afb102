//! Points with weights, which make curves rational.

use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::{ControlPoint, Jet};
use crate::math::{Real, VectorSpace};

/// A point in homogeneous coordinates: one dimension more, projected from the origin.
///
/// A polynomial curve of such points is the projection's pre-image of a rational one. Piegl and Tiller, "The NURBS
/// Book", section 1.4.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Homogeneous<V: VectorSpace> {
    /// The point times its weight.
    pub scaled: V,
    /// How much the point pulls, above 0.
    pub weight: V::Scalar,
}

impl<V: VectorSpace> Homogeneous<V> {
    /// A point and its weight.
    #[inline]
    pub fn new(point: V, weight: V::Scalar) -> Self {
        Self { scaled: point * weight, weight }
    }
}

impl<V: VectorSpace> Add for Homogeneous<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { scaled: self.scaled + other.scaled, weight: self.weight + other.weight }
    }
}

impl<V: VectorSpace> AddAssign for Homogeneous<V> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<V: VectorSpace> Sub for Homogeneous<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { scaled: self.scaled - other.scaled, weight: self.weight - other.weight }
    }
}

impl<V: VectorSpace> Neg for Homogeneous<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { scaled: -self.scaled, weight: -self.weight }
    }
}

impl<V: VectorSpace<Scalar = R>, R: Real> Mul<R> for Homogeneous<V> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self { scaled: self.scaled * factor, weight: self.weight * factor }
    }
}

impl<V: VectorSpace<Scalar = R>, R: Real> Div<R> for Homogeneous<V> {
    type Output = Self;
    #[inline(always)]
    fn div(self, divisor: R) -> Self {
        Self { scaled: self.scaled / divisor, weight: self.weight / divisor }
    }
}

impl<V: VectorSpace> VectorSpace for Homogeneous<V> {
    type Scalar = V::Scalar;
    const DIMENSION: usize = V::DIMENSION + 1;

    #[inline]
    fn from_fn(mut coordinate: impl FnMut(usize) -> V::Scalar) -> Self {
        Self { scaled: V::from_fn(&mut coordinate), weight: coordinate(V::DIMENSION) }
    }
    #[inline]
    fn coordinate(self, axis: usize) -> V::Scalar {
        if axis == V::DIMENSION { self.weight } else { self.scaled.coordinate(axis) }
    }
    #[inline]
    fn dot(self, other: Self) -> V::Scalar {
        self.scaled.dot(other.scaled) + self.weight * other.weight
    }
}

impl<V: VectorSpace> ControlPoint for Homogeneous<V> {
    type Point = V;

    #[inline(always)]
    fn project(self) -> V {
        self.scaled * (V::Scalar::ONE / self.weight)
    }
    /// The quotient rule.
    #[inline]
    fn project_jet(jet: Jet<Self>) -> Jet<V> {
        let reciprocal = V::Scalar::ONE / jet.point.weight;
        let point = jet.point.scaled * reciprocal;
        let first = (jet.first.scaled - point * jet.first.weight) * reciprocal;
        let twice = first * (jet.first.weight + jet.first.weight);
        let second = (jet.second.scaled - point * jet.second.weight - twice) * reciprocal;
        Jet { point, first, second }
    }
    /// Leibniz's rule for `scaled = weight * point`, solved for the point: "The NURBS Book", equation 4.8.
    fn project_derivatives(derivatives: &[Self], projected: &mut [V]) {
        for k in 0..derivatives.len().min(projected.len()) {
            let mut binomial = V::Scalar::ONE;
            let mut rest = derivatives[k].scaled;
            for i in 1..=k {
                binomial = binomial * V::Scalar::from_usize(k - i + 1) / V::Scalar::from_usize(i);
                rest = rest - projected[k - i] * (binomial * derivatives[i].weight);
            }
            projected[k] = rest / derivatives[0].weight;
        }
    }
    #[inline(always)]
    fn weight(self) -> V::Scalar {
        self.weight
    }
}
