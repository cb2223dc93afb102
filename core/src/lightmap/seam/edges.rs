//! The edges at which charts end.

use alloc::vec::Vec;
use core::ops::Range;

use glam::{Vec2, Vec3};

use super::super::Texels;
use crate::scene::World;

/// Edges are taken to lie on each other within this share of a texel...
const TOLERANCE: f32 = 0.05;
/// ...but not over wider gaps than this, in meters.
const WIDEST_GAP: f32 = 2e-3;

/// An edge of a triangle where its chart ends, from the first to the second corner, with the triangle on its left.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// Of the world.
    pub triangle: u32,
    /// In the world.
    pub ends: [Vec3; 2],
    /// In the image of the triangle, in texels.
    pub texels: [Vec2; 2],
    /// Shading normals at the ends.
    pub normals: [Vec3; 2],
    /// From the edge to the opposite corner, at right angles to the edge.
    pub height: Vec3,
    /// Of the lightmap.
    pub image: u32,
    /// How near other edges must be, in meters.
    pub tolerance: f32,
}

impl Edge {
    fn new(world: &World, texels: &Texels, triangle: u32, first: usize) -> Self {
        let (second, third) = ((first + 1) % 3, (first + 2) % 3);
        let (corners, in_image) = (&world.corners[triangle as usize], &texels.places[triangle as usize].corners);
        let normals = world.corner_normals(triangle);
        let ends = [corners[first], corners[second]];
        let along = (ends[1] - ends[0]).normalize_or_zero();
        let across = corners[third] - ends[0];
        let ends_in_image = [in_image[first], in_image[second]];
        let texel = (ends[1] - ends[0]).length() / ends_in_image[0].distance(ends_in_image[1]).max(f32::MIN_POSITIVE);
        Self {
            triangle,
            ends,
            texels: ends_in_image,
            normals: [normals[first], normals[second]],
            height: across - along * across.dot(along),
            image: texels.places[triangle as usize].image,
            tolerance: (TOLERANCE * texel).min(WIDEST_GAP).max(4.0 * world.lift(triangle)),
        }
    }

    pub fn length(&self) -> f32 {
        self.ends[0].distance(self.ends[1])
    }

    /// Texels in a meter along the edge.
    pub fn density(&self) -> f32 {
        self.texels[0].distance(self.texels[1]) / self.length()
    }
}

/// All edges that no other triangle shares in these lightmaps.
pub(super) fn open(world: &World, texels: &Texels, images: &Range<usize>) -> Vec<Edge> {
    let mut keys: Vec<([u32; 5], u32)> = Vec::new();
    let is_wanted = |triangle: usize| images.contains(&(texels.places[triangle].image as usize));
    for (triangle, place) in texels.places.iter().enumerate().filter(|(triangle, _)| is_wanted(*triangle)) {
        let bits = place.corners.map(|corner| corner.to_array().map(f32::to_bits));
        keys.extend((0..3).map(|first| {
            let (a, b) = (bits[first], bits[(first + 1) % 3]);
            let [low, high] = [a.min(b), a.max(b)];
            ([place.image, low[0], low[1], high[0], high[1]], (3 * triangle + first) as u32)
        }));
    }
    keys.sort_unstable();
    let alone = keys.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
    let mut alone: Vec<u32> = alone.map(|same| same[0].1).collect();
    alone.sort_unstable();
    let edges = alone.into_iter().map(|edge| Edge::new(world, texels, edge / 3, (edge % 3) as usize));
    edges.filter(|edge| edge.length() > edge.tolerance.min(1e-6) && edge.density() > 0.0).collect()
}
