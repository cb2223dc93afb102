//! Five scenes made in code, as glTF files, and as pictures of what Bevy shows with their lightmaps.

mod colonnade;
mod furnished_room;
mod model;
mod pictures;
mod shape;
mod spline;
mod stairwell;
mod thin_walls;
#[path = "../viewer/windowless.rs"]
mod windowless;

use std::error::Error;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use bevy_radiosity::cli::{try_run, write_glb};
use radiosity::render::Camera;
use radiosity::scene::{cornell_box, cornell_camera};

use crate::model::Exhibit;

const HELP: &str = "\
gallery --scenes DIR       writes NAME.glb of each scene
gallery --pictures DIR     bakes each scene into DIR/NAME, unless it is baked there already,
                           and writes NAME.png as Bevy shows it
        --only NAME        of one scene alone";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let only = match words[..] {
        [_, _, "--only", name] => Some(name),
        _ => None,
    };
    let exhibits = exhibits().into_iter().filter(|exhibit| only.is_none_or(|name| name == exhibit.name));
    let exhibits: Vec<Exhibit> = exhibits.collect();
    let done = match words[..] {
        _ if exhibits.is_empty() => Err("there is no such scene".into()),
        ["--scenes", folder] | ["--scenes", folder, "--only", _] => write_scenes(&exhibits, Path::new(folder)),
        ["--pictures", folder] | ["--pictures", folder, "--only", _] => make_pictures(exhibits, Path::new(folder)),
        _ => {
            eprintln!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn exhibits() -> Vec<Exhibit> {
    let (transform, fov_y) = cornell_camera();
    let camera = Camera::perspective(transform, fov_y);
    let cornell = Exhibit { name: "cornell", scene: cornell_box(), camera, aspect: 1.0, ev100: 7.9, density: 256.0 };
    vec![cornell, furnished_room::exhibit(), thin_walls::exhibit(), colonnade::exhibit(), stairwell::exhibit()]
}

fn write_scenes(exhibits: &[Exhibit], folder: &Path) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    for Exhibit { name, scene, camera, aspect, .. } in exhibits {
        let triangles: usize = scene.surfaces.iter().map(|surface| scene.meshes[surface.mesh].triangles.len()).sum();
        let path = folder.join(name).with_extension("glb");
        fs::write(&path, write_glb(scene, camera, *aspect)?)?;
        println!("{}: {triangles} triangles, {} surfaces", path.display(), scene.surfaces.len());
    }
    Ok(())
}

fn make_pictures(exhibits: Vec<Exhibit>, folder: &Path) -> Result<(), Box<dyn Error>> {
    let folder = std::path::absolute(folder)?;
    write_scenes(&exhibits, &folder)?;
    for Exhibit { name, density, .. } in &exhibits {
        let (scene, out) = (folder.join(name).with_extension("glb"), folder.join(name));
        if !out.join("manifest.json").exists() {
            let density = density.to_string();
            let words = ["bake".as_ref(), scene.as_os_str(), "--out".as_ref(), out.as_os_str(), "--views".as_ref()];
            let words = words.into_iter().chain(["--texels-per-meter".as_ref(), OsStr::new(&density)]);
            println!("{}", try_run(words.map(OsStr::to_owned), &AtomicBool::new(false))?);
        }
    }
    pictures::take(exhibits, &folder)
}
