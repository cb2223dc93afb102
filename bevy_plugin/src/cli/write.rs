//! All files of a finished bake.

use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use radiosity::bake::{Bake, BakeSettings};
use radiosity::render::{FalseColor, Truth};
use serde::Serialize;

use super::args::Args;
use super::document::Document;
use super::error::CliError;
use super::images::exr_name;
use super::load::Loaded;
use super::output::Staging;
use super::preview::Pictures;
use super::prune::prune;
use super::report_file::ReportFile;
use super::{scene_file, sky};
use crate::baked::manifest::{self, FILE_NAME, LightEntry, Manifest, SurfaceKey};

/// The file of the transport.
pub(super) const TRANSPORT: &str = "transport.bin";

/// What is written, with all that is needed for it.
pub(super) struct Written<'a> {
    pub args: &'a Args,
    pub document: Document,
    pub loaded: Loaded,
    /// With images that may be smaller than those in the files.
    pub bake: Bake,
    /// Width and height of the lightmaps.
    pub sizes: Vec<[u32; 2]>,
    pub hash: String,
    pub start: Instant,
}

impl Written<'_> {
    /// Writes the files beside the lightmaps, those last that say what the others are, and says what came out.
    pub fn write(mut self, mut staging: Staging<'_>) -> Result<String, CliError> {
        let manifest = self.manifest();
        if let Some(transport) = &self.bake.transport {
            staging.write(TRANSPORT, &transport.write())?;
        }
        self.add_coordinates()?;
        staging.write("scene.glb", &self.document.to_glb())?;
        let ev100 = self.draw(&mut staging)?;
        let truth = self.hold(&mut staging)?;
        let Loaded { collected, .. } = &self.loaded;
        let warnings = [&collected.warnings[..], &self.bake.report.warnings].concat();
        let scene = self.args.scene.as_deref().and_then(Path::file_name);
        let scene = scene.map_or("Cornell box".into(), |name| name.to_string_lossy());
        let seconds = self.start.elapsed().as_secs_f64();
        let report = ReportFile::new(self.args, &scene, &self.bake.report, ev100, seconds, &warnings);
        let report = report.with_truth(truth);
        staging.write("report.json", &json(&report)?)?;
        staging.write(FILE_NAME, &json(&manifest)?)?;
        staging.commit()?;
        self.remove_leftovers();
        Ok(self.summary(ev100, seconds))
    }

    /// Writes the pictures; returns the EV100 of the preview.
    fn draw(&self, staging: &mut Staging<'_>) -> Result<f32, CliError> {
        let pictures = self.pictures(staging.interrupted);
        let (picture, ev100) = pictures.preview(self.args.ev100)?;
        staging.write("preview.png", &picture)?;
        for shown in FalseColor::ALL.into_iter().filter(|_| self.args.views) {
            staging.write(&format!("{}.png", shown.name()), &pictures.false_color(shown)?)?;
        }
        if let Some(file) = &self.args.render {
            pictures.render(file, (self.args.samples, self.args.gloss), ev100)?;
        }
        Ok(ev100)
    }

    /// Holds the bake against paths of light, if that is asked for.
    fn hold(&mut self, staging: &mut Staging<'_>) -> Result<Option<Truth>, CliError> {
        let Some(points) = self.args.reference else { return Ok(None) };
        let kept = self.bake.images.iter().map(|image| [image.width, image.height]);
        if kept.ne(self.sizes.iter().copied()) {
            let warning = "--reference holds lightmaps of fewer texels than the files have, for they are large";
            eprintln!("warning: {warning}");
            self.bake.report.warnings.push(warning.into());
        }
        let pictures = self.pictures(staging.interrupted);
        let truth = pictures.truth(points)?;
        let true_errors = if self.args.views { pictures.true_errors(points)? } else { Vec::new() };
        if truth.points == 0 {
            let warning = "--reference found no point to look at: all of them lie inside of geometry; ask for more";
            eprintln!("warning: {warning}");
            self.bake.report.warnings.push(warning.into());
        }
        if self.args.views {
            self.bake.true_errors = true_errors;
            let picture = self.pictures(staging.interrupted).false_color(FalseColor::Truth)?;
            staging.write("truth.png", &picture)?;
        }
        Ok(Some(truth))
    }

    fn pictures<'a>(&'a self, interrupted: &'a AtomicBool) -> Pictures<'a> {
        Pictures::new(&self.loaded.collected.scene, &self.bake, self.loaded.camera, interrupted)
    }

    fn manifest(&self) -> Manifest {
        let key = |surface: usize| {
            let source = self.loaded.sources[surface];
            let node_name = self.document.list("nodes").get(source.node)?["name"].as_str()?.to_owned();
            let (node, mesh, primitive) = (source.node, source.mesh, source.primitive);
            Some(SurfaceKey::Gltf { node, node_name, mesh, primitive })
        };
        let mut manifest = Manifest::new(self.hash.clone(), &self.bake, key);
        for (image, &size) in manifest.images.iter_mut().zip(&self.sizes) {
            image.exr = Some(exr_name(&image.file));
            [image.width, image.height] = size;
        }
        manifest.lights = self.loaded.light_nodes.iter().map(|&node| LightEntry::Gltf { node }).collect();
        manifest
    }

    /// Puts the lightmap coordinates of every baked primitive into the glTF file, once.
    fn add_coordinates(&mut self) -> Result<(), CliError> {
        let (mut done, mut replaced) = (HashSet::new(), HashSet::new());
        for (source, surface) in self.loaded.sources.iter().zip(&self.loaded.collected.scene.surfaces) {
            let Some(uv) = &self.bake.uvs[surface.mesh] else { continue };
            if done.insert((source.mesh, source.primitive)) {
                scene_file::set_lightmap_uv(&mut self.document, source.mesh, source.primitive, uv, &mut replaced)?;
            }
        }
        prune(&mut self.document, &replaced);
        Ok(())
    }

    /// Removes the lightmaps of an earlier bake that had more of them.
    fn remove_leftovers(&self) {
        for index in self.bake.images.len().. {
            let [lightmap, exr] = ["ktx2", "exr"].map(|kind| self.args.out.join(format!("lightmap-{index}.{kind}")));
            // The EXR may be gone already.
            drop(fs::remove_file(exr));
            if fs::remove_file(lightmap).is_err() {
                break;
            }
        }
    }

    fn summary(&self, ev100: f32, seconds: f64) -> String {
        let report = &self.bake.report;
        let images: Vec<String> = self.sizes.iter().map(|[width, height]| format!("{width} x {height}")).collect();
        format!(
            "{}: {} lightmap(s) of {} texels for {} surfaces, {:.2} texels per meter, EV100 {ev100:.1}, {seconds:.1} s",
            self.args.out.display(),
            images.len(),
            images.join(", "),
            report.surfaces,
            report.texels_per_meter,
        )
    }
}

fn json(value: &impl Serialize) -> Result<Vec<u8>, CliError> {
    serde_json::to_vec_pretty(value).map_err(|error| CliError::new(format!("cannot write JSON: {error}")))
}

/// Hash of the scene and of all settings that have a say in the texels.
pub(super) fn hash(document: &Document, args: &Args, settings: &BakeSettings) -> String {
    // The result depends on neither threads nor memory.
    let settings = BakeSettings { threads: 0, memory_bytes: 0, ..settings.clone() };
    let said = format!("{settings:?} {}", args.emissive_scale);
    let parts = [document.json.to_string().as_bytes(), &document.buffer, said.as_bytes(), &sky::bytes(args)].concat();
    manifest::hash(&parts)
}
