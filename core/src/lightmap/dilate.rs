//! Texels without light of their own filled from their neighbors: first inside charts, then around them.

use alloc::vec::Vec;

use glam::Vec3;

use super::{LightmapImage, TexelState};
use crate::progress::{Cancelled, Progress};

/// Rounds around the charts: the gutter, and what block compression mixes in.
const GUTTER: usize = 4;

/// Fills invalid texels from the valid ones of their chart, then the gutters from all.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn dilate(image: &mut LightmapImage, progress: &Progress) -> Result<(), Cancelled> {
    let all_in = |image: &LightmapImage, state: TexelState| -> Vec<usize> {
        (0..image.states.len()).filter(|&at| image.states[at] == state).collect()
    };
    let invalid = all_in(image, TexelState::Invalid);
    let mut known: Vec<bool> = image.states.iter().map(|state| *state == TexelState::Valid).collect();
    // Inside its chart an invalid texel takes from known ones, ring by ring until nothing changes.
    let rest = fill(image, &mut known, invalid, true, progress)?;
    let mut front = all_in(image, TexelState::Valid);
    front.extend(all_in(image, TexelState::Invalid));
    for _ in 0..GUTTER {
        progress.check()?;
        let mut ring: Vec<usize> = front.iter().flat_map(|&at| neighbors(image, at)).collect();
        ring.retain(|&at| image.states[at] == TexelState::Empty);
        ring.sort_unstable();
        ring.dedup();
        front = grow(image, &mut known, &ring, false);
        front.iter().for_each(|&at| image.states[at] = TexelState::Gutter);
    }
    // What has no valid texel in its chart takes from whatever is near.
    fill(image, &mut known, rest, false, progress)?;
    Ok(())
}

/// Ring after ring until nothing changes; returns what could not be reached.
fn fill(
    image: &mut LightmapImage,
    known: &mut [bool],
    mut wanted: Vec<usize>,
    same_chart: bool,
    progress: &Progress,
) -> Result<Vec<usize>, Cancelled> {
    while !wanted.is_empty() && !grow(image, known, &wanted, same_chart).is_empty() {
        progress.check()?;
        wanted.retain(|&at| !known[at]);
    }
    Ok(wanted)
}

/// One ring: those of `wanted` that have known neighbors become their mean. Returns them.
fn grow(image: &mut LightmapImage, known: &mut [bool], wanted: &[usize], same_chart: bool) -> Vec<usize> {
    let ring: Vec<(usize, Vec3)> =
        wanted.iter().filter_map(|&at| Some((at, mean_of_neighbors(image, known, at, same_chart)?))).collect();
    for &(at, value) in &ring {
        (image.texels[at], known[at]) = (value, true);
    }
    ring.into_iter().map(|(at, _)| at).collect()
}

fn mean_of_neighbors(image: &LightmapImage, known: &[bool], at: usize, same_chart: bool) -> Option<Vec3> {
    let (mut sum, mut count) = (Vec3::ZERO, 0);
    for other in neighbors(image, at) {
        if known[other] && (!same_chart || image.charts[other] == image.charts[at]) {
            sum += image.texels[other];
            count += 1;
        }
    }
    (count > 0).then(|| sum / count as f32)
}

/// The up to eight texels around one.
fn neighbors(image: &LightmapImage, at: usize) -> impl Iterator<Item = usize> + use<> {
    let (width, height) = (image.width as i32, image.height as i32);
    let (x, y) = (at as i32 % width, at as i32 / width);
    (0..9).filter(|&k| k != 4).filter_map(move |k| {
        let (x, y) = (x + k % 3 - 1, y + k / 3 - 1);
        let is_inside = x >= 0 && y >= 0 && x < width && y < height;
        is_inside.then_some((y * width + x) as usize)
    })
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
        dilate(&mut image, &Progress::with_clock(|| 0.0)).unwrap();
        let values: Vec<f32> = image.texels.iter().map(|texel| texel.x).collect();
        assert_eq!(values, [1.0, 1.0, 1.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 0.0, 0.0]);
        assert_eq!(image.states[2], TexelState::Invalid);
        assert_eq!(image.states[9], TexelState::Gutter);
        assert_eq!(image.states[10], TexelState::Empty);
    }
}
