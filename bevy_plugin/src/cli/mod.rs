//! The command line: from a glTF file to a folder that Bevy loads.

mod accessor;
mod args;
mod document;
mod error;
mod export;
mod exr;
mod images;
mod load;
mod loadable;
mod memory;
mod meshopt;
mod names;
mod output;
mod preview;
mod progress;
mod prune;
mod ray_dump;
mod relight;
mod report_file;
mod scene_file;
mod sky;
mod write;

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use radiosity::bake::{Bake, BakeSettings, bake_into};
use radiosity::geometry::RayLog;
use radiosity::lightmap::LightmapImage;
use radiosity::progress::{Cancelled, Progress};
use radiosity::scene::Scene;

pub use self::error::CliError;
pub use self::export::write_glb;

use self::args::Args;
use self::document::Document;
use self::images::Images;
use self::memory::Budget;
use self::output::Staging;
use self::progress::Display;
use self::ray_dump::RayDump;

/// Set by Ctrl-C.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Bakes as the arguments say; the first is the name of the program. Ctrl-C cancels.
///
/// The exit code is 0 when the lightmaps are written, 1 when it failed, 2 when the arguments make no sense, and 130 when
/// it was cancelled.
pub fn run(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    static HANDLER: Once = Once::new();
    HANDLER.call_once(|| {
        let interrupt = || {
            if INTERRUPTED.swap(true, Ordering::Relaxed) {
                // Asked twice, it waits no longer than a file takes to write.
                output::clean_up_and_exit();
            }
        };
        if let Err(error) = ctrlc::set_handler(interrupt) {
            eprintln!("warning: Ctrl-C will not clean up ({error})");
        }
    });
    // An earlier run may have been cancelled.
    INTERRUPTED.store(false, Ordering::Relaxed);
    match try_run(args, &INTERRUPTED) {
        Ok(summary) => {
            println!("{summary}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            report(&error);
            error.exit_code()
        }
    }
}

/// Tells an error; help, which comes as one, on standard output.
fn report(error: &CliError) {
    match error {
        // It is lost where nobody listens.
        CliError::Usage(error) => drop(error.print()),
        _ => eprintln!("{error}"),
    }
}

/// Bakes as [`run`] does, until `interrupted` becomes true. Returns what is to be told in the end.
///
/// # Errors
///
/// See [`CliError`]. What lay in the folder before is as it was.
pub fn try_run(args: impl IntoIterator<Item = OsString>, interrupted: &AtomicBool) -> Result<String, CliError> {
    let args = Args::read(args).map_err(CliError::Usage)?;
    match &args.relight {
        Some(folder) => relight::relight(folder, &args, interrupted),
        None => bake_to_folder(&args, interrupted),
    }
}

/// The scene of a glTF file, as the command line bakes it.
///
/// # Errors
///
/// The file cannot be read or has no scene.
pub fn read_scene(path: &Path) -> Result<Scene, CliError> {
    Ok(load::load(&Document::read(path)?)?.collected.scene)
}

/// The whole way, in its order.
fn bake_to_folder(args: &Args, interrupted: &AtomicBool) -> Result<String, CliError> {
    let start = Instant::now();
    keep_source(args)?;
    find_folder(args)?;
    let mut document = match &args.scene {
        Some(path) => Document::read(path)?,
        None => export::cornell_document()?,
    };
    let settings = args.settings();
    let hash = write::hash(&document, args, &settings);
    names::make_unique(&mut document);
    let mut loaded = load::load(&document)?;
    for material in &mut loaded.collected.scene.materials {
        material.emissive *= args.emissive_scale;
    }
    sky::add(args, &mut loaded.collected.scene)?;
    for warning in &loaded.collected.warnings {
        eprintln!("warning: {warning}");
    }
    let mut staging = Staging::new(&args.out, interrupted)?;
    let memory = Budget::new(settings.memory_bytes)?;
    let settings = BakeSettings { memory_bytes: memory.left(), ..settings };
    let scene = &loaded.collected.scene;
    let dump = args.dump_rays.as_ref().map(|file| (RayDump::default(), file));
    let log = dump.as_ref().map(|(dump, _)| dump as &dyn RayLog);
    let (mut bake, sizes) = bake_watched(scene, &settings, &memory, log, &mut staging)?;
    if let Some((dump, file)) = dump {
        dump.write(file)?;
    }
    bake.report.estimated_memory_bytes += memory.resident;
    for warning in &bake.report.warnings {
        eprintln!("warning: {warning}");
    }
    let written = write::Written { args, document, loaded, bake, sizes, hash, start };
    written.write(staging)
}

/// The scene that is read must not be the one that is written: the baked one is no substitute for it.
fn keep_source(args: &Args) -> Result<(), CliError> {
    let Some(scene) = &args.scene else { return Ok(()) };
    match (fs::canonicalize(scene), fs::canonicalize(args.out.join("scene.glb"))) {
        (Ok(read), Ok(written)) if read == written => Err(CliError::new(format!(
            "{} would be overwritten by what is baked of it; choose another folder by --out",
            scene.display()
        ))),
        _ => Ok(()),
    }
}

/// The folder of the picture must be there before the bake, not be missing after it.
fn find_folder(args: &Args) -> Result<(), CliError> {
    let Some(file) = &args.render else { return Ok(()) };
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    match folder {
        Some(folder) if !folder.is_dir() => {
            let (folder, file) = (folder.display(), file.display());
            Err(CliError::new(format!("--render {file}: there is no folder {folder}; make it or choose another file")))
        }
        _ => Ok(()),
    }
}

/// Bakes on a thread of its own, writes the lightmaps as they come, shows how far it is, and stops when interrupted. The
/// images of the bake may be smaller than those that are written, whose sizes come with it.
fn bake_watched(
    scene: &Scene,
    settings: &BakeSettings,
    memory: &Budget,
    log: Option<&dyn RayLog>,
    staging: &mut Staging,
) -> Result<(Bake, Vec<[u32; 2]>), CliError> {
    let (progress, interrupted) = (Progress::default(), staging.interrupted);
    let (mut images, mut failure) = (Images::default(), None);
    let mut take = |index: usize, image: LightmapImage| {
        images.take(index, image, staging).map_err(|error| {
            failure = Some(error);
            Cancelled
        })
    };
    let mut display = Display::new();
    let result = thread::scope(|scope| {
        let worker = scope.spawn(|| bake_into(scene, settings, &progress, log, &mut take));
        while !worker.is_finished() {
            if interrupted.load(Ordering::Relaxed) {
                progress.cancel();
            }
            display.update(&progress);
            thread::sleep(Duration::from_millis(20));
        }
        worker.join()
    });
    display.finish();
    if interrupted.load(Ordering::Relaxed) {
        return Err(CliError::Cancelled);
    }
    if let Some(failure) = failure {
        return Err(failure);
    }
    match result {
        Ok(result) => {
            let mut bake = result.map_err(|error| memory.add(error))?;
            let sizes = images.put_into(&mut bake);
            Ok((bake, sizes))
        }
        Err(_) => Err(CliError::new("the bake ended in an error of its own, which is told above; please report it")),
    }
}
