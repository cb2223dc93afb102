//! Relighting against a bake anew: time, memory, bandwidth, and how far both lie apart.
//!
//!     cargo bench --profile bake -p bevy_radiosity --no-default-features --features cli --bench relight -- [SCENE.glb] [TEXELS_PER_METER]
//!
//! Without a scene it takes `../shared/scenes/zdm2.glb`, and where that is missing the Cornell box.

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Instant;

use bevy::math::Vec3;
use bevy_radiosity::cli::read_scene;
use radiosity::bake::{Bake, BakeSettings, Keep, bake};
use radiosity::light::Light;
use radiosity::lightmap::{LayoutSettings, Resolution, TexelState};
use radiosity::progress::Progress;
use radiosity::scene::{Scene, cornell_box};
use radiosity::transport::{Lighting, RelightReport, Relighter, Relit, Transport};

const THREADS: usize = 2;
const REPEATS: usize = 7;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    let (scene, usual_density) = scene(args.first().map(PathBuf::from));
    let density = args.get(1).map_or(usual_density, |text| text.parse().expect("texels per meter are a number"));
    let settings = BakeSettings {
        layout: LayoutSettings { resolution: Resolution::TexelsPerMeter(density), ..Default::default() },
        threads: THREADS,
        keep: Keep::Transport,
        ..Default::default()
    };
    let (whole, baked) = timed(|| bake(&scene, &settings, &Progress::default()).expect("the scene can be baked"));
    println!("bake: {whole:.2} s, {} valid texels, {} nodes", baked.report.valid_texels, baked.report.nodes);
    let transport = baked.transport.as_ref().expect("it was asked for");
    print_bytes(transport);
    print_times(transport, whole);
    let mut relighter = Relighter::new(transport, THREADS);
    let relit = relighter.relight(&transport.lighting, &Progress::default()).expect("it is the light of the bake");
    println!("the same light: rms {:.4} %", 100.0 * difference(&relit, &baked, &baked));
    for (name, lighting) in changes(&transport.lighting) {
        let relit = relighter.relight(&lighting, &Progress::default()).expect("it has as many lamps");
        let scene = lit(&scene, &lighting);
        let (seconds, again) = timed(|| bake(&scene, &settings, &Progress::default()).expect("other light"));
        println!(
            "{name}: {:.3} % rms from a bake anew, which takes {seconds:.1} s; the change is {:.1} %; energy {:.5}",
            100.0 * difference(&relit, &again, &again),
            100.0 * difference(&relit, &baked, &baked),
            relighter.energy_balance()
        );
    }
}

fn scene(path: Option<PathBuf>) -> (Scene, f32) {
    let usual = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes/zdm2.glb");
    match path.or_else(|| usual.exists().then_some(usual)) {
        Some(path) => {
            println!("{}", path.display());
            (read_scene(&path).expect("the scene can be read"), 8.0)
        }
        None => {
            println!("there is no ../shared/scenes/zdm2.glb: the Cornell box instead");
            (cornell_box(), 256.0)
        }
    }
}

fn print_bytes(transport: &Transport) {
    let bytes = transport.bytes();
    println!("transport: {:.1} MB {bytes:?}", bytes.total() as f64 * 1e-6);
    for (name, rows) in [("patches", &transport.patches), ("nodes", &transport.nodes), ("texels", &transport.texels)] {
        let each = rows.bytes() as f64 / rows.entries() as f64;
        println!("  {name}: {} rows, {} entries, {each:.2} bytes an entry", rows.len(), rows.entries());
    }
}

fn print_times(transport: &Transport, bake: f64) {
    let mut relighter = Relighter::new(transport, THREADS);
    let other = changes(&transport.lighting).swap_remove(1).1;
    let mut best = [RelightReport { gather: f64::INFINITY, ..Default::default() }; 2];
    for _ in 0..REPEATS {
        relighter.forget();
        for (best, lighting) in best.iter_mut().zip([&transport.lighting, &other]) {
            let report = relighter.relight(lighting, &Progress::default()).expect("it has as many lamps").report;
            if report.seconds() < best.seconds() {
                *best = report;
            }
        }
    }
    let stream = stream_bandwidth();
    for (name, report) in ["from the dark", "one lamp changed"].into_iter().zip(best) {
        let (seconds, gather) = (report.seconds(), report.gather);
        println!(
            "relight {name}: {:.1} ms, {:.0} times faster than the bake; {report:.4?}",
            1e3 * seconds,
            bake / seconds
        );
        let rows = transport.nodes.bytes() as f64 / gather;
        let with_loads = rows + 16.0 * transport.nodes.entries() as f64 / gather;
        println!(
            "  product: {:.1} ms, {:.1} GB/s of rows, {:.1} GB/s with what they load; stream {:.1} GB/s",
            1e3 * gather,
            rows * 1e-9,
            with_loads * 1e-9,
            stream * 1e-9
        );
    }
}

/// Bytes per second of reading memory once, as the rows are read: the best of some runs on all threads.
fn stream_bandwidth() -> f64 {
    let memory = vec![1_u64; (256 << 20) / 8];
    let sum = |part: &[u64]| {
        let lanes = part.chunks_exact(8).fold([0_u64; 8], |sums, lane| core::array::from_fn(|k| sums[k] ^ lane[k]));
        black_box(lanes);
    };
    let once = |_| {
        let (seconds, ()) = timed(|| {
            thread::scope(|scope| {
                memory.chunks(memory.len() / THREADS).for_each(|part| drop(scope.spawn(move || sum(part))));
            });
        });
        seconds
    };
    let best = (0..REPEATS).map(once).fold(f64::INFINITY, f64::min);
    (8 * memory.len()) as f64 / best
}

/// Other light for the same scene: half of the lamps off; one lamp four times as strong and red; another wall color.
fn changes(base: &Lighting) -> Vec<(&'static str, Lighting)> {
    let (mut half, mut red, mut painted) = (base.clone(), base.clone(), base.clone());
    half.lamps.iter_mut().step_by(2).for_each(|lamp| *lamp = Vec3::ZERO);
    match red.lamps.first_mut() {
        Some(lamp) => *lamp *= Vec3::new(4.0, 0.4, 0.4),
        None => red.materials.iter_mut().for_each(|material| material.emissive *= Vec3::new(4.0, 0.4, 0.4)),
    }
    if let Some(wall) = painted.materials.first_mut() {
        wall.base_color = Vec3::new(0.7, 0.2, 0.1);
    }
    vec![("half of the lamps off", half), ("one lamp red and stronger", red), ("another wall color", painted)]
}

/// The scene with other light.
fn lit(scene: &Scene, lighting: &Lighting) -> Scene {
    let mut scene = scene.clone();
    for (Light { source, .. }, &strength) in scene.lights.iter_mut().zip(&lighting.lamps) {
        *source = source.with_strength(strength);
    }
    for (material, colors) in scene.materials.iter_mut().zip(&lighting.materials) {
        material.base_color = colors.base_color.extend(material.base_color.w);
        material.emissive = colors.emissive;
    }
    scene.sky = lighting.sky;
    scene
}

/// Root mean square of |a - b| / (reference + 0.1 mean reference) over all valid texels.
fn difference(a: &Relit, b: &Bake, reference: &Bake) -> f64 {
    let valid = |bake: &Bake| -> Vec<Vec3> {
        let with_states = bake.images.iter().flat_map(|image| image.texels.iter().zip(&image.states));
        with_states.filter(|(_, state)| **state == TexelState::Valid).map(|(texel, _)| *texel).collect()
    };
    let states = reference.images.iter().flat_map(|image| &image.states);
    let texels = a.images.iter().flatten().zip(states).filter(|(_, state)| **state == TexelState::Valid);
    let (b, reference) = (valid(b), valid(reference));
    let mean = reference.iter().copied().sum::<Vec3>().element_sum() / (3 * reference.len()) as f32;
    let squares = texels.zip(b).zip(&reference).map(|(((a, _), b), reference)| {
        let relative = (*a - b).length() / 3_f32.sqrt() / (reference.element_sum() / 3.0 + 0.1 * mean);
        f64::from(relative * relative)
    });
    (squares.sum::<f64>() / reference.len() as f64).sqrt()
}

fn timed<T>(task: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = task();
    (start.elapsed().as_secs_f64(), result)
}
