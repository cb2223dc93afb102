//! The same curve with more knots, and nearly the same one with less: Boehm, Oslo, Bezier segments.

use super::bezier::MAX_ORDER;
use super::blossom::blossom;
use super::control_point::{check_degree, check_points};
use super::split::check_buffer;
use super::{BSpline, ControlPoint, KnotVector, SplineError};
use crate::math::Real;

impl<P: ControlPoint> BSpline<'_, P> {
    /// Writes knots and control points of the same curve with one knot more, as an open one.
    ///
    /// Both buffers are longer by one than the knots and the control points of an open curve. Boehm 1980: new points
    /// lie on the legs of the control polygon; "The NURBS Book", equation 5.15.
    ///
    /// # Errors
    ///
    /// Where the parameter lies outside of the domain or is a knot with full multiplicity, or a buffer does not fit.
    pub fn insert(&self, t: P::Scalar, knots: &mut [P::Scalar], points: &mut [P]) -> Result<(), SplineError> {
        check_buffer(points.len(), self.knots().count() + 1)?;
        let span = self.knots().insert(t, knots)?;
        points.iter_mut().enumerate().for_each(|(i, point)| *point = self.boehm(span, t, i));
        Ok(())
    }

    /// Writes the control points of the same curve on finer knots, which hold all of its own ones.
    ///
    /// Point `i` is the blossom of the curve at the knots `i + 1` to `i + degree`: the Oslo algorithm of Cohen, Lyche
    /// and Riesenfeld 1980, with as many rounds as there are new ones among them, which makes all steps interpolate
    /// (Lyche and Morken 1986).
    ///
    /// # Errors
    ///
    /// Where the degree is another one, an old knot is missing, a new one lies outside of the domain, or the buffer does
    /// not fit.
    pub fn refine(&self, finer: KnotVector<P::Scalar>, points: &mut [P]) -> Result<(), SplineError> {
        let (old, degree) = (self.knots().knots(), self.degree());
        if finer.degree() != degree {
            return Err(SplineError::Degree { degree: finer.degree() });
        }
        check_buffer(points.len(), finer.count())?;
        let mut passed = 0;
        for &knot in finer.knots() {
            // Of equal knots the old ones come first.
            if old.get(passed) == Some(&knot) {
                passed += 1;
            } else if old.get(passed).is_some_and(|&missing| knot > missing) {
                return Err(SplineError::MissingKnot { index: passed });
            } else {
                self.knots().check_inside(knot)?;
            }
        }
        if passed < old.len() {
            return Err(SplineError::MissingKnot { index: passed });
        }
        let mut passed = 0;
        for (i, point) in points.iter_mut().enumerate() {
            passed += usize::from(old[passed] == finer.knots()[i]);
            *point = self.oslo(passed, &finer.knots()[i + 1..=i + degree]);
        }
        Ok(())
    }

    /// The blossom at knots of which some are the next old ones after the first `passed` ones and all lie between two
    /// others.
    fn oslo(&self, passed: usize, arguments: &[P::Scalar]) -> P {
        let (old, degree) = (self.knots().knots(), self.degree());
        let (mut fresh, mut count, mut next) = ([P::Scalar::ZERO; MAX_ORDER], 0, passed);
        for &knot in arguments {
            if old.get(next) == Some(&knot) {
                next += 1;
            } else {
                fresh[count] = knot;
                count += 1;
            }
        }
        let first = passed - 1 - count;
        let mut points = [P::default(); MAX_ORDER];
        (0..=count).for_each(|k| points[k] = self.control(first + k));
        for (round, &knot) in fresh[..count].iter().enumerate() {
            for k in 0..count - round {
                let [low, high] = [first + k + round + 1, first + k + degree + 1].map(|index| old[index]);
                points[k] = points[k].lerp(points[k + 1], (knot - low) / (high - low));
            }
        }
        points[0]
    }

    /// Writes knots and control points of a curve with one knot less; returns how far it is away at most.
    ///
    /// Boehm's rule is solved from both sides for the points that the knot had moved. The distance is that of the
    /// control points when the knot is inserted again, which bounds that of the curves; 0 to rounding where the curve
    /// does not need the knot. Of rational curves it is measured in homogeneous coordinates. After Tiller 1992; "The
    /// NURBS Book", section 5.4.
    ///
    /// # Errors
    ///
    /// Where there is no such knot inside of the domain, or a buffer is not shorter by one than the knots and the
    /// control points of an open curve; where a weight of the curve without the knot is not positive, as it may be where
    /// the weights differ much: then the buffers hold what is no curve.
    pub fn remove(&self, knot: P::Scalar, knots: &mut [P::Scalar], points: &mut [P]) -> Result<P::Scalar, SplineError> {
        let (old, degree) = (self.knots().knots(), self.degree());
        let [start, end] = self.knots().domain();
        let multiplicity = self.knots().multiplicity(knot);
        if multiplicity == 0 || knot <= start || knot >= end {
            return Err(self.knots().outside(knot));
        }
        check_buffer(knots.len(), old.len() - 1)?;
        check_buffer(points.len(), self.knots().count() - 1)?;
        let last = old.partition_point(|&other| other <= knot) - 1;
        knots[..last].copy_from_slice(&old[..last]);
        knots[last..].copy_from_slice(&old[last + 1..]);
        self.solve_boehm([last - degree, last - multiplicity], knot, points);
        check_points(points)?;
        let without = BSpline::trusted(KnotVector::trusted(knots, degree), points);
        let moved = |i: usize| (without.boehm(last - 1, knot, i) - self.control(i)).length();
        Ok((last - degree..=last - multiplicity.min(degree)).map(moved).fold(P::Scalar::ZERO, Real::max))
    }

    /// Control point `i` after insertion of a knot behind knot `span`.
    fn boehm(&self, span: usize, knot: P::Scalar, i: usize) -> P {
        self.knots().boehm(span, knot, i, |k| self.control(k))
    }

    /// The control points before a knot was inserted, which moved those of `first..=last`: half of them from either side.
    fn solve_boehm(&self, [first, last]: [usize; 2], knot: P::Scalar, points: &mut [P]) {
        let (old, degree) = (self.knots().knots(), self.degree());
        let share = |i: usize| (knot - old[i]) / (old[i + degree + 1] - old[i]);
        points.iter_mut().enumerate().for_each(|(i, point)| *point = self.control(if i < first { i } else { i + 1 }));
        let middle = usize::midpoint(first, last + 1);
        for i in first..middle.min(last) {
            points[i] = (self.control(i) - points[i - 1] * (P::Scalar::ONE - share(i))) / share(i);
        }
        for i in (middle..last).rev() {
            let s = share(i + 1);
            points[i] = (self.control(i + 1) - points[i + 1] * s) / (P::Scalar::ONE - s);
        }
    }

    /// Writes the control points of the Bezier curve that is the piece of a span.
    ///
    /// Point `i` is the blossom with `i` times the end of the piece and else its beginning. `span` comes from
    /// [`span`](KnotVector::span) or [`spans`](KnotVector::spans); any other number stands for the piece to which its knot
    /// belongs, or for the last one.
    ///
    /// # Errors
    ///
    /// Where the buffer does not have length `degree + 1`.
    pub fn bezier(&self, span: usize, points: &mut [P]) -> Result<(), SplineError> {
        check_buffer(points.len(), self.degree() + 1)?;
        let knots = self.knots().knots();
        let span = self.knots().piece(span);
        let [start, end] = [knots[span], knots[span + 1]];
        for (i, point) in points.iter_mut().enumerate() {
            let mut arguments = [start; MAX_ORDER];
            arguments[..i].fill(end);
            *point = self.blossom(span, &arguments[..self.degree()]);
        }
        Ok(())
    }

    /// The blossom of the piece of a span: the polynomial of `degree` arguments that is linear in each, does not
    /// depend on their order, and is the piece where all are equal.
    ///
    /// De Boor's algorithm with another parameter in each round. Ramshaw 1989. Spans are as for
    /// [`bezier`](Self::bezier).
    pub fn blossom(&self, span: usize, arguments: &[P::Scalar]) -> P {
        let degree = self.degree();
        let span = self.knots().piece(span);
        let mut points = [P::default(); MAX_ORDER];
        (0..=degree).for_each(|i| points[i] = self.control(span - degree + i));
        blossom(&points[..=degree], self.knots().around(span), arguments.iter().copied())
    }

    /// The longest span of this curve of those on which basis function `i` of finer knots of a degree acts.
    ///
    /// From there the way to the knots of that function is the shortest, in lengths of the span.
    pub(super) fn span_of(&self, finer: &[P::Scalar], degree: usize, i: usize) -> usize {
        let [start, end] = self.knots().domain();
        let acts = |&span: &usize| {
            let knots = self.knots().knots();
            knots[span] < finer[i + degree + 1].min(end) && knots[span + 1] > finer[i].max(start)
        };
        let length = |span: usize| self.knots().knots()[span + 1] - self.knots().knots()[span];
        let longer = |a: usize, b: usize| if length(b) > length(a) { b } else { a };
        self.knots().spans().filter(acts).reduce(longer).unwrap_or(self.knots().span(finer[i]))
    }
}

/// Writes the knots of Bezier curves in a row: each break `degree` times, the outer ones once more.
///
/// The control points are those of the Bezier curves one after the other, without the first one of each but the first.
///
/// # Errors
///
/// Where the degree is 0 or too high, there are less than two breaks, or the buffer does not have length
/// `degree * breaks + 2`.
pub fn bezier_knots<R: Real>(breaks: &[R], degree: usize, knots: &mut [R]) -> Result<(), SplineError> {
    check_degree(degree)?;
    check_degree(degree + 1)?;
    if breaks.len() < 2 {
        return Err(SplineError::KnotCount { knots: breaks.len(), least: 2 });
    }
    check_buffer(knots.len(), degree * breaks.len() + 2)?;
    let last = knots.len() - 1;
    for (i, knot) in knots.iter_mut().enumerate() {
        *knot = breaks[(i.clamp(1, last - 1) - 1) / degree];
    }
    Ok(())
}
