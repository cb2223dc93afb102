//! Nusselt's projection: what a point sees, carried onto the hemisphere around it and from there straight down onto
//! the disc below. The share of the disc that is covered is the form factor.
//!
//! An edge of a polygon becomes an arc of a great circle on the hemisphere and an arc of an ellipse on the disc, whose
//! larger half axis is 1. [`nusselt_area`] computes the area that these arcs enclose. [`nusselt_rays`] goes the other
//! way: it lifts points that fill the disc evenly onto the hemisphere and looks what is there, whatever it be.
//!
//! Nusselt, "Graphische Bestimmung des Winkelverhältnisses bei der Wärmestrahlung", VDI-Zeitschrift 72, 1928. The
//! picture at [`nusselt_area`] is drawn by the example `nusselt`.

use glam::{Vec2, Vec3};

use super::samples::{add, finish, point_on_polygon};
use super::shadow::area_vector;
use super::{Bins, Estimate, Samples};
use crate::geometry::{Hit, Occluders, Ray, cosine_direction};
use crate::math::{Real, Vector};

/// The image of an edge on the disc of radius 1: an arc of an ellipse around its center, at most half of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscArc<R> {
    /// Where it starts.
    pub from: [R; 2],
    /// Where it ends.
    pub to: [R; 2],
    /// The direction of the larger half axis, of length 1 as that half axis is.
    pub axis: [R; 2],
    /// The smaller half axis, in `[-1, 1]`; negative where the arc runs clockwise around the center.
    pub minor: R,
    /// The arc that it is on the hemisphere, in radians, in `[0, pi]`: the difference of eccentric anomalies.
    pub angle: R,
}

/// Area over pi of the projection of a polygon: the share of the power leaving `point` that lands on it, with nothing
/// between.
///
/// The polygon is projected onto the hemisphere around the point, and from there straight down onto the disc below. Its
/// edges become arcs of ellipses:
///
#[doc = include_str!("nusselt.svg")]
///
/// `normal` has length 1. The polygon is planar, of any shape, and receives on the side from which it runs
/// counter-clockwise: seen from behind it has 0. What lies below the horizon does not count. In `[0, 1]`.
///
/// The area is that of the polygon of chords, by the shoelace formula, and of a segment of an ellipse at each edge:
/// `ab/2 (t - sin t)` for half axes `a`, `b` and an arc `t` of eccentric anomaly. It is the same number as Lambert's sum
/// over the edges, found another way, and stays accurate for small and distant polygons, where the terms of that sum
/// cancel: relative to the form factor the error is a few roundings over the angle that the polygon subtends, instead of
/// over its square.
pub fn nusselt_area<V: Vector>(point: V, normal: V, polygon: &[V]) -> V::Scalar {
    let half = V::Scalar::from_f64(0.5);
    let (mut area, mut start) = (V::Scalar::ZERO, None);
    nusselt_arcs(point, normal, polygon, |arc| {
        let [x, y] = *start.get_or_insert(arc.from);
        let [from, to] = [arc.from, arc.to].map(|end| [end[0] - x, end[1] - y]);
        area += half * (from[0] * to[1] - from[1] * to[0] + arc.minor * arc_less_sine(arc.angle));
    });
    (area / V::Scalar::PI).clamp(V::Scalar::ZERO, V::Scalar::ONE)
}

/// Calls `arc` with the image of each edge on the disc, in order; together they are a closed line.
///
/// Of `polygon` as for [`nusselt_area`]; where the horizon cuts it, an arc on the rim of the disc closes the line. The
/// coordinates of the disc run along the two vectors of [`nusselt_frame`]. Corners at the point itself are left out.
pub fn nusselt_arcs<V: Vector>(point: V, normal: V, polygon: &[V], mut arc: impl FnMut(DiscArc<V::Scalar>)) {
    let [x, y] = nusselt_frame(normal);
    let frame = [x, y, -normal];
    let (mut first, mut last): (Option<V>, Option<V>) = (None, None);
    above_horizon(point, normal, polygon, |corner| {
        let direction = corner.normalize_or_zero();
        if direction != V::default() {
            first.get_or_insert(direction);
            last.iter().for_each(|&last| arc(disc_arc(&frame, last, direction)));
            last = Some(direction);
        }
    });
    if let (Some(first), Some(last)) = (first, last) {
        arc(disc_arc(&frame, last, first));
    }
}

/// The axes of the disc, as seen by someone who looks along `normal`: to the right and up. Both have length 1.
pub fn nusselt_frame<V: Vector>(normal: V) -> [V; 2] {
    let [x, y, z] = normal.to_array().map(V::Scalar::abs);
    let axis = if z <= x && z <= y { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
    let axis = if x < y && x < z { [1.0, 0.0, 0.0] } else { axis };
    let right = V::from_array(axis.map(V::Scalar::from_f64)).cross(normal).normalize_or_zero();
    [right, right.cross(normal)]
}

/// The row of form factors of a point or a surface by rays: points that fill the disc evenly, lifted onto the hemisphere.
///
/// `sender` carries points of the unit square to points of the sender and their normals of length 1, equal areas to
/// equal areas; the points lie just above it, so that no ray meets the surface that it leaves ([`polygon_sender`]). `patch`
/// tells the place in the row of what a ray hits, or none for what belongs to the void. `hits` is as long as `row`.
///
/// Values are counts of rays over all of them, so that row and bins sum to one up to rounding. The error is
/// [`STANDARD_ERRORS`](super::STANDARD_ERRORS) standard errors between the scrambles, and not below seven rays: with none
/// of `n` independent rays on a patch, a form factor above `7/n` has a chance below 0.001.
///
/// Malley's method (Malley 1988, after Nusselt's projection); Owen-scrambled Sobol points.
pub fn nusselt_rays<R: Real>(
    sender: impl Fn(Vec2) -> [Vec3; 2],
    occluders: &impl Occluders,
    patch: impl Fn(&Hit) -> Option<usize>,
    samples: &Samples,
    row: &mut [Estimate<R>],
    hits: &mut [u32],
) -> Bins<R> {
    let samples = samples.at_least_one();
    let (mut sky, mut void) = (0_u32, 0_u32);
    row.fill(Estimate::default());
    for scramble in 0..samples.scrambles {
        let sequence = samples.sequence(scramble);
        hits.fill(0);
        for index in 0..samples.points {
            let at = |dimension| sequence.dimension(index, dimension);
            let [origin, normal] = sender(Vec2::new(at(2), at(3)));
            let direction = cosine_direction(sequence.square(index), normal);
            match occluders.nearest(&Ray { origin, direction, end: f32::INFINITY }) {
                None => sky += 1,
                Some(hit) => *patch(&hit).and_then(|place| hits.get_mut(place)).unwrap_or(&mut void) += 1,
            }
        }
        let share = |count: u32| R::from_f64(f64::from(count) / f64::from(samples.points));
        row.iter_mut().zip(&*hits).for_each(|(mean, &count)| add(mean, share(count), scramble + 1));
    }
    row.iter_mut().for_each(|mean| finish(mean, samples.scrambles, 7.0 / samples.total()));
    let [sky, void] = [sky, void].map(|count| R::from_f64(f64::from(count) / samples.total()));
    Bins { sky, void }
}

/// The points of a convex polygon, for [`nusselt_rays`]: lifted to its front by `2^-20` of its largest coordinate.
pub fn polygon_sender(polygon: &[Vec3]) -> impl Fn(Vec2) -> [Vec3; 2] {
    let normal = area_vector(polygon.iter().copied()).normalize_or_zero();
    let size = polygon.iter().fold(0.0_f32, |size, corner| size.max(corner.abs().max_element()));
    let lift = normal * (size / 1_048_576.0);
    move |square| [point_on_polygon(polygon, square.to_array()) + lift, normal]
}

/// Calls `corner` with the corners, relative to the point, of the part of a polygon above the horizon.
fn above_horizon<V: Vector>(point: V, normal: V, polygon: &[V], mut corner: impl FnMut(V)) {
    let is_above = |height: V::Scalar| height > V::Scalar::ZERO;
    for (k, &a) in polygon.iter().enumerate() {
        let (a, b) = (a - point, polygon[(k + 1) % polygon.len()] - point);
        let (height_a, height_b) = (a.dot(normal), b.dot(normal));
        if is_above(height_a) {
            corner(a);
        }
        if is_above(height_a) != is_above(height_b) {
            corner(a.lerp(b, height_a / (height_a - height_b)));
        }
    }
}

/// The image of the great circle between two directions of length 1.
fn disc_arc<V: Vector>(frame: &[V; 3], from: V, to: V) -> DiscArc<V::Scalar> {
    let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
    let cross = from.cross(to);
    let [x, y, z] = frame.map(|axis| cross.dot(axis));
    let (flat, length) = ((x * x + y * y).sqrt(), cross.length());
    let on_disc = |direction: V| [direction.dot(frame[0]), direction.dot(frame[1])];
    DiscArc {
        from: on_disc(from),
        to: on_disc(to),
        axis: if flat > zero { [-y / flat, x / flat] } else { [one, zero] },
        minor: if length > zero { (z / length).clamp(-one, one) } else { zero },
        angle: length.atan2(from.dot(to)),
    }
}

/// `t - sin t` for `t` in `[0, pi]`, to a few roundings of itself.
fn arc_less_sine<R: Real>(t: R) -> R {
    if t > R::from_f64(0.5) {
        return t - t.sin();
    }
    let terms = [210.0, 156.0, 110.0, 72.0, 42.0, 20.0];
    let series = terms.iter().fold(R::ONE, |sum, &term| R::ONE - t * t / R::from_f64(term) * sum);
    t * t * t / R::from_f64(6.0) * series
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::geometry::BruteForce;

    /// Lambert's sum over the edges, without any horizon: `1/2pi sum t_i (n . G_i)`.
    fn lambert(normal: DVec3, polygon: &[DVec3]) -> f64 {
        let edge = |k: usize| {
            let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
            let cross = b.cross(a);
            Real::atan2(cross.length(), a.dot(b)) * cross.dot(normal) / cross.length()
        };
        (0..polygon.len()).map(edge).sum::<f64>() / core::f64::consts::TAU
    }

    /// A regular polygon in a plane at some height, tilted; counter-clockwise seen from the origin below it.
    fn tilted<const N: usize>(size: f64, center: DVec3) -> [DVec3; N] {
        core::array::from_fn(|k| {
            let turn = -core::f64::consts::TAU * k as f64 / N as f64;
            center + DVec3::new(Real::cos(turn), Real::sin(turn), 0.3 * Real::cos(turn)) * size
        })
    }

    #[test]
    fn the_area_is_lamberts_sum() {
        for normal in [DVec3::Z, DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.36, 0.48, 0.8)] {
            for (size, x) in [(1.0, 0.0), (0.2, 0.3), (0.5, -1.0), (1.5, 0.9), (1e-2, 0.2)] {
                let hexagon: [DVec3; 6] = tilted(size, DVec3::new(x, 0.2, 2.0));
                let (area, sum) = (nusselt_area(DVec3::ZERO, normal, &hexagon), lambert(normal, &hexagon));
                assert!((area - sum).abs() < 1e-15, "{area} {sum}");
            }
        }
    }

    /// Howell's catalogue B-3 and B-4, closed forms: a parallel square with a corner above the point, and a wall whose
    /// base lies on the horizon, so that the horizon may cut it anywhere below.
    #[test]
    fn rectangles() {
        let square = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
        assert!((nusselt_area(DVec3::ZERO, DVec3::Z, &square) - 0.138_531_605_994_9).abs() < 1e-13);
        for base in [0.0, -0.5, -7.0] {
            let wall = [[0.0, base], [1.0, base], [1.0, 1.0], [0.0, 1.0]].map(|[y, z]| DVec3::new(1.0, y, z));
            let [front, back] = [[0, 3, 2, 1], [0, 1, 2, 3]].map(|order: [usize; 4]| order.map(|k| wall[k]));
            let expected = 0.055_734_197_002_55;
            assert!((nusselt_area(DVec3::ZERO, DVec3::Z, &front) - expected).abs() < 1e-13);
            assert_eq!(nusselt_area(DVec3::ZERO, DVec3::Z, &back), 0.0, "seen from behind");
        }
    }

    /// The form factor of a distant polygon is the point formula: `cos a cos b A / (pi r^2)` up to `(size/r)^2`.
    #[test]
    fn distant_polygons_stay_accurate() {
        let center = DVec3::new(1e6, 2e6, 2e6);
        let triangle: [DVec3; 3] = tilted(1.0, center);
        let double_area = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        let point = -center.dot(double_area) / 2.0 * center.z / (core::f64::consts::PI * 81e24);
        let single = triangle.map(|corner| corner.as_vec3());
        assert!((nusselt_area(DVec3::ZERO, DVec3::Z, &triangle) / point - 1.0).abs() < 1e-8);
        assert!((lambert(DVec3::Z, &triangle) / point - 1.0).abs() > 1e-5);
        assert!(nusselt_area(Vec3::ZERO, Vec3::Z, &single.map(|corner| corner / 1e4)) > 0.0);
    }

    /// A polygon on all of the horizon covers the disc, and half of one that stands upright.
    #[test]
    fn whole_and_half_disc() {
        let lid: [DVec3; 5] = tilted(1e9, DVec3::Z);
        assert!((nusselt_area(DVec3::ZERO, DVec3::new(-0.3, 0.0, 1.0).normalize(), &lid) - 1.0).abs() < 1e-6);
        let square = [[-1e9, -1e9], [-1e9, 1e9], [1e9, 1e9], [1e9, -1e9]].map(|[x, y]| DVec3::new(x, y, 1.0));
        assert!((nusselt_area(DVec3::ZERO, DVec3::X, &square) - 0.5).abs() < 1e-8);
    }

    /// The arcs lie on their ellipses, and close.
    #[test]
    fn arcs_are_those_of_ellipses() {
        let pentagon: [DVec3; 5] = tilted(2.0, DVec3::new(1.0, 0.2, 0.4));
        let (mut ends, mut count) = ([0.0; 2], 0);
        nusselt_arcs(DVec3::ZERO, DVec3::Z, &pentagon, |arc| {
            let anomaly = |[x, y]: [f64; 2]| {
                let [along, across] = [x * arc.axis[0] + y * arc.axis[1], y * arc.axis[0] - x * arc.axis[1]];
                assert!((along * along + (across / arc.minor) * (across / arc.minor) - 1.0).abs() < 1e-9);
                Real::atan2(across / arc.minor, along)
            };
            let turn = anomaly(arc.to) - anomaly(arc.from);
            let turn = turn - core::f64::consts::TAU * Real::floor(turn / core::f64::consts::TAU);
            assert!((turn - arc.angle).abs() < 1e-9, "{arc:?}");
            (0..2).for_each(|k| ends[k] += arc.to[k] - arc.from[k]);
            count += 1;
        });
        assert!(count >= 5 && ends.iter().all(|end| end.abs() < 1e-15), "{count} {ends:?}");
    }

    #[test]
    fn nothing_broken() {
        let nan = DVec3::splat(f64::NAN);
        assert_eq!(nusselt_area(DVec3::ZERO, DVec3::Z, &[]), 0.0);
        assert_eq!(nusselt_area(DVec3::ZERO, DVec3::Z, &[DVec3::Z; 3]), 0.0);
        assert_eq!(nusselt_area(DVec3::ZERO, DVec3::Z, &[DVec3::ZERO; 4]), 0.0);
        assert_eq!(nusselt_area(DVec3::ZERO, DVec3::Z, &[nan, DVec3::Z, DVec3::X]), 0.0);
    }

    /// Rays find what the area tells, to within their own error, and blockers take their part into the void.
    #[test]
    fn rays_count_the_area() {
        let square = |side: f32, z: f32| {
            [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, y]| Vec3::new(x * side, y * side, z))
        };
        let [light, blocker] = [square(0.5, 1.0), square(0.125, 0.5)];
        let fan = |[a, b, c, d]: [Vec3; 4]| [[a, b, c], [a, c, d]];
        let triangles = [fan(light), fan(blocker)].concat();
        let samples = Samples { scrambles: 16, points: 1024, seed: 1 };
        let (mut row, mut hits) = ([Estimate::<f64>::default()], [0]);
        let patch = |hit: &Hit| (hit.triangle < 2).then_some(0);
        let bins =
            nusselt_rays(|_| [Vec3::ZERO, Vec3::Z], &BruteForce(&triangles), patch, &samples, &mut row, &mut hits);
        assert!((row[0].value - 0.165_978_835_648_3).abs() < row[0].error && row[0].error < 5e-3, "{row:?}");
        assert!((row[0].value + bins.sky + bins.void - 1.0).abs() < 1e-12);
        let shadow = nusselt_area(Vec3::ZERO, Vec3::Z, &blocker);
        assert!((bins.void - f64::from(shadow)).abs() < 5e-3);
    }
}
