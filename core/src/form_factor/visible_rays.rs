//! Polygon to polygon with visibility by rays: for many blockers and for those that are not convex.

use crate::geometry::{Occluders, Ray, Sobol};
use crate::math::{Real, Vector};

use super::samples::{STANDARD_ERRORS, point_on_polygon};
use super::shadow::area_vector;
use super::{Estimate, polygon_to_polygon};

/// Independent sequences, from whose spread the error is known.
const SEQUENCES: u32 = 16;
/// Rays of one sequence in the first round; each round doubles them.
const FIRST_RAYS: u32 = 64;
/// Rays of one sequence after which no more are cast.
pub(super) const MOST_RAYS: u32 = 1 << 16;
/// In units in the last place of the largest coordinate: what stands no higher above the plane of a polygon lies in it.
const ROUNDING: f64 = 32.0;

/// Share of the power leaving `a` that lands on `b` past any `occluders`, with four standard errors.
///
/// Both are convex, run counter-clockwise seen from their fronts and exchange light there only. They may be among the
/// occluders: what a ray meets in the plane of either, up to 32 units in the last place (`f32`) of their largest
/// coordinate, is ignored. `accuracy` is the error to aim for,
/// [`STANDARD_ERRORS`] standard ones; rays are doubled until it is reached, up to a million, and 1024 at least.
///
/// Pairs of points `p`, `q`, four dimensions of a Sobol sequence, are weighted with `cos cos / r^2`. The weighted share
/// of the pairs that see each other, times the exact factor without occluders, is the value, so that neither all
/// visible nor all hidden leaves any noise. The error comes from 16 independent scramblings and is at least what a
/// single ray would change. Where the polygons share an edge the weights vary without bound and the error falls slowly.
pub fn visible_polygon_to_polygon_by_rays<V: Vector>(
    a: &[V],
    b: &[V],
    occluders: &impl Occluders,
    accuracy: V::Scalar,
) -> Estimate<V::Scalar> {
    cast(a, b, occluders, accuracy, MOST_RAYS)
}

/// [`visible_polygon_to_polygon_by_rays`] with another bound on the rays of one sequence.
pub(super) fn cast<V: Vector>(
    a: &[V],
    b: &[V],
    occluders: &impl Occluders,
    accuracy: V::Scalar,
    most_rays: u32,
) -> Estimate<V::Scalar> {
    let unoccluded = polygon_to_polygon(a, b);
    if unoccluded <= V::Scalar::ZERO {
        return Estimate::default();
    }
    let ends = [a, b].map(|polygon| (polygon, area_vector(polygon.iter().copied()).normalize_or_zero()));
    let coordinates = a.iter().chain(b).flat_map(|corner| corner.to_array());
    let size = coordinates.fold(V::Scalar::ZERO, |size, coordinate| size.max(coordinate.abs()));
    let pair = Pair { ends, tolerance: size.to_f64() * ROUNDING * f64::from(f32::EPSILON) };
    let mut sums = [Sum::default(); SEQUENCES as usize];
    let (mut start, mut end) = (0, FIRST_RAYS);
    loop {
        for (sum, seed) in sums.iter_mut().zip(0..) {
            let sequence = Sobol::new(seed);
            (start..end).for_each(|i| sum.add(&pair, &sequence, i, occluders));
        }
        let (share, spread) = visible_share(&sums);
        let one_ray = 1.0 / f64::from(end * SEQUENCES);
        let error = unoccluded * V::Scalar::from_f64((STANDARD_ERRORS * spread).max(one_ray));
        if error <= accuracy || 2 * end > most_rays {
            return Estimate { value: unoccluded * V::Scalar::from_f64(share), error };
        }
        (start, end) = (end, 2 * end);
    }
}

/// Two polygons between which rays are cast.
struct Pair<'a, V> {
    /// Each with its normal.
    ends: [(&'a [V], V); 2],
    /// Heights above their planes that are rounding errors.
    tolerance: f64,
}

/// Weights of all pairs of one sequence, and of those that see each other.
#[derive(Clone, Copy, Default)]
struct Sum {
    all: f64,
    visible: f64,
}

impl Sum {
    /// Adds a pair of points of two polygons.
    fn add<V: Vector>(&mut self, pair: &Pair<V>, sequence: &Sobol, index: u32, occluders: &impl Occluders) {
        let [x, y, z, w] = core::array::from_fn(|dimension| sequence.dimension(index, dimension));
        let [(from, from_normal), (to, to_normal)] = pair.ends;
        let origin = point_on_polygon(from, [x, y]);
        let direction = point_on_polygon(to, [z, w]) - origin;
        let (out, back) = (direction.dot(from_normal), -direction.dot(to_normal));
        if !(out > V::Scalar::ZERO && back > V::Scalar::ZERO) {
            return;
        }
        let squared = direction.length_squared();
        let weight = (out * back / (squared * squared)).to_f64();
        self.all += weight;
        let [origin, direction] = [origin, direction].map(|vector| vector.to_dvec3().as_vec3());
        let [rise, fall] = [out, back].map(V::Scalar::to_f64);
        let is_between = |share: f64| share * rise > pair.tolerance && (1.0 - share) * fall > pair.tolerance;
        let ray = Ray { origin, direction, end: 1.0 };
        if !occluders.any(&ray, |hit| is_between(f64::from(hit.distance))) {
            self.visible += weight;
        }
    }
}

/// The visible share over all sequences, and its standard error from their spread.
fn visible_share(sums: &[Sum; SEQUENCES as usize]) -> (f64, f64) {
    let all: f64 = sums.iter().map(|sum| sum.all).sum();
    if all == 0.0 {
        // No pair faces each other: nothing is known.
        return (0.5, 0.5);
    }
    let share = sums.iter().map(|sum| sum.visible).sum::<f64>() / all;
    // Of a ratio of means, by linearization.
    let squares: f64 = sums.iter().map(|sum| (sum.visible - share * sum.all) * (sum.visible - share * sum.all)).sum();
    let count = f64::from(SEQUENCES);
    let spread = squares * count / (count - 1.0) / (all * all);
    (share, Real::sqrt(spread))
}
