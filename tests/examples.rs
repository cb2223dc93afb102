//! The examples that need Bevy, as built beside this test, make the pictures and scenes that they are asked for.

use std::env;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};
use std::sync::atomic::AtomicBool;

use bevy_radiosity::cli::{read_scene, try_run};
use radiosity::bake::{BakeSettings, Quality, bake};
use radiosity::lightmap::{LayoutSettings, LightmapImage, Resolution};
use radiosity::progress::Progress;
use radiosity_tests::TestFolder;
use radiosity_tests::render::Studio;

/// Points of a picture of the Cornell box, on its red, green and back wall, as shares of its width and height.
const RED: [f32; 2] = [0.18, 0.4];
const GREEN: [f32; 2] = [0.82, 0.4];
const BACK: [f32; 2] = [0.5, 0.3];

/// 8-bit RGB, row by row.
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    fn read(path: &Path) -> Self {
        let decoder = png::Decoder::new(BufReader::new(File::open(path).expect("the picture is there")));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
        let pixels = bytes[..info.buffer_size()].as_chunks::<3>().0.to_vec();
        Self { width: info.width as usize, height: info.height as usize, pixels }
    }

    fn at(&self, [x, y]: [f32; 2]) -> [u8; 3] {
        let (column, row) = ((x * self.width as f32) as usize, (y * self.height as f32) as usize);
        self.pixels[row * self.width + column]
    }
}

/// What it writes to the terminal is shown where the test fails.
fn viewer(arguments: &[&str]) -> ExitStatus {
    example("viewer", arguments)
}

fn example(name: &str, arguments: &[&str]) -> ExitStatus {
    let test = env::current_exe().expect("a test has a path");
    let folder = test.parent().and_then(Path::parent).expect("below the folder of the profile");
    let program = folder.join("examples").join(format!("{name}{}", env::consts::EXE_SUFFIX));
    assert!(program.exists(), "{} is not built; run `cargo build --example {name}`", program.display());
    let output = Command::new(program).args(arguments).output().expect("it can be started");
    print!("{}", String::from_utf8_lossy(&output.stderr));
    output.status
}

fn picture_of(view: &str, folder: &TestFolder) -> Picture {
    let path: PathBuf = folder.path().join(view).with_extension("png");
    let file = path.to_str().expect("the folder has a name in Unicode");
    let status = viewer(&["--texels-per-meter", "32", "--view", view, "--screenshot", file]);
    assert!(status.success(), "{status}");
    Picture::read(&path)
}

#[test]
fn viewer_shows_light_and_charts() {
    let Some(_) = Studio::new() else { return };
    let folder = TestFolder::new("viewer");
    let lit = picture_of("lit", &folder);
    let [[r, g, _], [s, h, _], back] = [RED, GREEN, BACK].map(|point| lit.at(point));
    assert!(r > 2 * g && h > s, "the walls are {:?}, {:?}", lit.at(RED), lit.at(GREEN));
    assert!(back.iter().all(|channel| (60..=250).contains(channel)), "the back wall is {back:?}");

    let charts = picture_of("charts", &folder);
    let [red, green, back] = [RED, GREEN, BACK].map(|point| charts.at(point));
    assert!(red != green && green != back && back != red, "walls of one color: {red:?} {green:?} {back:?}");

    let truth = picture_of("truth", &folder);
    let count = |is_meant: fn(&[u8; 3]) -> bool| truth.pixels.iter().filter(|pixel| is_meant(pixel)).count();
    let small = count(|[red, green, blue]| blue > green && blue > red);
    let large = count(|[red, _, blue]| red / 2 > *blue.max(&40));
    assert!(small > truth.pixels.len() / 4 && small > 4 * large, "{small} {large}");

    let missing = folder.path().join("missing.glb");
    let picture = folder.path().join("missing.png");
    let status = viewer(&[missing.to_str().unwrap(), "--screenshot", picture.to_str().unwrap()]);
    assert_eq!(status.code(), Some(1), "there is nothing to bake");
    assert!(!picture.exists());
}

#[test]
fn viewer_tells_wrong_arguments() {
    for wrong in [&["--no-such-option"][..], &["--view", "none"], &["--texels-per-meter", "-1"], &["--screenshot"]] {
        assert_eq!(viewer(wrong).code(), Some(2), "{wrong:?}");
    }
}

/// Every scene of the gallery is a file that can be baked, with its camera and its lights.
#[test]
fn gallery_makes_scenes_that_can_be_baked() {
    let folder = TestFolder::new("gallery");
    let status = example("gallery", &["--scenes", folder.path().to_str().expect("it has a name in Unicode")]);
    assert!(status.success(), "{status}");
    for (name, density, lights) in [
        ("cornell", 16.0, 0),
        ("furnished_room", 1.0, 2),
        ("thin_walls", 1.0, 7),
        ("colonnade", 0.5, 1),
        ("stairwell", 1.0, 0),
    ] {
        let path = folder.path().join(name).with_extension("glb");
        let scene = read_scene(&path).expect("the file is a scene");
        assert_eq!(scene.lights.len(), lights, "{name}");
        let triangles: usize = scene.surfaces.iter().map(|surface| scene.meshes[surface.mesh].triangles.len()).sum();
        assert!((32..40_000).contains(&triangles), "{name}: {triangles} triangles");
        let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(density), ..Default::default() };
        let settings = BakeSettings { layout, quality: Quality::Draft, ..Default::default() };
        let bake = bake(&scene, &settings, &Progress::default()).expect("it can be baked");
        assert_eq!(bake.report.surfaces, scene.surfaces.len(), "{name}: {:?}", bake.report.warnings);
        let light =
            |image: &LightmapImage| image.texels.iter().all(|texel| texel.is_finite() && texel.min_element() >= 0.0);
        assert!(bake.images.iter().all(light), "{name}");
        let bright = bake.images.iter().flat_map(|image| &image.texels).filter(|texel| texel.max_element() > 1.0);
        assert!(bright.count() > bake.report.valid_texels / 2, "{name} is dark");
        assert!(bake.report.valid_texels > 4 * bake.report.invalid_texels, "{name}: {:?}", bake.report);
    }
}

/// Surfaces of splines are charts by nature: all coordinates are kept, and light goes on from patch to patch.
#[test]
fn vase_and_vault_need_no_unwrap() {
    let Some(_) = Studio::new() else { return };
    let folder = TestFolder::new("vase");
    let (scene, out) = (folder.path().join("vase.glb"), folder.path().join("baked"));
    let status = example("spline_vase", &["--scene", scene.to_str().expect("it has a name in Unicode")]);
    assert!(status.success(), "{status}");
    let words = ["bake".as_ref(), scene.as_os_str(), "--out".as_ref(), out.as_os_str()];
    let options = ["--quality", "draft", "--texels-per-meter", "24"].map(AsRef::as_ref);
    let words = words.into_iter().chain(options).map(|word: &std::ffi::OsStr| word.to_owned());
    try_run(words, &AtomicBool::new(false)).expect("all coordinates can be kept");
    let report = std::fs::read(out.join("report.json")).expect("it is written");
    let report: serde_json::Value = serde_json::from_slice(&report).expect("it is JSON");
    assert_eq!((&report["unwrapped"], &report["surfaces"]), (&0.into(), &17.into()));
    assert_eq!(report["warnings"].as_array().map(Vec::len), Some(0), "{}", report["warnings"]);
    let [before, after] = ["step_before", "step_after"].map(|key| report["seams"][key].as_f64().expect("a number"));
    assert!(after < 0.01 && after < 0.2 * before, "{before} {after}");
    assert!(report["seams"]["largest_after"].as_f64().is_some_and(|step| step < 0.3), "{}", report["seams"]);
}

#[test]
fn spline_examples_tell_wrong_arguments() {
    assert_eq!(example("spline_vase", &["--screenshot"]).code(), Some(2));
    assert_eq!(example("spline_vase", &["--texels-per-meter", "0"]).code(), Some(2));
    assert_eq!(example("spline_rail", &["--no-such-option"]).code(), Some(2));
}
