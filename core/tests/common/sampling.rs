//! Random points of surfaces, and lightmaps sampled there by both kernels that a GPU has.

use glam::{Vec2, Vec3};
use radiosity::bake::Bake;
use radiosity::geometry::Sobol;
use radiosity::lightmap::LightmapImage;
use radiosity::scene::Scene;

/// A point of a surface, and where its light is found.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub surface: usize,
    pub position: Vec3,
    pub image: usize,
    /// In texels; (0.5, 0.5) is the center of the first.
    pub at: Vec2,
}

/// How a GPU looks a lightmap up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    Bilinear,
    /// The cubic B-spline over 4 x 4 texels, as Bevy has it.
    Bicubic,
}

pub const KERNELS: [Kernel; 2] = [Kernel::Bilinear, Kernel::Bicubic];

impl Kernel {
    /// How far from a texel's center its light is seen, in texels.
    pub fn reach(self) -> f32 {
        match self {
            Self::Bilinear => 1.0,
            Self::Bicubic => 2.0,
        }
    }

    /// The texels that a place in an image takes from, each with its weight.
    pub fn taps(self, image: &LightmapImage, at: Vec2) -> Vec<(usize, f32)> {
        let along = |axis: usize, size: u32| {
            let place = at[axis] - 0.5;
            let (low, share) = (place.floor(), place - place.floor());
            let clamp = |offset: i32| (low as i32 + offset).clamp(0, size as i32 - 1) as usize;
            let t = share;
            match self {
                Self::Bilinear => vec![(clamp(0), 1.0 - t), (clamp(1), t)],
                Self::Bicubic => {
                    let outer = |t: f32| t * t * t / 6.0;
                    let inner = |t: f32| (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
                    [(-1, outer(1.0 - t)), (0, inner(t)), (1, inner(1.0 - t)), (2, outer(t))]
                        .map(|(offset, weight)| (clamp(offset), weight))
                        .to_vec()
                }
            }
        };
        let columns = along(0, image.width);
        let rows = along(1, image.height);
        let row = |&(y, weight): &(usize, f32)| {
            columns.iter().map(move |&(x, share)| (y * image.width as usize + x, weight * share)).collect::<Vec<_>>()
        };
        rows.iter().flat_map(row).collect()
    }

    /// The light there.
    pub fn sample(self, bake: &Bake, sample: &Sample) -> Vec3 {
        let image = &bake.images[sample.image];
        self.taps(image, sample.at).into_iter().map(|(texel, weight)| image.texels[texel] * weight).sum()
    }
}

/// `count` points of each triangle of all surfaces with a lightmap.
pub fn samples<'a>(scene: &'a Scene, bake: &'a Bake, count: u32) -> impl Iterator<Item = Sample> + 'a {
    scene.surfaces.iter().enumerate().flat_map(move |(index, surface)| {
        let uv = bake.uvs[surface.mesh].as_ref();
        let triangles = bake.placements[index].map_or(&[][..], |_| uv.map_or(&[][..], |uv| &uv.triangles[..]));
        triangles.iter().enumerate().flat_map(move |(triangle, vertices)| {
            let sequence = Sobol::new(triangle as u32);
            (0..count).map(move |k| {
                let Vec2 { x, y } = sequence.square(k);
                let [v, w] = if x + y > 1.0 { [1.0 - x, 1.0 - y] } else { [x, y] };
                sample(scene, bake, index, vertices, [1.0 - v - w, v, w])
            })
        })
    })
}

fn sample(scene: &Scene, bake: &Bake, surface: usize, vertices: &[u32; 3], weights: [f32; 3]) -> Sample {
    let placed = &scene.surfaces[surface];
    let (placement, uv) = (bake.placements[surface].unwrap(), bake.uvs[placed.mesh].as_ref().unwrap());
    let (mut position, mut at) = (Vec3::ZERO, Vec2::ZERO);
    for (&vertex, weight) in vertices.iter().zip(weights) {
        let source = uv.sources[vertex as usize] as usize;
        position += placed.transform.transform_point3(scene.meshes[placed.mesh].positions[source]) * weight;
        at += uv.uv_1[vertex as usize] * weight;
    }
    let image = &bake.images[placement.image];
    let size = Vec2::new(image.width as f32, image.height as f32);
    let at = (placement.min + at * (placement.max - placement.min)) * size;
    Sample { surface, position, image: placement.image, at }
}
