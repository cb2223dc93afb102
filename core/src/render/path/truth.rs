//! How far a bake is from the truth.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::{Optics, PATHS, PathTracer};
use crate::bake::Bake;
use crate::geometry::{Hit, Ray, Sobol, cosine_direction, hash, lift, normal_and_area, tree};
use crate::lightmap::TexelState;
use crate::math;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress, Stage};
use crate::render::preview::bilinear;
use crate::render::view::lightmap_place;
use crate::scene::{Scene, World};

/// Values of [`PATHS`] paths for each point: enough that bakes are further off than they are.
const VALUES: u32 = 1024;

/// A point that sees more backs of one-sided surfaces lies inside of geometry, where nobody looks.
const MOST_BACKS: f32 = 0.1;

/// The error of a bake, found by paths of light to random points of its surfaces. Errors are relative to the true light
/// plus a tenth of its mean, as [`EstimatedError`](crate::bake::EstimatedError) has them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Truth {
    /// Points that were looked at; where there is none, all else means nothing.
    pub points: usize,
    /// Points that were left out, because they lie inside of geometry.
    pub left_out: usize,
    /// Paths for each of them.
    pub paths: u32,
    /// Root mean square, without the noise of the paths.
    pub rms: f32,
    /// The same without the worst of all points. Where it is far less, `rms` is that of a single point at an edge that no
    /// texel holds, and other points would give another.
    pub rms_without_worst: f32,
    /// Half of the points are no further off, in the mean of their channels; the noise of the paths is part of it.
    pub p50: f32,
    /// The same for 19 of 20.
    pub p95: f32,
    /// Mean signed error over the mean.
    pub bias: f32,
    /// Of the truth at one point: root mean square.
    pub standard_error: f32,
}

/// What is true and what is baked at a point: irradiance / pi.
struct Point {
    baked: Vec3,
    mean: Vec3,
    standard_error: Vec3,
}

/// Holds a bake against paths of light to so many points, uniform by area over all lightmaps.
///
/// Light is looked up as graphics hardware does. Both take the scene as [`Diffuse`](super::Diffuse) has it: what that
/// leaves out, as gloss and refraction, is no error here, nor is light of lamps by way of several or curved mirrors. Points
/// on texels inside of geometry, which are filled in, are left out.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn truth(scene: &Scene, bake: &Bake, points: usize, progress: &Progress) -> Result<Truth, Cancelled> {
    progress.enter(Stage::Paths);
    let world = World::new(scene);
    let tracer = PathTracer::diffuse(&world, tree(world.corners[..world.blockers].to_vec()));
    let ends = ends_of_area(&world, bake);
    let seed = hash(bake.report.seed as u32, 0x7d0b);
    let point = |index: usize| {
        let seed = hash(seed, index as u32);
        let hit = random_point(&ends, seed)?;
        let baked = baked_light(&world, bake, &hit)?;
        let normal = world.shading_normal(&hit);
        if backs(&tracer.optics, &hit, normal, seed) > MOST_BACKS {
            return None;
        }
        let estimate = tracer.received(&hit, normal, VALUES, seed);
        Some(Point { baked, mean: estimate.mean, standard_error: estimate.standard_error() })
    };
    let workers = Workers::new(bake.report.threads);
    let found: Vec<Option<Point>> = workers.map(points, 4, progress, |range| range.map(point).collect())?;
    let found: Vec<Point> = found.into_iter().flatten().collect();
    Ok(Truth { left_out: points - found.len(), ..errors(&found) })
}

/// The share of what a point sees that are backs of one-sided surfaces.
fn backs(optics: &impl Optics<Vec3>, hit: &Hit, normal: Vec3, seed: u32) -> f32 {
    const RAYS: u32 = 64;
    let (corners, sequence) = (optics.corners()[hit.triangle as usize], Sobol::new(seed));
    let origin = hit.interpolate(corners) + normal * lift(&corners);
    let is_back = |index: &u32| {
        let ray = Ray { origin, direction: cosine_direction(sequence.square(*index), normal), end: f32::INFINITY };
        let (met, _) = optics.nearest(&ray, hash(seed, *index));
        met.is_some_and(|met| !met.front && !optics.both_sides(met.triangle))
    };
    (0..RAYS).filter(is_back).count() as f32 / RAYS as f32
}

/// The triangles with a lightmap, each with the sum of the areas up to it.
fn ends_of_area(world: &World, bake: &Bake) -> Vec<(f32, u32)> {
    let has_lightmap = |surface: u32| bake.placements.get(surface as usize).is_some_and(Option::is_some);
    let mut sum = 0.0;
    let triangles = (0..world.blockers).filter(|&triangle| has_lightmap(world.sources[triangle].surface));
    let with_end = |triangle: usize| {
        sum += normal_and_area(&world.corners[triangle]).map_or(0.0, |(_, area)| area);
        (sum, triangle as u32)
    };
    triangles.map(with_end).collect()
}

fn random_point(ends: &[(f32, u32)], seed: u32) -> Option<Hit> {
    let [which, x, y] = [1, 2, 3].map(|k| (hash(seed, k) >> 8) as f32 / 16_777_216.0);
    let (area, _) = *ends.last()?;
    let index = ends.partition_point(|(end, _)| *end <= which * area).min(ends.len() - 1);
    let root = math::sqrt(x);
    let barycentric = Vec2::new(root * (1.0 - y), root * y);
    Some(Hit { triangle: ends[index].1, distance: 0.0, barycentric, front: true })
}

/// Nothing where the texel is no light of its own.
fn baked_light(world: &World, bake: &Bake, hit: &Hit) -> Option<Vec3> {
    let (image, uv) = lightmap_place(world, bake, hit)?;
    let image = bake.images.get(image)?;
    let pixel = (uv * Vec2::new(image.width as f32, image.height as f32)).as_uvec2();
    let (x, y) = (pixel.x.min(image.width.saturating_sub(1)), pixel.y.min(image.height.saturating_sub(1)));
    let state = image.states.get((y * image.width + x) as usize)?;
    (*state == TexelState::Valid).then(|| bilinear(image, uv))
}

fn errors(points: &[Point]) -> Truth {
    let count = points.len().max(1) as f32;
    let mean = points.iter().map(|point| point.mean.element_sum() / 3.0).sum::<f32>() / count;
    let relative = |point: &Point, x: Vec3| x / (point.mean + 0.1 * mean).max(Vec3::splat(f32::MIN_POSITIVE));
    let square = |x: Vec3| x.length_squared() / 3.0;
    let error = |point: &Point| relative(point, point.baked - point.mean);
    let squares: Vec<f32> = points.iter().map(|point| square(error(point))).collect();
    let (sum, worst) = (squares.iter().sum::<f32>(), squares.iter().copied().fold(0.0, f32::max));
    let noise = points.iter().map(|point| square(relative(point, point.standard_error))).sum::<f32>() / count;
    let mut sizes: Vec<f32> = points.iter().map(|point| error(point).abs().element_sum() / 3.0).collect();
    sizes.sort_by(f32::total_cmp);
    let quantile = |share: f32| sizes.get((share * (count - 1.0)) as usize).copied().unwrap_or(0.0);
    let signed = points.iter().map(|point| (point.baked - point.mean).element_sum() / 3.0).sum::<f32>() / count;
    Truth {
        points: points.len(),
        left_out: 0,
        paths: VALUES * PATHS,
        rms: math::sqrt((sum / count - noise).max(0.0)),
        rms_without_worst: math::sqrt(((sum - worst) / (count - 1.0).max(1.0) - noise).max(0.0)),
        p50: quantile(0.5),
        p95: quantile(0.95),
        bias: signed / mean.max(f32::MIN_POSITIVE),
        standard_error: math::sqrt(noise),
    }
}
