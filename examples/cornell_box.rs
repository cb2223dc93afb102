//! Bakes the measured Cornell box without any engine and writes what its camera sees to `cornell_box.ppm`.

use std::error::Error;
use std::fs;

use radiosity::bake::{BakeSettings, bake};
use radiosity::lightmap::{LayoutSettings, Resolution};
use radiosity::progress::Progress;
use radiosity::render::{Camera, preview};
use radiosity::scene::{cornell_box, cornell_camera};

const FILE: &str = "cornell_box.ppm";
const SIDE: u32 = 512;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = cornell_box();
    let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(512.0), ..Default::default() };
    let progress = Progress::default();
    let bake = bake(&scene, &BakeSettings { layout, ..Default::default() }, &progress)?;
    for stage in &bake.report.stages {
        println!("{:>10} {:6.2} s {:10} rays", stage.name, stage.seconds, stage.rays);
    }

    let (pose, fov_y) = cornell_camera();
    let camera = Camera::perspective(pose, fov_y);
    let picture = preview(&scene, &bake, &camera, [SIDE, SIDE], None, &progress)?;
    let header = format!("P6 {SIDE} {SIDE} 255\n");
    fs::write(FILE, [header.as_bytes(), picture.rgb.as_flattened()].concat())?;
    println!("{FILE} shows it at EV100 {:.1}", picture.ev100);
    Ok(())
}
