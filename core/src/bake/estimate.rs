//! How wrong a bake is, as far as it can tell itself.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use super::{BakeSettings, EstimatedError, Keep};
use crate::lightmap::{DirectError, Smooth, Texels};
use crate::math;

/// Rounding of a channel to RGB9E5, in which lightmaps are stored: root mean square relative to the value, for mantissas
/// of 9 bits that are spread evenly in their logarithm, `sqrt(3 / (24 ln 2)) / 512`.
const ROUNDING: f32 = 8.3e-4;

/// Errors relative to the light at each texel plus a tenth of the mean of the whole bake. Lists have one entry for each
/// covered texel; light is irradiance / pi.
pub(super) struct Estimate {
    /// Mean over the valid texels that are here and the channels of direct and indirect light together.
    pub mean: f32,
    /// The same of all parts of the bake.
    pub whole: f32,
    /// Standard error of each valid texel from its rays, zero for others.
    pub errors: Vec<f32>,
    /// Root mean square of the errors.
    pub noise: f32,
    /// The same with what lies between texels and with what the file rounds.
    pub rms: f32,
}

impl Estimate {
    /// From the light of each texel and both of its parts, the direct one with its errors. What the texels of other
    /// parts will have is `foreseen`.
    pub fn new(
        texels: &Texels,
        is_valid: &[bool],
        light: &[f32],
        (direct, direct_errors): (&[Vec3A], &[DirectError]),
        indirect: &[Smooth],
        foreseen: &Foreseen,
    ) -> Self {
        let valid = || (0..light.len()).filter(|&index| is_valid[index]);
        let count = valid().count().max(1) as f64;
        let mean = (valid().map(|index| f64::from(light[index])).sum::<f64>() / count) as f32;
        let whole = foreseen.mean(mean);
        if whole <= 0.0 {
            return Self { errors: light.iter().map(|_| 0.0).collect(), mean, whole, noise: 0.0, rms: 0.0 };
        }
        let floor = 0.1 * whole;
        let variance = |index: usize| indirect[index].variance + direct_errors[index].noise;
        let error =
            |index: usize| if is_valid[index] { math::sqrt(variance(index)) / (light[index] + floor) } else { 0.0 };
        let errors: Vec<f32> = (0..light.len()).map(error).collect();
        let between = Between { texels, is_valid, light };
        let missed = |index: usize| {
            let scale = light[index] + floor;
            let lit = f64::from(between.squared_error(index) / (scale * scale));
            let direct = Vec3::from(direct[index]).element_sum() / 3.0;
            lit + f64::from(squared_error_at_edges(light[index], direct, &direct_errors[index], floor))
        };
        let noise = valid().map(|index| f64::from(errors[index] * errors[index])).sum::<f64>() / count;
        let missed = valid().map(missed).sum::<f64>() / count;
        let rms = math::sqrt((noise + missed) as f32 + ROUNDING * ROUNDING);
        Self { mean, whole, errors, noise: math::sqrt(noise as f32), rms }
    }
}

/// Direct and indirect light of each texel together, mean over the channels.
pub(super) fn light_of(direct: &[Vec3A], indirect: &[Smooth]) -> Vec<f32> {
    let total = |(direct, indirect): (&Vec3A, &Smooth)| Vec3::from(*direct) + indirect.irradiance;
    direct.iter().zip(indirect).map(|pair| total(pair).element_sum() / 3.0).collect()
}

/// The light of the texels of all parts before they gather: what comes straight from the lamps, and what their patches
/// received.
#[derive(Default)]
pub(super) struct Foreseen {
    /// Sum of the direct light of all valid texels.
    direct: f64,
    /// How many of them each patch has.
    texels: Vec<u32>,
    /// Sum of what their patches received.
    indirect: f64,
}

impl Foreseen {
    /// Counts the texels of a part, from the patch of each and its direct light.
    pub fn add(&mut self, patch_of: &[u32], is_valid: &[bool], direct: &[Vec3A]) {
        for ((&patch, direct), _) in patch_of.iter().zip(direct).zip(is_valid).filter(|(_, is_valid)| **is_valid) {
            let patch = patch as usize;
            self.texels.resize(self.texels.len().max(patch + 1), 0);
            self.texels[patch] += 1;
            self.direct += f64::from(direct.element_sum() / 3.0);
        }
    }

    /// Takes in what each patch received.
    pub fn receive(&mut self, received: &[Vec3A]) {
        let sum = |(&texels, received): (&u32, &Vec3A)| f64::from(texels) * f64::from(received.element_sum() / 3.0);
        self.indirect = self.texels.iter().zip(received).map(sum).sum();
    }

    /// The mean over all texels and channels; `only` where nothing was counted, since there is one part.
    fn mean(&self, only: f32) -> f32 {
        let count: f64 = self.texels.iter().map(|&texels| f64::from(texels)).sum();
        if count > 0.0 { ((self.direct + self.indirect) / count) as f32 } else { only }
    }
}

/// What the user should know where the error is larger than wanted.
pub(super) fn warning(error: &EstimatedError, settings: &BakeSettings, texels_per_meter: f32) -> Option<String> {
    let (EstimatedError { rms, noise, .. }, wanted) = (*error, settings.target_error);
    if wanted <= 0.0 || rms <= wanted {
        return None;
    }
    let percent = |error: f32| format!("{:.1} %", 100.0 * error);
    let remedy = match settings.keep {
        _ if noise <= wanted => format!(
            "the rest lies between texels, mostly at edges of shadows, where no rays help: bake more than \
             {texels_per_meter:.1} texels per meter"
        ),
        Keep::Lightmaps => "no texel gets more rays than that; choose a higher quality".into(),
        Keep::Transport => {
            "where the transport is kept, all texels have as many rays as the quality says; choose a higher one".into()
        }
    };
    let [rms, wanted, noise] = [rms, wanted, noise].map(percent);
    Some(format!("the estimated error is {rms} instead of {wanted}; noise is {noise}: {remedy}"))
}

/// Mean square error, relative to what is there, of a texel that an edge of a shadow crosses: it holds a mean of a dark
/// and a bright part, and is read on both.
///
/// `light` is all light of the texel, `direct` its direct part, `floor` what is added to the light of each part.
fn squared_error_at_edges(light: f32, direct: f32, error: &DirectError, floor: f32) -> f32 {
    let below = direct - error.darkest;
    if error.spread <= 0.0 || below <= 0.0 {
        return 0.0;
    }
    let above = error.spread / below;
    let [dark, bright] = [(light - below).max(0.0), light + above].map(|part| part + floor);
    let share = error.spread / (error.spread + below * below);
    share * (below / dark) * (below / dark) + (1.0 - share) * (above / bright) * (above / bright)
}

/// What a lightmap misses between its texels.
struct Between<'a> {
    texels: &'a Texels,
    is_valid: &'a [bool],
    light: &'a [f32],
}

/// What lies on a side of a texel; light is the mean over the channels.
enum Beside {
    /// No texel of the same chart that has light.
    Nothing,
    /// A texel without a wall between.
    Near(f32),
    /// A texel beyond a wall.
    Parted(f32),
    /// A texel without a wall between that was to have this light and is as dark as what lies beyond a wall.
    Torn(f32),
}

impl Between<'_> {
    /// Mean square error of interpolation around a texel.
    ///
    /// Between two texels of a step a lightmap is a ramp: its mean square error is 1/12 of the step squared, which is
    /// 1/24 of the squared second differences of both texels. That is for light that changes half-way; a wall may stand
    /// anywhere between two texels, and the mean over all places is 1/6 for both sides together.
    fn squared_error(&self, index: usize) -> f32 {
        let own = self.light[index];
        let along = |axis: usize| match [axis, axis + 2].map(|side| self.beside(index as u32, side)) {
            [Beside::Near(after), Beside::Near(before)] => {
                (before + after - 2.0 * own) * (before + after - 2.0 * own) / 24.0
            }
            // A border of a chart, or a gap behind furniture.
            [Beside::Nothing, _] | [_, Beside::Nothing] => 0.0,
            sides => sides.iter().map(|side| side.squared_error(own)).sum(),
        };
        along(0) + along(1)
    }

    fn beside(&self, index: u32, side: usize) -> Beside {
        let Self { texels, is_valid, light } = *self;
        let Some(other) = texels.beside(index, side) else { return Beside::Nothing };
        let is_same_chart = texels.list[other as usize].chart == texels.list[index as usize].chart;
        match (is_valid[other as usize], texels.links.is_open(index, side)) {
            _ if !is_same_chart => Beside::Nothing,
            (true, true) => Beside::Near(light[other as usize]),
            (true, false) => Beside::Parted(light[other as usize]),
            // Light passes to valid texels only: this one was valid.
            (false, true) => Beside::Torn(light[other as usize]),
            (false, false) => Beside::Nothing,
        }
    }
}

impl Beside {
    /// What this side alone adds to the error of a texel: a ramp where a step is right; and where the next texel is
    /// torn, a ramp to darkness and half of that texel.
    fn squared_error(&self, own: f32) -> f32 {
        match *self {
            Self::Nothing | Self::Near(_) => 0.0,
            Self::Parted(light) => (light - own) * (light - own) / 12.0,
            Self::Torn(light) => light * light * (1.0 / 3.0 + 1.0 / 2.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A texel half in the shadow of its only lamp holds 1 where 0 and 2 are right.
    #[test]
    fn an_edge_is_wrong_on_both_sides() {
        let error = DirectError { noise: 0.0, spread: 1.0, darkest: 0.0 };
        let expected = 0.5 * (1.0 / 0.1_f32.powi(2) + 1.0 / 2.1_f32.powi(2));
        assert!((squared_error_at_edges(1.0, 1.0, &error, 0.1) / expected - 1.0).abs() < 1e-6);
        // Three quarters in the light: 1.5 where 0 and 2 are right, beside 1 that comes from elsewhere.
        let error = DirectError { noise: 0.0, spread: 0.75, darkest: 0.0 };
        let expected = 0.25 * (1.5 / 1.1_f32).powi(2) + 0.75 * (0.5 / 3.1_f32).powi(2);
        assert!((squared_error_at_edges(2.5, 1.5, &error, 0.1) / expected - 1.0).abs() < 1e-6);
        assert_eq!(squared_error_at_edges(1.0, 1.0, &DirectError::default(), 0.1), 0.0);
    }

    #[test]
    fn warnings_tell_the_remedy() {
        let says = |noise, rms, target_error| {
            let settings = BakeSettings { target_error, ..Default::default() };
            warning(&EstimatedError { rms, noise, bias: 0.0 }, &settings, 8.0)
        };
        assert_eq!(says(0.01, 0.019, 0.02), None);
        assert_eq!(says(0.01, 0.1, 0.0), None);
        assert!(says(0.01, 0.1, 0.02).is_some_and(|text| text.contains("8.0 texels per meter")));
        assert!(says(0.03, 0.04, 0.02).is_some_and(|text| text.contains("higher quality")));
        let keeping = BakeSettings { target_error: 0.02, keep: Keep::Transport, ..Default::default() };
        let noisy = EstimatedError { rms: 0.04, noise: 0.03, bias: 0.0 };
        assert!(warning(&noisy, &keeping, 8.0).is_some_and(|text| text.contains("transport is kept")));
    }
}
