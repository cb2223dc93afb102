//! Texels without light of their own filled from their neighbors: first inside charts, then around them.

use alloc::vec::Vec;

use glam::Vec3;

use super::{LightmapImage, TexelState};

/// Rounds around the charts: the gutter, and what block compression mixes in.
const GUTTER: usize = 4;

/// Fills invalid texels from the valid ones of their chart, then the gutters from all.
pub fn dilate(image: &mut LightmapImage) {
    let is_invalid = |image: &LightmapImage, at: usize| image.states[at] == TexelState::Invalid;
    let mut known: Vec<bool> = image.states.iter().map(|state| *state == TexelState::Valid).collect();
    // Inside its chart an invalid texel takes from known ones, ring by ring until nothing changes.
    while grow(image, &mut known, TexelState::Invalid, is_invalid, true) {}
    for _ in 0..GUTTER {
        let is_empty = |image: &LightmapImage, at: usize| image.states[at] == TexelState::Empty;
        grow(image, &mut known, TexelState::Gutter, is_empty, false);
    }
    // What has no valid texel in its chart takes from whatever is near.
    while grow(image, &mut known, TexelState::Invalid, is_invalid, false) {}
}

/// One ring: texels that `wants` names and that have known neighbors become their mean. Tells whether any did.
fn grow(
    image: &mut LightmapImage,
    known: &mut [bool],
    state: TexelState,
    wants: impl Fn(&LightmapImage, usize) -> bool,
    same_chart: bool,
) -> bool {
    let ring: Vec<(usize, Vec3)> = (0..known.len())
        .filter(|&at| !known[at] && wants(image, at))
        .filter_map(|at| Some((at, mean_of_neighbors(image, known, at, same_chart)?)))
        .collect();
    for &(at, value) in &ring {
        (image.texels[at], image.states[at], known[at]) = (value, state, true);
    }
    !ring.is_empty()
}

fn mean_of_neighbors(image: &LightmapImage, known: &[bool], at: usize, same_chart: bool) -> Option<Vec3> {
    let (width, height) = (image.width as i32, image.height as i32);
    let (x, y) = (at as i32 % width, at as i32 / width);
    let (mut sum, mut count) = (Vec3::ZERO, 0);
    for k in (0..9).filter(|&k| k != 4) {
        let (x, y) = (x + k % 3 - 1, y + k / 3 - 1);
        if x < 0 || y < 0 || x >= width || y >= height {
            continue;
        }
        let other = (y * width + x) as usize;
        if known[other] && (!same_chart || image.charts[other] == image.charts[at]) {
            sum += image.texels[other];
            count += 1;
        }
    }
    (count > 0).then(|| sum / count as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lightmap::NONE;
    use alloc::vec;

    /// Two charts of four texels with one invalid texel each, in a row with a gap.
    #[test]
    fn charts_do_not_mix_inside_and_gutters_take_from_the_nearest() {
        let (v, i, e) = (TexelState::Valid, TexelState::Invalid, TexelState::Empty);
        let mut image = LightmapImage {
            width: 12,
            height: 1,
            texels: [1.0, 1.0, 9.0, 5.0, 5.0, 9.0].map(Vec3::splat).into_iter().chain([Vec3::ZERO; 6]).collect(),
            states: [v, v, i, v, v, i].into_iter().chain([e; 6]).collect(),
            charts: [0, 0, 0, 1, 1, 1].into_iter().chain([NONE; 6]).collect(),
            patches: vec![NONE; 12],
        };
        dilate(&mut image);
        let values: Vec<f32> = image.texels.iter().map(|texel| texel.x).collect();
        assert_eq!(values, [1.0, 1.0, 1.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 0.0, 0.0]);
        assert_eq!(image.states[2], TexelState::Invalid);
        assert_eq!(image.states[9], TexelState::Gutter);
        assert_eq!(image.states[10], TexelState::Empty);
    }
}
