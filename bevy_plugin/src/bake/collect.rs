//! From entities to the scene of a bake.

mod found;
#[cfg(test)]
mod tests;

use std::collections::HashMap;

use bevy::asset::UntypedAssetId;
use bevy::camera::visibility::RenderLayers;
use bevy::ecs::world::EntityRef;
use bevy::light::{DirectionalLight, NotShadowCaster, PointLight, RectLight, SpotLight, SunDisk};
use bevy::mesh::skinning::SkinnedMesh;
use bevy::prelude::*;
use radiosity::light::{Light, LightSource};
use radiosity::scene::{CurvedMesh, Receiver, Scene, Surface};

use self::found::{Found, LOOKUPS};
use super::components::{AngularDiameter, Baked, NotBaked, SkyLight};
use crate::convert;
use crate::gltf::GltfSource;
use crate::spline::SplineMesh;
use crate::stand_in::given_mesh;

/// What the sun looks like from Earth, in radians.
const SUN_DIAMETER: f32 = 0.53 * std::f32::consts::PI / 180.0;

/// Glass of a larger roughness scatters what it lets through.
const MATT: f32 = 0.3;

/// The scene of a bake and where its parts come from.
#[derive(Clone, Debug, Default)]
pub struct Collected {
    /// What is baked.
    pub scene: Scene,
    /// For each surface of the scene its entity.
    pub surfaces: Vec<Entity>,
    /// For each mesh of the scene its asset.
    pub mesh_handles: Vec<Handle<Mesh>>,
    /// For each light of the scene its entity; suns of the sky come after these and have none.
    pub lights: Vec<Entity>,
    /// What the user should know, each with the remedy.
    pub warnings: Vec<String>,
}

/// Collects every mesh and every light below a [`Baked`], and the [`SkyLight`]. Call it when transforms are propagated and assets loaded.
///
/// The order depends on the hierarchy alone, so that equal worlds give equal scenes.
pub fn collect(world: &mut World) -> Collected {
    let mut roots: Vec<Entity> = world.query_filtered::<Entity, With<Baked>>().iter(world).collect();
    roots.sort();
    let mut skies: Vec<Entity> = world.query_filtered::<Entity, With<SkyLight>>().iter(world).collect();
    skies.sort();
    let world = &*world;
    let mut collector = Collector::new(world);
    for root in roots {
        if ancestors(world, root).all(|above| !above.contains::<Baked>() && !above.contains::<NotBaked>()) {
            collector.walk(root);
        }
    }
    collector.add_sky(&skies);
    collector.finish()
}

/// What an entity hands down.
#[derive(Clone, Copy)]
struct Inherited {
    density: f32,
    visible: bool,
}

struct Collector<'w> {
    world: &'w World,
    collected: Collected,
    meshes: HashMap<AssetId<Mesh>, Result<usize, &'static str>>,
    materials: HashMap<UntypedAssetId, usize>,
    textures: HashMap<AssetId<Image>, Option<usize>>,
    /// Names of what is left out or changed, by what is said about it.
    notes: Vec<(String, Vec<String>)>,
}

impl<'w> Collector<'w> {
    fn new(world: &'w World) -> Self {
        Self {
            world,
            collected: Collected::default(),
            meshes: HashMap::new(),
            materials: HashMap::new(),
            textures: HashMap::new(),
            notes: Vec::new(),
        }
    }

    /// Visits an entity and everything below it in the order of the hierarchy.
    fn walk(&mut self, root: Entity) {
        let visible = ancestors(self.world, root).find_map(|above| own_visibility(above)).unwrap_or(true);
        let mut stack = vec![(root, Inherited { density: 1.0, visible })];
        while let Some((entity, above)) = stack.pop() {
            let Ok(entity) = self.world.get_entity(entity) else { continue };
            if entity.contains::<NotBaked>() {
                continue;
            }
            let density = entity.get::<Baked>().map_or(above.density, |baked| baked.density);
            let inherited = Inherited { density, visible: own_visibility(entity).unwrap_or(above.visible) };
            let on_default_layer =
                entity.get::<RenderLayers>().is_none_or(|layers| layers.intersects(&RenderLayers::layer(0)));
            if inherited.visible && on_default_layer {
                self.add_surface(entity, density);
                self.add_light(entity);
            }
            let children = entity.get::<Children>().into_iter().flat_map(|children| children.iter().rev());
            stack.extend(children.map(|child| (child, inherited)));
        }
    }

    fn add_surface(&mut self, entity: EntityRef<'w>, density: f32) {
        let (Some(mesh), Some(transform)) = (entity.get::<Mesh3d>(), entity.get::<GlobalTransform>()) else { return };
        let handle = given_mesh(mesh, entity.get());
        let name = surface_name(self.world, entity);
        if !transform.affine().is_finite() {
            return self.note("is left out, because its transform is not finite; correct its `Transform`", name);
        }
        if entity.contains::<SkinnedMesh>() {
            return self.note("is left out, because it is skinned; give it light from a probe", name);
        }
        let known = self.collected.scene.meshes.len();
        let mesh = match self.mesh(handle, &name) {
            Ok(mesh) => mesh,
            Err(reason) => return self.note(&format!("is left out, because it {reason}"), name),
        };
        if let Some(surface) = entity.get::<SplineMesh>().and_then(|made| made.surface_of(handle.id()))
            && mesh == known
        {
            self.collected.scene.curved.push(CurvedMesh { mesh, surface: surface.clone() });
        }
        let (material, lit) = self.material(entity, &name, mesh);
        let receives = lit && density > 0.0;
        self.collected.surfaces.push(entity.id());
        self.collected.scene.surfaces.push(Surface {
            name,
            mesh,
            material,
            transform: transform.affine(),
            receiver: if receives { Receiver::Lightmap { density } } else { Receiver::Nothing },
            casts: !entity.contains::<NotShadowCaster>(),
        });
    }

    /// The index of a mesh in the scene, or why it cannot be there.
    fn mesh(&mut self, handle: &Handle<Mesh>, name: &str) -> Result<usize, &'static str> {
        if let Some(known) = self.meshes.get(&handle.id()) {
            return *known;
        }
        let converted = match self.world.get_resource::<Assets<Mesh>>().and_then(|meshes| meshes.get(handle)) {
            None => Err("is not loaded; wait for its asset before the bake"),
            Some(mesh) if mesh.try_has_morph_targets().unwrap_or(false) => {
                Err("has morph targets; give it light from a probe")
            }
            Some(mesh) if mesh.try_contains_attribute(Mesh::ATTRIBUTE_JOINT_INDEX).unwrap_or(false) => {
                Err("is skinned; give it light from a probe")
            }
            Some(mesh) => convert::mesh(name, mesh),
        };
        let index = converted.map(|mesh| {
            self.collected.scene.meshes.push(mesh);
            self.collected.mesh_handles.push(handle.clone());
            self.collected.scene.meshes.len() - 1
        });
        self.meshes.insert(handle.id(), index);
        index
    }

    /// The index of the material of an entity in the scene, and whether light has a say in how it looks.
    fn material(&mut self, entity: EntityRef<'w>, surface: &str, mesh: usize) -> (usize, bool) {
        let Some(Found { id, name, inputs }) = LOOKUPS.iter().find_map(|lookup| lookup(self.world, entity)) else {
            let note = "has no material that a bake can read; it blocks light as gray and gets no lightmap. Give it a \
                        `StandardMaterial` if it should get one";
            self.note(note, surface.to_owned());
            let gray = radiosity::material::Material {
                name: surface.to_owned(),
                base_color: Vec4::new(0.5, 0.5, 0.5, 1.0),
                ..Default::default()
            };
            self.collected.scene.materials.push(gray);
            return (self.collected.scene.materials.len() - 1, false);
        };
        self.collected.scene.meshes[mesh].uv_1_in_use |= inputs.reads_uv_1;
        if let Some(&known) = self.materials.get(&id) {
            return (known, !inputs.unlit);
        }
        let name = name.unwrap_or_else(|| format!("material of {surface}"));
        if inputs.transmission > 0.0 && inputs.roughness > MATT {
            let note = "is matt glass, which scatters light, and a bake takes it for clear; blend it by alpha instead";
            self.note(note, name.clone());
        }
        let material = convert::material(&name, &inputs, |image| self.texture(image, &name));
        self.collected.scene.materials.push(material);
        self.materials.insert(id, self.collected.scene.materials.len() - 1);
        (self.collected.scene.materials.len() - 1, !inputs.unlit)
    }

    /// The index of a picture in the scene, if it can be read.
    fn texture(&mut self, handle: &Handle<Image>, material: &str) -> Option<usize> {
        if let Some(known) = self.textures.get(&handle.id()) {
            return *known;
        }
        let name = match handle.path() {
            Some(path) => path.to_string(),
            None => format!("texture of {material}"),
        };
        let converted = match self.world.get_resource::<Assets<Image>>().and_then(|images| images.get(handle)) {
            None => Err("is not loaded; wait for its asset before the bake".to_owned()),
            Some(image) => convert::texture(&name, image),
        };
        let index = match converted {
            Ok(texture) => {
                self.collected.scene.textures.push(texture);
                Some(self.collected.scene.textures.len() - 1)
            }
            Err(reason) => {
                self.note(&format!("{reason}. The factor alone is used"), name);
                None
            }
        };
        self.textures.insert(handle.id(), index);
        index
    }

    fn add_light(&mut self, entity: EntityRef<'w>) {
        let Some(transform) = entity.get::<GlobalTransform>() else { return };
        let sources = [
            entity.get::<PointLight>().map(|light| convert::point_light(light, transform)),
            entity.get::<SpotLight>().map(|light| convert::spot_light(light, transform)),
            entity
                .get::<DirectionalLight>()
                .map(|light| convert::directional_light(light, transform, angular_diameter(entity))),
            entity.get::<RectLight>().map(|light| convert::rect_light(light, transform)),
        ];
        for source in sources.into_iter().flatten() {
            let name = name_of(self.world, entity);
            if !convert::is_usable(&source) {
                let note = "is a light that is left out, because its place, direction, size, range or brightness is \
                            negative, not finite or lost to a scale of 0; correct it and the scales above it";
                self.note(note, name);
                continue;
            }
            self.collected.scene.lights.push(Light { name, source });
            self.collected.lights.push(entity.id());
        }
    }

    /// The first of the skies that is to be baked.
    fn add_sky(&mut self, skies: &[Entity]) {
        let world = self.world;
        let mut skies = skies.iter().filter_map(|&entity| world.get_entity(entity).ok());
        let is_baked = |entity: &EntityRef| {
            !entity.contains::<NotBaked>() && ancestors(world, entity.id()).all(|above| !above.contains::<NotBaked>())
        };
        let Some(entity) = skies.find(is_baked) else { return };
        let Some(sky) = entity.get::<SkyLight>() else { return };
        let name = name_of(world, entity);
        for other in skies.filter(is_baked) {
            self.note("is a second sky and left out; remove one of both", name_of(world, other));
        }
        let color = sky.color.to_linear();
        let radiance = Vec3::new(color.red, color.green, color.blue) * sky.brightness;
        if !(radiance.is_finite() && radiance.min_element() >= 0.0 && sky.rotation.is_normalized()) {
            let note = "is a sky that is left out, because its color, brightness or rotation is negative, not finite or \
                        of another length than 1; correct it";
            return self.note(note, name);
        }
        let scene = &mut self.collected.scene;
        let Some(handle) = &sky.image else {
            scene.sky = radiance;
            return;
        };
        let image = match world.get_resource::<Assets<Image>>().and_then(|images| images.get(handle)) {
            None => Err("is not loaded; wait for its asset before the bake".to_owned()),
            Some(image) => convert::sky(image),
        };
        match image {
            Ok(image) => convert::put_sky(scene, image.turned(sky.rotation), radiance, &name),
            Err(reason) => self.note(&format!("is a sky whose image {reason}. It is left out"), name),
        }
    }

    /// Remembers something to say about what has this name.
    fn note(&mut self, note: &str, name: String) {
        match self.notes.iter_mut().find(|(known, _)| known == note) {
            Some((_, names)) => names.push(name),
            None => self.notes.push((note.to_owned(), vec![name])),
        }
    }

    fn finish(mut self) -> Collected {
        for name in short_lights(&self.collected.scene) {
            let note = "is a light whose range ends within the scene, so that it fades to nothing there as it does in \
                        Bevy; give it a larger range (glTF files without one get 20 m)";
            self.note(note, name);
        }
        self.collected.warnings = self.notes.into_iter().map(|(note, names)| sentence(&names, &note)).collect();
        self.collected
    }
}

/// One sentence about one or several things.
fn sentence(names: &[String], note: &str) -> String {
    match names {
        [name] => format!("\"{name}\" {note}"),
        [name, rest @ ..] => format!("\"{name}\" {note} (and {} more like it)", rest.len()),
        [] => note.to_owned(),
    }
}

/// Names of the lights that the window of their range darkens visibly at some place in the scene.
fn short_lights(scene: &Scene) -> Vec<String> {
    let Some((min, max)) = bounds(scene) else { return Vec::new() };
    let cut = |light: &&Light| {
        let (position, intensity, range) = match &light.source {
            LightSource::Point(point) => (point.position, point.intensity, point.range),
            LightSource::Spot(spot) => (spot.point.position, spot.point.intensity, spot.point.range),
            LightSource::Directional(_) | LightSource::Rect(_) => return false,
        };
        // At half the range an eighth is lost; what gives less than a tenth of a lux there is not missed.
        let farthest = (position - min).abs().max((max - position).abs()).length();
        farthest > range / 2.0 && intensity.max_element() > 0.1 * range * range / 4.0
    };
    scene.lights.iter().filter(cut).map(|light| light.name.clone()).collect()
}

/// The smallest and largest coordinates of all surfaces that get a lightmap.
fn bounds(scene: &Scene) -> Option<(Vec3, Vec3)> {
    let lit = scene.surfaces.iter().filter(|surface| surface.receiver != Receiver::Nothing);
    let points = lit.flat_map(|surface| {
        let positions = &scene.meshes[surface.mesh].positions;
        positions.iter().map(|&position| surface.transform.transform_point3(position))
    });
    let points = points.filter(|point| point.is_finite());
    points.fold(None, |bounds, point| {
        let (min, max) = bounds.unwrap_or((point, point));
        Some((min.min(point), max.max(point)))
    })
}

fn angular_diameter(entity: EntityRef) -> f32 {
    match (entity.get::<AngularDiameter>(), entity.get::<SunDisk>()) {
        (Some(AngularDiameter(angle)), _) => *angle,
        (None, Some(disk)) => disk.angular_size,
        (None, None) => SUN_DIAMETER,
    }
}

/// Whether an entity says on its own that it is visible.
fn own_visibility(entity: EntityRef) -> Option<bool> {
    match entity.get::<Visibility>()? {
        Visibility::Hidden => Some(false),
        Visibility::Visible => Some(true),
        Visibility::Inherited => None,
    }
}

/// The entities above one, from the nearest on.
fn ancestors(world: &World, entity: Entity) -> impl Iterator<Item = EntityRef<'_>> {
    let parent = move |entity: EntityRef| world.get_entity(entity.get::<ChildOf>()?.parent()).ok();
    std::iter::successors(world.get_entity(entity).ok(), move |&entity| parent(entity)).skip(1)
}

/// The name of a surface: a primitive of a glTF file goes by the name of its node.
fn surface_name(world: &World, entity: EntityRef) -> String {
    let node = entity.get::<GltfSource>().and_then(|_| ancestors(world, entity.id()).next());
    name_of(world, node.unwrap_or(entity))
}

/// The name of an entity or of the nearest one above it that has one, else its number.
fn name_of(world: &World, entity: EntityRef) -> String {
    let above = || ancestors(world, entity.id()).find_map(|above| above.get::<Name>());
    match entity.get::<Name>().or_else(above) {
        Some(name) => name.to_string(),
        None => format!("entity {}", entity.id()),
    }
}
