//! What is measured: series of scenes in which one number grows.

use std::error::Error;

use radiosity::bake::{BakeSettings, Quality, Report, bake};
use radiosity::lightmap::{LayoutSettings, Resolution};
use radiosity::progress::{Progress, Stage};
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
    /// What time is measured, and how.
    pub time: Curve,
    /// The most memory that was used at a time, in MiB.
    pub memory: Curve,
    /// The reports of the bakes, each with the number that grows.
    pub bakes: Vec<(usize, Report)>,
}

/// What is measured, over the number that grows.
pub struct Curve {
    /// What it is, with its unit.
    pub measured: &'static str,
    /// The number, and what was measured.
    pub points: Vec<[f64; 2]>,
    /// The growth that should not be exceeded, which is drawn beside it.
    pub law: Law,
}

/// How something may grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// As the number.
    Linear,
    /// As its logarithm.
    Logarithmic,
}

impl Law {
    /// Where a curve through a point goes at a number.
    pub fn at(self, [x, y]: [f64; 2], number: f64) -> f64 {
        match self {
            Self::Linear => y * number / x,
            Self::Logarithmic => y * number.ln() / x.ln(),
        }
    }
}

impl Curve {
    /// The exponent of the power law that fits best: least squares of the logarithms.
    pub fn slope(&self) -> f64 {
        let logs: Vec<[f64; 2]> = self.points.iter().map(|point| point.map(f64::ln)).collect();
        let count = logs.len() as f64;
        let [x, y] = [0, 1].map(|axis| logs.iter().map(|log| log[axis]).sum::<f64>() / count);
        let above: f64 = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum();
        above / logs.iter().map(|log| (log[0] - x) * (log[0] - x)).sum::<f64>()
    }
}

/// Bakes, and the memory that each took.
#[derive(Default)]
struct Bakes(Vec<(usize, Report, u64)>);

impl Bakes {
    fn add(&mut self, number: impl FnOnce(&Report) -> usize, scene: &Scene, resolution: Resolution) -> Outcome {
        let layout = LayoutSettings { resolution, ..Default::default() };
        let settings = BakeSettings { layout, quality: Quality::Draft, ..Default::default() };
        let before = memory::start();
        let report = bake(scene, &settings, &Progress::default())?.report;
        let peak = memory::peak().saturating_sub(before);
        print(&report, scene.lights.len(), peak);
        self.0.push((number(&report), report, peak));
        Ok(())
    }

    /// The time of each bake, as `seconds` has it, and its memory.
    fn series(self, name: &'static str, measured: &'static str, law: Law, seconds: fn(&Report) -> f64) -> Series {
        let time = self.0.iter().map(|(number, report, _)| [*number as f64, seconds(report)]).collect();
        let memory = self.0.iter().map(|(number, _, peak)| [*number as f64, *peak as f64 / 1048576.0]);
        let series = Series {
            name,
            time: Curve { measured, points: time, law },
            memory: Curve { measured: "MiB at most", points: memory.collect(), law: Law::Linear },
            bakes: self.0.into_iter().map(|(number, report, _)| (number, report)).collect(),
        };
        let [time, memory] = [&series.time, &series.memory].map(Curve::slope);
        println!("{measured} grow as the number of {name} to the power of {time:.2}, memory to that of {memory:.2}");
        series
    }
}

type Outcome = Result<(), Box<dyn Error>>;

/// Seconds and rays of a stage.
fn stage(report: &Report, name: &str) -> (f64, f64) {
    let found = report.stages.iter().find(|stage| stage.name == name);
    found.map_or((0.0, 0.0), |stage| (stage.seconds, stage.rays as f64))
}

fn print_head(what: &str) {
    println!("{what}; seconds of each stage:");
    let stages: String = Stage::ALL.iter().map(|stage| format!("{:>10}", stage.name())).collect();
    println!(
        "{:>9}{:>10}{:>10}{:>6}{:>9}{:>9}{stages}{:>9}{:>9}{:>8}",
        "triangles", "texels", "valid", "lamps", "Mnodes", "Mrays", "est. MiB", "peak MiB", "B/texel"
    );
}

fn print(report: &Report, lamps: usize, peak: u64) {
    let Report { triangles, texels, valid_texels, nodes, stages, estimated_memory_bytes, .. } = report;
    let seconds: String = stages.iter().map(|stage| format!("{:>10.3}", stage.seconds)).collect();
    let rays: u64 = stages.iter().map(|stage| stage.rays).sum();
    println!(
        "{triangles:>9}{texels:>10}{valid_texels:>10}{lamps:>6}{:>9.3}{:>9.1}{seconds}{:>9}{:>9}{:>8.0}",
        *nodes as f64 * 1e-6,
        rays as f64 * 1e-6,
        estimated_memory_bytes >> 20,
        peak >> 20,
        peak as f64 / *texels as f64,
    );
}

/// Time for a gathered ray in ever more rooms, whose blocks are cut into ever more triangles.
pub fn triangles(extent: Extent) -> Result<Series, Box<dyn Error>> {
    let cubes: &[(usize, usize)] = match extent {
        Extent::Quick => &[(1, 2), (1, 8), (1, 32)],
        _ => &[(2, 4), (3, 3), (4, 5), (5, 7), (7, 7), (10, 7)],
    };
    print_head("More rooms, and more triangles in each");
    let mut bakes = Bakes::default();
    for &(count, cuts) in cubes {
        let texels = if extent == Extent::Quick { 1 << 13 } else { 1 << 18 };
        bakes.add(|report| report.triangles, &rooms(count, cuts, count.pow(3).min(8)), Resolution::Texels(texels))?;
    }
    Ok(bakes.series("triangles", "ns for a gathered ray", Law::Logarithmic, |report| {
        let (seconds, rays) = stage(report, "gather");
        1e9 * seconds / rays
    }))
}

/// Time of a bake of ever more texels.
pub fn texels(extent: Extent) -> Result<Series, Box<dyn Error>> {
    let sides: &[u32] = match extent {
        Extent::Quick => &[64, 128, 256],
        Extent::Usual => &[64, 128, 256, 512, 1024, 2048],
        Extent::Large => &[64, 128, 256, 512, 1024, 2048, 4096],
    };
    print_head("More texels");
    let mut bakes = Bakes::default();
    for &side in sides {
        bakes.add(|report| report.texels, &rooms(1, 2, 1), Resolution::SingleImage(side))?;
    }
    let all = |report: &Report| report.stages.iter().map(|stage| stage.seconds).sum();
    Ok(bakes.series("texels", "seconds for a bake", Law::Linear, all))
}

/// Time of direct light from ever more lamps.
pub fn lamps(extent: Extent) -> Result<Series, Box<dyn Error>> {
    let (rooms_along, counts, texels): (usize, &[usize], u32) = match extent {
        Extent::Quick => (2, &[8, 64, 512], 1 << 13),
        _ => (4, &[1, 4, 16, 64, 250, 1000], 1 << 18),
    };
    print_head("More lamps");
    let mut bakes = Bakes::default();
    for &lamps in counts {
        bakes.add(|_| lamps, &rooms(rooms_along, 2, lamps), Resolution::Texels(texels))?;
    }
    Ok(bakes.series("lamps", "seconds for direct light", Law::Linear, |report| stage(report, "direct").0))
}
