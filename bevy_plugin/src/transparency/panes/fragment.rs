//! Parts of meshes.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, MeshVertexAttribute, PrimitiveTopology, VertexAttributeValues};
use bevy::prelude::*;

/// A triangle of a mesh: three vertices and where they are in the world.
#[derive(Clone, Copy)]
pub struct Source {
    pub vertices: [u32; 3],
    pub corners: [Vec3; 3],
}

/// # Errors
///
/// Where an attribute cannot be interpolated: what to do.
pub fn can_be_cut(mesh: &Mesh) -> Result<(), &'static str> {
    use VertexAttributeValues as Values;
    let can_be_cut = |values: &_| {
        matches!(
            values,
            Values::Float32(_)
                | Values::Float32x2(_)
                | Values::Float32x3(_)
                | Values::Float32x4(_)
                | Values::Unorm8x4(_)
        )
    };
    match mesh.attributes().all(|(_, values)| can_be_cut(values)) {
        true => Ok(()),
        false => Err("it has an attribute that is neither of floats nor of colors; remove that from its mesh"),
    }
}

/// A mesh of the part of a triangle within a convex polygon in its plane; its vertices are interpolated.
pub fn fragment(mesh: &Mesh, source: &Source, polygon: &[Vec3]) -> Mesh {
    let weights: Vec<[f32; 3]> = polygon.iter().map(|&corner| barycentric(corner, &source.corners)).collect();
    let mut part = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
    for (attribute, values) in mesh.attributes() {
        let Some(values) = interpolated(values, source.vertices, &weights) else { continue };
        let &MeshVertexAttribute { name, id, format } = attribute;
        part.insert_attribute(MeshVertexAttribute { name, id, format }, values);
    }
    let fan = (1..polygon.len().saturating_sub(1) as u16).flat_map(|k| [0, k, k + 1]);
    part.insert_indices(Indices::U16(fan.collect()));
    part
}

/// The weights of the corners of a triangle with which a point in its plane is their mean.
fn barycentric(point: Vec3, &[a, b, c]: &[Vec3; 3]) -> [f32; 3] {
    let normal = (b - a).cross(c - a);
    let share = |from: Vec3, to: Vec3| (from - point).cross(to - point).dot(normal) / normal.length_squared();
    let [of_a, of_b] = [share(b, c), share(c, a)].map(|share| if share.is_finite() { share } else { 0.0 });
    [of_a, of_b, 1.0 - of_a - of_b]
}

fn interpolated(
    values: &VertexAttributeValues,
    vertices: [u32; 3],
    weights: &[[f32; 3]],
) -> Option<VertexAttributeValues> {
    use VertexAttributeValues as Values;
    let of = vertices.map(|vertex| vertex as usize);
    Some(match values {
        Values::Float32(values) => {
            let values = mixed(of.map(|k| [values[k]]), weights);
            Values::Float32(values.into_iter().map(|[value]| value).collect())
        }
        Values::Float32x2(values) => Values::Float32x2(mixed(of.map(|k| values[k]), weights)),
        Values::Float32x3(values) => Values::Float32x3(mixed(of.map(|k| values[k]), weights)),
        Values::Float32x4(values) => Values::Float32x4(mixed(of.map(|k| values[k]), weights)),
        Values::Unorm8x4(values) => {
            let values = mixed(of.map(|k| values[k].map(f32::from)), weights);
            Values::Unorm8x4(values.into_iter().map(|value| value.map(|part| part.round() as u8)).collect())
        }
        _ => return None,
    })
}

fn mixed<const N: usize>(of: [[f32; N]; 3], weights: &[[f32; 3]]) -> Vec<[f32; N]> {
    let mix = |weights: &[f32; 3]| std::array::from_fn(|k| (0..3).map(|corner| of[corner][k] * weights[corner]).sum());
    weights.iter().map(mix).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polygon in a triangle whose attributes are its coordinates has its own coordinates.
    #[test]
    fn attributes_follow_the_cut() {
        let corners = [Vec3::new(1.0, 0.0, 2.0), Vec3::new(4.0, 1.0, 2.5), Vec3::new(0.0, 3.0, -1.0)];
        let positions: Vec<[f32; 3]> = corners.map(|corner| corner.to_array()).to_vec();
        let mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions.clone())
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, positions)
            .with_inserted_attribute(Mesh::ATTRIBUTE_UV_1, corners.map(|p| [p.x, p.y]).to_vec());
        let at = |a: f32, b: f32| corners[0] * a + corners[1] * b + corners[2] * (1.0 - a - b);
        let polygon = [at(1.0, 0.0), at(0.2, 0.5), at(0.3, 0.3), at(0.6, 0.0)];
        let part = fragment(&mesh, &Source { vertices: [0, 1, 2], corners }, &polygon);
        assert_eq!(part.indices().map(Indices::len), Some(6));
        let Some(VertexAttributeValues::Float32x3(normals)) = part.attribute(Mesh::ATTRIBUTE_NORMAL) else { panic!() };
        let Some(VertexAttributeValues::Float32x2(uv)) = part.attribute(Mesh::ATTRIBUTE_UV_1) else { panic!() };
        for (corner, (normal, uv)) in polygon.iter().zip(normals.iter().zip(uv)) {
            assert!(Vec3::from(*normal).abs_diff_eq(*corner, 1e-5) && Vec2::from(*uv).abs_diff_eq(corner.xy(), 1e-5));
        }
    }
}
