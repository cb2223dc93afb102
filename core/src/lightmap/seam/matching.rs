//! Which edges belong together, and the points at which their light is compared.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::edges::Edge;
use super::tree::Tree;
use crate::geometry::{Occluders, Ray};
use crate::math;
use crate::transport::Tracer;

/// Cosine of the angle, 5 degrees, up to which shading normals are taken to be those of one surface.
const SMOOTH: f32 = 0.9962;
/// Cosine of the angle, 60 degrees, up to which a smooth surface may be bent at an edge.
const BENT: f32 = 0.5;
/// Points in a texel.
const POINTS: f32 = 2.0;
/// Coordinates in the lightmap this near each other, in texels, are the same: there is no seam.
const SAME: f32 = 0.01;
/// How far from the edge, in texels, nothing may stand between both sides.
const CLEAR: f32 = 0.5;

/// A point of a seam.
pub(super) struct Meeting {
    /// Image, and point in the image in texels, of both sides.
    pub sides: [(u32, Vec2); 2],
    /// Length of the seam that the point stands for, in half texels of the finer side.
    pub weight: f32,
}

/// Finds the points of seams.
pub(super) struct Matching<'a, 'w, O> {
    pub edges: &'a [Edge],
    pub tree: &'a Tree,
    pub tracer: &'a Tracer<'w, O>,
}

/// The part of two edges that lies on each other.
struct Common<'a> {
    /// The edge on each side.
    edges: [&'a Edge; 2],
    /// Where on each edge, in `[0, 1]`, the part starts and where it ends.
    parts: [[f32; 2]; 2],
    /// Length in meters.
    length: f32,
}

impl<O: Occluders> Matching<'_, '_, O> {
    /// The points at which an edge meets those after it, where their images count.
    pub fn meetings(&self, index: usize, counts: impl Fn([u32; 2]) -> bool) -> Vec<Meeting> {
        let edge = &self.edges[index];
        let others = self.tree.near(edge.ends, edge.tolerance);
        let after = others.into_iter().filter(|&other| other as usize > index);
        let others = after.map(|other| &self.edges[other as usize]).filter(|other| counts([edge.image, other.image]));
        let common = others.filter_map(|other| Common::new(edge, other));
        common.flat_map(|common| self.points(&common)).collect()
    }

    fn points(&self, common: &Common) -> Vec<Meeting> {
        let density = common.edges[0].density().max(common.edges[1].density());
        let half_texels = POINTS * density * common.length;
        let count = math::ceil(half_texels).clamp(1.0, 65536.0);
        let at = (0..count as usize).map(|k| (k as f32 + 0.5) / count);
        let open = at.filter(|&at| self.is_open(common, at));
        open.map(|at| Meeting { sides: common.sides(at), weight: half_texels / count }).collect()
    }

    /// Whether light reaches both sides alike: no wall stands on the edge.
    fn is_open(&self, common: &Common, at: f32) -> bool {
        let [left, right] = [0, 1].map(|side| common.beside(side, at));
        let world = self.tracer.world;
        let up: Vec3 = common.edges.iter().map(|edge| world.normals[edge.triangle as usize]).sum();
        let up = up.normalize_or_zero();
        // A line between two points of a convex surface runs below its edge.
        let below = (common.point(0, at) - 0.5 * (left + right)).dot(up).max(0.0);
        let lift = common.edges.iter().map(|edge| world.lift(edge.triangle)).fold(0.0, f32::max);
        let origin = left + up * (1.2 * below + 4.0 * lift);
        self.tracer.count(1);
        self.tracer.visibility(&Ray { origin, direction: right - left, end: 1.0 }) > 0.5
    }
}

impl<'a> Common<'a> {
    /// If the edges lie on each other where one surface goes on.
    fn new(edge: &'a Edge, other: &'a Edge) -> Option<Self> {
        let along = edge.ends[1] - edge.ends[0];
        let (length, tolerance) = (edge.length(), edge.tolerance.min(other.tolerance));
        let place = |point: Vec3| (point - edge.ends[0]).dot(along) / (length * length);
        // The other edge runs the other way, since its triangle lies on the other side.
        let [last, first] = other.ends.map(place);
        let part = [first.max(0.0), last.min(1.0)];
        let common = (part[1] - part[0]) * length;
        if first >= last || common <= 2.0 * tolerance.min(0.25 * length.min(other.length())) {
            return None;
        }
        let on_other = part.map(|at| ((last - at) / (last - first)).clamp(0.0, 1.0));
        let common = Self { edges: [edge, other], parts: [part, on_other], length: common };
        (common.is_near(tolerance) && common.is_smooth() && !common.is_same()).then_some(common)
    }

    fn is_near(&self, tolerance: f32) -> bool {
        [0.0, 1.0].iter().all(|&at| self.point(0, at).distance(self.point(1, at)) <= tolerance)
    }

    fn is_smooth(&self) -> bool {
        let [edge, other] = self.edges;
        let normals = [0, 1].map(|side| self.mix(side, 0.5, self.edges[side].normals).normalize_or_zero());
        let heights = [edge, other].map(|edge| edge.height.normalize_or_zero());
        normals[0].dot(normals[1]) >= SMOOTH && heights[0].dot(heights[1]) <= -BENT
    }

    /// Whether both sides are the same place of the same image.
    fn is_same(&self) -> bool {
        let is_same = |at: f32| {
            let [(image, point), (other_image, other)] = self.sides(at);
            image == other_image && point.distance(other) < SAME
        };
        is_same(0.0) && is_same(1.0)
    }

    /// What lies at a place of the common part, between what lies at the ends of the edge.
    fn mix<T>(&self, side: usize, at: f32, [first, second]: [T; 2]) -> T
    where
        T: core::ops::Mul<f32, Output = T> + core::ops::Add<Output = T>,
    {
        let [start, end] = self.parts[side];
        let at = start + (end - start) * at;
        first * (1.0 - at) + second * at
    }

    fn point(&self, side: usize, at: f32) -> Vec3 {
        self.mix(side, at, self.edges[side].ends)
    }

    /// A point on the triangle of a side, half a texel from the edge or halfway through the triangle.
    fn beside(&self, side: usize, at: f32) -> Vec3 {
        let edge = self.edges[side];
        let texels = edge.height.length() * edge.density();
        self.point(side, at) + edge.height * (CLEAR / texels.max(f32::MIN_POSITIVE)).min(0.5)
    }

    fn sides(&self, at: f32) -> [(u32, Vec2); 2] {
        [0, 1].map(|side| (self.edges[side].image, self.mix(side, at, self.edges[side].texels)))
    }
}
