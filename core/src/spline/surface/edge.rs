//! The edges of a surface, evaluated so that two surfaces that share one get the same bits.

use super::{BSplineSurface, Scalar, SurfacePoint};
use crate::math::Real;
use crate::spline::basis::cox_de_boor_orders;
use crate::spline::bezier::MAX_ORDER;
use crate::spline::{KnotVector, MAX_DEGREE};

/// One of the four edges of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At the first `v`, along `u`.
    Bottom,
    /// At the last `u`, along `v`.
    Right,
    /// At the last `v`, along `u`.
    Top,
    /// At the first `u`, along `v`.
    Left,
}

impl Side {
    /// The parameter that changes along it: 0 for `u`, 1 for `v`.
    #[cfg(feature = "alloc")]
    pub(in crate::spline) fn along(self) -> usize {
        usize::from(!self.is_along_u())
    }

    /// Whether `u` changes along it.
    pub(in crate::spline) fn is_along_u(self) -> bool {
        matches!(self, Self::Bottom | Self::Top)
    }
}

/// The control points of an edge that have an influence in an interval of its knots.
struct EdgePiece<'a, P: SurfacePoint> {
    points: [P; MAX_ORDER],
    knots: KnotVector<'a, Scalar<P>>,
    span: usize,
}

impl<P: SurfacePoint> BSplineSurface<'_, P> {
    /// The point of an edge at a parameter, with its derivative.
    ///
    /// It depends on the control points and knots of the edge alone and not on its direction: so neighbors that share
    /// the control points of an edge share the points on it, bit by bit, if the first and the last knots across the edge
    /// are as many as their degree and their distances along it are powers of two.
    pub fn edge(&self, side: Side, t: Scalar<P>) -> [P::Point; 2] {
        let knots = self.knots_of(side);
        let after = knots.span(t);
        // What is the piece after a knot for one side is the piece before it for the other.
        let is_inner = t == knots.knots()[after] && after > knots.span(knots.domain()[0]);
        let before = if is_inner { (0..after).rev().find(|&k| knots.knots()[k] < t).unwrap_or(after) } else { after };
        let [of_after, of_before] = [after, before].map(|span| self.edge_piece(side, span).at(t));
        let half = Scalar::<P>::from_f64(0.5);
        [0, 1].map(|k| (of_after[k] + of_before[k]) * half)
    }

    /// The knots along an edge.
    pub fn knots_of(&self, side: Side) -> KnotVector<'_, Scalar<P>> {
        self.knots(if side.is_along_u() { super::Direction::U } else { super::Direction::V })
    }

    fn edge_piece(&self, side: Side, span: usize) -> EdgePiece<'_, P> {
        let knots = self.knots_of(side);
        let across = self.knots(if side.is_along_u() { super::Direction::V } else { super::Direction::U });
        let [low, high] = across.domain();
        let end = if matches!(side, Side::Bottom | Side::Left) { low } else { high };
        let across_span = across.span(end);
        let weights = across.basis(across_span, end);
        let mut points = [P::default(); MAX_ORDER];
        let spans = if side.is_along_u() { [span, across_span] } else { [across_span, span] };
        for (j, row) in self.rows(spans).enumerate() {
            for (i, &point) in row.iter().enumerate() {
                let [along, across] = if side.is_along_u() { [i, j] } else { [j, i] };
                points[along] += point * weights[across];
            }
        }
        EdgePiece { points, span, knots }
    }
}

impl<P: SurfacePoint> EdgePiece<'_, P> {
    /// The mean of what the piece gives forwards and backwards.
    fn at(&self, t: Scalar<P>) -> [P::Point; 2] {
        let p = self.knots.degree();
        let mut local = [Scalar::<P>::ZERO; 2 * MAX_DEGREE];
        let local = &mut local[..2 * p];
        local.copy_from_slice(&self.knots.knots()[self.span + 1 - p..=self.span + p]);
        let forwards = sums(self.points[..=p].iter(), local, p, t);
        local.reverse();
        local.iter_mut().for_each(|knot| *knot = -*knot);
        let backwards = sums(self.points[..=p].iter().rev(), local, p, -t);
        let half = Scalar::<P>::from_f64(0.5);
        [(forwards[0] + backwards[0]) * half, (forwards[1] - backwards[1]) * half]
    }
}

/// Point and derivative of a piece of a curve.
fn sums<'p, P: SurfacePoint>(
    points: impl Iterator<Item = &'p P>,
    local: &[Scalar<P>],
    p: usize,
    t: Scalar<P>,
) -> [P::Point; 2] {
    let basis = cox_de_boor_orders::<_, MAX_ORDER, 2>(local, p, t);
    let mut partials = [[P::default(); 2]; 2];
    for (i, &point) in points.enumerate() {
        partials[0][0] += point * basis[0][i];
        partials[1][0] += point * basis[1][i];
    }
    // Divided, not multiplied by the reciprocal: a control point comes out as it is.
    let [_, [first, _]] = P::project_partials(partials);
    let (scaled, weight) = partials[0][0].to_scaled();
    [scaled / weight, first]
}
