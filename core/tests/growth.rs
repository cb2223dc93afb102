//! How rays and memory grow with triangles, texels and lamps. How long they take is not for a test to say.

#[path = "../../examples/growth/main.rs"]
#[expect(dead_code, reason = "the test draws no files")]
mod growth;

use growth::series::{Extent, Series, lamps, texels, triangles};
use radiosity::bake::Report;

/// What a bake has for each valid texel.
fn per_texel(report: &Report, all: f64) -> f64 {
    all / report.valid_texels as f64
}

fn rays(report: &Report) -> f64 {
    report.stages.iter().map(|stage| stage.rays as f64).sum()
}

/// A number of the last bake of a series over that of the first.
fn ratio(series: &Series, number: impl Fn(&Report) -> f64) -> f64 {
    let ends = [series.bakes.first(), series.bakes.last()].map(|bake| number(&bake.expect("bakes").1));
    ends[1] / ends[0]
}

/// Rays grow no faster than texels, since light is smoother from texel to texel; what the plan adds for each texel does
/// not depend on their number.
#[test]
fn rays_and_memory_are_linear_in_texels() {
    let series = texels(Extent::Quick).expect("it can be baked");
    let grown = ratio(&series, |report| report.valid_texels as f64);
    assert!(grown > 8.0, "{grown}");
    let of_rays = ratio(&series, |report| per_texel(report, rays(report)));
    assert!(of_rays < 1.1, "{of_rays} times the rays of a texel");
    let planned = |report: &Report| report.estimated_memory_bytes as f64;
    let added: Vec<f64> = series
        .bakes
        .windows(2)
        .map(|two| (planned(&two[1].1) - planned(&two[0].1)) / (two[1].1.texels - two[0].1.texels) as f64)
        .collect();
    assert!(added.iter().all(|&bytes| (100.0..800.0).contains(&bytes)), "{added:?} bytes for a texel more");
    assert!(growth::picture::draw(&series).expect("room for it").contains("polyline"));
}

/// The same surfaces in 250 times as many triangles ask for as many rays, and for no more than a tree of them.
#[test]
fn rays_do_not_depend_on_triangles() {
    let series = triangles(Extent::Quick).expect("it can be baked");
    let grown = ratio(&series, |report| report.triangles as f64);
    assert!(grown > 50.0, "{grown}");
    let of_rays = ratio(&series, |report| per_texel(report, rays(report)));
    assert!((0.7..1.3).contains(&of_rays), "{of_rays} times the rays of a texel");
    let ends = [&series.bakes[0].1, &series.bakes[2].1];
    let [few, many] = ends.map(|report| report.estimated_memory_bytes as f64);
    let more = (many - few) / (ends[1].triangles - ends[0].triangles) as f64;
    assert!(more < 600.0, "{more} bytes for a triangle more");
}

/// 64 times as many lamps in the same rooms ask for far fewer than 64 times as many shadow rays.
#[test]
fn rays_grow_slower_than_lamps() {
    let series = lamps(Extent::Quick).expect("it can be baked");
    let shadow = |report: &Report| {
        let direct = report.stages.iter().find(|stage| stage.name == "direct").expect("it has the stage");
        per_texel(report, direct.rays as f64)
    };
    let grown = ratio(&series, shadow);
    assert!(grown < 8.0, "{grown} times the rays of a texel");
}
