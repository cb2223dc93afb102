//! The point of a surface that is nearest to a point in space.

use super::ray::{MOST_POINTS, STACK};
use super::{BSplineSurface, Direction, Scalar, SurfacePoint};
use crate::math::{Real, Vector, VectorSpace as _};
use crate::spline::blossom::cut_out;
use crate::spline::split::hull;

/// A point of a surface and how far it is away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoint<V: Vector> {
    /// Of the surface.
    pub parameters: [V::Scalar; 2],
    /// On the surface.
    pub point: V,
    /// Between both points, in meters.
    pub distance: V::Scalar,
}

/// Parts whose boxes are not nearer than this share of what was found are left out.
const NEARER: f64 = 0.999;
/// How often a side of a piece is halved at most.
const HALVINGS: i32 = 10;
/// Steps of Newton's method from the middle of each part.
const STEPS: usize = 8;

/// From where to where a part goes in `u` and in `v`.
type Part<R> = [[R; 2]; 2];

struct Search<'s, 'a, P: SurfacePoint> {
    surface: &'s BSplineSurface<'a, P>,
    target: P::Point,
    best: NearestPoint<P::Point>,
}

impl<P: SurfacePoint> BSplineSurface<'_, P> {
    /// The point of the surface that is nearest to a point; where several are within 0.1 % of it, one of them.
    ///
    /// Parts whose boxes are further away than what was found already are left out; in the others Newton's method starts
    /// from the middle, and they are halved.
    pub fn nearest(&self, target: P::Point) -> NearestPoint<P::Point> {
        let [[u, _], [v, _]] = self.domain();
        let point = self.point(u, v);
        let best = NearestPoint { parameters: [u, v], point, distance: (point - target).length() };
        let mut search = Search { surface: self, target, best };
        // Of a point beyond all numbers, all points are as far away as the first one.
        if search.best.distance.partial_cmp(&Scalar::<P>::INFINITY) != Some(core::cmp::Ordering::Less) {
            return search.best;
        }
        let knots = [Direction::U, Direction::V].map(|direction| self.knots(direction));
        for j in knots[1].spans() {
            knots[0].spans().for_each(|i| search.piece([i, j]));
        }
        search.best
    }
}

impl<P: SurfacePoint> Search<'_, '_, P> {
    fn piece(&mut self, spans: [usize; 2]) {
        let knots = [Direction::U, Direction::V].map(|direction| self.surface.knots(direction));
        let whole = [0, 1].map(|k| [knots[k].knots()[spans[k]], knots[k].knots()[spans[k] + 1]]);
        let finest = whole.map(|[low, high]| (high - low) / Scalar::<P>::from_usize(1 << HALVINGS));
        let mut stack = [whole; STACK];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let part = stack[height];
            let Some(k) = self.part(spans, part) else { continue };
            if part[k][1] - part[k][0] > finest[k] && height + 2 <= STACK {
                let middle = (part[k][0] + part[k][1]) * Scalar::<P>::from_f64(0.5);
                (stack[height], stack[height + 1]) = (part, part);
                stack[height][k][0] = middle;
                stack[height + 1][k][1] = middle;
                height += 2;
            }
        }
    }

    /// Looks at a part; the longer one of its sides if a part of it may be nearer.
    fn part(&mut self, spans: [usize; 2], part: Part<Scalar<P>>) -> Option<usize> {
        let knots = [Direction::U, Direction::V].map(|direction| self.surface.knots(direction));
        let local = [0, 1].map(|k| {
            let p = knots[k].degree();
            &knots[k].knots()[spans[k] + 1 - p..=spans[k] + p]
        });
        let mut net = [P::default(); MOST_POINTS];
        let [columns, rows] = knots.map(|knots| knots.degree() + 1);
        let points = self.surface.rows(spans).flatten();
        net.iter_mut().zip(points).for_each(|(slot, &point)| *slot = point);
        let net = &mut net[..columns * rows];
        cut_out(net, local, part);
        if self.distance_to_box(hull(net)) >= self.best.distance * Scalar::<P>::from_f64(NEARER) {
            return None;
        }
        self.improve(part.map(|[low, high]| (low + high) * Scalar::<P>::from_f64(0.5)));
        let corner = |index: usize| net[index].project();
        let width =
            (corner(columns - 1) - corner(0)).length() + (corner(net.len() - 1) - corner(net.len() - columns)).length();
        let height =
            (corner(net.len() - columns) - corner(0)).length() + (corner(net.len() - 1) - corner(columns - 1)).length();
        Some(usize::from(height > width))
    }

    fn distance_to_box(&self, [low, high]: [P::Point; 2]) -> Scalar<P> {
        let (at, low, high) = (self.target.to_array(), low.to_array(), high.to_array());
        let outside = core::array::from_fn(|k| (low[k] - at[k]).max(at[k] - high[k]).max(Scalar::<P>::ZERO));
        P::Point::from_array(outside).length()
    }

    /// Newton's method for `(S - x) . S_u = (S - x) . S_v = 0`; the steps of Gauss where that leads to no minimum.
    fn improve(&mut self, mut at: [Scalar<P>; 2]) {
        let domain = self.surface.domain();
        for _ in 0..STEPS {
            let jet = self.surface.at(at[0], at[1]);
            let from = jet.point - self.target;
            let distance = from.length();
            if distance < self.best.distance {
                self.best = NearestPoint { parameters: at, point: jet.point, distance };
            }
            let gradient = [from.dot(jet.du), from.dot(jet.dv)];
            let first = [jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.dv.dot(jet.dv)];
            let second = [from.dot(jet.duu), from.dot(jet.duv), from.dot(jet.dvv)];
            let whole = [0, 1, 2].map(|k| first[k] + second[k]);
            let is_minimum = |[a, b, c]: [Scalar<P>; 3]| a > Scalar::<P>::ZERO && a * c - b * b > Scalar::<P>::ZERO;
            let [a, b, c] = if is_minimum(whole) { whole } else { first };
            let determinant = a * c - b * b;
            if determinant.partial_cmp(&Scalar::<P>::ZERO).is_none_or(core::cmp::Ordering::is_le) {
                return;
            }
            let step =
                [(gradient[0] * c - gradient[1] * b) / determinant, (gradient[1] * a - gradient[0] * b) / determinant];
            let next = [0, 1].map(|k| (at[k] - step[k]).clamp(domain[k][0], domain[k][1]));
            if next == at {
                return;
            }
            at = next;
        }
    }
}
