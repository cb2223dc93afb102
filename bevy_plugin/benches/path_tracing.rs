//! Paths of light against points that another path tracer computed, and how many there are in a second.
//!
//!     cargo bench --profile bake -p bevy_radiosity --no-default-features --features cli --bench path_tracing -- [SCENE.glb ...]
//!
//! Beside a scene lies its reference, `SCENE.csv`, as `benches/rivals/truth.py` writes it. Without a scene it takes those of
//! `../shared/scenes`, if they are there.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Instant;

use bevy::math::{Vec2, Vec3};
use bevy_radiosity::cli::read_scene;
use radiosity::geometry::{Hit, normal_and_area, tree};
use radiosity::parallel::Workers;
use radiosity::progress::Progress;
use radiosity::render::{Estimate, PATHS, PathTracer};
use radiosity::scene::World;

/// For each point, of as many paths as make a value.
const VALUES: u32 = 1024;
/// Points agree where they lie no further apart than so many standard errors of both together.
const SIGMAS: f32 = 3.0;

/// A row of a reference.
struct Row {
    position: Vec3,
    normal: Vec3,
    mean: Vec3,
    standard_error: Vec3,
}

fn main() {
    let args: Vec<PathBuf> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).map(Into::into).collect();
    let scenes = if args.is_empty() { beside() } else { args };
    if scenes.is_empty() {
        println!("there is no scene in ../shared/scenes; name one that has a reference");
    }
    for path in scenes {
        println!("{}", path.display());
        hold(&path, &rows(&path.with_extension("csv")));
    }
}

fn beside() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes");
    let files = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut scenes: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|kind| kind == "glb")).collect();
    scenes.sort();
    scenes
}

fn rows(path: &Path) -> Vec<Row> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let vector = |columns: [&str; 3]| {
            let number = |name| fields[names.iter().position(|other| *other == name)?].parse().ok();
            let [x, y, z]: [Option<f32>; 3] = columns.map(number);
            Some(Vec3::new(x?, y?, z?))
        };
        Some(Row {
            position: vector(["x", "y", "z"])?,
            normal: vector(["nx", "ny", "nz"])?,
            mean: vector(["r", "g", "b"])?,
            standard_error: vector(["se_r", "se_g", "se_b"])?,
        })
    };
    lines.filter_map(row).collect()
}

/// Follows paths to all points of a reference and tells which of them agree.
fn hold(path: &Path, rows: &[Row]) {
    let scene = read_scene(path).expect("the scene can be read");
    let world = World::new(&scene);
    let tracer = PathTracer::diffuse(&world, tree(world.corners[..world.blockers].to_vec()));
    let hits: Vec<Option<Hit>> = rows.iter().map(|row| nearest(&world, row)).collect();
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let start = Instant::now();
    let point = |index: usize| {
        let hit = hits[index]?;
        Some(tracer.received(&hit, world.shading_normal(&hit), VALUES, index as u32))
    };
    let found = Workers::new(threads).map(rows.len(), 1, &Progress::default(), |range| range.map(point).collect());
    let found: Vec<Option<Estimate<Vec3>>> = found.expect("nobody cancels it");
    let seconds = start.elapsed().as_secs_f64();
    let traced = found.iter().flatten().count() as f64 * f64::from(VALUES * PATHS);
    println!("  {:.0} paths a second on {threads} threads", traced / seconds);
    let pairs = || rows.iter().zip(&found).filter_map(|(row, found)| Some((row, found.as_ref()?)));
    let agree = pairs().filter(|(row, found)| sigmas(row, found) <= SIGMAS).count();
    println!("  {agree} of {} points agree within {SIGMAS} standard errors", pairs().count());
    let mean = |light: &dyn Fn(&Row, &Estimate<Vec3>) -> Vec3| {
        pairs().map(|(row, found)| light(row, found)).sum::<Vec3>() / pairs().count() as f32
    };
    println!(
        "  mean of the reference {:.4}, of the paths {:.4}",
        mean(&|row, _| row.mean),
        mean(&|_, found| found.mean)
    );
    for (row, found) in pairs().filter(|(row, found)| sigmas(row, found) > SIGMAS) {
        let (sigmas, error) = (sigmas(row, found), found.standard_error());
        println!(
            "  at {:.3}: {:.4} +- {:.4}, not {:.4} +- {:.4}: {sigmas:.1}",
            row.position, found.mean, error, row.mean, row.standard_error
        );
    }
}

/// The point of a triangle that a row means.
fn nearest(world: &World, row: &Row) -> Option<Hit> {
    let on = |triangle: usize| {
        let corners @ [a, b, c] = world.corners[triangle];
        let (normal, area) = normal_and_area(&corners)?;
        let off = (row.position - a).dot(normal).abs();
        let share = |p: Vec3, q: Vec3| 0.5 * (p - row.position).cross(q - row.position).dot(normal) / area;
        let barycentric = Vec2::new(share(c, a), share(a, b));
        let outside = (-barycentric.min_element()).max(barycentric.element_sum() - 1.0).max(0.0);
        let hit = Hit { triangle: triangle as u32, distance: 0.0, barycentric, front: true };
        (normal.dot(row.normal) > 0.999 && outside < 1e-3 && off < 1e-3).then_some((off + outside, hit))
    };
    (0..world.blockers).filter_map(on).min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, hit)| hit)
}

/// How far apart both are in standard errors, at least so many as rounding makes.
fn sigmas(row: &Row, found: &Estimate<Vec3>) -> f32 {
    let error = found.standard_error();
    let joint = (row.standard_error * row.standard_error + error * error).map(f32::sqrt);
    let apart = (row.mean - found.mean).abs() / (joint + 1e-5 * row.mean + 1e-9);
    apart.element_sum() / 3.0
}
