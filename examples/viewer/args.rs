//! What can be said on the command line.

use std::path::PathBuf;

use bevy::prelude::*;
use bevy_radiosity::prelude::*;

use crate::views::View;

/// All of it, and the keys of the window.
pub const HELP: &str = "\
viewer [SCENE.glb] [OPTIONS]     without a scene: the Cornell box

  --quality draft|medium|high    how many rays and texels; draft by default
  --texels-per-meter N           density; by default the quality chooses it
  --view NAME                    lit, lightmap, albedo, invalid, charts, patches,
                                 density, error, seams or truth
  --screenshot FILE.png          without a window: bakes, writes a picture of the view, and ends

  1 lit   2 lightmap   3 albedo   4 invalid   5 charts   6 patches   7 density   8 error   9 seams   0 truth   Escape ends
  invalid: each texel; gray were computed, red lie inside geometry and were filled in, blue are gutters
  density: green as the bake has it, blue a quarter, red four times as many texels per meter
  error, seams: estimated error and step of light, from blue at 0 to red at 10 %
  truth: the error of some texels, found by paths of light, in the same colors; it takes some seconds
  drag: turn   drag with the right button, W A S D, Q E: move   wheel: nearer, farther";

/// What was said.
#[derive(Resource, Clone, Debug)]
pub struct Args {
    /// Absolute; the Cornell box without one.
    pub scene: Option<PathBuf>,
    /// Where the picture goes, if there is to be one.
    pub screenshot: Option<PathBuf>,
    /// What is shown first.
    pub view: View,
    quality: Quality,
    resolution: Resolution,
}

impl Args {
    /// Reads the arguments after the name of the program; else tells what is wrong with them.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut args =
            Self { scene: None, screenshot: None, view: View::Lit, quality: Quality::Draft, resolution: default() };
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
            match word.as_str() {
                "--quality" => args.quality = quality(&value()?)?,
                "--texels-per-meter" => args.resolution = Resolution::TexelsPerMeter(positive(&value()?)?),
                "--view" => args.view = View::named(&value()?)?,
                "--screenshot" => args.screenshot = Some(value()?.into()),
                option if option.starts_with('-') => return Err(format!("there is no option {option}")),
                path => args.scene = Some(std::path::absolute(path).map_err(|error| format!("{path}: {error}"))?),
            }
        }
        Ok(args)
    }

    /// Where the scene lies: Bevy loads from one folder.
    pub fn folder(&self) -> String {
        let folder = self.scene.as_ref().and_then(|path| path.parent());
        folder.map_or_else(String::new, |folder| folder.display().to_string())
    }

    /// How to bake.
    pub fn bake_settings(&self) -> BakeSettings {
        BakeSettings { quality: self.quality, resolution: self.resolution, ..default() }
    }
}

fn quality(name: &str) -> Result<Quality, String> {
    match name {
        "draft" => Ok(Quality::Draft),
        "medium" => Ok(Quality::Medium),
        "high" => Ok(Quality::High),
        _ => Err(format!("there is no quality {name}")),
    }
}

fn positive(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number: &f32| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| format!("{text} is not a positive number"))
}
