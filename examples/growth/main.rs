//! Bakes series of rooms with ever more triangles, texels or lamps, and draws how time and memory grow into
//! `growth_triangles.svg`, `growth_texels.svg` and `growth_lamps.svg`.
//!
//! `growth [--quick | --large] [FOLDER]`: small series, or up to 4096 x 4096 texels; where the pictures go.

mod memory;
pub mod picture;
mod rooms;
pub mod series;

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

use series::{Extent, Series};

fn main() -> Result<(), Box<dyn Error>> {
    let (mut extent, mut folder) = (Extent::Usual, PathBuf::from("."));
    for argument in env::args().skip(1) {
        match argument.as_str() {
            "--quick" => extent = Extent::Quick,
            "--large" => extent = Extent::Large,
            other if other.starts_with('-') => return Err(format!("unknown option {other}; see the source").into()),
            other => folder = other.into(),
        }
    }
    fs::create_dir_all(&folder)?;
    for series in run(extent)? {
        let file = folder.join(format!("growth_{}.svg", series.name));
        fs::write(&file, picture::draw(&series)?)?;
        println!("{} shows it\n", file.display());
    }
    Ok(())
}

/// Bakes and prints all series.
pub fn run(extent: Extent) -> Result<[Series; 3], Box<dyn Error>> {
    Ok([series::triangles(extent)?, series::texels(extent)?, series::lamps(extent)?])
}
