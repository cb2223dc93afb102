//! What a bake spends its time in, piece by piece, on one thread.
//!
//!     cargo bench -p radiosity --bench kernels [-- NAME]
//!
//! `traversal`: rays (elements) a second. `product`: bytes of rows a second. `rows`, `direct`, `gather`: patches, texels,
//! nodes (elements) a second in that stage of a bake of draft quality. `unwrap`, `seams`: triangles, pairs of points.

mod scenes;

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput};
use glam::Vec3A;
use radiosity::bake::{Bake, BakeSettings, Quality, Report, bake};
use radiosity::geometry::{Occluders, Ray, hash, tree};
use radiosity::lightmap::{LayoutSettings, Resolution, Seams, Texels, UvMode, check, layout};
use radiosity::parallel::Workers;
use radiosity::progress::Progress;
use radiosity::scene::{Scene, World, cornell_box};
use radiosity::transport::{Row, Rows, Tracer};

const RAYS: u32 = 1 << 14;

fn main() {
    let usual = Criterion::default().sample_size(20).measurement_time(Duration::from_secs(3));
    let mut criterion = usual.configure_from_args();
    for kernel in [traversal, row, product, stages, unwrap, seams] {
        kernel(&mut criterion);
    }
    criterion.final_summary();
}

fn traversal(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("traversal");
    group.throughput(Throughput::Elements(u64::from(RAYS)));
    for (name, scene) in [("cornell", cornell_box()), ("hall", scenes::hall())] {
        let world = World::new(&scene);
        let (low, high) = world.bounds();
        let tree = tree(world.corners[..world.blockers].to_vec());
        let coherent: fn(_, _, _) -> Vec<Ray> = scenes::coherent;
        for (order, rays) in [("coherent", coherent), ("incoherent", scenes::incoherent)] {
            let rays = rays(low, high, RAYS);
            group.bench_function(BenchmarkId::new(format!("closest/{order}"), name), |bencher| {
                bencher.iter(|| rays.iter().filter(|ray| tree.nearest(black_box(ray)).is_some()).count());
            });
            group.bench_function(BenchmarkId::new(format!("any/{order}"), name), |bencher| {
                bencher.iter(|| rays.iter().filter(|ray| tree.any(black_box(ray), |_| true)).count());
            });
        }
    }
    group.finish();
}

/// Columns that rays met become a row: 128 rays, each column met by some four of them.
fn row(criterion: &mut Criterion) {
    let columns: Vec<u32> = (0..128).map(|k| 100 * (hash(3, k) % 32)).collect();
    let mut group = criterion.benchmark_group("row");
    group.throughput(Throughput::Elements(columns.len() as u64));
    group.bench_function("count", |bencher| bencher.iter(|| Row::count(&mut columns.clone())));
    group.finish();
}

/// The product of stored rows with radiances, as every bounce needs it: 16 384 rows of 128 entries.
fn product(criterion: &mut Criterion) {
    const COLUMNS: u32 = 1 << 14;
    let row = |i: u32| {
        // Half of the light comes from near, half from anywhere.
        let column = |k: u32| if k.is_multiple_of(2) { i + k } else { hash(i, k) };
        Row::count(&mut (0..128).map(|k| column(k) % COLUMNS).collect::<Vec<u32>>())
    };
    let rows = Rows::from((0..COLUMNS).map(row).collect::<Vec<_>>());
    let radiance: Vec<Vec3A> = (0..COLUMNS).map(|k| Vec3A::splat(hash(5, k) as f32)).collect();
    let mut group = criterion.benchmark_group("product");
    group.throughput(Throughput::Bytes(rows.bytes() as u64));
    group.bench_function("rows times radiance", |bencher| {
        bencher.iter(|| (0..rows.len()).map(|i| rows.mean(i, black_box(&radiance))).sum::<Vec3A>());
    });
    group.finish();
}

/// Stages that stand on the whole bake: its own clock tells what they take.
fn stages(criterion: &mut Criterion) {
    let scenes = [("cornell", cornell_box(), 64.0), ("hall", scenes::hall(), 4.0)];
    for (name, scene, density) in &scenes {
        let once = || baked(scene, *density).report;
        let report = once();
        let kinds = [("rows", "transport", report.patches), ("direct", "direct", report.valid_texels)];
        for (kernel, stage, count) in kinds.into_iter().chain([("gather", "gather", report.nodes)]) {
            let mut group = criterion.benchmark_group(kernel);
            group.throughput(Throughput::Elements(count as u64)).sample_size(10);
            group.bench_function(*name, |bencher| {
                bencher.iter_custom(|times| (0..times).map(|_| seconds_of(stage, &once())).sum());
            });
            group.finish();
        }
    }
}

fn baked(scene: &Scene, density: f32) -> Bake {
    bake(scene, &settings(density), &Progress::default()).expect("the scene can be baked")
}

fn settings(density: f32) -> BakeSettings {
    let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(density), ..Default::default() };
    BakeSettings { layout, quality: Quality::Draft, threads: 1, ..Default::default() }
}

fn seconds_of(stage: &str, report: &Report) -> Duration {
    let found = report.stages.iter().find(|found| found.name == stage);
    Duration::from_secs_f64(found.map_or(0.0, |found| found.seconds))
}

fn unwrap(criterion: &mut Criterion) {
    let scene = scenes::one_ball();
    let settings = LayoutSettings { uv: UvMode::Unwrap, ..settings(16.0).layout };
    let workers = Workers::new(1);
    let mut group = criterion.benchmark_group("unwrap");
    group.throughput(Throughput::Elements(scene.meshes[0].triangles.len() as u64)).sample_size(10);
    group.bench_function("ball", |bencher| {
        bencher.iter(|| workers.run(|| layout(&scene, &settings, &Progress::default())).expect("it can be unwrapped"));
    });
    group.finish();
}

/// Least squares over the borders of the charts of a ball.
fn seams(criterion: &mut Criterion) {
    const DENSITY: f32 = 64.0;
    let (scene, progress, workers) = (scenes::one_ball(), Progress::default(), Workers::new(1));
    let layout = layout(&scene, &settings(DENSITY).layout, &progress).expect("it can be unwrapped");
    let world = World::new(&scene);
    let tracer = Tracer::new(&world, tree(world.corners[..world.blockers].to_vec()));
    let mut texels = Texels::new(&world, &layout, 0..layout.images.len(), &progress).expect("nobody cancels");
    let is_valid = check(&mut texels, &tracer, &workers, 1, &progress).expect("nobody cancels");
    let errors = vec![0.01; texels.list.len()];
    let find = || Seams::new(&texels, &is_valid, &errors, &tracer, &workers, &progress).expect("nobody cancels");
    let (seams, images) = (find(), baked(&scene, DENSITY).images);
    let mut group = criterion.benchmark_group("seams");
    group.throughput(Throughput::Elements(seams.points.len() as u64)).sample_size(10);
    group.bench_function("find", |bencher| bencher.iter(find));
    group.bench_function("solve", |bencher| {
        bencher.iter(|| seams.solve(&mut images.clone(), 1.0, &workers, &progress).expect("nobody cancels"));
    });
    group.finish();
}
