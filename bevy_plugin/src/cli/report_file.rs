//! What `report.json` says.

use radiosity::bake::Report;
use radiosity::lightmap::Resolution;
use radiosity::render::Truth;
use serde::Serialize;

use super::args::Args;
use super::memory;

/// Everything that `report.json` says.
#[derive(Serialize)]
pub(super) struct ReportFile<'a> {
    version: &'static str,
    scene: &'a str,
    settings: Settings,
    seconds: f64,
    triangles: usize,
    surfaces: usize,
    unwrapped: usize,
    texels: usize,
    valid_texels: usize,
    invalid_texels: usize,
    patches: usize,
    nodes: usize,
    images: usize,
    parts: usize,
    texels_per_meter: f32,
    ev100: f32,
    threads: usize,
    seed: u64,
    peak_memory_bytes: u64,
    estimated_memory_bytes: u64,
    transport_bytes: u64,
    stages: Vec<Stage>,
    closure_error: f32,
    energy_balance: f32,
    estimated_error: EstimatedError,
    #[serde(skip_serializing_if = "Option::is_none")]
    true_error: Option<TrueError>,
    seams: Seams,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct Settings {
    quality: String,
    target_error: f32,
    uv: String,
    resolution: String,
    emissive_scale: f32,
    memory_bytes: u64,
}

#[derive(Serialize)]
struct Stage {
    name: &'static str,
    seconds: f64,
    rays: u64,
}

#[derive(Serialize)]
struct EstimatedError {
    rms: f32,
    noise: f32,
    bias: f32,
}

/// What paths of light say about the bake.
#[derive(Serialize)]
struct TrueError {
    points: usize,
    left_out: usize,
    paths: u32,
    rms: f32,
    rms_without_worst: f32,
    p50: f32,
    p95: f32,
    bias: f32,
    standard_error: f32,
}

impl From<Truth> for TrueError {
    fn from(truth: Truth) -> Self {
        let Truth { points, left_out, paths, rms, rms_without_worst, p50, p95, bias, standard_error } = truth;
        Self { points, left_out, paths, rms, rms_without_worst, p50, p95, bias, standard_error }
    }
}

/// Steps between the two sides of seams.
#[derive(Serialize)]
struct Seams {
    pairs: usize,
    step_before: f32,
    step_after: f32,
    largest_before: f32,
    largest_after: f32,
}

impl<'a> ReportFile<'a> {
    /// The same with what paths of light say, if they said anything.
    pub fn with_truth(self, truth: Option<Truth>) -> Self {
        Self { true_error: truth.filter(|truth| truth.points > 0).map(Into::into), ..self }
    }

    /// Puts together what the bake and what the command line know.
    pub fn new(args: &Args, scene: &'a str, report: &Report, ev100: f32, seconds: f64, warnings: &'a [String]) -> Self {
        let settings = args.settings();
        Self {
            version: env!("CARGO_PKG_VERSION"),
            scene,
            settings: Settings {
                quality: format!("{:?}", settings.quality).to_lowercase(),
                target_error: settings.target_error,
                uv: format!("{:?}", settings.layout.uv).to_lowercase(),
                resolution: match settings.layout.resolution {
                    Resolution::Texels(texels) => format!("{texels} texels"),
                    Resolution::TexelsPerMeter(density) => format!("{density} texels per meter"),
                    Resolution::SingleImage(side) => format!("{side} x {side} texels"),
                },
                emissive_scale: args.emissive_scale,
                memory_bytes: settings.memory_bytes,
            },
            seconds,
            triangles: report.triangles,
            surfaces: report.surfaces,
            unwrapped: report.unwrapped,
            texels: report.texels,
            valid_texels: report.valid_texels,
            invalid_texels: report.invalid_texels,
            patches: report.patches,
            nodes: report.nodes,
            images: report.images,
            parts: report.parts,
            texels_per_meter: report.texels_per_meter,
            ev100,
            threads: report.threads,
            seed: report.seed,
            peak_memory_bytes: memory::peak_bytes(),
            estimated_memory_bytes: report.estimated_memory_bytes,
            transport_bytes: report.transport_bytes,
            stages: report
                .stages
                .iter()
                .map(|stage| Stage { name: stage.name, seconds: stage.seconds, rays: stage.rays })
                .collect(),
            closure_error: report.closure_error,
            energy_balance: report.energy_balance,
            estimated_error: EstimatedError {
                rms: report.estimated_error.rms,
                noise: report.estimated_error.noise,
                bias: report.estimated_error.bias,
            },
            true_error: None,
            seams: Seams {
                pairs: report.seams.pairs,
                step_before: report.seams.step_before,
                step_after: report.seams.step_after,
                largest_before: report.seams.largest_before,
                largest_after: report.seams.largest_after,
            },
            warnings,
        }
    }
}
