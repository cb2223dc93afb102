//! What `report.json` says.

use std::fs;

use radiosity::bake::Report;
use radiosity::lightmap::Resolution;
use serde::Serialize;
use sysinfo::{ProcessRefreshKind, ProcessesToUpdate, System};

use super::args::Args;

/// Everything that `report.json` says.
#[derive(Serialize)]
pub(super) struct ReportFile<'a> {
    version: &'static str,
    scene: &'a str,
    settings: Settings,
    seconds: f64,
    triangles: usize,
    surfaces: usize,
    texels: usize,
    valid_texels: usize,
    invalid_texels: usize,
    patches: usize,
    nodes: usize,
    images: usize,
    texels_per_meter: f32,
    ev100: f32,
    threads: usize,
    seed: u64,
    peak_memory_bytes: u64,
    estimated_memory_bytes: u64,
    stages: Vec<Stage>,
    closure_error: f32,
    energy_balance: f32,
    estimated_error: EstimatedError,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct Settings {
    quality: String,
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
    bias: f32,
}

impl<'a> ReportFile<'a> {
    /// Puts together what the bake and what the command line know.
    pub fn new(args: &Args, scene: &'a str, report: &Report, ev100: f32, seconds: f64, warnings: &'a [String]) -> Self {
        let settings = args.settings();
        Self {
            version: env!("CARGO_PKG_VERSION"),
            scene,
            settings: Settings {
                quality: format!("{:?}", settings.quality).to_lowercase(),
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
            texels: report.texels,
            valid_texels: report.valid_texels,
            invalid_texels: report.invalid_texels,
            patches: report.patches,
            nodes: report.nodes,
            images: report.images,
            texels_per_meter: report.texels_per_meter,
            ev100,
            threads: report.threads,
            seed: report.seed,
            peak_memory_bytes: peak_memory_bytes(),
            estimated_memory_bytes: report.estimated_memory_bytes,
            stages: report
                .stages
                .iter()
                .map(|stage| Stage { name: stage.name, seconds: stage.seconds, rays: stage.rays })
                .collect(),
            closure_error: report.closure_error,
            energy_balance: report.energy_balance,
            estimated_error: EstimatedError { rms: report.estimated_error.rms, bias: report.estimated_error.bias },
            warnings,
        }
    }
}

/// The most memory that this process had; where the system does not tell, what it has now.
fn peak_memory_bytes() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix("kB"));
    peak.and_then(|kibibytes| kibibytes.trim().parse::<u64>().ok())
        .map_or_else(memory_bytes, |kibibytes| kibibytes << 10)
}

fn memory_bytes() -> u64 {
    let Ok(own) = sysinfo::get_current_pid() else { return 0 };
    let mut system = System::new();
    let memory = ProcessRefreshKind::nothing().with_memory();
    system.refresh_processes_specifics(ProcessesToUpdate::Some(&[own]), false, memory);
    system.process(own).map_or(0, |process| process.memory())
}
