//! The lightmaps of a folder for other lamps and colors, without a ray.

use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use bevy::math::Vec3;
use radiosity::lightmap::LightmapImage;
use radiosity::progress::Progress;
use radiosity::transport::{Lighting, Relighter, Transport};

use super::args::{Args, NamedColor};
use super::error::CliError;
use super::exr;
use super::images::exr_name;
use super::output::Staging;
use super::write::TRANSPORT;
use crate::baked::ktx2;
use crate::baked::manifest::{FILE_NAME, Manifest};

/// The name of the sky among the lights.
const SKY: &str = "sky";

/// Writes the lightmaps of a folder anew, and nothing else of it. What changes is the light of the bake: an earlier
/// relighting does not count.
pub(super) fn relight(folder: &Path, args: &Args, interrupted: &AtomicBool) -> Result<String, CliError> {
    let bytes = read(folder, TRANSPORT)?;
    let transport = Transport::read(&bytes).map_err(|error| failed(folder, TRANSPORT, &error))?;
    let manifest: Manifest =
        serde_json::from_slice(&read(folder, FILE_NAME)?).map_err(|error| failed(folder, FILE_NAME, &error))?;
    let lighting = changed(&transport, args)?;
    let mut relighter = Relighter::new(&transport, args.threads);
    let relit = relighter.relight(&lighting, &Progress::default()).map_err(|error| CliError::new(error.to_string()))?;
    if manifest.images.len() != relit.images.len() {
        return Err(CliError::new(format!("{FILE_NAME} and {TRANSPORT} are of different bakes; bake the scene again")));
    }
    let mut staging = Staging::new(folder, interrupted)?;
    for ((entry, stored), texels) in manifest.images.iter().zip(&transport.images).zip(relit.images) {
        let image = LightmapImage { width: stored.width, height: stored.height, texels, ..Default::default() };
        staging.write(&entry.file, &ktx2::encode(&image))?;
        staging.write(&exr_name(&entry.file), &exr::encode(&image)?)?;
    }
    staging.commit()?;
    let (count, milliseconds) = (manifest.images.len(), 1e3 * relit.report.seconds());
    Ok(format!("{}: {count} lightmap(s) relit in {milliseconds:.0} ms", folder.display()))
}

fn read(folder: &Path, name: &str) -> Result<Vec<u8>, CliError> {
    fs::read(folder.join(name)).map_err(|error| {
        CliError::new(format!("{}: {error}; bake the scene with --transport first", folder.join(name).display()))
    })
}

fn failed(folder: &Path, name: &str, error: &impl std::fmt::Display) -> CliError {
    CliError::new(format!("{}: {error}", folder.join(name).display()))
}

/// The light of the bake with the changes that were asked for.
fn changed(transport: &Transport, args: &Args) -> Result<Lighting, CliError> {
    let mut lighting = transport.lighting.clone();
    let with_name = |names: &[String], name: &str| -> Vec<usize> {
        names.iter().enumerate().filter(|(_, other)| *other == name).map(|(index, _)| index).collect()
    };
    let emits = |index: &usize| transport.lighting.materials[*index].emissive != Vec3::ZERO;
    for NamedColor { name, color } in &args.light {
        let lamps = with_name(&transport.lamp_names, name);
        let emitters: Vec<usize> = with_name(&transport.material_names, name).into_iter().filter(emits).collect();
        let is_sky = name == SKY && transport.lighting.sky != Vec3::ZERO;
        if lamps.is_empty() && emitters.is_empty() && !is_sky {
            let all = transport.material_names.iter().enumerate().filter(|(index, _)| emits(index));
            return Err(unknown("light", name, transport.lamp_names.iter().chain(all.map(|(_, name)| name))));
        }
        if is_sky {
            lighting.sky *= Vec3::from(*color);
        }
        lamps.into_iter().for_each(|lamp| lighting.lamps[lamp] *= Vec3::from(*color));
        emitters.into_iter().for_each(|material| lighting.materials[material].emissive *= Vec3::from(*color));
    }
    for NamedColor { name, color } in &args.material {
        let materials = with_name(&transport.material_names, name);
        if materials.is_empty() {
            return Err(unknown("material", name, transport.material_names.iter()));
        }
        materials.into_iter().for_each(|material| lighting.materials[material].base_color = (*color).into());
    }
    Ok(lighting)
}

fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a String>) -> CliError {
    let known: Vec<&str> = known.map(String::as_str).collect();
    CliError::new(format!("the bake has no {what} \"{name}\"; it has: {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::super::try_run;
    use super::*;

    /// A bake keeps what relighting needs; the same light gives nearly the same bytes, another one others.
    #[test]
    fn a_folder_is_relit() {
        let folder = std::env::temp_dir().join(format!("radiosity-relight-{}", std::process::id()));
        let out = folder.to_string_lossy().into_owned();
        let run = |args: &[&str]| {
            let args = [&["bake"], args].concat().into_iter().map(std::ffi::OsString::from);
            try_run(args, &AtomicBool::new(false))
        };
        run(&["--out", &out, "--quality", "draft", "--texels-per-meter", "60", "--transport"]).unwrap();
        let transport = Transport::read(&fs::read(folder.join(TRANSPORT)).unwrap()).unwrap();
        let is_lamp = |index: &usize| transport.lighting.materials[*index].emissive != Vec3::ZERO;
        let lamp = &transport.material_names[(0..transport.material_names.len()).find(is_lamp).unwrap()];
        let mut sums = Vec::new();
        for factor in ["1", "0.5", "0"] {
            run(&["--relight", &out, "--light", &format!("{lamp}={factor}")]).unwrap();
            let bytes = fs::read(folder.join("lightmap-0.ktx2")).unwrap();
            sums.push(bytes[bytes.len() / 2..].iter().map(|&byte| u64::from(byte)).sum::<u64>());
        }
        assert!(sums[0] != sums[1] && sums[1] != sums[2] && sums[2] == 0, "{sums:?}");
        let error = run(&["--relight", &out, "--light", "nobody=1"]).unwrap_err().to_string();
        assert!(error.contains("nobody") && error.contains(lamp.as_str()), "{error}");
        fs::write(folder.join(TRANSPORT), "nothing").unwrap();
        assert!(run(&["--relight", &out]).unwrap_err().to_string().contains("no stored transport"));
        fs::remove_dir_all(folder).unwrap();
    }
}
