//! Knots: where the pieces of a B-spline join.

use super::control_point::check_highest;
use super::split::check_buffer;
use super::{MAX_DEGREE, SplineError};
use crate::math::{Real, VectorSpace};

/// Knots in non-decreasing order, and the degree of the polynomials between them.
///
/// With `m` knots and degree `p` there are `m - p - 1` basis functions. The domain runs from knot `p` to knot
/// `m - p - 1`, counted from 0. A knot that stands `k` times joins its pieces with `p - k` continuous derivatives; at
/// most `p + 1` may be equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnotVector<'a, R> {
    knots: &'a [R],
    degree: usize,
}

/// So many knots are counted faster than searched: no step waits for the one before it.
const FEW: usize = 24;

impl<'a, R: Real> KnotVector<'a, R> {
    /// Any knots: clamped, uniform, periodic or with multiple ones.
    ///
    /// # Errors
    ///
    /// Where the degree is above [`MAX_DEGREE`], there are less than `2 (degree + 1)` knots, one is not finite or
    /// smaller than the one before it, more than `degree + 1` are equal, or the domain is empty.
    pub fn new(knots: &'a [R], degree: usize) -> Result<Self, SplineError> {
        check_highest(degree)?;
        let order = degree + 1;
        if knots.len() < 2 * order {
            return Err(SplineError::KnotCount { knots: knots.len(), least: 2 * order });
        }
        if let Some(index) = knots.iter().position(|knot| !is_finite(*knot)) {
            return Err(SplineError::KnotNotFinite { index });
        }
        if let Some(index) = knots.windows(2).position(|pair| pair[1] < pair[0]) {
            let knots = [knots[index], knots[index + 1]].map(R::to_f64);
            return Err(SplineError::Decreasing { index: index + 1, knots });
        }
        if let Some(index) = knots.windows(order + 1).position(|equal| equal[0] == equal[order]) {
            return Err(SplineError::Multiplicity { index: index + order, most: order });
        }
        if knots[degree] == knots[knots.len() - order] {
            return Err(SplineError::EmptyDomain);
        }
        Ok(Self { knots, degree })
    }

    /// Knots that were checked before, or computed from such.
    pub(super) fn trusted(knots: &'a [R], degree: usize) -> Self {
        Self { knots, degree }
    }

    /// The knots.
    pub fn knots(&self) -> &'a [R] {
        self.knots
    }

    /// The degree of the polynomials.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The number of basis functions, and of the control points of an open curve.
    pub fn count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// The first and the last parameter.
    pub fn domain(&self) -> [R; 2] {
        [self.knots[self.degree], self.knots[self.count()]]
    }

    /// The index of the knot that begins the piece of parameter `t`, which is never empty.
    ///
    /// A parameter at a knot belongs to the piece after it, at the end of the domain to the last piece; what lies
    /// outside of the domain, to the first or the last piece. "The NURBS Book", algorithm A2.1.
    #[inline]
    pub fn span(&self, t: R) -> usize {
        self.span_inlined(t)
    }

    /// The same without a call, which takes a twentieth of a point of [`Bicubics`](super::Bicubics).
    #[inline(always)]
    pub(super) fn span_inlined(&self, t: R) -> usize {
        let [start, end] = self.domain();
        let t = if t > start { t } else { start };
        let inner = &self.knots[self.degree + 1..self.count()];
        // Without a branch, which no processor could guess.
        let is_before = |knot: R| (knot <= t) & (knot < end);
        self.degree
            + if inner.len() <= FEW {
                inner.iter().map(|&knot| usize::from(is_before(knot))).sum::<usize>()
            } else {
                inner.partition_point(|&knot| is_before(knot))
            }
    }

    /// As [`span`](Self::span), but faster where `near` is the answer, or the one before it.
    #[inline]
    pub fn span_near(&self, t: R, near: usize) -> usize {
        let is_in = |span: usize| match self.knots.get(span..span + 2) {
            Some(&[low, high]) => low <= t && t < high,
            _ => false,
        };
        let is_inside = near >= self.degree && near + 1 < self.count();
        if is_inside && is_in(near) {
            near
        } else if is_inside && is_in(near + 1) {
            near + 1
        } else {
            self.span(t)
        }
    }

    /// How many knots equal `t`.
    pub fn multiplicity(&self, t: R) -> usize {
        self.knots.iter().filter(|&&knot| knot == t).count()
    }

    /// The pieces: the index of the knot that begins each, in order. None is empty.
    pub fn spans(&self) -> impl Iterator<Item = usize> + use<'a, R> {
        let knots = self.knots;
        (self.degree..self.count()).filter(move |&span| knots[span] < knots[span + 1])
    }

    /// The span itself, as [`span`](Self::span) finds it; for any other number that of its knot, or of the last one.
    #[inline]
    pub(super) fn piece(&self, span: usize) -> usize {
        let is_piece = (self.degree..self.count()).contains(&span) && self.knots[span] < self.knots[span + 1];
        if is_piece { span } else { self.span(self.knots[span.min(self.knots.len() - 1)]) }
    }

    /// How many knots a period has, if the distances of the first `2 degree + 1` knots repeat themselves at the end.
    pub(super) fn period(&self) -> Result<usize, SplineError> {
        let ([start, end], all) = (self.domain(), self.knots);
        let count = self.count().saturating_sub(self.degree).max(1);
        let slack = R::EPSILON * R::from_f64(16.0) * (start.abs() + end.abs());
        let breaks = |&i: &usize| ((all[i] - all[i - count]) - (end - start)).abs() > slack;
        match (count..all.len()).find(breaks) {
            Some(index) => Err(SplineError::NotPeriodic { index }),
            None => Ok(count),
        }
    }

    /// Whether a parameter lies in the domain.
    pub(super) fn check_inside(&self, t: R) -> Result<(), SplineError> {
        let [start, end] = self.domain();
        if t >= start && t <= end { Ok(()) } else { Err(self.outside(t)) }
    }

    /// That a parameter is none of the domain.
    pub(super) fn outside(&self, t: R) -> SplineError {
        SplineError::Parameter { parameter: t.to_f64(), domain: self.domain().map(R::to_f64) }
    }

    /// Writes the knots with one more; the index of the last old one that is not larger.
    pub(super) fn insert(&self, t: R, knots: &mut [R]) -> Result<usize, SplineError> {
        self.check_inside(t)?;
        check_buffer(knots.len(), self.knots.len() + 1)?;
        let span = self.knots.partition_point(|&knot| knot <= t) - 1;
        if self.multiplicity(t) > self.degree {
            return Err(SplineError::Multiplicity { index: span + 1, most: self.degree + 1 });
        }
        knots[..=span].copy_from_slice(&self.knots[..=span]);
        knots[span + 1] = t;
        knots[span + 2..].copy_from_slice(&self.knots[span + 1..]);
        Ok(span)
    }

    /// Control point `i` after insertion of a knot behind knot `span`, from those before. Boehm 1980.
    pub(super) fn boehm<P: VectorSpace<Scalar = R>>(
        &self,
        span: usize,
        knot: R,
        i: usize,
        control: impl Fn(usize) -> P,
    ) -> P {
        let (old, degree) = (self.knots, self.degree);
        if i + degree <= span {
            control(i)
        } else if i > span || old[i] >= knot {
            control(i - 1)
        } else {
            control(i - 1).lerp(control(i), (knot - old[i]) / (old[i + degree] - old[i]))
        }
    }

    /// The first knot after `t` in the domain; its end if there is none.
    pub fn next_break(&self, t: R) -> R {
        let span = self.span(t);
        let [start, _] = self.domain();
        if t < start { start } else { self.knots[span + 1] }
    }

    /// The Greville abscissa of a basis function: the mean of its inner knots.
    ///
    /// A spline whose control points are these is the identity; control polygons are drawn over them. For degree 0 the
    /// middle between its two knots. `index` is below [`count`](Self::count); the last one stands for larger ones.
    pub fn greville(&self, index: usize) -> R {
        let index = index.min(self.count() - 1);
        let inner = match self.degree {
            0 => &self.knots[index..index + 2],
            degree => &self.knots[index + 1..=index + degree],
        };
        inner.iter().copied().sum::<R>() / R::from_usize(inner.len())
    }

    /// The `2 degree` knots around a span: the ones that decide on its basis functions.
    #[inline(always)]
    pub(super) fn around(&self, span: usize) -> &'a [R] {
        &self.knots[span + 1 - self.degree..][..2 * self.degree]
    }
}

impl<R: Real> KnotVector<'static, R> {
    /// The knots of a Bezier curve: as many zeros and ones as it has points.
    ///
    /// # Errors
    ///
    /// Where the degree is above [`MAX_DEGREE`].
    pub fn bezier(degree: usize) -> Result<Self, SplineError> {
        let spare = MAX_DEGREE.checked_sub(degree).ok_or(SplineError::Degree { degree })?;
        Ok(Self::trusted(&R::STEP[spare..spare + 2 * (degree + 1)], degree))
    }
}

/// Writes knots over `[0, 1]` at equal distances, the first and the last `degree + 1` times.
///
/// A curve with them begins at its first and ends at its last control point. `knots.len()` is the number of control
/// points plus `degree + 1`.
pub fn clamped_knots<R: Real>(knots: &mut [R], degree: usize) {
    let pieces = R::from_usize(knots.len().saturating_sub(degree.saturating_mul(2).saturating_add(1)).max(1));
    for (i, knot) in knots.iter_mut().enumerate() {
        *knot = (R::from_usize(i.saturating_sub(degree)) / pieces).min(R::ONE);
    }
}

/// Writes knots at equal distances so that the domain is `[0, 1]`.
///
/// `knots.len()` is the number of control points plus `degree + 1` for an open curve, which then begins and ends in
/// the middle of its control polygon, or plus `2 degree + 1` for a closed one.
pub fn uniform_knots<R: Real>(knots: &mut [R], degree: usize) {
    let pieces = R::from_usize(knots.len().saturating_sub(degree.saturating_mul(2).saturating_add(1)).max(1));
    for (i, knot) in knots.iter_mut().enumerate() {
        *knot = (R::from_usize(i) - R::from_usize(degree)) / pieces;
    }
}

pub(super) fn is_finite<R: Real>(x: R) -> bool {
    x.abs() < R::INFINITY
}
