//! The picture of a baked scene.

use alloc::vec::Vec;

use glam::{DVec3, Vec2, Vec3};

use super::view::{View, lightmap_place};
use super::{Camera, automatic_ev100, exposure, khronos_pbr_neutral, valid_texels};
use crate::bake::Bake;
use crate::geometry::{Hit, Ray};
use crate::lightmap::LightmapImage;
use crate::material::linear_to_srgb;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;

/// Rays for each pixel, in each direction and in all.
const SIDE: u32 = 4;
const SAMPLES: u32 = SIDE * SIDE;

/// Transparent layers and mirrors by way of which a ray sees at most.
const LAYERS: usize = 64;

/// A picture, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    /// `width x height` pixels in sRGB.
    pub rgb: Vec<[u8; 3]>,
    /// The exposure it was taken with.
    pub ev100: f32,
}

/// The baked scene as `camera` sees it: what its surfaces emit, and what they reflect of the light in their lightmaps.
///
/// One-sided surfaces are not seen from behind. A surface without a lightmap is lit by the mean of all texels. Where
/// `ev100` is `None`, [`automatic_ev100`] chooses it. Tone mapping is [`khronos_pbr_neutral`].
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn preview(
    scene: &Scene,
    bake: &Bake,
    camera: &Camera,
    [width, height]: [u32; 2],
    ev100: Option<f32>,
    progress: &Progress,
) -> Result<Preview, Cancelled> {
    let ev100 = ev100.unwrap_or_else(|| automatic_ev100(&bake.images));
    let exposure = exposure(ev100);
    let rgb = Picture::new(scene, bake, camera, [width, height]).pixels(progress, |samples| {
        let mean = samples.map(|radiance| khronos_pbr_neutral(radiance * exposure)).sum::<Vec3>() / SAMPLES as f32;
        mean.to_array().map(linear_to_srgb)
    })?;
    Ok(Preview { rgb, ev100 })
}

/// What [`preview`] shows, before exposure and tone mapping: radiance in cd/m2, row by row from the top.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn lightmapped(
    scene: &Scene,
    bake: &Bake,
    camera: &Camera,
    size: [u32; 2],
    progress: &Progress,
) -> Result<Vec<Vec3>, Cancelled> {
    Picture::new(scene, bake, camera, size).pixels(progress, |samples| samples.sum::<Vec3>() / SAMPLES as f32)
}

/// Everything that a pixel depends on.
struct Picture<'a> {
    view: View<'a>,
    bake: &'a Bake,
    /// Light on surfaces that have no lightmap.
    mean: Vec3,
    camera: &'a Camera,
    size: [u32; 2],
}

impl<'a> Picture<'a> {
    fn new(scene: &'a Scene, bake: &'a Bake, camera: &'a Camera, size: [u32; 2]) -> Self {
        Self { view: View::new(scene), bake, mean: mean_texel(&bake.images), camera, size }
    }

    /// All pixels, row by row, each made of its samples: edges at lamps stay smooth where these are tone mapped one by one.
    fn pixels<T: Send>(
        &self,
        progress: &Progress,
        pixel: impl Fn(&mut dyn Iterator<Item = Vec3>) -> T + Sync,
    ) -> Result<Vec<T>, Cancelled> {
        let [width, height] = self.size;
        let row = |y: usize| (0..width).map(|x| pixel(&mut self.samples(x, y as u32))).collect::<Vec<T>>();
        let workers = Workers::new(self.bake.report.threads);
        let rows = workers.map(height as usize, 1, progress, |rows| rows.map(row).collect())?;
        Ok(rows.into_iter().flatten().collect())
    }

    /// The radiance along a grid of rays.
    fn samples(&self, x: u32, y: u32) -> impl Iterator<Item = Vec3> {
        let size = Vec2::from(self.size.map(|side| side as f32));
        (0..SAMPLES).map(move |sample| {
            let within = (Vec2::new((sample % SIDE) as f32, (sample / SIDE) as f32) + 0.5) / SIDE as f32;
            let point = (Vec2::new(x as f32, y as f32) + within) / size;
            self.radiance(&self.camera.ray(point, size.x / size.y))
        })
    }

    /// What arrives along a ray, through all transparent layers and by way of mirrors.
    fn radiance(&self, ray: &Ray) -> Vec3 {
        let (mut ray, mut last) = (*ray, None);
        let (mut arrived, mut left) = (Vec3::ZERO, Vec3::ONE);
        for _ in 0..LAYERS {
            let Some(hit) = self.view.nearest(&ray, last.as_ref()) else {
                return arrived + left * self.view.scene.sky_radiance(ray.direction);
            };
            if let Some(tint) = self.view.mirror(&hit) {
                left *= tint;
                (ray, last) = (self.view.reflected(&ray, &hit), None);
                continue;
            }
            let reflected = self.view.reflectance(&hit) * self.baked_texel(&hit).unwrap_or(self.mean);
            arrived += left * (reflected + self.view.emission(&hit)) * self.view.opacity(&hit);
            left *= self.view.shows_behind(&hit);
            if left == Vec3::ZERO {
                break;
            }
            last = Some(hit);
        }
        arrived
    }

    /// Irradiance / pi from the lightmap of a surface, if it has one.
    fn baked_texel(&self, hit: &Hit) -> Option<Vec3> {
        let (image, uv) = lightmap_place(&self.view, self.bake, hit)?;
        Some(bilinear(self.bake.images.get(image)?, uv))
    }
}

/// Mixes the four texels around `uv` as graphics hardware does.
pub(super) fn bilinear(image: &LightmapImage, uv: Vec2) -> Vec3 {
    let size = Vec2::new(image.width as f32, image.height as f32);
    let position = uv * size - 0.5;
    let corner = position.floor();
    let share = position - corner;
    let texel = |x: i32, y: i32| {
        let column = x.clamp(0, image.width as i32 - 1) as usize;
        let row = y.clamp(0, image.height as i32 - 1) as usize;
        image.texels[row * image.width as usize + column]
    };
    let (x, y) = (corner.x as i32, corner.y as i32);
    let row = |y| texel(x, y).lerp(texel(x + 1, y), share.x);
    row(y).lerp(row(y + 1), share.y)
}

/// Zero where there is none.
fn mean_texel(images: &[LightmapImage]) -> Vec3 {
    let sum: DVec3 = valid_texels(images).map(Vec3::as_dvec3).sum();
    (sum / valid_texels(images).count().max(1) as f64).as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Mesh;
    use crate::lightmap::{LightmapUv, Placement, TexelState, UvOrigin};
    use crate::material::{AlphaMode, Material};
    use crate::scene::{Receiver, Surface};
    use alloc::vec;
    use glam::{Affine3A, Vec4};

    /// Counter-clockwise seen from `+z`, with `v` down.
    const CORNERS: [Vec2; 4] = [Vec2::NEG_ONE, Vec2::new(1.0, -1.0), Vec2::ONE, Vec2::new(-1.0, 1.0)];

    /// A square of 2 m around `(0, 0, z)` that faces `+z`.
    fn add_square(scene: &mut Scene, z: f32, material: Material) {
        let positions = CORNERS.map(|corner| corner.extend(z)).into();
        scene.surfaces.push(Surface {
            name: Default::default(),
            mesh: scene.meshes.len(),
            material: scene.materials.len(),
            transform: Affine3A::IDENTITY,
            receiver: Receiver::Lightmap { density: 1.0 },
            casts: true,
        });
        scene.meshes.push(Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Default::default() });
        scene.materials.push(material);
    }

    fn square(material: Material) -> Scene {
        let mut scene = Scene::default();
        add_square(&mut scene, 0.0, material);
        scene
    }

    /// The first square of a scene has the right half of an image of 8 x 4 texels; nothing else has a lightmap.
    fn bake(texel: impl Fn(u32) -> Vec3) -> Bake {
        let image = LightmapImage {
            width: 8,
            height: 4,
            texels: (0..32).map(|i| texel(i % 8)).collect(),
            states: vec![TexelState::Valid; 32],
            ..Default::default()
        };
        let uv = LightmapUv {
            origin: UvOrigin::Unwrapped,
            sources: vec![0, 1, 2, 3],
            uv_1: CORNERS.map(|corner| Vec2::new(0.5 + 0.5 * corner.x, 0.5 - 0.5 * corner.y)).into(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        };
        let placement = Placement { image: 0, min: Vec2::new(0.5, 0.0), max: Vec2::ONE };
        Bake { images: vec![image], uvs: vec![Some(uv)], placements: vec![Some(placement)], ..Default::default() }
    }

    /// A picture of 4 x 4 pixels that the first square just fills.
    fn take(scene: &Scene, bake: &Bake, ev100: Option<f32>) -> Preview {
        let camera = Camera::looking_at(Vec3::new(0.0, 0.0, 2.0), Vec3::ZERO, 2.0 * 0.5_f32.atan());
        preview(scene, bake, &camera, [4, 4], ev100, &Progress::with_clock(|| 0.0)).unwrap()
    }

    /// The EV100 whose exposure is 1.
    fn unit_ev100() -> f32 {
        -1.2_f32.log2()
    }

    /// What a gray of the linear range looks like: `x - 0.04`, then sRGB.
    fn shown(gray: f32) -> u8 {
        linear_to_srgb(gray - 0.04)
    }

    #[test]
    fn a_texel_gives_the_pixel_that_the_formulas_say() {
        let base_color = Vec4::new(0.5, 0.5, 0.5, 1.0);
        let scene = square(Material { base_color, emissive: Vec3::splat(0.1), ..Default::default() });
        let preview = take(&scene, &bake(|_| Vec3::splat(0.8)), Some(unit_ev100()));
        assert_eq!(preview.rgb, vec![[shown(0.5); 3]; 16]);
    }

    #[test]
    fn automatic_exposure_shows_a_white_wall_brighter_than_middle_gray() {
        let preview = take(&square(Material::default()), &bake(|_| Vec3::splat(321.0)), None);
        assert_eq!(preview.rgb, vec![[shown(0.36); 3]; 16]);
    }

    /// Texels 4 to 7 hold 4/16 to 7/16: linear along the picture between their centers, one pixel for each texel.
    #[test]
    fn texels_are_mixed_bilinearly() {
        let preview = take(&square(Material::default()), &bake(|x| Vec3::splat(x as f32 / 16.0)), Some(unit_ev100()));
        assert_eq!(preview.rgb[5], [shown(5.0 / 16.0); 3]);
        assert_eq!(preview.rgb[6], [shown(6.0 / 16.0); 3]);
    }

    #[test]
    fn a_mirrored_surface_shows_its_lightmap_mirrored() {
        let mut scene = square(Material::default());
        scene.surfaces[0].transform = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
        let preview = take(&scene, &bake(|x| Vec3::splat(x as f32 / 16.0)), Some(unit_ev100()));
        assert_eq!(preview.rgb[5], [shown(6.0 / 16.0); 3]);
        assert_eq!(preview.rgb[6], [shown(5.0 / 16.0); 3]);
    }

    #[test]
    fn one_sided_surfaces_are_not_seen_from_behind() {
        let mut scene = square(Material { double_sided: true, ..Default::default() });
        scene.sky = Vec3::splat(0.3);
        let bake = bake(|_| Vec3::splat(0.6));
        let turn = Affine3A::from_rotation_y(core::f32::consts::PI);
        let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
        for (double_sided, transform, gray) in [
            (false, Affine3A::IDENTITY, 0.6),
            (false, mirror, 0.6),
            (false, turn, 0.3),
            (false, turn * mirror, 0.3),
            (true, turn, 0.6),
        ] {
            scene.materials[0].double_sided = double_sided;
            scene.surfaces[0].transform = transform;
            assert_eq!(take(&scene, &bake, Some(unit_ev100())).rgb[5], [shown(gray); 3]);
        }
    }

    /// In front of a wall of 0.6 stands one that emits 0.4 and blocks a quarter; one lamp lies behind everything.
    #[test]
    fn blended_layers_cover_their_share() {
        let mut scene = square(Material::default());
        let pane = Material {
            base_color: Vec4::new(0.0, 0.0, 0.0, 0.25),
            emissive: Vec3::splat(0.4),
            alpha: AlphaMode::Blend,
            ..Default::default()
        };
        add_square(&mut scene, 0.5, pane);
        add_square(&mut scene, -0.5, Material { emissive: Vec3::splat(1e3), ..Default::default() });
        let pixel = |scene: &Scene| take(scene, &bake(|_| Vec3::splat(0.6)), Some(unit_ev100())).rgb[5];
        assert_eq!(pixel(&scene), [shown(0.25 * 0.4 + 0.75 * 0.6); 3]);
        scene.materials[1].alpha = AlphaMode::Mask(0.5);
        assert_eq!(pixel(&scene), [shown(0.6); 3]);
        scene.materials[1].alpha = AlphaMode::Mask(0.25);
        assert_eq!(pixel(&scene), [shown(0.4); 3]);
    }

    #[test]
    fn surfaces_without_lightmap_are_lit_by_the_mean() {
        let scene = square(Material::default());
        let bake = Bake { placements: vec![None], ..bake(|x| Vec3::splat(if x < 4 { 0.2 } else { 0.6 })) };
        assert_eq!(take(&scene, &bake, Some(unit_ev100())).rgb, vec![[shown(0.4); 3]; 16]);
    }
}
