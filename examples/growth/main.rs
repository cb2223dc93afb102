//! Bakes series of rooms with ever more triangles, texels or lamps, and draws how time and memory grow into
//! `growth_triangles.svg`, `growth_texels.svg` and `growth_lamps.svg`.
//!
//! `growth [--quick | --large] [--only SERIES] [FOLDER]`: small series, or up to 4096 x 4096 texels; only that of
//! triangles, texels or lamps; where the pictures go.
//! `growth --sixteen SIDE` bakes sixteen images of that side instead, in 8 GiB where it is 4096, else in proportion.

mod memory;
pub mod picture;
mod rooms;
pub mod series;
mod sixteen;

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

use series::{Extent, Series};

/// Bakes and prints a series.
pub type Measure = fn(Extent) -> Result<Series, Box<dyn Error>>;

/// All series by their names.
pub const SERIES: [(&str, Measure); 3] =
    [("triangles", series::triangles), ("texels", series::texels), ("lamps", series::lamps)];

fn main() -> Result<(), Box<dyn Error>> {
    let (mut extent, mut only, mut folder) = (Extent::Usual, String::new(), PathBuf::from("."));
    let mut arguments = env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--quick" => extent = Extent::Quick,
            "--large" => extent = Extent::Large,
            "--only" => only = arguments.next().ok_or("which series?")?,
            "--sixteen" => return sixteen::bake_sixteen(arguments.next().ok_or("which side?")?.parse()?),
            other if other.starts_with('-') => return Err(format!("unknown option {other}; see the source").into()),
            other => folder = other.into(),
        }
    }
    fs::create_dir_all(&folder)?;
    for (name, measure) in SERIES.into_iter().filter(|(name, _)| only.is_empty() || *name == only) {
        let file = folder.join(format!("growth_{name}.svg"));
        fs::write(&file, picture::draw(&measure(extent)?)?)?;
        println!("{} shows it\n", file.display());
    }
    Ok(())
}
