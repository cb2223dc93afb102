//! A surface cut along its creases, so that every part has a normal that changes without jumps.

use alloc::vec;
use alloc::vec::Vec;

use super::super::{BSplineSurface, Direction, KnotVector, Scalar, SurfacePoint};
use crate::math::{Real, Vector, VectorSpace};

/// Squared sine of the angle, 0.06 degrees, from which a line of knots is a crease.
const CREASE: f64 = 1e-6;

/// A part of a surface between creases.
pub(super) struct Block<'a, P: VectorSpace> {
    knots: [KnotVector<'a, P::Scalar>; 2],
    points: Vec<P>,
}

impl<P: SurfacePoint> Block<'_, P> {
    pub fn surface(&self) -> BSplineSurface<'_, P> {
        BSplineSurface::assume(self.knots, &self.points)
    }
}

/// The parts of a surface; it is its only one if it has no creases.
pub(super) fn blocks<'a, P: SurfacePoint>(surface: &BSplineSurface<'a, P>) -> Vec<Block<'a, P>> {
    let [us, vs] = [Direction::U, Direction::V].map(|direction| ranges(surface, direction));
    let pairs = vs.iter().flat_map(|&v| us.iter().map(move |&u| [u, v]));
    pairs.map(|spans| block(surface, spans)).collect()
}

/// First and last interval of the knots between two creases.
type Range = [usize; 2];

fn ranges<P: SurfacePoint>(surface: &BSplineSurface<P>, direction: Direction) -> Vec<Range> {
    let spans: Vec<usize> = surface.knots(direction).spans().collect();
    let mut ranges = vec![[spans[0], spans[0]]];
    for pair in spans.windows(2) {
        match ranges.last_mut() {
            Some(last) if !is_crease(surface, direction, [pair[0], pair[1]]) => last[1] = pair[1],
            _ => ranges.push([pair[1], pair[1]]),
        }
    }
    ranges
}

/// Whether the normal jumps between two intervals.
fn is_crease<P: SurfacePoint>(surface: &BSplineSurface<P>, direction: Direction, [left, right]: [usize; 2]) -> bool {
    if right - left < surface.knots(direction).degree() {
        return false;
    }
    let other = if direction == Direction::U { Direction::V } else { Direction::U };
    let across = surface.knots(other);
    across.spans().any(|span| {
        let [low, high] = interval(&across, span);
        [0.25, 0.75].iter().any(|&share| {
            let t = low + (high - low) * Scalar::<P>::from_f64(share);
            let [before, after] = [left, right].map(|span| normal_beside(surface, direction, span, [left, right], t));
            before.cross(after).length_squared() > Scalar::<P>::from_f64(CREASE)
                || before.dot(after) < Scalar::<P>::ZERO
        })
    })
}

/// The normal on the line between two intervals, as one of them has it.
fn normal_beside<P: SurfacePoint>(
    surface: &BSplineSurface<P>,
    direction: Direction,
    own: usize,
    [_, right]: [usize; 2],
    t: Scalar<P>,
) -> P::Point {
    let knots = surface.knots(direction);
    let at = knots.knots()[right];
    let other = if direction == Direction::U { Direction::V } else { Direction::U };
    let cross_span = surface.knots(other).span(t);
    let (spans, [u, v]) = match direction {
        Direction::U => ([own, cross_span], [at, t]),
        Direction::V => ([cross_span, own], [t, at]),
    };
    let [[_, dv], [du, _]] = surface.derivatives_in::<2>(spans, u, v);
    du.cross(dv).normalize_or_zero()
}

fn interval<R: Real>(knots: &KnotVector<R>, span: usize) -> [R; 2] {
    [knots.knots()[span], knots.knots()[span + 1]]
}

fn block<'a, P: SurfacePoint>(surface: &BSplineSurface<'a, P>, ranges: [Range; 2]) -> Block<'a, P> {
    let all = [Direction::U, Direction::V].map(|direction| surface.knots(direction));
    let knots = [0, 1].map(|k| {
        let ([first, last], p) = (ranges[k], all[k].degree());
        KnotVector::trusted(&all[k].knots()[first - p..=last + p + 1], p)
    });
    let [[left, right], [bottom, top]] = ranges;
    let [p, q] = [all[0].degree(), all[1].degree()];
    let rows = surface.points().chunks_exact(surface.columns()).skip(bottom - q).take(top + q + 1 - bottom);
    let points = rows.flat_map(|row| row[left - p..=right].iter().copied()).collect();
    Block { knots, points }
}
