//! Where a ray meets a surface.

use core::ops::{Add, Mul};

use super::{BSplineSurface, Direction, SurfacePoint};
use crate::math::{Real, Vector, VectorSpace as _};
use crate::spline::basis::cox_de_boor_orders;
use crate::spline::bezier::MAX_ORDER;
use crate::spline::blossom::cut_out;

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit<R> {
    /// From the origin of the ray, in lengths of its direction.
    pub distance: R,
    /// Of the surface.
    pub parameters: [R; 2],
}

/// The most control points of a piece.
pub(super) const MOST_POINTS: usize = MAX_ORDER * MAX_ORDER;
/// Parts that wait: each halving leaves one, and no side is halved more often than a number has bits.
pub(super) const STACK: usize = 128;
/// Parts of a piece that are looked at, for rays that lie in the surface.
const MOST_PARTS: usize = 4096;
/// Steps of Newton's method.
const STEPS: usize = 12;

/// A point in the plane across a ray: the distances from two planes through it, times the weight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Across<R>([R; 2]);

impl<R: Real> Add for Across<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }
}

impl<R: Real> Mul<R> for Across<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self([self.0[0] * factor, self.0[1] * factor])
    }
}

/// A piece of a surface as a ray sees it.
struct Seen<'a, R> {
    net: [Across<R>; MOST_POINTS],
    local: [&'a [R]; 2],
    /// From where to where it goes.
    domain: [[R; 2]; 2],
    degrees: [usize; 2],
    /// What rounding makes of zero.
    slack: R,
}

/// What a part of a piece has for the ray.
enum Verdict<R> {
    Nothing,
    Point([R; 2]),
    /// Which parameter is to be halved.
    Halve(usize),
}

impl<P: SurfacePoint> BSplineSurface<'_, P> {
    /// Where a ray first meets the surface, if it does.
    ///
    /// Seen along the ray, the surface is one in the plane, polynomial even if it is rational, and each hit a zero of it
    /// (Kajiya 1982; Nishita, Sederberg and Kakimoto 1990). Parts whose control points lie on one side are left out; the
    /// others are halved until their derivatives show that they hold one zero at most, which Newton's method finds. A
    /// part where a ray only touches is halved as far as numbers go.
    pub fn ray(&self, origin: P::Point, direction: P::Point) -> Option<SurfaceHit<P::Scalar>> {
        let squared = direction.length_squared();
        let planes = planes(direction)?;
        let knots = [Direction::U, Direction::V].map(|direction| self.knots(direction));
        let mut first: Option<SurfaceHit<P::Scalar>> = None;
        for j in knots[1].spans() {
            for i in knots[0].spans() {
                let Some(seen) = Seen::new(self, [i, j], origin, planes) else { continue };
                seen.zeros(|[u, v]| {
                    let distance = (self.point(u, v) - origin).dot(direction) / squared;
                    let is_first = first.is_none_or(|first| distance < first.distance);
                    if distance >= P::Scalar::ZERO && is_first {
                        first = Some(SurfaceHit { distance, parameters: [u, v] });
                    }
                });
            }
        }
        first
    }
}

/// Two directions at right angles to a direction and to each other.
fn planes<V: Vector>(direction: V) -> Option<[V; 2]> {
    let forward = direction.normalize_or_zero();
    let [x, y, z] = forward.to_array().map(Real::abs);
    let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
    let other = if x <= y && x <= z {
        [one, zero, zero]
    } else if y <= z {
        [zero, one, zero]
    } else {
        [zero, zero, one]
    };
    let right = forward.cross(V::from_array(other)).normalize_or_zero();
    (right.length_squared() > zero).then(|| [right, forward.cross(right)])
}

impl<'a, R: Real> Seen<'a, R> {
    /// The piece in an interval of knots, if the ray may meet it.
    fn new<P: SurfacePoint<Scalar = R>>(
        surface: &BSplineSurface<'a, P>,
        spans: [usize; 2],
        origin: P::Point,
        planes: [P::Point; 2],
    ) -> Option<Self> {
        let knots = [Direction::U, Direction::V].map(|direction| surface.knots(direction));
        let degrees = knots.map(|knots| knots.degree());
        let local = [0, 1].map(|k| knots[k].around(spans[k]));
        let domain = [0, 1].map(|k| [0, 1].map(|end| knots[k].knots()[spans[k] + end]));
        let mut net = [Across::default(); MOST_POINTS];
        let mut size = R::ZERO;
        for (slot, &point) in net.iter_mut().zip(surface.rows(spans).flatten()) {
            let (scaled, weight) = point.to_scaled();
            *slot = Across(planes.map(|plane| (scaled - origin * weight).dot(plane)));
            size = size.max(slot.0[0].abs()).max(slot.0[1].abs());
        }
        let seen = Self { net, local, domain, degrees, slack: size * R::EPSILON * R::from_f64(16.0) };
        let count = (degrees[0] + 1) * (degrees[1] + 1);
        seen.holds_zero(&seen.net[..count]).then_some(seen)
    }

    /// Calls `found` with the parameters of all zeros.
    fn zeros(&self, mut found: impl FnMut([R; 2])) {
        let mut stack = [self.domain; STACK];
        let mut height = 1;
        for _ in 0..MOST_PARTS {
            if height == 0 {
                return;
            }
            height -= 1;
            let part = stack[height];
            match self.judge(part) {
                Verdict::Nothing => {}
                Verdict::Point(at) => found(at),
                Verdict::Halve(k) if height + 2 <= STACK => {
                    let middle = (part[k][0] + part[k][1]) * R::from_f64(0.5);
                    (stack[height], stack[height + 1]) = (part, part);
                    stack[height][k][0] = middle;
                    stack[height + 1][k][1] = middle;
                    height += 2;
                }
                Verdict::Halve(_) => {}
            }
        }
    }

    fn judge(&self, part: [[R; 2]; 2]) -> Verdict<R> {
        let [columns, rows] = self.degrees.map(|degree| degree + 1);
        let mut net = self.net;
        let net = &mut net[..columns * rows];
        cut_out(net, self.local, part);
        if !self.holds_zero(net) {
            return Verdict::Nothing;
        }
        let middle = part.map(|[low, high]| (low + high) * R::from_f64(0.5));
        // With degree 0 nothing changes along a side, as if it had no length.
        let size = |[low, high]: [R; 2]| high - low;
        let finest = |k: usize| size(self.domain[k]) * R::EPSILON * R::from_f64(64.0);
        let small = |k: usize| self.degrees[k] == 0 || size(part[k]) <= finest(k);
        if small(0) && small(1) {
            return Verdict::Point(middle);
        }
        let by = [difference(net, columns, 0), difference(net, columns, 1)];
        let is_longer = |k: usize| by[k].0[0].abs() + by[k].0[1].abs() > by[1 - k].0[0].abs() + by[1 - k].0[1].abs();
        let halved = if small(0) || (is_longer(1) && !small(1)) { 1 } else { 0 };
        if !is_one_to_one(net, columns, by) {
            return Verdict::Halve(halved);
        }
        match self.newton(middle, part) {
            Some(at) => Verdict::Point(at),
            None if self.is_outside(middle, part) => Verdict::Nothing,
            None => Verdict::Halve(halved),
        }
    }

    /// Whether both distances have points on both sides of zero.
    fn holds_zero(&self, net: &[Across<R>]) -> bool {
        (0..2).all(|k| {
            let is_below = net.iter().any(|point| point.0[k] <= self.slack);
            is_below && net.iter().any(|point| point.0[k] >= -self.slack)
        })
    }

    /// The zero near a point, if it lies in the part.
    fn newton(&self, start: [R; 2], part: [[R; 2]; 2]) -> Option<[R; 2]> {
        let at = self.converged(start, part)?;
        let is_in = |k: usize| {
            let slack = (part[k][1] - part[k][0]) * R::from_f64(1e-3) + R::EPSILON * R::from_f64(8.0) * at[k].abs();
            part[k][0] - slack <= at[k] && at[k] <= part[k][1] + slack
        };
        // A zero a little beyond the part is that of its neighbor too, or lies on the edge of the surface.
        (is_in(0) && is_in(1)).then(|| [0, 1].map(|k| at[k].clamp(part[k][0], part[k][1])))
    }

    /// Whether the only zero near is that of another part.
    fn is_outside(&self, start: [R; 2], part: [[R; 2]; 2]) -> bool {
        self.converged(start, part).is_some()
    }

    fn converged(&self, mut at: [R; 2], part: [[R; 2]; 2]) -> Option<[R; 2]> {
        for _ in 0..STEPS {
            let [value, by_u, by_v] = self.evaluate(at);
            let determinant = by_u[0] * by_v[1] - by_u[1] * by_v[0];
            if determinant == R::ZERO {
                return None;
            }
            let step = [
                (value[0] * by_v[1] - value[1] * by_v[0]) / determinant,
                (by_u[0] * value[1] - by_u[1] * value[0]) / determinant,
            ];
            at = [0, 1].map(|k| {
                let size = part[k][1] - part[k][0];
                (at[k] - step[k]).clamp(part[k][0] - size, part[k][1] + size)
            });
            let is_still = |k: usize| step[k].abs() <= R::EPSILON * R::from_f64(4.0) * (at[k].abs() + R::ONE);
            if is_still(0) && is_still(1) {
                return Some(at);
            }
        }
        let [value, ..] = self.evaluate(at);
        (value[0].abs().max(value[1].abs()) <= self.slack).then_some(at)
    }

    /// Value and derivatives.
    fn evaluate(&self, [u, v]: [R; 2]) -> [[R; 2]; 3] {
        let [p, q] = self.degrees;
        let along = cox_de_boor_orders::<R, MAX_ORDER, 2>(self.local[0], p, u);
        let across = cox_de_boor_orders::<R, MAX_ORDER, 2>(self.local[1], q, v);
        let mut sums = [Across::default(); 3];
        for (j, row) in self.net[..(p + 1) * (q + 1)].chunks_exact(p + 1).enumerate() {
            let mut of_row = [Across::default(); 2];
            for (i, &point) in row.iter().enumerate() {
                of_row = [0, 1].map(|k| of_row[k] + point * along[k][i]);
            }
            sums[0] = sums[0] + of_row[0] * across[0][j];
            sums[1] = sums[1] + of_row[1] * across[0][j];
            sums[2] = sums[2] + of_row[0] * across[1][j];
        }
        sums.map(|sum| sum.0)
    }
}

/// From the middle of one side to the middle of the other.
fn difference<R: Real>(net: &[Across<R>], columns: usize, k: usize) -> Across<R> {
    let (step, last) = if k == 0 { (columns, columns - 1) } else { (1, net.len() - columns) };
    let count = if k == 0 { net.len() / columns } else { columns };
    let minus = -R::ONE;
    let lines = (0..count).map(|line| net[line * step + last] + net[line * step] * minus);
    lines.fold(Across::default(), |sum, x| sum + x) * (R::ONE / R::from_usize(count))
}

/// Whether no two points of a part lie at one place: all pairs of derivatives by `u` and by `v`, seen in the frame of the
/// mean ones, turn the same way.
fn is_one_to_one<R: Real>(net: &[Across<R>], columns: usize, [a, b]: [Across<R>; 2]) -> bool {
    let determinant = a.0[0] * b.0[1] - a.0[1] * b.0[0];
    if determinant == R::ZERO || net.len() == columns || columns == 1 {
        return false;
    }
    let rows = net.len() / columns;
    let in_frame = |x: Across<R>| {
        [(x.0[0] * b.0[1] - x.0[1] * b.0[0]) / determinant, (a.0[0] * x.0[1] - a.0[1] * x.0[0]) / determinant]
    };
    let minus = -R::ONE;
    let mut least = [R::INFINITY; 2];
    let mut most_across = [R::ZERO; 2];
    for (k, step) in [(0, 1), (1, columns)] {
        let degree = R::from_usize(if k == 0 { columns - 1 } else { rows - 1 });
        for index in 0..net.len() - step {
            if k == 0 && (index + 1).is_multiple_of(columns) {
                continue;
            }
            let derivative = in_frame((net[index + step] + net[index] * minus) * degree);
            least[k] = least[k].min(derivative[k]);
            most_across[k] = most_across[k].max(derivative[1 - k].abs());
        }
    }
    least[0] > R::ZERO && least[1] > R::ZERO && least[0] * least[1] > most_across[0] * most_across[1]
}
