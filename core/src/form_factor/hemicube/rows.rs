//! Rows of form factors: all patches drawn at once.

use core::f32::consts::TAU;

use glam::Vec3;

use super::super::samples::{add, finish, point_on_polygon};
use super::super::shadow::area_vector;
use super::super::{Bins, Estimate, Samples};
use super::{Hemicube, VOID};
use crate::math::{Real, Vector};

/// Form factors by drawing all patches.
impl Hemicube<'_> {
    /// From a point to all patches, each hidden by those before it; the same as [`Hemicube::row`] otherwise.
    ///
    /// `normal` has length 1; `turn` is an angle in radians by which the cube is turned about it. Patches are planar and
    /// convex, counter-clockwise seen from their front; their backs block and belong to the void. One whose plane holds
    /// the point to rounding, such as the patch that it lies on, is left out.
    pub fn point_row<V: Vector>(
        &mut self,
        [point, normal]: [V; 2],
        turn: f32,
        patches: &[&[V]],
        row: &mut [Estimate<V::Scalar>],
    ) -> Bins<V::Scalar> {
        self.draw_all([point, normal], turn, patches);
        self.row(row)
    }

    /// From a convex polygon to all patches: the mean of what [`Hemicube::point_row`] finds at points of it, each with a
    /// turn of its own.
    ///
    /// The polygon sends on the side from which it runs counter-clockwise. The error is
    /// [`STANDARD_ERRORS`](crate::form_factor::STANDARD_ERRORS) standard errors between the scrambles, which see the aliasing of the
    /// pixels as well as the choice of the points, and not below one pixel of one point. `scratch` is as long as `row`.
    /// A polygon without area sees the sky only.
    pub fn polygon_row<V: Vector>(
        &mut self,
        polygon: &[V],
        patches: &[&[V]],
        samples: &Samples,
        row: &mut [Estimate<V::Scalar>],
        scratch: &mut [Estimate<V::Scalar>],
    ) -> Bins<V::Scalar> {
        let samples = samples.at_least_one();
        row.fill(Estimate::default());
        let normal = area_vector(polygon.iter().copied()).normalize_or_zero();
        if normal == V::default() {
            return Bins { sky: V::Scalar::ONE, void: V::Scalar::ZERO };
        }
        let mut bins = Bins::default();
        let share = V::Scalar::from_f64(1.0 / f64::from(samples.points));
        for scramble in 0..samples.scrambles {
            let sequence = samples.sequence(scramble);
            scratch.fill(Estimate::default());
            for index in 0..samples.points {
                let point = point_on_polygon(polygon, sequence.square(index).to_array());
                self.draw_all([point, normal], TAU * sequence.dimension(index, 2), patches);
                self.add_to(scratch, &mut bins, share);
            }
            row.iter_mut().zip(&*scratch).for_each(|(mean, seen)| add(mean, seen.value, scramble + 1));
        }
        let least = self.largest_delta() / samples.total();
        row.iter_mut().for_each(|mean| finish(mean, samples.scrambles, least));
        let scrambles = V::Scalar::from_f64(f64::from(samples.scrambles));
        Bins { sky: bins.sky / scrambles, void: bins.void / scrambles }
    }

    fn draw_all<V: Vector>(&mut self, [point, normal]: [V; 2], turn: f32, patches: &[&[V]]) {
        self.place(single(normal), turn);
        for (index, patch) in patches.iter().enumerate() {
            match facing(point, patch) {
                Facing::Front => self.draw_fan(point, patch, index as u32),
                Facing::Back => self.draw_fan(point, patch, VOID),
                Facing::Edge => {}
            }
        }
    }

    fn draw_fan<V: Vector>(&mut self, point: V, patch: &[V], item: u32) {
        let corner = |k: usize| single(patch[k] - point);
        (2..patch.len()).for_each(|k| self.draw(&[corner(0), corner(k - 1), corner(k)], item));
    }
}

/// How a patch stands to a point.
enum Facing {
    Front,
    Back,
    Edge,
}

/// Which side of a patch a point sees. Within the rounding of the coordinates of its plane it sees none.
fn facing<V: Vector>(point: V, patch: &[V]) -> Facing {
    let Some(&first) = patch.first() else { return Facing::Edge };
    let normal = area_vector(patch.iter().copied()).normalize_or_zero();
    let height = (point - first).dot(normal);
    let size = patch.iter().fold(point.length(), |size, &corner| size.max(corner.length()));
    let rounding = V::Scalar::from_f64(8.0) * V::Scalar::EPSILON * size;
    match () {
        () if height > rounding => Facing::Front,
        () if height < -rounding => Facing::Back,
        () => Facing::Edge,
    }
}

fn single<V: Vector>(vector: V) -> Vec3 {
    vector.to_dvec3().as_vec3()
}
