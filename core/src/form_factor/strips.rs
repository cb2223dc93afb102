//! Strips without end, seen along their length: lines in a plane.
//!
//! A strip runs from its first point to its second one with its front on the left; what lies behind it neither sends
//! nor receives.

use crate::math::Real;

/// A point or a direction in the plane across the strips.
pub type Planar<R> = [R; 2];

/// Share of the power leaving `point` that lands on the front of a strip, with nothing between:
/// `(sin b_2 - sin b_1) / 2` for the angles of its ends with the normal.
///
/// `normal` has length 1. What lies below the horizon of `point` does not count. In `[0, 1]`, to a few roundings; 0
/// behind the strip and on its line. Hottel 1954.
pub fn point_to_strip<R: Real>(point: Planar<R>, normal: Planar<R>, strip: [Planar<R>; 2]) -> R {
    let is_in_front = side(strip, point) > R::ZERO;
    if !is_in_front {
        return R::ZERO;
    }
    let Some(ends) = left_of([point, [point[0] + normal[1], point[1] - normal[0]]], strip) else {
        return R::ZERO;
    };
    let sine = |end: Planar<R>| {
        let to = minus(end, point);
        cross(normal, to) / length(to)
    };
    ((sine(ends[1]) - sine(ends[0])) / R::from_f64(2.0)).abs().min(R::ONE)
}

/// From strip to strip, with nothing between: crossed strings less uncrossed strings, over twice the width of `a`.
///
/// In `[0, 1]`; the parts behind the other one are cut off first. The absolute error is a few roundings of the longest
/// string over the width of `a`. Hottel 1954.
pub fn strip_to_strip<R: Real>(a: [Planar<R>; 2], b: [Planar<R>; 2]) -> R {
    let (Some([a0, a1]), Some([b0, b1])) = (left_of(b, a), left_of(a, b)) else { return R::ZERO };
    let string = |p: Planar<R>, q: Planar<R>| length(minus(q, p));
    // The string to one end less the string to the other, without cancellation.
    let back = minus(b0, b1);
    let difference = |p: Planar<R>| {
        let sum = string(p, b0) + string(p, b1);
        let both = [b0[0] - p[0] + (b1[0] - p[0]), b0[1] - p[1] + (b1[1] - p[1])];
        if sum > R::ZERO { dot(back, both) / sum } else { R::ZERO }
    };
    let width = string(a[0], a[1]);
    ((difference(a0) - difference(a1)) / (width + width)).clamp(R::ZERO, R::ONE)
}

/// Between two facing strips of equal width: `sqrt(1 + (h / w)^2) - h / w`. In `[0, 1]`, to a few roundings.
/// Howell's catalogue C-1.
pub fn parallel_strips<R: Real>(width: R, distance: R) -> R {
    width / (length([width, distance]) + distance)
}

/// From a strip of width `a` to one of width `b` that shares an edge with it, with the included `angle` in `[0, pi]`:
/// `(a + b - c) / 2a` for the third side `c` of the triangle. In `[0, 1]`, to a few roundings. Howell's catalogue C-5
/// and C-6.
pub fn strips_at_an_angle<R: Real>(a: R, b: R, angle: R) -> R {
    let half = angle / R::from_f64(2.0);
    // c^2 is (a - b)^2 plus 4 a b sin^2 of half the angle, and a + b - c is 4 a b cos^2 over a + b + c.
    let third = length([a - b, R::from_f64(2.0) * (a * b).sqrt() * half.sin()]);
    let cos = half.cos();
    R::from_f64(2.0) * b * cos * cos / (a + b + third)
}

/// The part of a strip on the left of a line.
fn left_of<R: Real>(line: [Planar<R>; 2], [from, to]: [Planar<R>; 2]) -> Option<[Planar<R>; 2]> {
    let (first, last) = (side(line, from), side(line, to));
    let (first_in, last_in) = (first > R::ZERO, last > R::ZERO);
    let meets = || {
        let share = first / (first - last);
        [from[0] + (to[0] - from[0]) * share, from[1] + (to[1] - from[1]) * share]
    };
    match (first_in, last_in) {
        (true, true) => Some([from, to]),
        (true, false) => Some([from, meets()]),
        (false, true) => Some([meets(), to]),
        (false, false) => None,
    }
}

/// Positive on the left of a line.
fn side<R: Real>([from, to]: [Planar<R>; 2], point: Planar<R>) -> R {
    cross(minus(to, from), minus(point, from))
}

fn minus<R: Real>(a: Planar<R>, b: Planar<R>) -> Planar<R> {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot<R: Real>(a: Planar<R>, b: Planar<R>) -> R {
    a[0] * b[0] + a[1] * b[1]
}

fn cross<R: Real>(a: Planar<R>, b: Planar<R>) -> R {
    a[0] * b[1] - a[1] * b[0]
}

fn length<R: Real>(a: Planar<R>) -> R {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_are_the_closed_forms() {
        let floor = [[0.0, 0.0], [1.0, 0.0]];
        for height in [0.01, 0.5, 3.0, 1000.0] {
            let found: f64 = strip_to_strip(floor, [[1.0, height], [0.0, height]]);
            assert!((found - parallel_strips(1.0, height)).abs() < 1e-14);
        }
        for angle in [0.1, 1.0, 2.0, 3.0] {
            let wall = [[2.0 * Real::cos(angle), 2.0 * Real::sin(angle)], [0.0, 0.0]];
            let found: f64 = strip_to_strip(floor, wall);
            assert!((found - strips_at_an_angle(1.0, 2.0, angle)).abs() < 1e-14, "{angle}");
        }
    }

    /// The walls of a triangular duct catch all, even where one is cut by the line of another one's front.
    #[test]
    fn ducts_are_closed() {
        let corners = [[0.1, 0.2], [3.0, -0.5], [1.0, 2.5]];
        let walls = [[corners[0], corners[1]], [corners[1], corners[2]], [corners[2], corners[0]]];
        for i in 0..3 {
            let sum: f64 = (0..3).map(|j| strip_to_strip(walls[i], walls[j])).sum();
            assert!((sum - 1.0).abs() < 1e-15);
            let point = [1.2, 0.5];
            let sum: f64 = walls.iter().map(|&wall| point_to_strip(point, [0.6, 0.8], wall)).sum();
            assert!((sum - 1.0).abs() < 1e-15, "{sum}");
        }
    }

    #[test]
    fn backs_and_lines() {
        let floor = [[0.0, 0.0], [1.0, 0.0]];
        assert_eq!(strip_to_strip(floor, floor), 0.0);
        assert_eq!(strip_to_strip(floor, [[0.0, 1.0], [1.0, 1.0]]), 0.0);
        assert_eq!(strip_to_strip(floor, [[0.0, f64::NAN], [1.0, 1.0]]), 0.0);
        assert_eq!(point_to_strip([0.5, 0.0], [0.0, -1.0], floor), 0.0);
        assert_eq!(point_to_strip([0.5, 1.0], [0.0, 1.0], floor), 0.0);
        // Half of the strip stands behind the floor's line: the rest is a wall of half the height.
        let through = strip_to_strip(floor, [[1.0, -1.0], [1.0, 1.0]]);
        assert!((through - strips_at_an_angle(1.0, 1.0, core::f64::consts::FRAC_PI_2)).abs() < 1e-15);
    }
}
