//! The triangles of a mesh, read.

use bevy::mesh::{Indices, PrimitiveTopology, VertexAttributeValues};
use bevy::prelude::*;

/// The triangles of a mesh in its own space.
pub struct TriangleList<'a> {
    pub positions: &'a [[f32; 3]],
    /// Each points at three positions.
    pub corners: Vec<[u32; 3]>,
    pub width: IndexWidth,
}

/// How indices are stored.
#[derive(Clone, Copy)]
pub enum IndexWidth {
    U16,
    U32,
}

impl<'a> TriangleList<'a> {
    /// # Errors
    ///
    /// Where they cannot be read: why, and what to do.
    pub fn of(mesh: &'a Mesh) -> Result<Self, &'static str> {
        const ON_GPU: &str = "the mesh lives on the GPU alone; give it RenderAssetUsages::default()";
        if mesh.primitive_topology() != PrimitiveTopology::TriangleList {
            return Err("they are not a list; make the mesh with PrimitiveTopology::TriangleList");
        }
        let positions = match mesh.try_attribute_option(Mesh::ATTRIBUTE_POSITION) {
            Ok(Some(VertexAttributeValues::Float32x3(positions))) => positions,
            Ok(_) => return Err("the mesh has no positions of three floats; give it Mesh::ATTRIBUTE_POSITION"),
            Err(_) => return Err(ON_GPU),
        };
        if mesh.attributes().any(|(_, values)| values.len() != positions.len()) {
            return Err("its attributes are not of the same length; give each as many values as there are positions");
        }
        let (indices, width): (Vec<u32>, _) = match mesh.try_indices_option() {
            Ok(Some(Indices::U16(indices))) => (indices.iter().copied().map(u32::from).collect(), IndexWidth::U16),
            Ok(Some(Indices::U32(indices))) => (indices.clone(), IndexWidth::U32),
            Ok(None) => ((0..positions.len() as u32).collect(), IndexWidth::U32),
            Err(_) => return Err(ON_GPU),
        };
        if indices.iter().any(|&index| index as usize >= positions.len()) {
            return Err("an index of the mesh points past its vertices; correct its indices");
        }
        Ok(Self { positions, corners: indices.as_chunks::<3>().0.to_vec(), width })
    }

    /// The corners of a triangle.
    pub fn points(&self, corners: [u32; 3]) -> [Vec3; 3] {
        corners.map(|corner| self.positions[corner as usize].into())
    }
}
