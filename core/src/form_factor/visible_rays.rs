//! Polygon to polygon with visibility by rays: for many blockers and for those that are not convex.

use glam::Vec3;

use crate::geometry::{Occluders, Ray, Sobol};
use crate::math;

use super::samples::point_on_polygon;
use super::shadow::area_vector;
use super::{Estimate, visible_polygon_to_polygon};

/// Independent sequences, from whose spread the error is known.
const SEQUENCES: u32 = 16;
/// Rays of one sequence in the first round; each round doubles them.
const FIRST_RAYS: u32 = 64;
/// Rays of one sequence after which no more are cast.
const MOST_RAYS: u32 = 1 << 16;
/// Of the way from point to point at each end; what stands there is one of the two polygons.
const END: f32 = 1e-4;

/// Share of the power leaving `a` that lands on `b` past any `occluders`, with its standard error.
///
/// Both are convex, run counter-clockwise seen from their fronts and exchange light there only. They may be among the
/// occluders: what a ray meets in the first or last 1e-4 of its way is ignored. `accuracy` is the standard error to aim
/// for; rays are doubled until it is reached, up to a million, and 1024 at least.
///
/// Pairs of points `p`, `q`, four dimensions of a Sobol sequence, are weighted with `cos cos / r^2`. The weighted share
/// of the pairs that see each other, times the exact factor without occluders, is the value, so that neither all
/// visible nor all hidden leaves any noise. The error comes from 16 independent scramblings and is at least what a
/// single ray would change. Where the polygons share an edge the weights vary without bound and the error falls slowly.
pub fn visible_polygon_to_polygon_by_rays(
    a: &[Vec3],
    b: &[Vec3],
    occluders: &impl Occluders,
    accuracy: f32,
) -> Estimate<f32> {
    let unoccluded = visible_polygon_to_polygon(a, b, &[], 1e-6);
    if !(unoccluded.value > 0.0) {
        return unoccluded;
    }
    let ends = [a, b].map(|polygon| (polygon, area_vector(polygon.iter().copied()).normalize_or_zero()));
    let mut sums = [Sum::default(); SEQUENCES as usize];
    let (mut start, mut end) = (0, FIRST_RAYS);
    loop {
        for (sum, seed) in sums.iter_mut().zip(0..) {
            let sequence = Sobol::new(seed);
            (start..end).for_each(|i| sum.add(&ends, &sequence, i, occluders));
        }
        let (share, spread) = visible_share(&sums);
        let one_ray = 1.0 / (end * SEQUENCES) as f32;
        let error = unoccluded.value * spread.max(one_ray) + unoccluded.error;
        if error <= accuracy || end >= MOST_RAYS {
            return Estimate { value: unoccluded.value * share, error };
        }
        (start, end) = (end, 2 * end);
    }
}

/// Weights of all pairs of one sequence, and of those that see each other.
#[derive(Clone, Copy, Default)]
struct Sum {
    all: f64,
    visible: f64,
}

impl Sum {
    /// Adds a pair of points of two polygons, which are given with their normals.
    fn add(&mut self, ends: &[(&[Vec3], Vec3); 2], sequence: &Sobol, index: u32, occluders: &impl Occluders) {
        let [x, y, z, w] = core::array::from_fn(|dimension| sequence.dimension(index, dimension));
        let [(from, from_normal), (to, to_normal)] = *ends;
        let origin = point_on_polygon(from, [x, y]);
        let direction = point_on_polygon(to, [z, w]) - origin;
        let (out, back) = (direction.dot(from_normal), -direction.dot(to_normal));
        if out <= 0.0 || back <= 0.0 {
            return;
        }
        let squared = direction.length_squared();
        let weight = f64::from(out * back / (squared * squared));
        self.all += weight;
        let ray = Ray { origin, direction, end: 1.0 - END };
        if !occluders.any(&ray, |hit| hit.distance > END) {
            self.visible += weight;
        }
    }
}

/// The visible share over all sequences, and its standard error from their spread.
fn visible_share(sums: &[Sum; SEQUENCES as usize]) -> (f32, f32) {
    let all: f64 = sums.iter().map(|sum| sum.all).sum();
    let share = sums.iter().map(|sum| sum.visible).sum::<f64>() / all;
    // Of a ratio of means, by linearization.
    let squares: f64 = sums.iter().map(|sum| (sum.visible - share * sum.all) * (sum.visible - share * sum.all)).sum();
    let count = f64::from(SEQUENCES);
    let spread = squares * count / (count - 1.0) / (all * all);
    (share as f32, math::sqrt(spread as f32))
}
