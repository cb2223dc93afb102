//! Bezier curves: de Casteljau's construction.

use super::arc_length::integrate;
use super::bernstein::{PASCAL, bernstein_sum};
use super::control_point::{check_degree, check_points};
use super::curve::evaluated_by_itself;
use super::{ControlPoint, Cubic, Curve, Homogeneous, Jet, SplineError};
use crate::math::{Real, VectorSpace};

/// The highest degree of a curve; [`de_casteljau`] and [`bernstein`](super::bernstein()) themselves know no limit.
pub const MAX_DEGREE: usize = 15;

/// As many points as the highest degree has.
pub(super) const MAX_ORDER: usize = MAX_DEGREE + 1;

/// Evaluates the Bezier curve of these control points at `t`, and overwrites them.
///
/// The degree is one less than the number of points; without any point the result is zero. `t` in `[0, 1]` lies on the
/// curve between the first and the last point, any other number on its continuation. `n` rounds of linear
/// interpolation; the last three points that are left give the derivatives. De Casteljau 1959; Farin, "Curves and
/// Surfaces for CAGD", section 4.
pub fn de_casteljau<V: VectorSpace>(points: &mut [V], t: V::Scalar) -> Jet<V> {
    let degree = points.len().saturating_sub(1);
    let n = V::Scalar::from_usize(degree);
    let mut jet = Jet::default();
    for count in (1..=points.len()).rev() {
        match (count, &*points) {
            (3, [a, b, c, ..]) => jet.second = ((*c - *b) - (*b - *a)) * (n * (n - V::Scalar::ONE)),
            (2, [a, b, ..]) => jet.first = (*b - *a) * n,
            (1, [a, ..]) => jet.point = *a,
            _ => {}
        }
        construct(&mut points[..count], t);
    }
    jet
}

/// One round of de Casteljau's construction: each point but the last moves towards the next one.
#[inline]
pub(super) fn construct<V: VectorSpace>(points: &mut [V], t: V::Scalar) {
    (1..points.len()).for_each(|i| points[i - 1] = points[i - 1] * (V::Scalar::ONE - t) + points[i] * t);
}

/// A Bezier curve on borrowed control points, of degree 0 to [`MAX_DEGREE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bezier<'a, P>(&'a [P]);

/// A Bezier curve with weights: quotients of polynomials, among them all conics.
pub type RationalBezier<'a, V> = Bezier<'a, Homogeneous<V>>;

impl<'a, P: ControlPoint> Bezier<'a, P> {
    /// A curve from the first point to the last one, which the others pull.
    ///
    /// # Errors
    ///
    /// Where there is no point or one too many, a coordinate is not finite, or a weight is not positive.
    pub fn new(points: &'a [P]) -> Result<Self, SplineError> {
        check_degree(points.len())?;
        check_points(points)?;
        Ok(Self(points))
    }

    /// Points that were checked before, or computed from such.
    pub(super) fn trusted(points: &'a [P]) -> Self {
        Self(points)
    }

    /// The control points.
    pub fn points(&self) -> &'a [P] {
        self.0
    }

    /// The highest power of the parameter.
    pub fn degree(&self) -> usize {
        self.0.len() - 1
    }

    /// The point at `t` in `[0, 1]`, in as many steps as there are control points.
    ///
    /// Other parameters lie on the continuation of the curve, where rounding errors grow with the distance.
    #[inline]
    pub fn point(&self, t: P::Scalar) -> P::Point {
        bernstein_sum(self.0, t).project()
    }

    /// The point at `t` in `[0, 1]` with its derivatives.
    ///
    /// The three points of the last but two rounds of de Casteljau's construction, each from its own sum, so that the
    /// number of steps stays proportional to the degree.
    #[inline]
    pub fn at(&self, t: P::Scalar) -> Jet<P::Point> {
        let n = P::Scalar::from_usize(self.degree());
        P::project_jet(match *self.0 {
            [] => Jet::default(),
            [a] => Jet { point: a, ..Jet::default() },
            [a, b] => Jet { point: bernstein_sum(&[a, b], t), first: b - a, second: P::default() },
            [a, b, c, d] => {
                let [ab, bc, cd] = [[a, b], [b, c], [c, d]].map(|pair| bernstein_sum(&pair, t));
                let [abc, bcd] = [[ab, bc], [bc, cd]].map(|pair| bernstein_sum(&pair, t));
                Jet {
                    point: bernstein_sum(&[abc, bcd], t),
                    first: (bcd - abc) * n,
                    second: ((cd - bc) - (bc - ab)) * (n + n),
                }
            }
            [_, _, ref inner @ ..] => {
                let [a, b, c] = [0, 1, 2].map(|i| bernstein_sum(&self.0[i..i + inner.len()], t));
                let (ab, bc) = (b - a, c - b);
                Jet {
                    point: bernstein_sum(&[a, b, c], t),
                    first: bernstein_sum(&[ab, bc], t) * n,
                    second: (bc - ab) * (n * (n - P::Scalar::ONE)),
                }
            }
        })
    }

    /// Writes the derivatives of order 0, 1, 2 ... at `t` to `derivatives`, up to order [`MAX_DEGREE`]; zero above.
    ///
    /// The derivative of order `k` is `n! / (n - k)!` times the difference of order `k` of the points of de Casteljau's
    /// round `n - k`. Farin, section 5.3.
    pub fn derivatives(&self, t: P::Scalar, derivatives: &mut [P::Point]) {
        let (mut scratch, mut homogeneous) = ([P::default(); MAX_ORDER], [P::default(); MAX_ORDER]);
        let degree = self.degree();
        scratch[..=degree].copy_from_slice(self.0);
        for k in (0..=degree).rev() {
            let factor = (degree - k + 1..=degree).fold(1.0, |product, i| product * i as f64);
            let signed = |i: usize| if (k - i).is_multiple_of(2) { factor } else { -factor } * PASCAL[k][i];
            homogeneous[k] = weighted(&scratch[..=k], |i| P::Scalar::from_f64(signed(i)));
            construct(&mut scratch[..=k], t);
        }
        derivatives.iter_mut().for_each(|derivative| *derivative = P::Point::default());
        P::project_derivatives(&homogeneous, derivatives);
    }
}

/// The sum of points times factors.
pub(super) fn weighted<V: VectorSpace>(points: &[V], factor: impl Fn(usize) -> V::Scalar) -> V {
    points.iter().enumerate().fold(V::default(), |sum, (i, &point)| sum + point * factor(i))
}

impl<P: ControlPoint> Curve for Bezier<'_, P> {
    type Point = P::Point;

    fn domain(&self) -> [P::Scalar; 2] {
        [P::Scalar::ZERO, P::Scalar::ONE]
    }
    evaluated_by_itself!();
    #[inline]
    fn piece_length(&self, interval: [P::Scalar; 2], tolerance: P::Scalar) -> P::Scalar {
        match *self.0 {
            [a, b, c, d] => Cubic::from_bezier([a, b, c, d]).piece_length(interval, tolerance),
            _ => integrate(self, interval, tolerance),
        }
    }
    #[inline]
    fn speed(&self, t: P::Scalar) -> P::Scalar {
        let [before, after] = match *self.0 {
            [] | [_] => return P::Scalar::ZERO,
            [a, b, c, d] => [bernstein_sum(&[a, b, c], t), bernstein_sum(&[b, c, d], t)],
            [_, ref inner @ ..] => [0, 1].map(|i| bernstein_sum(&self.0[i..i + inner.len()], t)),
        };
        let first = (after - before) * P::Scalar::from_usize(self.degree());
        P::project_jet(Jet { point: bernstein_sum(&[before, after], t), first, second: P::default() }).first.length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    /// Some points of no particular order.
    fn points<const N: usize>() -> [DVec3; N] {
        core::array::from_fn(|i| {
            let x = i as f64;
            DVec3::new(x, (2.3 * x).sin(), (1.7 * x * x).cos())
        })
    }

    /// `sum_i C(n, i) t^i (1 - t)^(n - i) p_i`
    fn bernstein(points: &[DVec3], t: f64) -> DVec3 {
        let n = points.len() - 1;
        let mut binomial = 1.0;
        let mut sum = DVec3::ZERO;
        for (i, &point) in points.iter().enumerate() {
            sum += point * binomial * t.powi(i as i32) * (1.0 - t).powi((n - i) as i32);
            binomial *= (n - i) as f64 / (i + 1) as f64;
        }
        sum
    }

    #[test]
    fn the_construction_equals_the_sum_of_bernstein_polynomials() {
        let points = points::<10>();
        for count in 1..=10 {
            let curve = Bezier::new(&points[..count]).unwrap();
            for step in 0..=20 {
                let t = f64::from(step) / 20.0;
                assert!((curve.at(t).point - bernstein(&points[..count], t)).length() < 1e-13);
            }
        }
    }

    /// Partition of unity: a curve whose points are one point stands still; and its ends are its first and last point.
    #[test]
    fn weights_sum_to_one_and_ends_are_points() {
        let still = Bezier::new(&[Vec3::ONE; 8]).unwrap();
        let points = points::<7>();
        let curve = Bezier::new(&points).unwrap();
        assert_eq!((curve.at(0.0).point, curve.at(1.0).point), (points[0], points[6]));
        for step in 0..=10 {
            let jet = still.at(step as f32 / 10.0);
            assert!(jet.point.abs_diff_eq(Vec3::ONE, 1e-6) && jet.first.length() < 1e-5 && jet.second.length() < 1e-4);
        }
    }

    #[test]
    fn derivatives_are_limits_of_differences() {
        let points = points::<6>();
        for count in 1..=6 {
            let curve = Bezier::new(&points[..count]).unwrap();
            let h = 1e-4;
            for step in 1..10 {
                let t = f64::from(step) / 10.0;
                let [before, jet, after] = [t - h, t, t + h].map(|t| curve.at(t));
                assert!(((after.point - before.point) / (2.0 * h) - jet.first).length() < 1e-6);
                assert!(((after.first - before.first) / (2.0 * h) - jet.second).length() < 1e-5);
            }
        }
    }

    /// Raising the degree by the rule of Forrest changes the points, not the curve.
    #[test]
    fn the_same_curve_with_one_point_more() {
        let points = points::<5>();
        let raised: [DVec3; 6] = core::array::from_fn(|i| {
            let share = i as f64 / 5.0;
            points[i.saturating_sub(1)] * share + points[i.min(4)] * (1.0 - share)
        });
        let (low, high) = (Bezier::new(&points).unwrap(), Bezier::new(&raised).unwrap());
        for step in 0..=10 {
            let t = f64::from(step) / 10.0;
            let (a, b) = (low.at(t), high.at(t));
            assert!((a.point - b.point).length() + (a.first - b.first).length() < 1e-12);
        }
    }

    #[test]
    fn errors_name_the_point() {
        assert_eq!(Bezier::<Vec3>::new(&[]), Err(SplineError::Empty));
        assert_eq!(Bezier::new(&[Vec3::ZERO; 17]), Err(SplineError::Degree { degree: 16 }));
        assert_eq!(Bezier::new(&[Vec3::ZERO, Vec3::NAN]), Err(SplineError::NotFinite { index: 1 }));
        assert_eq!(de_casteljau::<Vec3>(&mut [], 0.5), Jet::default());
    }
}
