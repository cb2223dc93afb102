//! From radiance to what a screen shows.

use glam::Vec3;

use crate::lightmap::{LightmapImage, TexelState};
use crate::math;

/// EV100 where no texel says what is right: a bright interior, and what Bevy takes by default.
pub const DEFAULT_EV100: f32 = 9.7;

/// What a white surface in light of the geometric mean comes to: one that reflects half of it shows in middle gray, 0.18.
const MEAN_WHITE: f32 = 0.36;

/// The darkest part of the mean that still counts, so that a few black texels do not decide.
const DARKEST: f32 = 1e-3;

/// Weights of red, green and blue in luminance, ITU-R BT.709.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// What a radiance in cd/m2 is multiplied by, as in Bevy: `2^-ev100 / 1.2`.
pub fn exposure(ev100: f32) -> f32 {
    math::exp2(-ev100) / 1.2
}

/// The EV100 at which a surface that reflects half of the geometric mean of the valid texels becomes middle gray.
pub fn automatic_ev100(images: &[LightmapImage]) -> f32 {
    let luminances = || valid_texels(images).map(|texel| texel.dot(LUMINANCE));
    let count = luminances().count() as f64;
    let mean = (luminances().map(f64::from).sum::<f64>() / count) as f32;
    if !mean.is_finite() || mean <= 0.0 {
        return DEFAULT_EV100;
    }
    let log_sum: f64 = luminances().map(|luminance| f64::from(math::log2(luminance.max(DARKEST * mean)))).sum();
    (log_sum / count) as f32 - math::log2(1.2 * MEAN_WHITE)
}

/// The texels whose own light was computed.
pub(super) fn valid_texels(images: &[LightmapImage]) -> impl Iterator<Item = Vec3> {
    let texels = images.iter().flat_map(|image| image.texels.iter().zip(&image.states));
    texels.filter(|&(_, &state)| state == TexelState::Valid).map(|(&texel, _)| texel)
}

/// Khronos PBR Neutral: exposed linear RGB into `[0, 1]`, true to base colors below the highlights.
///
/// Khronos Group, "Khronos PBR Neutral Tone Mapper Specification", 2024.
pub fn khronos_pbr_neutral(color: Vec3) -> Vec3 {
    const FRESNEL: f32 = 0.04;
    const START: f32 = 0.8 - FRESNEL;
    const ROOM: f32 = 1.0 - START;
    const DESATURATION: f32 = 0.15;
    let least = color.min_element();
    let offset = if least < 2.0 * FRESNEL { least - least * least / (4.0 * FRESNEL) } else { FRESNEL };
    let color = color - offset;
    let peak = color.max_element();
    if peak < START {
        return color;
    }
    let new_peak = 1.0 - ROOM * ROOM / (peak + ROOM - START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    (color * (new_peak / peak)).lerp(Vec3::splat(new_peak), white)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use alloc::vec::Vec;

    fn image(texels: Vec<Vec3>, states: Vec<TexelState>) -> LightmapImage {
        LightmapImage { width: texels.len() as u32, height: 1, texels, states, ..Default::default() }
    }

    /// Bevy documents 0.001001908 for its default of 9.7.
    #[test]
    fn exposure_of_known_ev100() {
        assert!((exposure(9.7) / 0.001_001_908 - 1.0).abs() < 1e-5);
        assert!((exposure(0.0) - 1.0 / 1.2).abs() < 1e-7);
        assert!((exposure(7.0) / exposure(8.0) - 2.0).abs() < 1e-6);
    }

    /// Grays of 10 and 1000 cd/m2 have a geometric mean of 100; neither gutters nor black texels change much.
    #[test]
    fn automatic_exposure_puts_half_of_the_geometric_mean_at_middle_gray() {
        let texels = vec![Vec3::splat(10.0), Vec3::splat(1000.0), Vec3::splat(9e9)];
        let states = vec![TexelState::Valid, TexelState::Valid, TexelState::Gutter];
        let ev100 = automatic_ev100(&[image(texels, states)]);
        assert!((100.0 * exposure(ev100) - 0.36).abs() < 1e-5);
    }

    #[test]
    fn automatic_exposure_without_light() {
        assert_eq!(automatic_ev100(&[]), DEFAULT_EV100);
        assert_eq!(automatic_ev100(&[image(vec![Vec3::ZERO; 3], vec![TexelState::Valid; 3])]), DEFAULT_EV100);
        let with_black = image(vec![Vec3::ZERO, Vec3::ONE, Vec3::ONE, Vec3::ONE], vec![TexelState::Valid; 4]);
        assert!(
            (automatic_ev100(&[with_black]) - automatic_ev100(&[image(vec![Vec3::ONE], vec![TexelState::Valid])]))
                .abs()
                < 3.0
        );
    }

    /// Grays, from the definition: `6.25 x^2` below 0.08, `x - 0.04` below 0.8, `1 - 0.24^2 / (x - 0.56)` above.
    #[test]
    fn grays_follow_the_closed_form() {
        for (x, expected) in [
            (0.0, 0.0),
            (0.04, 6.25 * 0.04 * 0.04),
            (0.08, 0.04),
            (0.5, 0.46),
            (0.79, 0.75),
            (0.8, 0.76),
            (1.0, 1.0 - 0.24 * 0.24 / 0.44),
            (10.0, 1.0 - 0.24 * 0.24 / 9.44),
        ] {
            let mapped = khronos_pbr_neutral(Vec3::splat(x));
            assert!(mapped.abs_diff_eq(Vec3::splat(expected), 1e-6), "{x}: {mapped} instead of {expected}");
        }
    }

    /// Pure red at 4: peak 4, new peak 1 - 0.0576 / 3.48, desaturated by 1 - 1 / (0.15 (4 - new peak) + 1).
    #[test]
    fn bright_colors_lose_saturation_and_stay_in_range() {
        let mapped = khronos_pbr_neutral(Vec3::new(4.0, 0.0, 0.0));
        let new_peak = 1.0 - 0.0576 / 3.48;
        let white = 1.0 - 1.0 / (0.15 * (4.0 - new_peak) + 1.0);
        assert!(mapped.abs_diff_eq(Vec3::new(new_peak, white * new_peak, white * new_peak), 1e-6), "{mapped}");
        assert!(khronos_pbr_neutral(Vec3::new(1e9, 3.0, 1e4)).cmple(Vec3::ONE).all());
    }
}
