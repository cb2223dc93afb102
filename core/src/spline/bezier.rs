//! Bezier curves: de Casteljau's construction.

use core::fmt;

use crate::math::{Real, Vector};

/// The highest degree of a [`Bezier`]; [`de_casteljau`] itself knows no limit.
pub const MAX_DEGREE: usize = 15;

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

/// Evaluates the Bezier curve of these control points at `t`, and overwrites them.
///
/// The degree is one less than the number of points; without any point the result is zero. `t` in `[0, 1]` lies on the
/// curve between the first and the last point, any other number on its continuation. `n` rounds of linear
/// interpolation; the last three points that are left give the derivatives. De Casteljau 1959; Farin, "Curves and
/// Surfaces for CAGD", section 4.
pub fn de_casteljau<V: Vector>(points: &mut [V], t: V::Scalar) -> Jet<V> {
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
        (1..count).for_each(|i| points[i - 1] = points[i - 1] * (V::Scalar::ONE - t) + points[i] * t);
    }
    jet
}

/// A Bezier curve on borrowed control points, of degree 0 to [`MAX_DEGREE`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bezier<'a, V>(&'a [V]);

/// Why control points make no curve or surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BezierError {
    /// There is no point.
    Empty,
    /// The degree is above [`MAX_DEGREE`].
    Degree {
        /// The degree asked for.
        degree: usize,
    },
    /// A point has a coordinate that is infinite or no number.
    NotFinite {
        /// Of the point.
        index: usize,
    },
    /// The points of a surface do not fill its rows.
    Ragged {
        /// Number of points.
        points: usize,
        /// Number of points in a row.
        columns: usize,
    },
}

impl fmt::Display for BezierError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "there are no control points; give at least one"),
            Self::Degree { degree } => {
                write!(f, "the degree is {degree}, the highest is {MAX_DEGREE}; cut the curve into pieces")
            }
            Self::NotFinite { index } => write!(f, "control point {index} is not finite; give finite coordinates"),
            Self::Ragged { points, columns } => {
                write!(f, "{points} control points are no rows of {columns}; give whole rows")
            }
        }
    }
}

impl core::error::Error for BezierError {}

impl<'a, V: Vector> Bezier<'a, V> {
    /// A curve from the first point to the last one, which the others pull.
    ///
    /// # Errors
    ///
    /// Where there is no point or one too many, or a coordinate is not finite.
    pub fn new(points: &'a [V]) -> Result<Self, BezierError> {
        check_degree(points.len())?;
        check_finite(points)?;
        Ok(Self(points))
    }

    /// The point at `t` in `[0, 1]` with its derivatives.
    pub fn at(&self, t: V::Scalar) -> Jet<V> {
        let mut scratch = [V::default(); MAX_DEGREE + 1];
        let scratch = &mut scratch[..self.0.len()];
        scratch.copy_from_slice(self.0);
        de_casteljau(scratch, t)
    }
}

/// Whether as many points make a curve.
pub(super) fn check_degree(count: usize) -> Result<(), BezierError> {
    match count {
        0 => Err(BezierError::Empty),
        _ if count > MAX_DEGREE + 1 => Err(BezierError::Degree { degree: count - 1 }),
        _ => Ok(()),
    }
}

/// Whether all coordinates are finite.
pub(super) fn check_finite<V: Vector>(points: &[V]) -> Result<(), BezierError> {
    let is_finite = |point: &V| point.to_array().iter().all(|x| x.abs() < V::Scalar::INFINITY);
    match points.iter().position(|point| !is_finite(point)) {
        Some(index) => Err(BezierError::NotFinite { index }),
        None => Ok(()),
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
        assert_eq!(Bezier::<Vec3>::new(&[]), Err(BezierError::Empty));
        assert_eq!(Bezier::new(&[Vec3::ZERO; 17]), Err(BezierError::Degree { degree: 16 }));
        assert_eq!(Bezier::new(&[Vec3::ZERO, Vec3::NAN]), Err(BezierError::NotFinite { index: 1 }));
        assert_eq!(de_casteljau::<Vec3>(&mut [], 0.5), Jet::default());
    }
}
