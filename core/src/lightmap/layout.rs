//! Lightmap coordinates for every mesh and a place for every surface.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use glam::{Mat3A, Vec2};

use super::chart::{self, Charts};
use super::plan::{self, Extent, Item, NoPlan, Plan, Shape};
use super::unwrap::unwrap;
use super::{LightmapUv, Placement, UvOrigin};
use crate::geometry::Mesh;
use crate::progress::{Cancelled, Progress};
use crate::scene::{Receiver, Scene};

/// How many texels a bake has, and what becomes of the coordinates that the meshes bring along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayoutSettings {
    /// How many texels.
    pub resolution: Resolution,
    /// What becomes of the lightmap coordinates that the meshes bring along.
    pub uv: UvMode,
    /// Longest side of an image in texels, a multiple of 4, at most 4096.
    pub max_image_size: u32,
}

impl Default for LayoutSettings {
    /// About a million texels, coordinates kept where they are usable, images up to 4096 texels wide and high.
    fn default() -> Self {
        Self { resolution: Resolution::Texels(1 << 20), uv: UvMode::Auto, max_image_size: 4096 }
    }
}

/// How many texels a bake has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// As many per meter as give about this many texels in all images together, between 1 and 64 per meter.
    Texels(u32),
    /// The same density everywhere; 4 to 64 are usual.
    TexelsPerMeter(f32),
    /// One square image of this side in texels.
    SingleImage(u32),
}

/// What becomes of the lightmap coordinates that a mesh brings along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UvMode {
    /// Usable ones are kept, the rest is unwrapped.
    #[default]
    Auto,
    /// A mesh without usable ones is an error.
    Keep,
    /// All meshes are unwrapped anew.
    Unwrap,
}

/// Where everything lies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// For each mesh of the scene its lightmap coordinates, if a surface with a lightmap uses it.
    pub uvs: Vec<Option<LightmapUv>>,
    /// For each mesh of the scene the chart of each triangle, counted from 0 within the mesh; empty without coordinates.
    pub charts: Vec<Vec<u32>>,
    /// For each surface of the scene where its lightmap lies, if it has one.
    pub placements: Vec<Option<Placement>>,
    /// Width and height of each image in texels, multiples of 4.
    pub images: Vec<[u32; 2]>,
    /// Density of the bake.
    pub texels_per_meter: f32,
    /// What the user should know, each with the remedy.
    pub warnings: Vec<String>,
}

/// Why no layout could be made. Each has the remedy in the text of the error of the bake.
#[derive(Clone, Debug, PartialEq)]
pub enum LayoutError {
    /// Something that the settings say cannot be; the text says what.
    Invalid(String),
    /// `UvMode::Keep`, and a mesh has no usable lightmap coordinates.
    UnusableUv {
        /// Of the mesh.
        mesh: String,
        /// What is wrong with its coordinates.
        reason: String,
    },
    /// The charts do not fit; the text says by how much and what to do.
    DoesNotFit(String),
    /// The progress was told to cancel.
    Cancelled,
}

impl From<Cancelled> for LayoutError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

#[cfg(all(test, feature = "unwrap"))]
mod tests;

/// Share of the work that goes into coordinates; packing is the rest.
const UNWRAPPING: f32 = 0.9;
/// Widest image that can be asked for, in texels.
const LARGEST_IMAGE: u32 = 4096;

/// Keeps or makes lightmap coordinates and packs all surfaces into images.
///
/// A mesh is laid out once; every surface that uses it gets a rectangle of its own, larger where the surface is larger.
/// Charts are at least 4 texels apart, and 2 from the border of an unwrapped rectangle; kept coordinates reach the
/// border of theirs, which has 2 empty texels around it. No two rectangles share a block of 4 x 4 texels.
///
/// # Errors
///
/// See [`LayoutError`].
pub fn layout(scene: &Scene, settings: &LayoutSettings, progress: &Progress) -> Result<Layout, LayoutError> {
    check(scene, settings)?;
    let mut warnings = Vec::new();
    let surfaces = receiving(scene, &mut warnings, progress)?;
    let shapes = shapes(scene, settings, &surfaces, &mut warnings, progress)?;
    let items = items(scene, &surfaces, &shapes, progress)?;
    let area = surfaces.iter().filter(|s| shapes[s.mesh].is_some()).map(|s| s.scaled_area() as f32).sum();
    progress.advance(UNWRAPPING)?;
    let (plan, density) = plan_for(&shapes, &items, settings, area, progress).map_err(|no| explain(no, scene))?;
    warn_of_lower_density(scene, &items, &plan, density, &mut warnings);
    progress.advance(1.0)?;
    Ok(assemble(scene, shapes, &items, plan, density, warnings))
}

/// A surface that can get a lightmap.
struct Surface {
    index: usize,
    mesh: usize,
    /// Linear part of its transform.
    linear: Mat3A,
    /// Factor on the texels per meter.
    density: f32,
    /// In square meters.
    area: f64,
}

impl Surface {
    /// Area as the density of the bake sees it.
    fn scaled_area(&self) -> f64 {
        self.area * f64::from(self.density) * f64::from(self.density)
    }
}

fn check(scene: &Scene, settings: &LayoutSettings) -> Result<(), LayoutError> {
    let is_size = |size: u32| (16..=LARGEST_IMAGE).contains(&size) && size.is_multiple_of(4);
    let invalid = |text: String| Err(LayoutError::Invalid(text));
    if !is_size(settings.max_image_size) {
        return invalid(format!(
            "images of at most {} texels: choose a multiple of 4 from 16 to {LARGEST_IMAGE}",
            settings.max_image_size
        ));
    }
    match settings.resolution {
        Resolution::Texels(0) => return invalid("0 texels: choose at least 1".into()),
        Resolution::TexelsPerMeter(density) if !(density.is_finite() && density > 0.0) => {
            return invalid(format!("{density} texels per meter: choose a positive number, 4 to 64 are usual"));
        }
        Resolution::SingleImage(side) if !is_size(side) || side > settings.max_image_size => {
            return invalid(format!(
                "one image of {side} texels: choose a multiple of 4 from 16 to {}",
                settings.max_image_size
            ));
        }
        _ => {}
    }
    check_scene(scene)
}

fn check_scene(scene: &Scene) -> Result<(), LayoutError> {
    for mesh in &scene.meshes {
        let count = mesh.positions.len();
        if let Some(index) = mesh.triangles.as_flattened().iter().find(|&&index| index as usize >= count) {
            let name = &mesh.name;
            return Err(LayoutError::Invalid(format!("mesh \"{name}\" has {count} vertices and uses number {index}")));
        }
    }
    for surface in &scene.surfaces {
        let name = &surface.name;
        if surface.mesh >= scene.meshes.len() {
            return Err(LayoutError::Invalid(format!(
                "surface \"{name}\" uses mesh {}, which is not there",
                surface.mesh
            )));
        }
        match surface.receiver {
            Receiver::Lightmap { density } if !(density.is_finite() && density > 0.0) => {
                return Err(LayoutError::Invalid(format!(
                    "surface \"{name}\" asks for {density} times the density: choose a positive number, 1 is usual"
                )));
            }
            _ => {}
        }
    }
    Ok(())
}

/// The surfaces that get a lightmap and have an area.
fn receiving(scene: &Scene, warnings: &mut Vec<String>, progress: &Progress) -> Result<Vec<Surface>, Cancelled> {
    let mut surfaces = Vec::new();
    for (index, surface) in scene.surfaces.iter().enumerate() {
        let Receiver::Lightmap { density } = surface.receiver else { continue };
        progress.check()?;
        let (mesh, linear) = (&scene.meshes[surface.mesh], surface.transform.matrix3);
        let area = chart::area(&chart::mapped(&mesh.positions, &linear), &mesh.triangles);
        if area > 0.0 && area.is_finite() {
            surfaces.push(Surface { index, mesh: surface.mesh, linear, density, area });
        } else {
            warnings.push(format!(
                "surface \"{}\" has no area and gets no lightmap; check the scale of its transform and its triangles",
                surface.name
            ));
        }
    }
    Ok(surfaces)
}

/// Coordinates for every mesh that a surface needs.
fn shapes(
    scene: &Scene,
    settings: &LayoutSettings,
    surfaces: &[Surface],
    warnings: &mut Vec<String>,
    progress: &Progress,
) -> Result<Vec<Option<Shape>>, LayoutError> {
    let references = references(scene, surfaces);
    let size = |mesh: usize| scene.meshes[mesh].triangles.len();
    let total: usize = (0..scene.meshes.len()).filter(|&mesh| references[mesh].is_some()).map(size).sum();
    let (mut shapes, mut done) = (Vec::with_capacity(scene.meshes.len()), 0);
    for (index, reference) in references.into_iter().enumerate() {
        let Some(reference) = reference else {
            shapes.push(None);
            continue;
        };
        let advance =
            |part: f32| progress.advance(UNWRAPPING * (done as f32 + part * size(index) as f32) / total as f32);
        advance(0.0)?;
        shapes.push(shape(&scene.meshes[index], &surfaces[reference], settings.uv, warnings, &advance)?);
        done += size(index);
    }
    Ok(shapes)
}

/// For each mesh the smallest surface that uses it, in texels.
fn references(scene: &Scene, surfaces: &[Surface]) -> Vec<Option<usize>> {
    let mut references: Vec<Option<usize>> = vec![None; scene.meshes.len()];
    for (index, surface) in surfaces.iter().enumerate() {
        let smallest = &mut references[surface.mesh];
        if smallest.is_none_or(|other| surface.scaled_area() < surfaces[other].scaled_area()) {
            *smallest = Some(index);
        }
    }
    references
}

fn shape(
    mesh: &Mesh,
    reference: &Surface,
    mode: UvMode,
    warnings: &mut Vec<String>,
    advance: &(dyn Fn(f32) -> Result<(), Cancelled> + Sync),
) -> Result<Option<Shape>, LayoutError> {
    let name = &mesh.name;
    let judged = match mode {
        UvMode::Unwrap if !mesh.uv_1_in_use => Err("all meshes are to be unwrapped".into()),
        _ => chart::judge(mesh),
    };
    let reason = match judged {
        Ok(kept) => return Ok(Some(Shape::Kept(kept))),
        Err(reason) => reason,
    };
    match mode {
        UvMode::Keep => return Err(LayoutError::UnusableUv { mesh: name.clone(), reason }),
        _ if mesh.uv_1_in_use => {
            warnings.push(format!(
                "mesh \"{name}\" gets no lightmap: a texture uses its second UV set, which cannot serve for a lightmap \
                 too ({reason}); let the texture use the first set, or mend the second"
            ));
            return Ok(None);
        }
        UvMode::Auto if !mesh.uv_1.is_empty() => {
            warnings.push(format!("mesh \"{name}\" was unwrapped anew: {reason}; mend its second UV set to keep it"));
        }
        _ => {}
    }
    let charts = unwrapped(mesh, reference, advance)?;
    if charts.scattered > 0 {
        warnings.push(format!(
            "{} triangles of mesh \"{name}\" could not be unwrapped and became charts of their own; \
             give it a second UV set to avoid seams",
            charts.scattered
        ));
    }
    Ok(Some(Shape::Unwrapped(charts)))
}

/// The charts of a mesh at the size of a surface, its density included.
fn unwrapped(
    mesh: &Mesh,
    reference: &Surface,
    advance: &(dyn Fn(f32) -> Result<(), Cancelled> + Sync),
) -> Result<Charts, LayoutError> {
    let positions = chart::mapped(&mesh.positions, &(reference.linear * reference.density));
    unwrap(&positions, &mesh.triangles, advance).map_err(|error| match error {
        LayoutError::UnusableUv { reason, .. } => LayoutError::UnusableUv { mesh: mesh.name.clone(), reason },
        other => other,
    })
}

fn items(
    scene: &Scene,
    surfaces: &[Surface],
    shapes: &[Option<Shape>],
    progress: &Progress,
) -> Result<Vec<Item>, Cancelled> {
    let references = references(scene, surfaces);
    let mut items = Vec::with_capacity(surfaces.len());
    for surface in surfaces {
        progress.check()?;
        let mesh = &scene.meshes[surface.mesh];
        let extent = match (&shapes[surface.mesh], references[surface.mesh]) {
            (Some(Shape::Kept(kept)), _) => {
                let positions = chart::mapped(&mesh.positions, &(surface.linear * surface.density));
                Extent::Meters(chart::meters_per_uv(&positions, &mesh.triangles, &kept.uv_1))
            }
            (Some(Shape::Unwrapped(_)), Some(reference)) => {
                let ratio = surface.scaled_area() / surfaces[reference].scaled_area();
                Extent::Scale(crate::math::sqrt(ratio as f32).max(1.0))
            }
            _ => continue,
        };
        items.push(Item { surface: surface.index, mesh: surface.mesh, extent });
    }
    Ok(items)
}

fn plan_for(
    shapes: &[Option<Shape>],
    items: &[Item],
    settings: &LayoutSettings,
    area: f32,
    progress: &Progress,
) -> Result<(Plan, f32), NoPlan> {
    let max = settings.max_image_size;
    match settings.resolution {
        _ if items.is_empty() => {
            Ok((Plan { tiles: Vec::new(), rects: Vec::new(), places: Vec::new(), images: Vec::new() }, 0.0))
        }
        Resolution::Texels(texels) => plan::for_texels(shapes, items, texels, [area, max as f32], progress),
        Resolution::TexelsPerMeter(density) => Ok((plan::at_density(shapes, items, density, max, progress)?, density)),
        Resolution::SingleImage(side) => plan::for_image(shapes, items, side, area, progress),
    }
}

fn explain(no_plan: NoPlan, scene: &Scene) -> LayoutError {
    match no_plan {
        NoPlan::Cancelled => LayoutError::Cancelled,
        NoPlan::TooManyCharts(mesh) => LayoutError::DoesNotFit(format!(
            "mesh \"{}\" has more charts than the largest image has room for; split it into several meshes",
            scene.meshes[mesh].name
        )),
        NoPlan::OneImage => LayoutError::DoesNotFit(
            "the surfaces do not fit into one image even at the lowest density; ask for a larger image, or for texels per meter"
                .into(),
        ),
    }
}

fn warn_of_lower_density(scene: &Scene, items: &[Item], plan: &Plan, density: f32, warnings: &mut Vec<String>) {
    for (item, rect) in items.iter().zip(&plan.rects).filter(|(_, rect)| rect.share < 1.0) {
        warnings.push(format!(
            "surface \"{}\" (mesh \"{}\") is too large for one image: it gets {:.2} instead of {density:.2} texels per \
             meter, {:.0} % of the density; split the mesh, or allow larger images",
            scene.surfaces[item.surface].name,
            scene.meshes[item.mesh].name,
            density * rect.share,
            100.0 * rect.share,
        ));
    }
}

fn assemble(
    scene: &Scene,
    shapes: Vec<Option<Shape>>,
    items: &[Item],
    plan: Plan,
    texels_per_meter: f32,
    warnings: Vec<String>,
) -> Layout {
    let mut layout = Layout { texels_per_meter, warnings, ..Layout::default() };
    for (index, shape) in shapes.into_iter().enumerate() {
        let (uv, charts) = match (shape, plan.tiles.get(index)) {
            (Some(Shape::Kept(kept)), _) => {
                let mesh = &scene.meshes[index];
                let sources = (0..mesh.positions.len() as u32).collect();
                let triangles = mesh.triangles.clone();
                (Some(LightmapUv { origin: UvOrigin::Kept, sources, uv_1: kept.uv_1, triangles }), kept.triangle_charts)
            }
            (Some(Shape::Unwrapped(charts)), Some(Some(tile))) => {
                let uv_1 = tile.coordinates(&charts);
                let Charts { sources, triangles, triangle_charts, .. } = charts;
                (Some(LightmapUv { origin: UvOrigin::Unwrapped, sources, uv_1, triangles }), triangle_charts)
            }
            _ => (None, Vec::new()),
        };
        layout.uvs.push(uv);
        layout.charts.push(charts);
    }
    layout.placements = vec![None; scene.surfaces.len()];
    for ((item, rect), place) in items.iter().zip(&plan.rects).zip(&plan.places) {
        let image = Vec2::from(plan.images[place.image].map(|side| side as f32));
        let corner = place.corner.map(|texel| texel + rect.inset);
        let texel = |corner: [u32; 2]| Vec2::from(corner.map(|texel| texel as f32)) / image;
        let (min, max) = (texel(corner), texel([0, 1].map(|axis| corner[axis] + rect.size[axis])));
        layout.placements[item.surface] = Some(Placement { image: place.image, min, max });
    }
    layout.images = plan.images;
    layout
}
