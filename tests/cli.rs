//! The command line from the outside: files, messages, exit codes.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use bevy_radiosity::baked::ktx2::shared_exponent;
use bevy_radiosity::cli::{CliError, try_run};
use radiosity_tests::TestFolder;
use radiosity_tests::glb::Glb;
use serde_json::Value;

/// Bakes quickly; all that is tested here does not depend on the quality.
fn bake(scene: &Path, out: &Path, more: &[&str]) -> Result<String, CliError> {
    let mut args: Vec<OsString> = ["bake", "--quality", "draft", "--resolution", "64"].map(OsString::from).to_vec();
    args.extend([scene.into(), "--out".into(), out.into()]);
    args.extend(more.iter().map(OsString::from));
    try_run(args, &AtomicBool::new(false))
}

/// The text of the error that a bake of these bytes ends with.
fn error_of(name: &str, file: &str, bytes: &[u8]) -> String {
    let folder = TestFolder::new(name);
    let scene = folder.write(file, bytes);
    let error = bake(&scene, &folder.path().join("out"), &[]).expect_err("the scene cannot be baked");
    assert_eq!(error.exit_code(), ExitCode::from(1), "{error}");
    assert!(!folder.path().join("out").exists(), "a failed bake leaves nothing behind");
    error.to_string()
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("the file is there")).expect("the file is JSON")
}

/// The JSON of a `.glb` file.
fn glb_json(path: &Path) -> Value {
    let bytes = fs::read(path).expect("the file is there");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).expect("the chunk is JSON")
}

/// Names and bytes of all files in a folder.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("the folder is there").map(|entry| entry.expect("it can be read"));
    entries.map(|e| (e.file_name().to_string_lossy().into_owned(), fs::read(e.path()).expect("readable"))).collect()
}

#[test]
fn all_files_are_written_and_fit_together() {
    let folder = TestFolder::new("files");
    let out = folder.path().join("out");
    bake(&folder.write("room.glb", &Glb::room().bytes()), &out, &[]).expect("the room can be baked");
    let expected = ["lightmap-0.exr", "lightmap-0.ktx2", "manifest.json", "preview.png", "report.json", "scene.glb"];
    assert_eq!(contents(&out).into_keys().collect::<Vec<_>>(), expected);

    let manifest = json(&out.join("manifest.json"));
    assert_eq!(manifest["images"][0]["file"], "lightmap-0.ktx2");
    assert_eq!(manifest["images"][0]["exr"], "lightmap-0.exr");
    assert_eq!((&manifest["images"][0]["width"], &manifest["images"][0]["height"]), (&64.into(), &64.into()));
    let scene = glb_json(&out.join("scene.glb"));
    let surfaces = manifest["surfaces"].as_array().expect("a list");
    assert_eq!(surfaces.len(), 2);
    for surface in surfaces {
        let node = &scene["nodes"][surface["node"].as_u64().expect("an index") as usize];
        assert_eq!((&node["name"], &node["mesh"]), (&surface["node_name"], &surface["mesh"]));
        let rect: Vec<f64> = (0..4).map(|i| surface["uv_rect"][i].as_f64().expect("a number")).collect();
        assert!(0.0 <= rect[0] && rect[0] < rect[2] && rect[2] <= 1.0, "{rect:?}");
        assert!(0.0 <= rect[1] && rect[1] < rect[3] && rect[3] <= 1.0, "{rect:?}");
    }
    assert_eq!(manifest["lights"][0]["node"], 2);
    assert_eq!(scene["materials"].as_array().map(Vec::len), Some(1));
    let names: Vec<_> = scene["nodes"].as_array().expect("a list").iter().map(|node| &node["name"]).collect();
    assert_eq!(names, ["Floor", "Wall", "Lamp"]);
    for mesh in scene["meshes"].as_array().expect("a list") {
        let accessor = mesh["primitives"][0]["attributes"]["TEXCOORD_1"].as_u64().expect("an index") as usize;
        assert_eq!(scene["accessors"][accessor]["type"], "VEC2");
    }
    report_is_complete(&json(&out.join("report.json")));
    let preview = png::Decoder::new(std::io::BufReader::new(fs::File::open(out.join("preview.png")).expect("there")));
    assert!(preview.read_info().expect("a PNG").info().width > 100);
}

/// One picture for each question, as large as the preview, and each shows something else.
#[test]
fn views_are_pictures_of_the_size_of_the_preview() {
    let folder = TestFolder::new("views");
    let out = folder.path().join("out");
    bake(&folder.write("room.glb", &Glb::room().bytes()), &out, &["--views"]).expect("the room can be baked");
    let read = |name: &str| {
        let file = fs::File::open(out.join(name)).expect("the picture is there");
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
        let info = reader.next_frame(&mut pixels).expect("it is whole");
        ((info.width, info.height), pixels)
    };
    let (size, preview) = read("preview.png");
    let mut seen = vec![preview];
    for name in ["density.png", "error.png", "invalid.png", "seams.png"] {
        let (own, pixels) = read(name);
        assert_eq!(own, size, "{name}");
        assert!(!seen.contains(&pixels), "{name} shows nothing of its own");
        seen.push(pixels);
    }
}

/// Paths of light draw what the bake shows, side by side with it, and find no large errors; views show these too.
#[test]
fn paths_of_light_agree_with_the_bake() {
    let folder = TestFolder::new("paths");
    let (out, picture) = (folder.path().join("out"), folder.path().join("truth.png"));
    let render = picture.to_str().expect("it has a name in Unicode");
    let more = ["--render", render, "--samples", "1", "--reference", "50", "--views"];
    bake(&folder.write("room.glb", &Glb::room().bytes()), &out, &more).expect("the room can be baked");
    let read = |path: &Path| {
        let file = fs::File::open(path).expect("the picture is there");
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("it fits")];
        let info = reader.next_frame(&mut pixels).expect("it is whole");
        (info.width as usize, info.height as usize, pixels)
    };
    let mean = |pixels: &[u8]| pixels.iter().map(|channel| f64::from(*channel)).sum::<f64>() / pixels.len() as f64;
    let (width, height, preview) = read(&out.join("preview.png"));
    let (own_width, own_height, truth) = read(&picture);
    assert_eq!((own_width, own_height), (width, height));
    assert!((mean(&truth) - mean(&preview)).abs() < 0.1 * mean(&preview), "{} {}", mean(&truth), mean(&preview));
    let (both, ..) = read(&folder.path().join("truth-beside.png"));
    assert!(both > 2 * width && both < 2 * width + 10);
    assert_eq!(read(&folder.path().join("truth-difference.png")).0, width);
    assert_eq!(read(&out.join("truth.png")).0, width);
    let error = &json(&out.join("report.json"))["true_error"];
    assert!(error["points"].as_u64().is_some_and(|points| (1..=50).contains(&points)), "{error}");
    assert!(error["p50"].as_f64().is_some_and(|p50| p50 > 0.0 && p50 < 0.2), "{error}");
}

/// Before the bake, not after it.
#[test]
fn a_missing_folder_for_a_picture_is_named() {
    let folder = TestFolder::new("nowhere");
    let picture = folder.path().join("pictures").join("truth.png");
    let out = folder.path().join("out");
    let render = ["--render", picture.to_str().expect("it has a name in Unicode")];
    let error = bake(&folder.write("room.glb", &Glb::room().bytes()), &out, &render).expect_err("there is no folder");
    assert!(error.to_string().contains("pictures") && !out.exists(), "{error}");
}

/// A room without lamps under skies: one color, a panorama that is the same, and what is kept of it twice as bright.
#[test]
fn skies_light_rooms() {
    let folder = TestFolder::new("skies");
    let mut room = Glb::room();
    room.lights.clear();
    room.nodes.pop();
    let scene = folder.write("room.glb", &room.bytes());
    let panorama = folder.path().join("even.exr");
    exr::prelude::write_rgb_file(&panorama, 8, 4, |_, _| (2.0_f32, 1.0_f32, 0.5_f32)).expect("it can be written");
    let panorama = panorama.to_str().expect("it has a name in Unicode");
    let out = folder.path().join("out");
    let light = || {
        let image = exr::prelude::read_first_rgba_layer_from_file(
            out.join("lightmap-0.exr"),
            |_, _| [0.0_f64; 3],
            |sums, _, (r, g, b, _): (f32, f32, f32, f32)| {
                sums.iter_mut().zip([r, g, b]).for_each(|(sum, channel)| *sum += f64::from(channel));
            },
        );
        image.expect("an EXR file").layer_data.channel_data.pixels
    };
    bake(&scene, &out, &["--sky", "4,2,1"]).expect("a sky is light");
    let even = light();
    assert!(even[2] > 1.0);
    let more = ["--sky", panorama, "--sky-scale", "2", "--sky-turn", "-30", "--transport"];
    bake(&scene, &out, &more).expect("a panorama is a sky");
    let of_image = light();
    let twice = ["bake", "--relight", out.to_str().expect("Unicode"), "--light", "sky=2"].map(OsString::from);
    try_run(twice, &AtomicBool::new(false)).expect("the sky is kept");
    for ((even, of_image), twice) in even.into_iter().zip(of_image).zip(light()) {
        assert!(
            (of_image / even - 1.0).abs() < 0.02 && (twice / of_image - 2.0).abs() < 0.05,
            "{even} {of_image} {twice}"
        );
    }
    let error = bake(&scene, &out, &["--sky", "nowhere.hdr"]).expect_err("there is no such sky").to_string();
    assert!(error.contains("nowhere.hdr"), "{error}");
}

/// Every field that others read is there, and the sums are right.
fn report_is_complete(report: &Value) {
    let numbers = "triangles surfaces texels valid_texels invalid_texels patches nodes images texels_per_meter ev100 \
                   threads seed peak_memory_bytes closure_error energy_balance";
    for key in numbers.split_whitespace() {
        assert!(report[key].is_number(), "{key}: {}", report[key]);
    }
    assert_eq!(report["unwrapped"], 2);
    assert!(report["version"].is_string() && report["settings"].is_object() && report["warnings"].is_array());
    assert_eq!(report["scene"], "room.glb");
    assert_eq!((&report["triangles"], &report["surfaces"], &report["texels"]), (&4.into(), &2.into(), &4096.into()));
    assert!(report["estimated_error"]["rms"].is_number() && report["estimated_error"]["bias"].is_number());
    for stage in report["stages"].as_array().expect("a list") {
        assert!(stage["name"].is_string() && stage["seconds"].is_number() && stage["rays"].is_number());
    }
}

/// Both files of a lightmap hold the same texels, as an independent reader of each finds them; the lamp lights them.
#[test]
fn ktx2_and_exr_agree() {
    let folder = TestFolder::new("formats");
    let out = folder.path().join("out");
    bake(&folder.write("room.glb", &Glb::room().bytes()), &out, &[]).expect("the room can be baked");
    let image = exr::prelude::read_first_rgba_layer_from_file(
        out.join("lightmap-0.exr"),
        |size, _| vec![[0.0_f32; 3]; size.area()],
        |texels, at, (r, g, b, _): (f32, f32, f32, f32)| texels[at.y() * 64 + at.x()] = [r, g, b],
    );
    let texels = image.expect("the file is EXR").layer_data.channel_data.pixels;
    let file = fs::read(out.join("lightmap-0.ktx2")).expect("the file is there");
    let reader = ktx2::Reader::new(&file).expect("the file is KTX2");
    assert_eq!(reader.header().format, Some(ktx2::Format::E5B9G9R9_UFLOAT_PACK32));
    let level = reader.levels().next().expect("it has a level");
    let words = level.data.chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().expect("four bytes")));
    assert!(words.eq(texels.iter().map(|&texel| shared_exponent(texel))));
    assert!(texels.iter().any(|texel| texel[0] > 1.0));
}

/// The coordinates that were made are usable: the written scene can be baked with them as they are.
#[test]
fn the_written_scene_can_be_baked_again() {
    let folder = TestFolder::new("again");
    let (first, second) = (folder.path().join("first"), folder.path().join("second"));
    bake(&folder.write("room.glb", &Glb::room().bytes()), &first, &[]).expect("the room can be baked");
    bake(&first.join("scene.glb"), &second, &["--uv", "keep"]).expect("its coordinates are usable");
    let [before, after] = [&first, &second].map(|out| json(&out.join("manifest.json"))["surfaces"].clone());
    assert_eq!(before.as_array().map(Vec::len), Some(2));
    for (before, after) in before.as_array().into_iter().flatten().zip(after.as_array().into_iter().flatten()) {
        for key in ["node", "node_name", "mesh", "primitive"] {
            assert_eq!(before[key], after[key]);
        }
    }
}

#[test]
fn threads_do_not_change_a_bit() {
    let folder = TestFolder::new("threads");
    let scene = folder.write("room.glb", &Glb::room().bytes());
    let files = ["1", "2"].map(|threads| {
        let out = folder.path().join(threads);
        bake(&scene, &out, &["--threads", threads]).expect("the room can be baked");
        let mut files = contents(&out);
        // It tells the time.
        files.remove("report.json");
        files
    });
    assert!(files[0] == files[1], "one and two threads give different files");
}

#[test]
fn a_failed_and_a_cancelled_bake_leave_the_last_good_one() {
    let folder = TestFolder::new("survives");
    let out = folder.path().join("out");
    let room = Glb::room().bytes();
    let scene = folder.write("room.glb", &room);
    bake(&scene, &out, &[]).expect("the room can be baked");
    let before = contents(&out);
    let truncated = folder.write("truncated.glb", &room[..room.len() - 40]);
    bake(&truncated, &out, &[]).expect_err("the file is truncated");
    assert!(contents(&out) == before);
    let args = ["bake".into(), scene.into_os_string(), "--out".into(), out.clone().into_os_string()];
    let cancelled = try_run(args, &AtomicBool::new(true)).expect_err("it is cancelled at once");
    assert_eq!(cancelled.exit_code(), ExitCode::from(130));
    assert!(contents(&out) == before);
}

/// The folder of the scene can be the one for the bake, unless the scene is called as the baked one is.
#[test]
fn the_source_is_never_overwritten() {
    let folder = TestFolder::new("source");
    let room = Glb::room().bytes();
    let scene = folder.write("scene.glb", &room);
    let error = bake(&scene, &folder.path().join("."), &[]).expect_err("it would overwrite its source");
    assert!(error.exit_code() == ExitCode::from(1) && error.to_string().contains("--out"), "{error}");
    assert!(contents(folder.path()) == BTreeMap::from([("scene.glb".to_owned(), room)]));
}

/// What the process has before the bake begins counts too.
#[test]
fn too_little_memory_is_named() {
    let folder = TestFolder::new("memory");
    let scene = folder.write("room.glb", &Glb::room().bytes());
    let error = bake(&scene, &folder.path().join("out"), &["--memory", "1M"]).expect_err("it has more already");
    assert!(error.to_string().contains("1 MiB") && error.to_string().contains("--memory"), "{error}");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn a_truncated_file_is_named() {
    let room = Glb::room().bytes();
    let text = error_of("truncated", "room.glb", &room[..room.len() / 2]);
    assert!(text.contains("room.glb") && text.contains("truncated"), "{text}");
}

#[test]
fn what_is_not_gltf_is_named() {
    let text = error_of("picture", "room.glb", b"\x89PNG and so on");
    assert!(text.contains("not a glTF file"), "{text}");
}

#[test]
fn a_missing_texture_is_named() {
    let mut room = Glb::room();
    room.images.push(r#"{"uri":"bricks.png"}"#.into());
    let text = error_of("texture", "room.glb", &room.bytes());
    assert!(text.contains("bricks.png"), "{text}");
}

#[test]
fn a_missing_buffer_is_named() {
    let text = Glb::room().json("").replace(r#""buffers":[{"#, r#""buffers":[{"uri":"room.bin","#);
    let text = error_of("buffer", "room.gltf", text.as_bytes());
    assert!(text.contains("room.bin"), "{text}");
}

#[test]
fn a_scene_without_meshes_is_named() {
    let mut glb = Glb::default();
    glb.point_light([0.0; 3], 100.0);
    let text = error_of("meshes", "lamp.glb", &glb.bytes());
    assert!(text.contains("no surface"), "{text}");
}

#[test]
fn a_scene_without_lights_is_named() {
    let mut room = Glb::room();
    room.lights.clear();
    room.nodes.pop();
    let text = error_of("lights", "dark.glb", &room.bytes());
    assert!(text.contains("no light"), "{text}");
}

/// Such an index makes the loader panic.
#[test]
fn an_index_beyond_the_vertices_is_named() {
    let mut room = Glb::room();
    let (positions, indices) = (room.positions(&[[0.0; 3]; 3]), room.indices(&[0, 1, 3]));
    room.meshes.push(format!(
        r#"{{"name":"Torn","primitives":[{{"attributes":{{"POSITION":{positions}}},"indices":{indices}}}]}}"#
    ));
    let text = error_of("index", "room.glb", &room.bytes());
    assert!(text.contains("Torn") && text.contains("vertex 3"), "{text}");
}

#[test]
fn draco_is_named() {
    let text = Glb::room().json(r#""extensionsRequired":["KHR_draco_mesh_compression"]"#);
    let folder = TestFolder::new("draco-buffer");
    let buffer = folder.write("room.bin", &Glb::room().buffer);
    let uri = format!(r#""buffers":[{{"uri":{buffer:?},"#);
    let text = error_of("draco", "room.gltf", text.replace(r#""buffers":[{"#, &uri).as_bytes());
    assert!(text.contains("Draco"), "{text}");
}

/// The triangle is left out and counted; the rest is baked.
#[test]
fn nan_is_a_warning() {
    let mut room = Glb::room();
    room.quad("Broken", [[0.0, f32::NAN, 0.0], [1.0, 0.5, 0.0], [1.0, 0.5, 1.0], [0.0, 0.5, 1.0]]);
    let folder = TestFolder::new("nan");
    let out = folder.path().join("out");
    bake(&folder.write("room.glb", &room.bytes()), &out, &[]).expect("the rest can be baked");
    let report = json(&out.join("report.json"));
    let counted =
        |warning: &Value| warning.as_str().is_some_and(|text| text.starts_with("2 triangles") && text.contains("NaN"));
    assert!(report["warnings"].as_array().expect("a list").iter().any(counted), "{report}");
}

/// The bake goes on with the factor of the material.
#[test]
fn a_webp_texture_is_a_warning() {
    let mut room = Glb::room();
    let view = room.view(b"RIFF....WEBPVP8 ");
    room.images.push(format!(r#"{{"name":"Bricks","mimeType":"image/webp","bufferView":{view}}}"#));
    room.textures.push(r#"{"extensions":{"EXT_texture_webp":{"source":0}}}"#.into());
    room.materials[0] = r#"{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}"#.into();
    let folder = TestFolder::new("webp");
    let out = folder.path().join("out");
    bake(&folder.write("room.glb", &room.bytes()), &out, &[]).expect("it is baked without the texture");
    let report = json(&out.join("report.json"));
    assert!(report["warnings"][0].as_str().is_some_and(|text| text.contains("Bricks") && text.contains("WebP")));
    // The picture itself is still there.
    assert_eq!(glb_json(&out.join("scene.glb"))["images"][0]["mimeType"], "image/webp");
}

#[test]
fn wrong_arguments_are_usage_errors() {
    for args in [
        &["bake", "--resolution", "3"][..],
        &["bake", "--resolution", "12"],
        &["bake", "--threads", "257"],
        &["bake", "--quality", "best"],
        &["bake", "a.glb", "b.glb"],
    ] {
        let error = try_run(args.iter().map(OsString::from), &AtomicBool::new(false)).expect_err("it makes no sense");
        assert_eq!(error.exit_code(), ExitCode::from(2), "{args:?}");
    }
}
