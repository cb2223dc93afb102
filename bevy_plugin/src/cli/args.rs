//! What can be said on the command line.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, ValueEnum};
use radiosity::bake::{BakeSettings, Keep, Quality};
use radiosity::lightmap::{LayoutSettings, Resolution, UvMode};
use sysinfo::System;

use super::sky::{self, SkyArg};

/// Bakes the lightmaps of a glTF scene into a folder that Bevy loads.
#[derive(Parser, Clone, Debug)]
#[command(name = "bake", version)]
pub(super) struct Args {
    /// .glb or .gltf file; without one a Cornell box is baked
    pub scene: Option<PathBuf>,

    /// Folder for scene.glb, the lightmaps, manifest.json, report.json and preview.png
    #[arg(long, value_name = "DIR", default_value = "baked")]
    pub out: PathBuf,

    /// Density of the lightmaps; by default it is chosen by the quality
    #[arg(long, value_name = "N", value_parser = positive, conflicts_with = "resolution")]
    pub texels_per_meter: Option<f32>,

    /// Side of one single image in texels, a multiple of 4 from 16 to 4096
    #[arg(long, value_name = "N", value_parser = image_side)]
    pub resolution: Option<u32>,

    /// What becomes of the second set of coordinates of the meshes
    #[arg(long, value_enum, default_value_t)]
    pub uv: UvArg,

    /// How many rays and, without a density, how many texels: about 2^18, 2^20 or 2^22
    #[arg(long, value_enum, default_value_t)]
    pub quality: QualityArg,

    /// Rays are added until the estimated error is no larger: 2% or 0.02; the quality says with how many it begins
    #[arg(long, value_name = "E", value_parser = share, conflicts_with = "transport")]
    pub error: Option<f32>,

    /// Worker threads, 0 for one on each core; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = threads, default_value_t = 0)]
    pub threads: usize,

    /// What the bake may use, as 2G or 512M; by default three quarters of what the machine has
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    pub memory: Option<u64>,

    /// Seed of all random decisions
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,

    /// Factor on what emissive materials emit, in cd/m2 for each unit in the file
    #[arg(long, value_name = "X", value_parser = not_negative, default_value_t = 1.0)]
    pub emissive_scale: f32,

    /// The sky: a panorama as .hdr or .exr, whose suns become lights, or one color in cd/m2
    #[arg(long, value_name = "FILE|X|R,G,B", value_parser = sky::parse)]
    pub sky: Option<SkyArg>,

    /// Factor on the sky: cd/m2 for each unit in the file
    #[arg(long, value_name = "X", value_parser = not_negative, default_value_t = 1.0, requires = "sky")]
    pub sky_scale: f32,

    /// Turns a panorama to the right, in degrees; its middle lies towards -Z
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = finite, default_value_t = 0.0, requires = "sky")]
    pub sky_turn: f32,

    /// Write transport.bin too, by which lamps and colors can change later without a bake
    #[arg(long)]
    pub transport: bool,

    /// Write density.png, error.png, invalid.png and seams.png too: how good the bake is, seen as preview.png is; with
    /// --reference also truth.png
    #[arg(long)]
    pub views: bool,

    /// Hold the bake against paths of light to N random points, and tell its true error in report.json
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    pub reference: Option<u32>,

    /// Follow paths of light to each pixel of preview.png too, into FILE.png; FILE-beside.png has both pictures,
    /// FILE-difference.png how much too dark (blue) or too bright (red) the baked one is, up to 10 %. Paths take the scene
    /// as the bake does: diffuse, with mirrors and with glass that does not bend light
    #[arg(long, value_name = "FILE.png", value_parser = png_file)]
    pub render: Option<PathBuf>,

    /// Paths for each pixel, rounded up to a multiple of 16
    #[arg(long, value_name = "N", default_value_t = 64, requires = "render", value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    pub samples: u32,

    /// Let rough metal and varnish reflect in what --render draws, as Bevy does; the bake has none of it
    #[arg(long, requires = "render")]
    pub gloss: bool,

    /// Make the lightmaps of a folder anew for other lamps and colors, by its transport.bin; its other files stay
    #[arg(long, value_name = "DIR", conflicts_with_all = ["scene", "out", "sky", "transport", "views", "reference", "render"])]
    pub relight: Option<PathBuf>,

    /// Factor on what a lamp, a material that emits, or the "sky" gave in the bake: one for all channels or three; 0 is off
    #[arg(long, value_name = "NAME=X|R,G,B", value_parser = named_color, requires = "relight")]
    pub light: Vec<NamedColor>,

    /// Base color of a material, linear
    #[arg(long, value_name = "NAME=R,G,B", value_parser = named_color, requires = "relight")]
    pub material: Vec<NamedColor>,

    /// Write the rays of every 64th tile of work to FILE, to trace them by other means; needs --threads 1
    #[arg(long, value_name = "FILE", conflicts_with = "relight")]
    pub dump_rays: Option<PathBuf>,

    /// Exposure of preview.png; by default it is chosen by the lightmaps
    #[arg(long, value_name = "EV", allow_negative_numbers = true, value_parser = finite)]
    pub ev100: Option<f32>,
}

/// Something of the scene, and a color for it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NamedColor {
    pub name: String,
    pub color: [f32; 3],
}

/// What becomes of the second set of coordinates of the meshes.
#[derive(ValueEnum, Clone, Copy, Debug, Default)]
pub(super) enum UvArg {
    /// Usable ones are kept, the rest is unwrapped
    #[default]
    Auto,
    /// A mesh without usable ones is an error
    Keep,
    /// All meshes are unwrapped anew
    Unwrap,
}

/// How much work is spent.
#[derive(ValueEnum, Clone, Copy, Debug, Default)]
pub(super) enum QualityArg {
    /// To see where the light goes
    Draft,
    /// For a game
    #[default]
    Medium,
    /// For the last bake before shipping
    High,
}

impl Args {
    /// Reads the arguments, of which the first is the name of the program.
    pub fn read(words: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let args = Self::try_parse_from(words)?;
        if args.dump_rays.is_some() && args.threads != 1 {
            let text = "--dump-rays writes rays in the order of one thread only; add --threads 1";
            return Err(Self::command().error(ErrorKind::ArgumentConflict, text));
        }
        Ok(args)
    }

    /// How the bake is to be made.
    pub fn settings(&self) -> BakeSettings {
        let (texels, box_density) = match self.quality {
            QualityArg::Draft => (1 << 18, 256.0),
            QualityArg::Medium => (1 << 20, 512.0),
            QualityArg::High => (1 << 22, 1024.0),
        };
        let resolution = match (self.texels_per_meter, self.resolution) {
            (Some(density), _) => Resolution::TexelsPerMeter(density),
            (None, Some(side)) => Resolution::SingleImage(side),
            // Half a meter wide, it would get 35 texels a wall from the limit of 64 per meter.
            (None, None) if self.scene.is_none() => Resolution::TexelsPerMeter(box_density),
            (None, None) => Resolution::Texels(texels),
        };
        let uv = match self.uv {
            UvArg::Auto => UvMode::Auto,
            UvArg::Keep => UvMode::Keep,
            UvArg::Unwrap => UvMode::Unwrap,
        };
        let quality = match self.quality {
            QualityArg::Draft => Quality::Draft,
            QualityArg::Medium => Quality::Medium,
            QualityArg::High => Quality::High,
        };
        BakeSettings {
            layout: LayoutSettings { resolution, uv, ..Default::default() },
            quality,
            target_error: self.error.unwrap_or(0.0),
            threads: self.threads,
            memory_bytes: self.memory.unwrap_or_else(most_of_the_machine),
            seed: self.seed,
            keep: if self.transport { Keep::Transport } else { Keep::Lightmaps },
        }
    }
}

/// Three quarters of the memory that this process may have, in bytes.
fn most_of_the_machine() -> u64 {
    let mut system = System::new();
    system.refresh_memory();
    let limit = system.cgroup_limits().map_or(u64::MAX, |limits| limits.total_memory);
    system.total_memory().min(limit) / 4 * 3
}

fn positive(text: &str) -> Result<f32, String> {
    finite(text).and_then(|number| if number > 0.0 { Ok(number) } else { Err("it must be above 0".into()) })
}

fn not_negative(text: &str) -> Result<f32, String> {
    finite(text).and_then(|number| if number >= 0.0 { Ok(number) } else { Err("it must not be below 0".into()) })
}

fn finite(text: &str) -> Result<f32, String> {
    text.parse().ok().filter(|number: &f32| number.is_finite()).ok_or_else(|| "it must be a number".into())
}

fn share(text: &str) -> Result<f32, String> {
    let share = match text.strip_suffix('%') {
        Some(percent) => positive(percent.trim_end())? / 100.0,
        None => positive(text)?,
    };
    if share < 1.0 { Ok(share) } else { Err("it must be below 100%".into()) }
}

fn named_color(text: &str) -> Result<NamedColor, String> {
    let (name, color) = text.rsplit_once('=').ok_or("it must be a name, = and one number or three with commas")?;
    let numbers = color.split(',').map(not_negative).collect::<Result<Vec<f32>, String>>()?;
    let color = match numbers[..] {
        [all] => [all; 3],
        [red, green, blue] => [red, green, blue],
        _ => return Err("it must be one number or three with commas".into()),
    };
    Ok(NamedColor { name: name.into(), color })
}

fn png_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|kind| kind.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("its name must end in .png".into()) }
}

fn image_side(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(side @ 16..=4096) if side % 4 == 0 => Ok(side),
        _ => Err("it must be a multiple of 4 from 16 to 4096".into()),
    }
}

fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads @ 0..=256) => Ok(threads),
        _ => Err("it must be a number from 0 to 256".into()),
    }
}

fn bytes(text: &str) -> Result<u64, String> {
    let error = || "it must be a number of bytes such as 2G or 512M".to_owned();
    let text = text.trim_end_matches(['B', 'b']).trim_end_matches('i');
    let digits = text.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    let shift = match &text[digits.len()..] {
        "" => 0,
        "K" | "k" => 10,
        "M" | "m" => 20,
        "G" | "g" => 30,
        "T" | "t" => 40,
        _ => return Err(error()),
    };
    let number: f64 = digits.parse().map_err(|_| error())?;
    let bytes = number * (1_u64 << shift) as f64;
    if bytes >= 1.0 && bytes.is_finite() { Ok(bytes as u64) } else { Err(error()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_has_units() {
        assert_eq!(bytes("2G"), Ok(2 << 30));
        assert_eq!(bytes("512M"), Ok(512 << 20));
        assert_eq!(bytes("1.5GiB"), Ok(3 << 29));
        assert_eq!(bytes("4096"), Ok(4096));
        for wrong in ["", "G", "2X", "-1G", "0"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }

    /// Rays of several threads would come mixed: exit code 2, and what to add.
    #[test]
    fn rays_come_from_one_thread() {
        let read =
            |words: &[&str]| Args::read([&["bake", "--dump-rays", "rays"], words].concat().iter().map(Into::into));
        assert!(read(&["--threads", "1"]).is_ok());
        for wrong in [&[][..], &["--threads", "0"], &["--threads", "2"]] {
            let error = read(wrong).unwrap_err();
            assert_eq!(error.exit_code(), 2);
            assert!(error.to_string().contains("add --threads 1"), "{error}");
        }
    }

    #[test]
    fn errors_are_shares() {
        assert_eq!(share("2%"), Ok(0.02));
        assert_eq!(share("0.5 %"), Ok(0.005));
        assert_eq!(share("0.02"), Ok(0.02));
        for wrong in ["", "%", "0%", "-1%", "2", "100%", "NaN", "two"] {
            assert!(share(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn colors_have_names() {
        let named = |text| named_color(text).map(|NamedColor { name, color }| (name, color));
        assert_eq!(named("Lamp=2"), Ok(("Lamp".into(), [2.0; 3])));
        assert_eq!(named("a=b=1,0.5,0"), Ok(("a=b".into(), [1.0, 0.5, 0.0])));
        for wrong in ["Lamp", "Lamp=", "Lamp=1,2", "Lamp=-1", "Lamp=red"] {
            assert!(named(wrong).is_err(), "{wrong}");
        }
        for wrong in [&["--light", "Lamp=1"][..], &["a.glb", "--relight", "baked"]] {
            assert!(Args::try_parse_from([&["bake"], wrong].concat()).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn density_and_quality_choose_the_resolution() {
        let resolution = |args: &[&str]| {
            Args::try_parse_from([&["bake"], args].concat()).map(|args| args.settings().layout.resolution)
        };
        assert_eq!(resolution(&["a.glb"]).unwrap(), Resolution::Texels(1 << 20));
        assert_eq!(resolution(&["a.glb", "--quality", "draft"]).unwrap(), Resolution::Texels(1 << 18));
        assert_eq!(resolution(&[]).unwrap(), Resolution::TexelsPerMeter(512.0));
        assert_eq!(resolution(&["--texels-per-meter", "8"]).unwrap(), Resolution::TexelsPerMeter(8.0));
        assert_eq!(resolution(&["--resolution", "512"]).unwrap(), Resolution::SingleImage(512));
        for wrong in ["0", "12", "510", "4100", "-16"] {
            assert!(resolution(&["--resolution", wrong]).is_err(), "{wrong}");
        }
        assert!(resolution(&["--threads", "256"]).is_ok() && resolution(&["--threads", "257"]).is_err());
        assert!(resolution(&["--resolution", "512", "--texels-per-meter", "8"]).is_err());
    }

    #[test]
    fn pictures_are_png() {
        let read = |words: &[&str]| Args::try_parse_from([&["bake"], words].concat());
        let args = read(&["--render", "a/b.png", "--samples", "7"]).unwrap();
        assert_eq!((args.render, args.samples), (Some("a/b.png".into()), 7));
        assert_eq!(read(&["--render", "b.PNG"]).unwrap().samples, 64);
        for wrong in [&["--render", "b.jpg"][..], &["--render", ".png"], &["--render"], &["--samples", "7"]] {
            assert!(read(wrong).is_err(), "{wrong:?}");
        }
        assert!(read(&["--render", "b.png", "--samples", "0"]).is_err());
    }
}
