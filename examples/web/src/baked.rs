//! The lightmaps of the box: the whole bake, with rests between its rays, and other lamps without a ray.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};
use radiosity::bake::{BakeError, BakeSettings, Keep, Quality, bake_into};
use radiosity::geometry::{Ray, RayKind, RayLog};
use radiosity::lightmap::{LayoutSettings, LightmapUv, Placement, Resolution, UvMode};
use radiosity::progress::Progress;
use radiosity::scene::Scene;
use radiosity::transport::{Lighting, Relighter};

use crate::view::{color, see};

/// Texels per meter: the box is half a meter wide.
const DENSITY: f32 = 40.0;

/// Lightmaps, the transport that they came from, and a picture of them.
pub struct Baked {
    scene: Scene,
    relighter: Relighter<'static>,
    progress: Progress,
    images: Vec<Vec<Vec3>>,
    /// Color of the lamp, as shares of its usual radiance.
    lamp: Vec3,
    seen: Vec<Option<Seen>>,
    pixels: Vec<u8>,
}

/// What stands in a pixel.
#[derive(Clone, Copy)]
struct Seen {
    material: u32,
    image: u32,
    /// Texels in a row of the image.
    width: u32,
    /// In texels, from the center of the first one.
    place: Vec2,
}

/// Calls a function before each ray: a page lets the bake rest there.
struct Rests<F>(F);

impl<F: Fn() + Sync> RayLog for Rests<F> {
    fn record(&self, _: &Ray, _: RayKind) {
        self.0();
    }
}

impl Baked {
    /// Bakes the box, for a square picture with `side` pixels a side; `rest` is called before each ray and each stage.
    ///
    /// The transport is never freed: it lives as long as the page.
    ///
    /// # Errors
    ///
    /// See [`bake_into`].
    pub fn new(side: u32, rest: impl Fn() + Clone + Send + Sync + 'static) -> Result<Self, BakeError> {
        let scene = small_bake::scene();
        let layout =
            LayoutSettings { resolution: Resolution::TexelsPerMeter(DENSITY), uv: UvMode::Keep, ..Default::default() };
        let settings = BakeSettings { layout, quality: Quality::Medium, keep: Keep::Transport, ..Default::default() };
        let between_stages = rest.clone();
        let progress = Progress::with_clock(move || {
            between_stages();
            0.0
        });
        let mut images = vec![];
        let bake = bake_into(&scene, &settings, &progress, Some(&Rests(rest)), &mut |index, image| {
            images.push((index, image));
            Ok(())
        })?;
        images.sort_by_key(|&(index, _)| index);
        let sizes: Vec<[u32; 2]> = images.iter().map(|(_, image)| [image.width, image.height]).collect();
        Ok(Self {
            seen: seen(&scene, &bake.placements, &bake.uvs, &sizes, side),
            images: images.into_iter().map(|(_, image)| image.texels).collect(),
            relighter: Relighter::new(Box::leak(Box::new(bake.transport.unwrap_or_default())), 1),
            pixels: vec![255; 4 * (side * side) as usize],
            lamp: Vec3::ONE,
            scene,
            progress,
        })
    }

    /// The lamp in another color, as shares of its usual radiance. No ray is traced.
    pub fn relight(&mut self, lamp: Vec3) {
        self.lamp = lamp;
        let mut lighting = Lighting::from(&self.scene);
        lighting.materials.iter_mut().for_each(|material| material.emissive *= lamp);
        // The lighting is that of this scene, and nobody cancels.
        if let Ok(relit) = self.relighter.relight(&lighting, &self.progress) {
            self.images = relit.images;
        }
    }

    /// The picture as it is now, four bytes a pixel.
    pub fn draw(&mut self) -> &[u8] {
        let Self { scene, images, lamp, seen, pixels, .. } = self;
        for (pixel, seen) in pixels.chunks_exact_mut(4).zip(seen) {
            let radiance = seen.map_or(Vec3::ZERO, |seen| {
                let material = &scene.materials[seen.material as usize];
                let light = bilinear(&images[seen.image as usize], &seen);
                material.base_color.truncate() * light + material.emissive * *lamp
            });
            pixel[..3].copy_from_slice(&color(radiance));
        }
        pixels
    }
}

/// For each pixel the place in the lightmaps that it shows. Nothing where the picture is too large.
fn seen(
    scene: &Scene,
    placements: &[Option<Placement>],
    uvs: &[Option<LightmapUv>],
    sizes: &[[u32; 2]],
    side: u32,
) -> Vec<Option<Seen>> {
    let mut seen = vec![None; side as usize * side as usize];
    let things = scene.surfaces.iter().zip(placements).flat_map(|(surface, placement)| {
        let (mesh, uv, placement) = (&scene.meshes[surface.mesh], uvs[surface.mesh].as_ref(), placement.as_ref());
        uv.zip(placement).into_iter().flat_map(move |(uv, placement)| {
            mesh.triangles.iter().zip(&uv.triangles).map(move |(corners, places)| {
                let size = Vec2::from(sizes[placement.image].map(|side| side as f32));
                let place = |vertex: u32| {
                    (placement.min + uv.uv_1[vertex as usize] * (placement.max - placement.min)) * size - 0.5
                };
                let name = (surface.material as u32, placement.image, places.map(place));
                (name, corners.map(|vertex| mesh.positions[vertex as usize]))
            })
        })
    });
    let drawn = see(side, things, |(material, image, [a, b, c]), fragment| {
        let weights = fragment.weights;
        let place = a * weights.x + b * weights.y + c * weights.z;
        seen[fragment.pixel] = Some(Seen { material, image: image as u32, width: sizes[image][0], place });
    });
    if drawn.is_err() { vec![] } else { seen }
}

/// Mixes the four texels around a place, which lies within the gutters.
fn bilinear(texels: &[Vec3], seen: &Seen) -> Vec3 {
    let [column, row] = seen.place.max(Vec2::ZERO).to_array().map(|place| place as u32);
    let share = seen.place - Vec2::new(column as f32, row as f32);
    let texel = |x: u32, y: u32| texels.get((y * seen.width + x) as usize).copied().unwrap_or_default();
    let upper = texel(column, row).lerp(texel(column + 1, row), share.x);
    upper.lerp(texel(column, row + 1).lerp(texel(column + 1, row + 1), share.x), share.y)
}
