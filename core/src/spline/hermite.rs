//! Curves through points with given tangents: Hermite splines, and the ways to choose tangents.
//!
//! Cardinal, Catmull-Rom and Kochanek-Bartels splines and the C2 interpolation are Hermite splines; each is a rule for
//! tangents. All tangents are derivatives by the parameter, whose value at each point is its time.

use super::control_point::check_finite;
use super::curve::evaluated_by_itself;
use super::knots::is_finite;
use super::split::check_buffer;
use super::{ControlPoint, Cubic, Curve, Jet, SplineError};
use crate::math::{Real, VectorSpace};

/// A curve of cubics through points at given times with given tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hermite<'a, V: VectorSpace> {
    times: &'a [V::Scalar],
    points: &'a [V],
    /// Where the curve comes to a point, and where it leaves it.
    tangents: [&'a [V]; 2],
}

impl<'a, V: ControlPoint<Point = V>> Hermite<'a, V> {
    /// A curve whose direction and speed change nowhere at once (C1).
    ///
    /// # Errors
    ///
    /// Where there are less than two points, not as many times and tangents as points, times that do not ascend, or
    /// something is not finite.
    pub fn new(times: &'a [V::Scalar], points: &'a [V], tangents: &'a [V]) -> Result<Self, SplineError> {
        Self::with_corners(times, points, [tangents; 2])
    }

    /// A curve that may come to a point with another tangent than the one it leaves it with.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn with_corners(
        times: &'a [V::Scalar],
        points: &'a [V],
        [arriving, leaving]: [&'a [V]; 2],
    ) -> Result<Self, SplineError> {
        check_times(times, points.len())?;
        check_finite(points)?;
        for tangents in [arriving, leaving] {
            if tangents.len() != points.len() {
                return Err(SplineError::PointCount { points: tangents.len(), wanted: points.len() });
            }
            check_finite(tangents)?;
        }
        Ok(Self { times, points, tangents: [arriving, leaving] })
    }

    /// The times.
    pub fn times(&self) -> &'a [V::Scalar] {
        self.times
    }

    /// The number of cubics.
    pub fn pieces(&self) -> usize {
        self.points.len() - 1
    }

    /// The cubic between points `index` and `index + 1`, by its share of the time between them; the last one for a
    /// larger index.
    #[inline]
    pub fn piece(&self, index: usize) -> Cubic<V> {
        let i = index.min(self.pieces() - 1);
        let duration = self.times[i + 1] - self.times[i];
        let [arriving, leaving] = self.tangents;
        let tangents = [leaving[i] * duration, arriving[i + 1] * duration];
        Cubic::from_hermite([self.points[i], self.points[i + 1]], tangents)
    }

    /// The index of the cubic at time `t`; the first or the last one outside of the times.
    #[inline]
    pub fn piece_at(&self, t: V::Scalar) -> usize {
        self.times[1..self.pieces()].partition_point(|&time| time <= t)
    }

    /// The point at time `t`, with its derivatives.
    pub fn at(&self, t: V::Scalar) -> Jet<V> {
        let i = self.piece_at(t);
        let rate = V::Scalar::ONE / (self.times[i + 1] - self.times[i]);
        let Jet { point, first, second } = self.piece(i).at((t - self.times[i]) * rate);
        Jet { point, first: first * rate, second: second * (rate * rate) }
    }

    /// The point at time `t`.
    pub fn point(&self, t: V::Scalar) -> V {
        let i = self.piece_at(t);
        self.piece(i).point((t - self.times[i]) / (self.times[i + 1] - self.times[i]))
    }
}

impl<V: ControlPoint<Point = V>> Curve for Hermite<'_, V> {
    type Point = V;

    fn domain(&self) -> [V::Scalar; 2] {
        [self.times[0], self.times[self.pieces()]]
    }
    evaluated_by_itself!();
    fn next_break(&self, t: V::Scalar) -> V::Scalar {
        self.times[if t < self.times[0] { 0 } else { self.piece_at(t) + 1 }]
    }
}

/// Writes times at which to reach points: each takes `|distance|^exponent` longer than the one before it.
///
/// Exponent 0 gives uniform times 0, 1, 2 ..., 1 chordal ones, 1/2 centripetal ones, for which a Catmull-Rom spline has
/// neither loops nor cusps inside its pieces (Yuksel, Schaefer and Keyser 2011). Points that coincide are a tiny step
/// apart.
///
/// # Errors
///
/// Where there are not as many times as points, or a point is not finite.
pub fn chord_times<V: VectorSpace>(
    points: &[V],
    exponent: V::Scalar,
    times: &mut [V::Scalar],
) -> Result<(), SplineError> {
    check_buffer(times.len(), points.len())?;
    check_finite(points)?;
    let step = |pair: &[V]| match (pair[1] - pair[0]).length() {
        _ if exponent == V::Scalar::ZERO => V::Scalar::ONE,
        length if length > V::Scalar::ZERO => (length.ln() * exponent).exp(),
        _ => V::Scalar::ZERO,
    };
    let total = points.windows(2).map(step).fold(V::Scalar::ZERO, |a, b| a + b);
    let least = (total * V::Scalar::EPSILON * V::Scalar::from_f64(64.0)).max(V::Scalar::EPSILON);
    let mut time = V::Scalar::ZERO;
    for (i, to) in times.iter_mut().enumerate() {
        if i > 0 {
            time += step(&points[i - 1..=i]).max(least);
        }
        *to = time;
    }
    Ok(())
}

/// Writes the tangents of a cardinal spline at uniform times: `(1 - tension) / 2` times the way from the point before
/// to the point after.
///
/// Tension 0 gives the uniform Catmull-Rom spline, 1 stops at each point. The ends take the way to their neighbor.
///
/// # Errors
///
/// Where there are not as many tangents as points.
pub fn cardinal_tangents<V: VectorSpace>(
    points: &[V],
    tension: V::Scalar,
    tangents: &mut [V],
) -> Result<(), SplineError> {
    check_buffer(tangents.len(), points.len())?;
    let loose = V::Scalar::ONE - tension;
    for (i, tangent) in tangents.iter_mut().enumerate() {
        let (before, after) = neighbors(points, i);
        let steps = V::Scalar::from_usize(after - before).max(V::Scalar::ONE);
        *tangent = (points[after] - points[before]) * (loose / steps);
    }
    Ok(())
}

/// Writes the tangents of a Catmull-Rom spline at any times, as those of [`chord_times`].
///
/// Each is the derivative of the parabola through a point and its neighbors, which is what the pyramid of Barry and
/// Goldman 1988 gives; the ends take the parabola of their neighbor, two points a line.
///
/// # Errors
///
/// Where there are not as many times and tangents as points, less than two, or the times do not ascend.
pub fn catmull_rom_tangents<V: VectorSpace>(
    times: &[V::Scalar],
    points: &[V],
    tangents: &mut [V],
) -> Result<(), SplineError> {
    check_times(times, points.len())?;
    check_buffer(tangents.len(), points.len())?;
    let slope = |i: usize| (points[i + 1] - points[i]) / (times[i + 1] - times[i]);
    let last = points.len() - 1;
    for (i, tangent) in tangents.iter_mut().enumerate() {
        let middle = i.clamp(1, last.max(2) - 1);
        *tangent = if last == 1 {
            slope(0)
        } else {
            let (before, after) = (times[middle] - times[middle - 1], times[middle + 1] - times[middle]);
            let (slow, fast) = (slope(middle - 1), slope(middle));
            let bend = (fast - slow) / (before + after);
            slow + bend * ((times[i] - times[middle - 1]) + (times[i] - times[middle]))
        };
    }
    Ok(())
}

/// How a Kochanek-Bartels spline goes through a point. All numbers are 0 for a Catmull-Rom spline and lie in `[-1, 1]`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KochanekBartels<R> {
    /// How sharply it bends: 1 is tight, -1 is round.
    pub tension: R,
    /// Whether it overshoots: -1 before the point, 1 after it.
    pub bias: R,
    /// How its direction changes: 0 smoothly, -1 and 1 with corners outwards and inwards.
    pub continuity: R,
}

/// Writes the tangents of a Kochanek-Bartels spline at uniform times: those with which it arrives, and those with which
/// it leaves.
///
/// Kochanek and Bartels 1984, equations 8 and 9. At the ends the missing neighbor is mirrored.
///
/// # Errors
///
/// Where there are not as many rules and tangents as points.
pub fn kochanek_bartels_tangents<V: VectorSpace>(
    points: &[V],
    rules: &[KochanekBartels<V::Scalar>],
    [arriving, leaving]: [&mut [V]; 2],
) -> Result<(), SplineError> {
    for length in [rules.len(), arriving.len(), leaving.len()] {
        check_buffer(length, points.len())?;
    }
    let (one, half) = (V::Scalar::ONE, V::Scalar::from_f64(0.5));
    for (i, &KochanekBartels { tension, bias, continuity }) in rules.iter().enumerate() {
        let (before, after) = neighbors(points, i);
        let (mut to, mut from) = (points[i] - points[before], points[after] - points[i]);
        to = if before == i { from } else { to };
        from = if after == i { to } else { from };
        let tight = (one - tension) * half;
        let [out, inward] = [one + continuity, one - continuity];
        arriving[i] = to * (tight * (one + bias) * inward) + from * (tight * (one - bias) * out);
        leaving[i] = to * (tight * (one + bias) * out) + from * (tight * (one - bias) * inward);
    }
    Ok(())
}

/// How a C2 curve through points begins and ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EndCondition<V> {
    /// Without curvature: the natural spline, the one that bends least.
    Natural,
    /// With these tangents.
    Clamped([V; 2]),
    /// The first two and the last two cubics are one each, so that cubics are reproduced; four points at least.
    NotAKnot,
    /// As it ends, it begins: the first and the last point are the same, and so are their tangents and curvatures.
    Periodic,
}

/// Writes the tangents of the curve through points at given times whose curvature changes nowhere at once (C2).
///
/// One linear equation for each point says that the second derivatives of both neighbors agree there. The matrix has
/// three diagonals and is solved by elimination, which is stable as its diagonal dominates; `scratch` is as long as
/// twice the points. De Boor, "A Practical Guide to Splines", chapter IV; what closes a periodic curve is added by the
/// formula of Sherman and Morrison.
///
/// # Errors
///
/// Where there are less than two points (four for [`NotAKnot`](EndCondition::NotAKnot), three for
/// [`Periodic`](EndCondition::Periodic)), a buffer does not fit or the times do not ascend.
pub fn c2_tangents<V: VectorSpace>(
    times: &[V::Scalar],
    points: &[V],
    ends: EndCondition<V>,
    scratch: &mut [V::Scalar],
    tangents: &mut [V],
) -> Result<(), SplineError> {
    let least = match ends {
        EndCondition::NotAKnot => 4,
        EndCondition::Periodic => 3,
        EndCondition::Natural | EndCondition::Clamped(_) => 2,
    };
    if points.len() < least {
        return Err(SplineError::PointCount { points: points.len(), wanted: least });
    }
    check_times(times, points.len())?;
    check_buffer(tangents.len(), points.len())?;
    check_buffer(scratch.len(), 2 * points.len())?;
    let (upper, correction) = scratch.split_at_mut(points.len());
    let equations = C2 { times, points };
    if ends == EndCondition::Periodic {
        equations.solve_periodic(upper, correction, tangents);
    } else {
        equations.solve_open(ends, upper, tangents);
    }
    Ok(())
}

/// The equations for the tangents of a C2 curve.
struct C2<'a, V: VectorSpace> {
    times: &'a [V::Scalar],
    points: &'a [V],
}

/// A row of three diagonals and its right side.
struct Row<V: VectorSpace> {
    factors: [V::Scalar; 3],
    right: V,
}

impl<V: VectorSpace> C2<'_, V> {
    fn step(&self, i: usize) -> V::Scalar {
        self.times[i + 1] - self.times[i]
    }

    fn slope(&self, i: usize) -> V {
        (self.points[i + 1] - self.points[i]) / self.step(i)
    }

    /// Equal second derivatives where piece `before` meets piece `after`.
    fn joint(&self, before: usize, after: usize) -> Row<V> {
        let (a, b) = (self.step(before), self.step(after));
        let three = V::Scalar::from_f64(3.0);
        let factors = [b, (a + b) + (a + b), a];
        Row { factors, right: (self.slope(before) * b + self.slope(after) * a) * three }
    }

    fn solve_open(&self, ends: EndCondition<V>, upper: &mut [V::Scalar], tangents: &mut [V]) {
        let last = self.points.len() - 1;
        let row = |i: usize| if i == 0 || i == last { self.end(ends, i) } else { self.joint(i - 1, i) };
        let (mut above, mut value) = (V::Scalar::ZERO, V::default());
        for i in 0..=last {
            let Row { factors: [a, b, c], right } = row(i);
            let pivot = b - a * above;
            above = c / pivot;
            value = (right - value * a) / pivot;
            (upper[i], tangents[i]) = (above, value);
        }
        (0..last).rev().for_each(|i| tangents[i] = tangents[i] - tangents[i + 1] * upper[i]);
    }

    /// The first or the last equation.
    fn end(&self, ends: EndCondition<V>, i: usize) -> Row<V> {
        let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
        let two = one + one;
        let piece = i.saturating_sub(1);
        let inward = |near, far| if i == 0 { [zero, near, far] } else { [far, near, zero] };
        match ends {
            EndCondition::Clamped([from, to]) => {
                Row { factors: [zero, one, zero], right: if i == 0 { from } else { to } }
            }
            EndCondition::NotAKnot => {
                let (own, next) = if i == 0 { (0, 1) } else { (i - 1, i - 2) };
                let (a, b) = (self.step(own), self.step(next));
                let d = a + b;
                let right = (self.slope(own) * ((a + d * two) * b) + self.slope(next) * (a * a)) / d;
                Row { factors: inward(b, d), right }
            }
            EndCondition::Natural | EndCondition::Periodic => {
                Row { factors: inward(two, one), right: self.slope(piece) * (two + one) }
            }
        }
    }

    /// The corner elements of the matrix are moved into a product of two vectors: the first and the last point have one
    /// tangent, row 0.
    fn solve_periodic(&self, upper: &mut [V::Scalar], correction: &mut [V::Scalar], tangents: &mut [V]) {
        let n = self.points.len() - 1;
        let row = |i: usize| self.joint(if i == 0 { n - 1 } else { i - 1 }, i);
        let ([corner, diagonal, _], [.., low]) = (row(0).factors, row(n - 1).factors);
        let gamma = -diagonal;
        let (mut above, mut value, mut z) = (V::Scalar::ZERO, V::default(), V::Scalar::ZERO);
        for i in 0..n {
            let Row { factors: [a, b, c], right } = row(i);
            let a = if i == 0 { V::Scalar::ZERO } else { a };
            let b = match i {
                0 => b - gamma,
                _ if i == n - 1 => b - corner * low / gamma,
                _ => b,
            };
            let unit = match i {
                0 => gamma,
                _ if i == n - 1 => low,
                _ => V::Scalar::ZERO,
            };
            let pivot = b - a * above;
            above = c / pivot;
            value = (right - value * a) / pivot;
            z = (unit - z * a) / pivot;
            (upper[i], tangents[i], correction[i]) = (above, value, z);
        }
        for i in (0..n - 1).rev() {
            tangents[i] = tangents[i] - tangents[i + 1] * upper[i];
            correction[i] -= correction[i + 1] * upper[i];
        }
        let share = corner / gamma;
        let factor = V::Scalar::ONE / (V::Scalar::ONE + correction[0] + correction[n - 1] * share);
        let excess = (tangents[0] + tangents[n - 1] * share) * factor;
        (0..n).for_each(|i| tangents[i] = tangents[i] - excess * correction[i]);
        tangents[n] = tangents[0];
    }
}

/// The points before and after a point, or itself at the ends.
fn neighbors<V>(points: &[V], i: usize) -> (usize, usize) {
    (i.saturating_sub(1), (i + 1).min(points.len() - 1))
}

/// Whether there are as many times as points, at least two, and all ascend.
fn check_times<R: Real>(times: &[R], points: usize) -> Result<(), SplineError> {
    if points < 2 {
        return Err(SplineError::PointCount { points, wanted: 2 });
    }
    check_buffer(times.len(), points)?;
    if let Some(index) = times.iter().position(|&time| !is_finite(time)) {
        return Err(SplineError::KnotNotFinite { index });
    }
    match times.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(index) => {
            Err(SplineError::Decreasing { index: index + 1, knots: [times[index], times[index + 1]].map(R::to_f64) })
        }
        None => Ok(()),
    }
}
