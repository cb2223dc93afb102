//! What is measured: series of scenes in which one number grows.

use std::error::Error;

use radiosity::bake::{BakeSettings, Quality, Report, bake};
use radiosity::lightmap::{LayoutSettings, Resolution};
use radiosity::progress::Progress;
use radiosity::scene::Scene;

use super::memory;
use super::rooms::rooms;

/// How far the series go.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// For a test.
    Quick,
    /// Up to 2048 x 2048 texels.
    Usual,
    /// Up to 4096 x 4096 texels.
    Large,
}

/// Bakes in which one number grows.
pub struct Series {
    /// What grows.
    pub name: &'static str,
    /// What is measured.
    pub measured: &'static str,
    /// The number, and what was measured.
    pub points: Vec<[f64; 2]>,
    /// The growth that should not be exceeded, which is drawn beside it.
    pub law: &'static str,
}

impl Series {
    /// The exponent of the power law that fits best: least squares of the logarithms.
    pub fn slope(&self) -> f64 {
        let logs: Vec<[f64; 2]> = self.points.iter().map(|point| point.map(f64::ln)).collect();
        let count = logs.len() as f64;
        let [x, y] = [0, 1].map(|axis| logs.iter().map(|log| log[axis]).sum::<f64>() / count);
        let above: f64 = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum();
        above / logs.iter().map(|log| (log[0] - x) * (log[0] - x)).sum::<f64>()
    }
}

/// A bake, and the memory that it took.
struct Measured {
    report: Report,
    peak: u64,
}

impl Measured {
    fn new(scene: &Scene, resolution: Resolution) -> Result<Self, Box<dyn Error>> {
        let layout = LayoutSettings { resolution, ..Default::default() };
        let settings = BakeSettings { layout, quality: Quality::Draft, ..Default::default() };
        let before = memory::start();
        let report = bake(scene, &settings, &Progress::default())?.report;
        Ok(Self { report, peak: memory::peak().saturating_sub(before) })
    }

    fn seconds(&self, stage: &str) -> f64 {
        self.report.stages.iter().filter(|report| report.name == stage).map(|report| report.seconds).sum()
    }

    fn all_seconds(&self) -> f64 {
        self.report.stages.iter().map(|stage| stage.seconds).sum()
    }

    fn rays(&self, stage: &str) -> f64 {
        self.report.stages.iter().filter(|report| report.name == stage).map(|report| report.rays as f64).sum()
    }

    fn print(&self, lamps: usize) {
        let Report { triangles, texels, valid_texels, stages, estimated_memory_bytes, .. } = &self.report;
        let stages: String = stages.iter().map(|stage| format!("{:>10.3}", stage.seconds)).collect();
        let rays: u64 = self.report.stages.iter().map(|stage| stage.rays).sum();
        println!(
            "{triangles:>9}{texels:>10}{valid_texels:>10}{lamps:>6}{:>9.1}{stages}{:>9}{:>9}{:>8.0}",
            rays as f64 * 1e-6,
            estimated_memory_bytes >> 20,
            self.peak >> 20,
            self.peak as f64 / *texels as f64,
        );
    }
}

fn print_head(what: &str) {
    println!("{what}");
    let stages: String = radiosity::progress::Stage::ALL.iter().map(|stage| format!("{:>10}", stage.name())).collect();
    println!(
        "{:>9}{:>10}{:>10}{:>6}{:>9}{stages}{:>9}{:>9}{:>8}",
        "triangles", "texels", "valid", "lamps", "Mrays", "est. MiB", "peak MiB", "B/texel"
    );
}

/// Time for a gathered ray in ever more rooms, whose blocks are cut into ever more triangles.
pub fn triangles(extent: Extent) -> Result<Series, Box<dyn Error>> {
    let cubes: &[(usize, usize)] = match extent {
        Extent::Quick => &[(1, 2), (2, 3)],
        _ => &[(2, 2), (3, 3), (4, 5), (5, 7), (7, 7), (10, 7)],
    };
    print_head("More rooms, and more triangles in each; seconds of each stage:");
    let mut points = Vec::new();
    for &(count, cuts) in cubes {
        let measured = Measured::new(&rooms(count, cuts, 8), Resolution::Texels(1 << 18))?;
        measured.print(8);
        let nanoseconds = measured.seconds("gather") / measured.rays("gather") * 1e9;
        points.push([measured.report.triangles as f64, nanoseconds]);
    }
    let series = Series {
        name: "triangles",
        measured: "ns for a gathered ray",
        points,
        law: "dashed: the logarithm of the number",
    };
    println!("time for a gathered ray grows as the number of triangles to the power of {:.2}", series.slope());
    Ok(series)
}

/// Time of a bake of ever more texels.
pub fn texels(extent: Extent) -> Result<Series, Box<dyn Error>> {
    let sides: &[u32] = match extent {
        Extent::Quick => &[64, 128],
        Extent::Usual => &[64, 128, 256, 512, 1024, 2048],
        Extent::Large => &[64, 128, 256, 512, 1024, 2048, 4096],
    };
    print_head("More texels; seconds of each stage:");
    let mut points = Vec::new();
    for &side in sides {
        let measured = Measured::new(&rooms(1, 2, 1), Resolution::SingleImage(side))?;
        measured.print(1);
        points.push([measured.report.texels as f64, measured.all_seconds()]);
    }
    let series =
        Series { name: "texels", measured: "seconds for a bake", points, law: "dashed: as the number of texels" };
    println!("time grows as the number of texels to the power of {:.2}", series.slope());
    Ok(series)
}

/// Time of direct light from ever more lamps.
pub fn lamps(extent: Extent) -> Result<Series, Box<dyn Error>> {
    let (rooms_along, counts): (usize, &[usize]) = match extent {
        Extent::Quick => (1, &[1, 10]),
        _ => (4, &[1, 4, 16, 64, 250, 1000]),
    };
    print_head("More lamps; seconds of each stage:");
    let mut points = Vec::new();
    for &lamps in counts {
        let measured = Measured::new(&rooms(rooms_along, 2, lamps), Resolution::Texels(1 << 18))?;
        measured.print(lamps);
        points.push([lamps as f64, measured.seconds("direct")]);
    }
    let series =
        Series { name: "lamps", measured: "seconds for direct light", points, law: "dashed: as the number of lamps" };
    println!("time for direct light grows as the number of lamps to the power of {:.2}", series.slope());
    Ok(series)
}
