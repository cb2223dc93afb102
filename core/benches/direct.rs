//! Direct light from 1 to 10 000 lamps in a hall with pillars, as a table: time for each texel, rays, error against all
//! lamps asked one by one, and the error that direct light claims.
//!
//! The lamps hang in a grid below the ceiling, share the same power and reach any distance.

use std::f32::consts::PI;
use std::time::Instant;

use glam::{Affine3A, Vec2, Vec3};
use radiosity::geometry::{Mesh, Occluders, tree};
use radiosity::light::{DirectLight, Lamps, LightSource, PointLight};
use radiosity::lightmap::{Blocks, Direct, DirectTexel, LayoutSettings, Resolution, ShadowRays, Texels, check, layout};
use radiosity::material::Material;
use radiosity::parallel::Workers;
use radiosity::progress::Progress;
use radiosity::scene::{Receiver, Scene, Surface, World};
use radiosity::transport::Tracer;

const RAYS: ShadowRays = ShadowRays { first: 16, sharp: 1, most: 256, noise: 0.02 };
/// The side of the hall in meters.
const SIDE: f32 = 40.0;
/// One of so many texels is compared with the truth.
const COMPARED: usize = 61;

fn main() {
    let scene = hall();
    let (progress, workers) = (Progress::default(), Workers::new(1));
    let resolution = Resolution::TexelsPerMeter(4.0);
    let layout = layout(&scene, &LayoutSettings { resolution, ..Default::default() }, &progress).expect("it fits");
    let world = World::new(&scene);
    let tracer = Tracer::new(&world, tree(world.corners.clone()));
    let mut texels = Texels::new(&world, &layout, 0..layout.images.len(), &progress).expect("nobody cancels");
    let is_valid = check(&mut texels, &tracer, &workers, 1, &progress).expect("nobody cancels");
    println!("| lamps | us a texel | rays a texel | rms error | claimed |\n|---|---|---|---|---|");
    for count in [1, 10, 100, 1_000, 10_000] {
        let lights: Vec<DirectLight> = lights(count).iter().map(DirectLight::from).collect();
        let lamps = Lamps::new(lights.iter().map(|light| (light, Vec3::ONE)).collect());
        let direct = Direct {
            texels: &texels,
            blocks: &Blocks::new(&texels),
            is_valid: &is_valid,
            tracer: &tracer,
            rays: RAYS,
            seed: 1,
        };
        tracer.take_count();
        let start = Instant::now();
        let light = direct.light(&lamps, &workers, &progress).expect("nobody cancels");
        let seconds = start.elapsed().as_secs_f64();
        let valid = is_valid.iter().filter(|&&is_valid| is_valid).count() as f64;
        let rays = tracer.take_count() as f64;
        let [error, claimed] = errors(&texels, &is_valid, &tracer, &lamps, &light);
        println!(
            "| {count} | {:.2} | {:.1} | {:.2} % | {:.2} % |",
            1e6 * seconds / valid,
            rays / valid,
            100.0 * error,
            100.0 * claimed
        );
    }
}

/// Rms of the error and of what is claimed, relative to the light and a tenth of its mean.
fn errors<O: Occluders>(
    texels: &Texels,
    is_valid: &[bool],
    tracer: &Tracer<O>,
    lamps: &Lamps,
    light: &[DirectTexel],
) -> [f64; 2] {
    let level = |light: Vec3| f64::from(light.element_sum() / 3.0);
    let compared: Vec<usize> = (0..light.len()).step_by(COMPARED).filter(|&index| is_valid[index]).collect();
    let truth = |&index: &usize| {
        let texel = &texels.list[index];
        let flat = tracer.world.normals[texel.triangle as usize];
        let of_lamp = |lamp: u32| {
            let irradiance = lamps.irradiance(lamp, texel.position, texel.normal);
            let ray = lamps.light(lamp).shadow_ray(Vec2::splat(0.5), texel.position, texel.normal);
            let is_lit = irradiance != Vec3::ZERO && ray.direction.dot(flat) > 0.0;
            let ray = tracer.leave_for(texel.triangle, texel.position, flat, &ray);
            if is_lit { irradiance * tracer.visibility(&ray) } else { Vec3::ZERO }
        };
        level((0..lamps.len() as u32).map(of_lamp).sum::<Vec3>() / PI)
    };
    let truths: Vec<f64> = compared.iter().map(truth).collect();
    let mean = truths.iter().sum::<f64>() / truths.len() as f64;
    let mut sums = [0.0; 2];
    for (&index, truth) in compared.iter().zip(&truths) {
        let scale = (truth + 0.1 * mean).powi(2) * truths.len() as f64;
        sums[0] += (level(light[index].irradiance) - truth).powi(2) / scale;
        sums[1] += f64::from(light[index].error.noise) / scale;
    }
    sums.map(f64::sqrt)
}

/// So many lamps in a grid that fills the hall, with the same power together.
fn lights(count: usize) -> Vec<LightSource> {
    let columns = (count as f64).sqrt().ceil() as usize;
    let place = |k: usize| (k as f32 + 0.37) / columns as f32 * SIDE;
    let light = |k: usize| PointLight {
        position: Vec3::new(place(k % columns), 3.8, place(k / columns)),
        intensity: Vec3::splat(1e4 / count as f32),
        range: f32::INFINITY,
        radius: 0.0,
    };
    (0..count).map(|k| LightSource::Point(light(k))).collect()
}

/// A floor, a ceiling, four outer walls, inner walls with doors, and a grid of pillars.
fn hall() -> Scene {
    let mut scene = Scene { materials: vec![Material::default()], ..Default::default() };
    add_box(&mut scene, Vec3::ZERO, Vec3::new(SIDE, 4.0, SIDE), -1.0);
    for k in 0..64 {
        let low = Vec3::new((k % 8) as f32 * 5.0 + 2.3, 0.0, (k / 8) as f32 * 5.0 + 2.3);
        add_box(&mut scene, low, low + Vec3::new(0.4, 4.0, 0.4), 1.0);
    }
    for k in 1..4 {
        let along = k as f32 * 10.0;
        for (start, end) in [(0.0, 17.0), (19.0, 31.0), (33.0, SIDE)] {
            add_box(&mut scene, Vec3::new(start, 0.0, along), Vec3::new(end, 4.0, along + 0.1), 1.0);
            add_box(&mut scene, Vec3::new(along, 0.0, start), Vec3::new(along + 0.1, 4.0, end), 1.0);
        }
    }
    scene
}

/// The sides of a box, seen from outside with `side` 1, from inside with -1.
fn add_box(scene: &mut Scene, low: Vec3, high: Vec3, side: f32) {
    let corner =
        |k: usize| Vec3::from_array([0, 1, 2].map(|axis| if k >> axis & 1 == 1 { high[axis] } else { low[axis] }));
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = if side > 0.0 { vec![[0, 1, 2], [0, 2, 3]] } else { vec![[0, 2, 1], [0, 3, 2]] };
    for quad in quads {
        scene.surfaces.push(Surface {
            name: String::new(),
            mesh: scene.meshes.len(),
            material: 0,
            transform: Affine3A::IDENTITY,
            receiver: Receiver::Lightmap { density: 1.0 },
            casts: true,
        });
        let positions = quad.map(corner).to_vec();
        scene.meshes.push(Mesh { positions, triangles: triangles.clone(), ..Default::default() });
    }
}
