//! How wrong a bake is, as far as it can tell itself.

use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use crate::lightmap::{DirectError, Smooth, Texel, Texels};
use crate::math;

/// Errors relative to the light at each texel plus a tenth of the mean of all. Lists have one entry for each covered
/// texel; light is irradiance / pi.
pub(super) struct Estimate {
    /// Direct and indirect light, mean over the channels.
    pub light: Vec<f32>,
    /// Mean of `light` over the valid texels.
    pub mean: f32,
    /// Standard error of each valid texel, zero for others.
    pub errors: Vec<f32>,
    /// Root mean square of the errors, with what lies between texels.
    pub rms: f32,
}

impl Estimate {
    /// From both parts of the light of each texel, the direct one with its errors.
    pub fn new(
        texels: &Texels,
        is_valid: &[bool],
        (direct, direct_errors): (&[Vec3A], &[DirectError]),
        indirect: &[Smooth],
    ) -> Self {
        let total = |(direct, indirect): (&Vec3A, &Smooth)| Vec3::from(*direct) + indirect.irradiance;
        let light: Vec<f32> = direct.iter().zip(indirect).map(|pair| total(pair).element_sum() / 3.0).collect();
        let valid = || (0..light.len()).filter(|&index| is_valid[index]);
        let count = valid().count().max(1) as f64;
        let mean = (valid().map(|index| f64::from(light[index])).sum::<f64>() / count) as f32;
        if mean <= 0.0 {
            return Self { errors: light.iter().map(|_| 0.0).collect(), light, mean, rms: 0.0 };
        }
        let scale = |index: usize| light[index] + 0.1 * mean;
        let variance = |index: usize| indirect[index].variance + direct_errors[index].noise;
        let error = |index: usize| if is_valid[index] { math::sqrt(variance(index)) / scale(index) } else { 0.0 };
        let errors: Vec<f32> = (0..light.len()).map(error).collect();
        let between = Between { texels, is_valid, light: &light };
        let squared = |index: usize| {
            let own = f64::from(errors[index]);
            own * own + f64::from(between.squared_error(index)) / f64::from(scale(index) * scale(index))
        };
        let rms = math::sqrt((valid().map(squared).sum::<f64>() / count) as f32);
        Self { light, mean, errors, rms }
    }
}

/// What a lightmap misses between its texels.
struct Between<'a> {
    texels: &'a Texels,
    is_valid: &'a [bool],
    light: &'a [f32],
}

impl Between<'_> {
    /// Mean square error of interpolation around a texel.
    ///
    /// Between two texels of a step a lightmap is a ramp: its mean square error is 1/12 of the step squared, which is
    /// 1/24 of the squared second differences of both texels.
    fn squared_error(&self, index: usize) -> f32 {
        let Texel { pixel: [x, y], image, chart, .. } = self.texels.list[index];
        let at = |dx: i32, dy: i32| {
            let other = self.texels.at_pixel(u32::from(image), i32::from(x) + dx, i32::from(y) + dy)? as usize;
            (self.is_valid[other] && self.texels.list[other].chart == chart).then(|| self.light[other])
        };
        let squared = |before: Option<f32>, after: Option<f32>| match (before, after) {
            (Some(before), Some(after)) => {
                let difference = before + after - 2.0 * self.light[index];
                difference * difference
            }
            _ => 0.0,
        };
        (squared(at(-1, 0), at(1, 0)) + squared(at(0, -1), at(0, 1))) / 24.0
    }
}
