//! The logarithm of the distance between the points of two straight edges, integrated over both.

use glam::DVec3;

use super::quadrature::{GAUSS_4, GAUSS_6, GAUSS_8, GAUSS_12, GAUSS_16, Gauss};
use crate::math::Real;

/// Edges are halved at most so often on the way to where they nearly meet.
const DEPTH: u32 = 60;

/// An edge of a polygon.
#[derive(Clone, Copy, Debug)]
struct Edge {
    start: DVec3,
    /// Of length 1.
    direction: DVec3,
    length: f64,
}

impl Edge {
    fn new(start: DVec3, end: DVec3) -> Self {
        let length = length(end - start);
        Self { start, direction: (end - start) / length, length }
    }

    fn end(&self) -> DVec3 {
        self.at(self.length)
    }

    fn at(&self, s: f64) -> DVec3 {
        self.start + self.direction * s
    }

    fn halves(&self) -> [Self; 2] {
        let length = 0.5 * self.length;
        [Self { length, ..*self }, Self { start: self.at(length), length, ..*self }]
    }
}

/// Where the lines of two edges are nearest to each other.
#[derive(Clone, Copy, Debug)]
struct Approach {
    /// Along the first edge and along the second.
    at: [f64; 2],
    distance: f64,
    sin: f64,
}

/// `int int ln(|p - q| / reach) dp . dq` over the points `p` of one edge and `q` of another.
///
/// Closed forms where the lines of the edges are parallel or the edges touch. Else the inner integral is in closed form
/// and the outer one a Gauss sum, of as many points as the distance of the nearest singularity asks for 11 digits;
/// where that is too near, the edge is halved.
pub fn edge_pair(p: [DVec3; 2], q: [DVec3; 2], reach: f64) -> f64 {
    let (e, f) = (Edge::new(p[0], p[1]), Edge::new(q[0], q[1]));
    let cos = e.direction.dot(f.direction);
    if !(e.length > 0.0 && f.length > 0.0 && cos.abs() > 1e-15) {
        return 0.0;
    }
    let (short, long) = if e.length < f.length { (e, f) } else { (f, e) };
    cos * Pair { inverse: 1.0 / (reach * reach), reach }.integral(&short, &long, DEPTH)
}

/// The unit of length in which the logarithms are taken, and its inverse square.
#[derive(Clone, Copy, Debug)]
struct Pair {
    inverse: f64,
    reach: f64,
}

impl Pair {
    /// `int int ln(|p - q| / reach) ds dt`.
    fn integral(self, e: &Edge, f: &Edge, depth: u32) -> f64 {
        let approach = approach(e, f, self.reach);
        if approach.is_none() && f.length <= 8.0 * e.length && length(f.start - e.start) <= 16.0 * e.length {
            return self.parallel(e, f);
        }
        if let Some(rule) = rule(e, f, approach) {
            return e.length * rule.mean(|s| self.over_edge(e.at(s * e.length), f));
        }
        match approach {
            None => self.parallel(e, f),
            _ if depth == 0 => e.length * GAUSS_16.mean(|s| self.over_edge(e.at(s * e.length), f)),
            Some(approach) if touch(e, f, approach) => {
                if f.length > 8.0 * e.length {
                    return f.halves().iter().map(|half| self.integral(e, half, depth - 1)).sum();
                }
                self.touching(e, f, approach)
            }
            Some(_) => e.halves().iter().map(|half| self.integral(half, f, depth - 1)).sum(),
        }
    }

    /// `int ln(|p - q| / reach) dt` over the points `q` of an edge.
    #[inline]
    fn over_edge(self, p: DVec3, f: &Edge) -> f64 {
        let to_start = f.start - p;
        let t1 = to_start.dot(f.direction);
        let t2 = t1 + f.length;
        let squared = (to_start - f.direction * t1).length_squared();
        let distance = Real::sqrt(squared);
        let angle = Real::atan2(distance * f.length, squared + t1 * t2);
        self.times_ln(t2, t2 * t2 + squared) - self.times_ln(t1, t1 * t1 + squared) - f.length + distance * angle
    }

    /// `x ln(r / reach)` for the square of `r`; 0 at `r = 0`, where `x` is 0 too.
    #[inline]
    fn times_ln(self, x: f64, squared: f64) -> f64 {
        if squared > 0.0 { 0.5 * x * Real::ln(squared * self.inverse) } else { 0.0 }
    }

    /// Parallel edges, on the same line or not: second differences of a function of the shift along the line.
    fn parallel(self, e: &Edge, f: &Edge) -> f64 {
        let to_start = f.start - e.start;
        let (first, last) = (to_start.dot(e.direction), (f.end() - e.start).dot(e.direction));
        let distance = length(to_start - e.direction * first);
        self.shifts(-first.min(last), e.length, distance) - self.shifts(-first.max(last), e.length, distance)
    }

    /// The integral from `x` to `x + length` of `T(x)`, where `T' = ln(sqrt(x^2 + h^2) / reach)`.
    fn shifts(self, x: f64, length: f64, h: f64) -> f64 {
        let radius = |x: f64| Real::sqrt(x * x + h * h);
        let end = x + length;
        if radius(x) + radius(end) > 2.8 * length {
            let once = |x: f64| self.times_ln(x, x * x + h * h) - x + h * Real::atan2(x, h);
            return length * GAUSS_16.mean(|s| once(x + s * length));
        }
        let twice = |x: f64| {
            let half_ln = 0.5 * self.times_ln(1.0, x * x + h * h);
            (x - h) * (x + h) * half_ln + h * x * Real::atan2(x, h) - 0.75 * x * x
        };
        twice(end) - twice(x)
    }

    /// Edges whose lines meet at a point of both.
    fn touching(self, e: &Edge, f: &Edge, Approach { at: [s, t], sin, .. }: Approach) -> f64 {
        let wedge = Wedge { pair: self, cos: e.direction.dot(f.direction), sin };
        let mut sum = 0.0;
        if e.length > s {
            sum += wedge.rectangle([Real::max(-s, 0.0), e.length - s], [-t, f.length - t]);
        }
        if s > 0.0 {
            sum += wedge.rectangle([Real::max(s - e.length, 0.0), s], [t - f.length, t]);
        }
        sum
    }
}

/// Two lines that meet at an angle.
#[derive(Clone, Copy, Debug)]
struct Wedge {
    pair: Pair,
    cos: f64,
    sin: f64,
}

impl Wedge {
    /// The integral over a range of distances from the meeting point on one line, not negative, and one on the other.
    fn rectangle(self, [s1, s2]: [f64; 2], [t1, t2]: [f64; 2]) -> f64 {
        self.corner(s2, t2) - self.corner(s1, t2) - self.corner(s2, t1) + self.corner(s1, t1)
    }

    /// A function with the mixed derivative `ln(|s - t w| / reach)`, where `w = cos + i sin`:
    /// the real part of `-(z^2 / 2) (ln z - 1/2) / w - s t` for `z = s - t w`.
    fn corner(self, s: f64, t: f64) -> f64 {
        let (x, y) = (s - t * self.cos, -t * self.sin);
        let ln = self.pair.times_ln(1.0, x * x + y * y) - 0.5;
        let angle = Real::atan2(y, x);
        let (re, im) = (0.5 * (x - y) * (x + y), x * y);
        let (a, b) = (re * ln - im * angle, re * angle + im * ln);
        -(self.cos * a + self.sin * b) - s * t
    }
}

/// Where the lines of the edges are nearest; none where they are parallel up to the rounding of their ends.
fn approach(e: &Edge, f: &Edge, reach: f64) -> Option<Approach> {
    let normal = e.direction.cross(f.direction);
    let squared = normal.length_squared();
    let sin = Real::sqrt(squared);
    if sin * Real::min(e.length, f.length) <= 4e-15 * reach {
        return None;
    }
    let between = f.start - e.start;
    let s = between.cross(f.direction).dot(normal) / squared;
    let t = between.cross(e.direction).dot(normal) / squared;
    Some(Approach { at: [s, t], distance: (between.dot(normal) / sin).abs(), sin })
}

/// Whether the point where the lines meet belongs to both edges, up to rounding.
fn touch(e: &Edge, f: &Edge, Approach { at: [s, t], distance, .. }: Approach) -> bool {
    let slack = 1e-13 * f.length;
    distance <= slack && s >= -slack && s <= e.length + slack && t >= -slack && t <= f.length + slack
}

/// The Gauss rule for 11 digits of the integral over `e` of the closed form over `f`, if 16 points suffice.
///
/// That function is singular at the ends of `f` and, seen as one of a complex variable, where the lines approach each
/// other inside `f`. The error of `n` points falls with `(x + sqrt(x^2 - 1))^-2n`, where `x` is the sum of the
/// distances of a singularity from both ends of `e`, over the length of `e`.
fn rule(e: &Edge, f: &Edge, approach: Option<Approach>) -> Option<Gauss> {
    let end = e.end();
    let spread = |q: DVec3| length(e.start - q) + length(end - q);
    let mut nearest = Real::min(spread(f.start), spread(f.end()));
    if let Some(Approach { at: [s, t], distance, sin }) = approach
        && t > 0.0
        && t < f.length
    {
        let imaginary = distance / sin;
        let radius = |x: f64| Real::sqrt(x * x + imaginary * imaginary);
        nearest = nearest.min(radius(s) + radius(s - e.length));
    }
    match nearest / e.length {
        x if x > 11.9 => Some(GAUSS_4),
        x if x > 4.2 => Some(GAUSS_6),
        x if x > 2.54 => Some(GAUSS_8),
        x if x > 1.62 => Some(GAUSS_12),
        x if x > 1.34 => Some(GAUSS_16),
        _ => None,
    }
}

fn length(vector: DVec3) -> f64 {
    Real::sqrt(vector.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition: both integrals by tanh-sinh, the outer one cut where the edges meet.
    fn by_sums(p: [DVec3; 2], q: [DVec3; 2], cuts: &[f64]) -> f64 {
        use super::super::quadrature::tanh_sinh;
        let (e, f) = (Edge::new(p[0], p[1]), Edge::new(q[0], q[1]));
        let pair = Pair { inverse: 1.0, reach: 1.0 };
        let ends = || [0.0].into_iter().chain(cuts.iter().copied()).chain([e.length]);
        let pieces = ends().zip(ends().skip(1));
        let sum: f64 = pieces.map(|(a, b)| tanh_sinh(a, b, |s| pair.over_edge(e.at(s), &f))).sum();
        sum * e.direction.dot(f.direction)
    }

    fn check(p: [[f64; 3]; 2], q: [[f64; 3]; 2], cuts: &[f64]) {
        let (p, q) = (p.map(DVec3::from_array), q.map(DVec3::from_array));
        let (found, expected) = (edge_pair(p, q, 1.0), by_sums(p, q, cuts));
        assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{p:?} {q:?}: {found} {expected}");
        assert!((edge_pair(q, p, 1.0) - found).abs() < 1e-13);
    }

    #[test]
    fn skew_edges() {
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.2, 0.3, 1.0], [0.9, 1.4, 1.2]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[5.0, 3.0, 1.0], [7.0, 1.4, 1.2]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.2, -0.5, 0.1], [0.6, 0.5, 0.1]], &[0.4]);
    }

    #[test]
    fn parallel_edges() {
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[1.0, 0.5, 0.0], [0.0, 0.5, 0.0]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.25, 0.0, 0.0], [0.5, 0.0, 0.0]], &[0.25, 0.5]);
    }

    #[test]
    fn edges_that_touch() {
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, 0.0, 0.0], [0.5, 0.0, 0.7]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[1.0, 0.0, 0.0], [2.0, 0.0, -2.0]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.3, 0.0, 0.0], [0.5, 0.9, 0.0]], &[0.3]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.2, -0.5, 0.0], [0.6, 0.5, 0.0]], &[0.4]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, 0.0, 0.0], [10.0, 30.0, 0.0]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, 0.0, 0.0], [-1.0, 0.01, 0.0]], &[]);
        check([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, 0.0, 0.0], [2.0, 1e-12, 0.0]], &[]);
    }
}
