//! Directions along a curve: Frenet's frame, and frames that turn no more than they must.

use super::{Curve, Jet, Parameter};
use crate::math::{Real, Vector, VectorSpace};

/// A place with three directions of length 1, at right angles to each other, right-handed in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame<V> {
    /// Where it is.
    pub point: V,
    /// Along the curve.
    pub tangent: V,
    /// Across it.
    pub normal: V,
    /// Across both.
    pub binormal: V,
}

impl<V: Vector> Frame<V> {
    /// With a tangent and the direction that the normal is to have as nearly as it can.
    ///
    /// Any direction across the tangent where that one runs along it; `x` where there is no tangent.
    pub fn new(point: V, tangent: V, towards: V) -> Self {
        let tangent = match tangent.normalize_or_zero() {
            zero if zero == V::default() => axis(0),
            tangent => tangent,
        };
        let across = |direction: V| (direction - tangent * direction.dot(tangent)).normalize_or_zero();
        let least = (1..3).fold(0, |least, i| {
            let of = |axis: usize| tangent.coordinate(axis).abs();
            if of(i) < of(least) { i } else { least }
        });
        // What is left of a direction along the tangent is rounding errors, of any direction.
        let slack = V::Scalar::EPSILON.sqrt() * towards.length();
        let is_across = (towards - tangent * towards.dot(tangent)).length() > slack;
        let normal = across(across(if is_across { towards } else { axis(least) }));
        Self { point, tangent, normal, binormal: tangent.cross(normal) }
    }

    /// Frenet's frame: the normal shows to where the curve bends. It jumps where the curve bends to another side; where
    /// it does not bend, the normal is any one.
    pub fn frenet(jet: &Jet<V>) -> Self {
        Self::new(jet.point, jet.first, jet.second)
    }

    /// The frame at the next point of a curve that turns no more about the tangent than it must.
    ///
    /// Two reflections, one of which takes the point to the next one and the other one the tangent to the next one:
    /// off by the fourth power of the step. Wang, Juttler, Zheng and Liu 2008, "Computation of rotation minimizing
    /// frames", table 1.
    pub fn next(&self, point: V, tangent: V) -> Self {
        let tangent = match tangent.normalize_or_zero() {
            zero if zero == V::default() => self.tangent,
            tangent => tangent,
        };
        let across = point - self.point;
        let [normal, mirrored] = [self.normal, self.tangent].map(|direction| reflect(direction, across));
        Self::new(point, tangent, reflect(normal, tangent - mirrored))
    }

    /// The frame turned about its tangent by an angle in radians, from the normal to the binormal.
    pub fn turned(&self, angle: V::Scalar) -> Self {
        let normal = self.normal * angle.cos() + self.binormal * angle.sin();
        Self { normal, binormal: self.tangent.cross(normal), ..*self }
    }
}

/// Writes frames at parameters of a curve, in order, that turn no more about the tangent than they must.
///
/// The first normal is as near to `towards` as it can. As many as both slices have. Where the curve stands still, the
/// tangent stays.
pub fn rotation_minimizing_frames<C: Curve<Point: Vector>>(
    curve: &C,
    towards: C::Point,
    parameters: &[Parameter<C>],
    frames: &mut [Frame<C::Point>],
) {
    let mut before: Option<Frame<C::Point>> = None;
    for (&t, frame) in parameters.iter().zip(frames) {
        let jet = curve.at(t);
        *frame = match before {
            Some(before) => before.next(jet.point, jet.first),
            None => Frame::new(jet.point, jet.first, towards),
        };
        before = Some(*frame);
    }
}

/// Turns the frames of a closed curve, whose last point is its first one, so that the last frame is the first one too.
///
/// Each is turned by its share of the way.
pub fn close_frames<V: Vector>(frames: &mut [Frame<V>]) {
    let [first, .., last] = *frames else { return };
    let angle = first.normal.dot(last.binormal).atan2(first.normal.dot(last.normal));
    let steps = |frames: &[Frame<V>]| {
        frames.windows(2).map(|pair| (pair[1].point - pair[0].point).length()).fold(V::Scalar::ZERO, |a, b| a + b)
    };
    let whole = steps(frames);
    let (mut way, mut before) = (V::Scalar::ZERO, first.point);
    for frame in frames {
        way += (frame.point - before).length();
        before = frame.point;
        *frame = frame.turned(if whole > V::Scalar::ZERO { angle * (way / whole) } else { V::Scalar::ZERO });
    }
}

/// The mirror image of a vector in the plane across another one.
fn reflect<V: VectorSpace>(vector: V, across: V) -> V {
    let squared = across.length_squared();
    if squared > V::Scalar::ZERO {
        let share = vector.dot(across) / squared;
        vector - across * (share + share)
    } else {
        vector
    }
}

fn axis<V: Vector>(axis: usize) -> V {
    V::from_fn(|i| if i == axis { V::Scalar::ONE } else { V::Scalar::ZERO })
}
