//! The meshes of surfaces and swept curves, made anew when they change.

use bevy::asset::RenderAssetUsages;
use bevy::ecs::query::QueryData;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use radiosity::spline::{BSplineSurface, ChartScale, Homogeneous, OwnedSurface, Tessellation, Tolerance, tessellate};

use super::{ShapeError, SplineCurve, SplineSurface, SplineSweep};

/// How near the triangles of a surface or a sweep come to it.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq)]
#[reflect(Component, Default)]
pub struct SplineTolerance {
    /// The largest distance, in meters.
    pub chord: f32,
    /// The largest angle between the normals at the ends of an edge, in radians.
    pub angle: f32,
}

impl Default for SplineTolerance {
    fn default() -> Self {
        Self { chord: 0.002, angle: 0.2 }
    }
}

impl SplineTolerance {
    pub(super) fn checked(self) -> Result<Tolerance<f32>, ShapeError> {
        Ok(Tolerance::new(self.chord, self.angle)?)
    }
}

/// On an entity whose mesh was made from its [`SplineSurface`]: what of. A bake takes the true normals from here.
#[derive(Component, Clone, Debug)]
pub struct SplineMesh {
    mesh: AssetId<Mesh>,
    surface: OwnedSurface<Homogeneous<Vec3>>,
}

impl SplineMesh {
    /// The surface that the mesh was made from, in the space of the entity.
    pub fn surface(&self) -> BSplineSurface<'_, Homogeneous<Vec3>> {
        self.surface.surface()
    }

    /// The surface that a mesh was made from, if it is this one.
    pub(crate) fn surface_of(&self, mesh: AssetId<Mesh>) -> Option<&OwnedSurface<Homogeneous<Vec3>>> {
        (self.mesh == mesh).then_some(&self.surface)
    }
}

/// An entity and what it is called.
#[derive(QueryData)]
pub(super) struct Surfaces {
    name: NameOrEntity,
    surface: &'static SplineSurface,
    tolerance: &'static SplineTolerance,
}

type ChangedSurface = Or<(Changed<SplineSurface>, Changed<SplineTolerance>)>;

/// A new mesh for each surface that changed; an old one stays as it is for who else shows it.
pub(super) fn update_surfaces(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    surfaces: Query<Surfaces, ChangedSurface>,
) {
    for item in &surfaces {
        match cut(item.surface, *item.tolerance) {
            Ok((surface, part)) => {
                let mesh = meshes.add(mesh(&part));
                commands.entity(item.name.entity).try_insert((SplineMesh { mesh: mesh.id(), surface }, Mesh3d(mesh)));
            }
            Err(error) => warn!("the mesh of the surface \"{}\" stays as it was: {error}", item.name),
        }
    }
}

type Cut = (OwnedSurface<Homogeneous<Vec3>>, Tessellation<Vec3>);

fn cut(surface: &SplineSurface, tolerance: SplineTolerance) -> Result<Cut, ShapeError> {
    let surface = surface.surface()?;
    let part = tessellate(&surface.surface(), &tolerance.checked()?, ChartScale::Area);
    if part.triangles.is_empty() { Err(ShapeError::Nothing) } else { Ok((surface, part)) }
}

/// A curve that is swept.
#[derive(QueryData)]
pub(super) struct Sweeps {
    name: NameOrEntity,
    curve: &'static SplineCurve,
    sweep: &'static SplineSweep,
    tolerance: &'static SplineTolerance,
}

type ChangedSweep = Or<(Changed<SplineCurve>, Changed<SplineSweep>, Changed<SplineTolerance>)>;

/// A new mesh for each swept curve that changed.
pub(super) fn update_sweeps(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    sweeps: Query<Sweeps, ChangedSweep>,
) {
    for item in &sweeps {
        match item.sweep.mesh(item.curve, *item.tolerance) {
            Ok(mesh) => {
                commands.entity(item.name.entity).try_insert(Mesh3d(meshes.add(mesh)));
            }
            Err(error) => warn!("the mesh of the curve \"{}\" stays as it was: {error}", item.name),
        }
    }
}

/// Bevy's mesh of triangles that lie near a surface.
pub fn mesh(part: &Tessellation<Vec3>) -> Mesh {
    let positions: Vec<[f32; 3]> = part.positions.iter().map(|position| position.to_array()).collect();
    let normals: Vec<[f32; 3]> = part.normals.iter().map(|normal| normal.to_array()).collect();
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, part.uv_0.clone())
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_1, part.uv_1.clone())
        .with_inserted_indices(Indices::U32(part.triangles.as_flattened().to_vec()))
}
