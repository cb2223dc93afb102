//! Scenes made in code, and lightmaps looked up as a GPU does.

use glam::{Affine3A, Vec2, Vec3};
use radiosity::bake::{Bake, BakeSettings, Quality, bake};
use radiosity::geometry::Mesh;
use radiosity::lightmap::{LayoutSettings, Resolution};
use radiosity::material::Material;
use radiosity::progress::Progress;
use radiosity::scene::{Receiver, Scene, Surface};

/// Settings with so many texels per meter.
pub fn settings(texels_per_meter: f32, quality: Quality) -> BakeSettings {
    let resolution = Resolution::TexelsPerMeter(texels_per_meter);
    BakeSettings { layout: LayoutSettings { resolution, ..LayoutSettings::default() }, quality, ..Default::default() }
}

/// A bake that succeeds.
pub fn baked(scene: &Scene, settings: &BakeSettings) -> Bake {
    bake(scene, settings, &Progress::default()).unwrap()
}

/// A diffuse material of one grey.
pub fn grey(reflectance: f32, emission: f32) -> Material {
    Material { base_color: Vec3::splat(reflectance).extend(1.0), emissive: Vec3::splat(emission), ..Default::default() }
}

/// Adds a quadrilateral, counter-clockwise seen from its front, and returns the index of its surface.
pub fn add_quad(scene: &mut Scene, name: &str, corners: [[f32; 3]; 4], material: usize) -> usize {
    let positions = corners.map(Vec3::from_array).to_vec();
    let mesh = Mesh { name: name.into(), positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Default::default() };
    add_mesh(scene, mesh, material)
}

/// Adds a mesh at its place and returns the index of its surface.
pub fn add_mesh(scene: &mut Scene, mesh: Mesh, material: usize) -> usize {
    scene.surfaces.push(Surface {
        name: mesh.name.clone(),
        mesh: scene.meshes.len(),
        material,
        transform: Affine3A::IDENTITY,
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    });
    scene.meshes.push(mesh);
    scene.surfaces.len() - 1
}

/// Adds the six sides of a box between two corners; their fronts look inside, or outside.
pub fn add_box(scene: &mut Scene, name: &str, low: [f32; 3], high: [f32; 3], material: usize, inside: bool) {
    let [[a, b, c], [d, e, f]] = [low, high];
    let sides = [
        [[a, b, c], [a, b, f], [d, b, f], [d, b, c]],
        [[a, e, c], [d, e, c], [d, e, f], [a, e, f]],
        [[a, b, c], [a, e, c], [a, e, f], [a, b, f]],
        [[d, b, c], [d, b, f], [d, e, f], [d, e, c]],
        [[a, b, c], [d, b, c], [d, e, c], [a, e, c]],
        [[a, b, f], [a, e, f], [d, e, f], [d, b, f]],
    ];
    for (side, mut corners) in sides.into_iter().enumerate() {
        if !inside {
            corners.reverse();
        }
        add_quad(scene, &format!("{name} {side}"), corners, material);
    }
}

/// A closed room of one material.
pub fn room(low: [f32; 3], high: [f32; 3], material: Material) -> Scene {
    let mut scene = Scene { materials: vec![material], ..Default::default() };
    add_box(&mut scene, "room", low, high, 0, true);
    scene
}

/// The lightmap at a point of a surface that faces this way, bilinear as a GPU samples it.
pub fn lookup(scene: &Scene, bake: &Bake, point: Vec3, normal: Vec3) -> Vec3 {
    let extent =
        scene.meshes.iter().flat_map(|mesh| &mesh.positions).fold(0.0_f32, |m, p| m.max(p.abs().max_element()));
    for (index, surface) in scene.surfaces.iter().enumerate() {
        let (Some(placement), Some(uv)) = (bake.placements[index], &bake.uvs[surface.mesh]) else { continue };
        for triangle in &uv.triangles {
            let corners = triangle.map(|vertex| {
                let position = scene.meshes[surface.mesh].positions[uv.sources[vertex as usize] as usize];
                surface.transform.transform_point3(position)
            });
            let Some([v, w]) = weights(corners, point, normal, extent) else { continue };
            let [a, b, c] = triangle.map(|vertex| uv.uv_1[vertex as usize]);
            let uv = placement.min + (a * (1.0 - v - w) + b * v + c * w) * (placement.max - placement.min);
            return bilinear(bake, placement.image, uv);
        }
    }
    panic!("no surface at {point}");
}

/// Weights of the second and third corner if the point lies on the triangle.
fn weights([a, b, c]: [Vec3; 3], point: Vec3, normal: Vec3, extent: f32) -> Option<[f32; 2]> {
    let cross = (b - a).cross(c - a);
    let squared = cross.length_squared();
    let is_near = (point - a).dot(cross.normalize_or_zero()).abs() < 1e-4 * extent;
    if squared == 0.0 || !is_near || cross.normalize().dot(normal) < 0.99 {
        return None;
    }
    let v = (point - a).cross(c - a).dot(cross) / squared;
    let w = (b - a).cross(point - a).dot(cross) / squared;
    (v >= -1e-4 && w >= -1e-4 && v + w <= 1.0 + 1e-4).then_some([v, w])
}

/// The light of an image, as a GPU samples it.
pub fn bilinear(bake: &Bake, image: usize, uv: Vec2) -> Vec3 {
    let image = &bake.images[image];
    let size = Vec2::new(image.width as f32, image.height as f32);
    let at = (uv * size - 0.5).clamp(Vec2::ZERO, size - 1.0);
    let (low, share) = (at.floor(), at.fract());
    let high = (low + 1.0).min(size - 1.0);
    let texel = |x: f32, y: f32| image.texels[y as usize * image.width as usize + x as usize];
    let top = texel(low.x, low.y).lerp(texel(high.x, low.y), share.x);
    let bottom = texel(low.x, high.y).lerp(texel(high.x, high.y), share.x);
    top.lerp(bottom, share.y)
}

/// All finished texels that hold light of their own.
pub fn valid_texels(bake: &Bake) -> impl Iterator<Item = Vec3> + '_ {
    bake.images.iter().flat_map(|image| {
        let valid = |state: &radiosity::lightmap::TexelState| *state == radiosity::lightmap::TexelState::Valid;
        image.texels.iter().zip(&image.states).filter(move |(_, state)| valid(state)).map(|(texel, _)| *texel)
    })
}
