//! The circle in the four forms of a curve, and all conics as rational Bezier curves and NURBS.

use super::split::check_buffer;
use super::{ControlPoint, Curve, Homogeneous, Jet, SplineError};
use crate::math::{Real, VectorSpace};

/// A circle in a plane or in space: `center + x cos(alpha) + y sin(alpha)`.
///
/// An ellipse where the axes `x` and `y` are not as long as each other or not at right angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle<V> {
    /// The middle.
    pub center: V,
    /// From the middle to the point at angle 0.
    pub x: V,
    /// From the middle to the point at a quarter of the turn.
    pub y: V,
}

impl<V: VectorSpace> Circle<V> {
    /// The implicit form `x^2 + y^2 - r^2` of a circle in the plane of its axes: negative inside, 0 on it.
    ///
    /// To tell where a point lies, and to find where a ray arrives.
    pub fn implicit(&self, point: V) -> V::Scalar {
        (point - self.center).length_squared() - self.x.length_squared()
    }

    /// The explicit form `y = sqrt(1 - x^2)`, `x` in `[-1, 1]` in units of its axes: the upper half only, with endless
    /// slope at both ends. NaN coordinates for other `x`.
    pub fn explicit(&self, x: V::Scalar) -> V {
        self.center + self.x * x + self.y * ((V::Scalar::ONE - x) * (V::Scalar::ONE + x)).sqrt()
    }

    /// The parametric form `(cos alpha, sin alpha)`, `alpha` in radians: constant speed.
    pub fn parametric(&self, alpha: V::Scalar) -> V {
        self.center + self.x * alpha.cos() + self.y * alpha.sin()
    }

    /// The rational form `((1 - t^2) / (1 + t^2), 2 t / (1 + t^2))` with `t = tan(alpha / 2)`.
    ///
    /// `t` in `[-1, 1]` is the right half; all numbers are all of the circle but the point at half a turn. Without any
    /// function other than the four basic operations, and what NURBS are made for.
    pub fn rational(&self, t: V::Scalar) -> V {
        let square = t * t;
        let denominator = V::Scalar::ONE + square;
        self.center + self.x * ((V::Scalar::ONE - square) / denominator) + self.y * ((t + t) / denominator)
    }

    /// The rational Bezier curve of the arc from angle `from` to angle `to`, less than half a turn apart.
    ///
    /// The point in the middle lies where the tangents at both ends meet; its weight is the cosine of half of the angle.
    /// "The NURBS Book", section 7.3. Half a turn and more make the weight 0 or negative, which
    /// [`Bezier::new`](super::Bezier::new) does not take.
    pub fn arc(&self, from: V::Scalar, to: V::Scalar) -> [Homogeneous<V>; 3] {
        let half = V::Scalar::from_f64(0.5);
        let ((middle, aperture), one) = (((from + to) * half, (to - from) * half), V::Scalar::ONE);
        let weight = aperture.cos();
        let tip = self.center * weight + (self.x * middle.cos() + self.y * middle.sin());
        let end = |alpha| Homogeneous::new(self.parametric(alpha), one);
        [end(from), Homogeneous { scaled: tip, weight }, end(to)]
    }

    /// Writes the control points of the NURBS curve of degree 2 from angle `from` to angle `to`: arcs in a row.
    ///
    /// Its knots are those of [`bezier_knots`](super::bezier_knots) with one break more than there are arcs. Each arc
    /// takes at most a third of a turn well; four make a circle.
    ///
    /// # Errors
    ///
    /// Where the number of points is not an odd one of at least 3.
    pub fn arcs(&self, [from, to]: [V::Scalar; 2], points: &mut [Homogeneous<V>]) -> Result<(), SplineError> {
        let arcs = points.len() / 2;
        check_buffer(points.len(), 2 * arcs.max(1) + 1)?;
        let angle = |i: usize| from + (to - from) * (V::Scalar::from_usize(i) / V::Scalar::from_usize(arcs));
        for i in 0..arcs {
            points[2 * i..2 * i + 3].copy_from_slice(&self.arc(angle(i), angle(i + 1)));
        }
        Ok(())
    }

    /// The nine control points of the whole circle as a NURBS curve, with [`CIRCLE_KNOTS`].
    ///
    /// The corners of the square around it have weight `1 / sqrt 2`. Its angle at `t` is not `2 pi t`, but never
    /// far from it; at `t` = 0, 1/8, 1/4 ... it is.
    pub fn nurbs(&self) -> [Homogeneous<V>; 9] {
        let [zero, one] = [V::Scalar::ZERO, V::Scalar::ONE];
        let weight = V::Scalar::from_f64(core::f64::consts::FRAC_1_SQRT_2);
        let corners = [[one, zero], [one, one], [zero, one], [-one, one], [-one, zero], [-one, -one], [zero, -one]];
        let corner = |i: usize| corners.get(i).copied().unwrap_or(if i == 7 { [one, -one] } else { [one, zero] });
        core::array::from_fn(|i| {
            let [x, y] = corner(i);
            let point = self.center + self.x * x + self.y * y;
            Homogeneous::new(point, if i.is_multiple_of(2) { one } else { weight })
        })
    }
}

/// The knots of [`Circle::nurbs`], of degree 2.
pub const CIRCLE_KNOTS: [f64; 12] = [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];

/// A circle by its angle in radians, from 0 to a whole turn.
impl<V: ControlPoint<Point = V>> Curve for Circle<V> {
    type Point = V;

    fn domain(&self) -> [V::Scalar; 2] {
        [V::Scalar::ZERO, V::Scalar::PI + V::Scalar::PI]
    }
    fn at(&self, alpha: V::Scalar) -> Jet<V> {
        let (sin, cos) = (alpha.sin(), alpha.cos());
        let outward = self.x * cos + self.y * sin;
        Jet { point: self.center + outward, first: self.y * cos - self.x * sin, second: -outward }
    }
}

/// What a rational curve of degree 2 is, if its ends have weight 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conic {
    /// The weight in the middle is below 1.
    Ellipse,
    /// It is 1.
    Parabola,
    /// It is above 1.
    Hyperbola,
}

impl Conic {
    /// Of the rational Bezier curve with these weights, all positive: `w_1^2 / (w_0 w_2)` decides. "The NURBS Book",
    /// equation 7.24.
    pub fn of<R: Real>([start, middle, end]: [R; 3]) -> Self {
        let (inner, outer) = (middle * middle, start * end);
        if inner < outer {
            Self::Ellipse
        } else if inner > outer {
            Self::Hyperbola
        } else {
            Self::Parabola
        }
    }
}

/// The arc of a conic from `start` to `end`, with tangents that meet in `tip`, through the point above the middle of the
/// chord whose share of the way to `tip` is `sharpness`, in `(0, 1)`.
///
/// Below 1/2 an ellipse, at 1/2 a parabola, above a hyperbola. The weight is `sharpness / (1 - sharpness)`; the
/// "projective discriminant" of Liming 1944, Farin section 13.
pub fn conic<V: VectorSpace>([start, tip, end]: [V; 3], sharpness: V::Scalar) -> [Homogeneous<V>; 3] {
    let one = V::Scalar::ONE;
    [Homogeneous::new(start, one), Homogeneous::new(tip, sharpness / (one - sharpness)), Homogeneous::new(end, one)]
}
