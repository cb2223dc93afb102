//! A mesh with the lightmap coordinates of a bake, for which vertices may be split.

use bevy::mesh::{Indices, PrimitiveTopology, VertexAttributeValues};
use bevy::prelude::*;
use radiosity::lightmap::LightmapUv;

/// The mesh over the vertices of `uv`, with those coordinates as `UV_1`.
///
/// None where the mesh has them already, or where its vertices live on the GPU only.
pub(crate) fn with_lightmap_uv(mesh: &Mesh, uv: &LightmapUv) -> Option<Mesh> {
    let uv_1: Vec<[f32; 2]> = uv.uv_1.iter().map(|uv| uv.to_array()).collect();
    if has_same_vertices(mesh, uv) && has_uv_1(mesh, &uv_1) {
        return None;
    }
    let mut split = Mesh::new(PrimitiveTopology::TriangleList, mesh.asset_usage);
    for (attribute, values) in mesh.try_attributes().ok()? {
        split.insert_attribute(*attribute, values.clone());
    }
    // Bevy duplicates vertices in the order of the indices.
    split.insert_indices(Indices::U32(uv.sources.clone()));
    split.duplicate_vertices();
    split.insert_attribute(Mesh::ATTRIBUTE_UV_1, uv_1);
    split.insert_indices(indices(uv));
    split.enable_raytracing = mesh.enable_raytracing;
    Some(split)
}

/// Whether the coordinates can be of this mesh: it has the vertices and as many triangles.
pub(crate) fn fits(mesh: &Mesh, uv: &LightmapUv) -> bool {
    let vertices = vertex_count(mesh);
    let corners = mesh.try_indices_option().ok().flatten().map_or(vertices, Indices::len);
    let triangles = match mesh.primitive_topology() {
        PrimitiveTopology::TriangleList => corners / 3,
        PrimitiveTopology::TriangleStrip => corners.saturating_sub(2),
        _ => return false,
    };
    triangles == uv.triangles.len() && uv.sources.iter().all(|&source| (source as usize) < vertices)
}

fn vertex_count(mesh: &Mesh) -> usize {
    mesh.try_attribute(Mesh::ATTRIBUTE_POSITION).map_or(0, VertexAttributeValues::len)
}

fn has_same_vertices(mesh: &Mesh, uv: &LightmapUv) -> bool {
    let count = vertex_count(mesh);
    uv.sources.len() == count && uv.sources.iter().copied().eq(0..count as u32)
}

fn has_uv_1(mesh: &Mesh, uv_1: &[[f32; 2]]) -> bool {
    let uv = mesh.try_attribute(Mesh::ATTRIBUTE_UV_1);
    matches!(uv, Ok(VertexAttributeValues::Float32x2(own)) if own == uv_1)
}

/// As narrow as they can be.
fn indices(uv: &LightmapUv) -> Indices {
    let indices = uv.triangles.iter().flatten();
    if uv.sources.len() <= 1 << 16 {
        Indices::U16(indices.map(|&index| index as u16).collect())
    } else {
        Indices::U32(indices.copied().collect())
    }
}
