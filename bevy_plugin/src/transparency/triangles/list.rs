//! The triangles of a mesh and their order.

use std::sync::Arc;

use bevy::asset::RenderAssetUsages;
use bevy::math::Affine3A;
use bevy::mesh::Indices;
use bevy::prelude::*;
use radiosity::composite::{Draw, DrawKey, Tolerance, ViewDepth, resort};

use super::super::triangle_list::{IndexWidth, TriangleList};

/// The triangles of a mesh in the order of the asset.
#[derive(Clone)]
pub struct Triangles(Arc<List>);

struct List {
    corners: Vec<[u32; 3]>,
    centroids: Vec<Vec3>,
    center: Vec3,
    width: IndexWidth,
}

/// Triangles from far to near.
#[derive(Default)]
pub struct Order(Vec<Draw>);

impl Triangles {
    /// # Errors
    ///
    /// Where they cannot be sorted: why, and what to do.
    pub fn of(mesh: &Mesh) -> Result<Self, &'static str> {
        let list = TriangleList::of(mesh)?;
        let centroid = |&corners: &[u32; 3]| list.points(corners).into_iter().sum::<Vec3>() / 3.0;
        let centroids: Vec<Vec3> = list.corners.iter().map(centroid).collect();
        let center = centroids.iter().sum::<Vec3>() / centroids.len().max(1) as f32;
        Ok(Self(Arc::new(List { corners: list.corners, centroids, center, width: list.width })))
    }

    pub fn len(&self) -> usize {
        self.0.corners.len()
    }

    /// The mean of their centroids.
    pub fn center(&self) -> Vec3 {
        self.0.center
    }

    /// A mesh whose indices can be written; one without gets some.
    pub fn copy_of(&self, mesh: &Mesh) -> Mesh {
        let mut copy = mesh.clone();
        copy.asset_usage = RenderAssetUsages::default();
        copy.insert_indices(self.indices(0..self.len()));
        copy
    }

    fn indices(&self, order: impl Iterator<Item = usize>) -> Indices {
        let corners = order.flat_map(|triangle| self.0.corners[triangle]);
        match self.0.width {
            IndexWidth::U16 => Indices::U16(corners.map(|index| index as u16).collect()),
            IndexWidth::U32 => Indices::U32(corners.collect()),
        }
    }
}

impl Order {
    /// As they stand in the asset.
    pub fn of(triangles: &Triangles) -> Self {
        let key = DrawKey::new(0, 0, 0.0);
        Self((0..triangles.len() as u32).map(|index| Draw { key, rank: index, index }).collect())
    }

    /// Sorts them from where they stood before.
    pub fn sorted(mut self, triangles: &Triangles, depth: &ViewDepth, world_from_local: &Affine3A) -> Self {
        for draw in &mut self.0 {
            let centroid = world_from_local.transform_point3(triangles.0.centroids[draw.index as usize]);
            draw.key = DrawKey::new(0, 0, depth.of_point(centroid));
        }
        let mut scratch = self.0.clone();
        resort(&mut self.0, &mut scratch, Tolerance::NONE);
        self
    }

    /// Writes it into the mesh; one that is gone needs none.
    pub fn write(&self, triangles: &Triangles, copy: &Handle<Mesh>, meshes: &mut Assets<Mesh>) {
        let indices = triangles.indices(self.0.iter().map(|draw| draw.index as usize));
        if let Some(mut mesh) = meshes.get_mut(copy) {
            mesh.insert_indices(indices);
        }
    }
}
