//! A mesh with the lightmap coordinates of a bake, for which vertices may be split.

use bevy::mesh::{Indices, PrimitiveTopology, VertexAttributeValues};
use bevy::prelude::*;
use radiosity::lightmap::LightmapUv;

/// The mesh over the vertices of `uv`, with those coordinates as `UV_1`.
///
/// It has `UV_0` too. None where the mesh has all that already, or where its vertices live on the GPU only.
pub(crate) fn with_lightmap_uv(mesh: &Mesh, uv: &LightmapUv) -> Option<Mesh> {
    let uv_1: Vec<[f32; 2]> = uv.uv_1.iter().map(|uv| uv.to_array()).collect();
    let has_uv_0 = mesh.try_contains_attribute(Mesh::ATTRIBUTE_UV_0).ok()?;
    if has_uv_0 && has_same_vertices(mesh, uv) && has_uv_1(mesh, &uv_1) {
        return None;
    }
    let mut split = Mesh::new(PrimitiveTopology::TriangleList, mesh.asset_usage);
    for (attribute, values) in mesh.try_attributes().ok()? {
        split.insert_attribute(*attribute, values.clone());
    }
    // Bevy duplicates vertices in the order of the indices.
    split.insert_indices(Indices::U32(uv.sources.clone()));
    split.duplicate_vertices();
    if !has_uv_0 {
        // The shader of Bevy 0.19.1 does not compile for a mesh with `UV_1` alone.
        split.insert_attribute(Mesh::ATTRIBUTE_UV_0, vec![[0.0_f32; 2]; uv_1.len()]);
    }
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

#[cfg(test)]
mod tests {
    use bevy::asset::RenderAssetUsages;
    use radiosity::lightmap::UvOrigin;

    use super::*;

    /// Bevy 0.19.1 does not draw a mesh with `UV_1` and without `UV_0`.
    #[test]
    fn every_lightmap_mesh_has_uv_0() {
        let corners = [Vec2::ZERO, Vec2::X, Vec2::Y];
        let uv = LightmapUv {
            origin: UvOrigin::Kept,
            sources: vec![0, 1, 2],
            uv_1: corners.to_vec(),
            triangles: vec![[0, 1, 2]],
        };
        let bare = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, corners.map(|corner| corner.extend(0.0)).to_vec());
        let with_uv_1 = bare.clone().with_inserted_attribute(Mesh::ATTRIBUTE_UV_1, corners.to_vec());
        for mesh in [bare, with_uv_1] {
            let lightmap_mesh = with_lightmap_uv(&mesh, &uv).expect("something is missing");
            assert!(lightmap_mesh.contains_attribute(Mesh::ATTRIBUTE_UV_0));
            assert!(with_lightmap_uv(&lightmap_mesh, &uv).is_none(), "nothing is missing any more");
        }
    }
}
