//! Texels without light of their own filled from their neighbors: first inside charts, then around them.

use alloc::vec::Vec;

use glam::Vec3;

use super::{LightmapImage, TexelState};
use crate::progress::{Cancelled, Progress};
use crate::transport::{Fills, NEIGHBORS};

/// Rounds around the charts: the gutter, and what block compression mixes in.
const GUTTER: usize = 4;

/// Of [`NEIGHBORS`]: those that share a side.
const BESIDE: u8 = 0b0101_1010;
/// Texels inside geometry take from none that is so many times as bright as another they could take from.
const CONTRAST: f32 = 4.0;

/// Fills invalid texels from the valid ones of their chart, then the gutters from all; returns how, for other light.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn dilate(image: &mut LightmapImage, progress: &Progress) -> Result<Fills, Cancelled> {
    let all_in = |image: &LightmapImage, state: TexelState| -> Vec<usize> {
        (0..image.states.len()).filter(|&at| image.states[at] == state).collect()
    };
    let invalid = all_in(image, TexelState::Invalid);
    let known = image.states.iter().map(|state| *state == TexelState::Valid).collect();
    let fills = Fills { width: image.width, ..Fills::default() };
    let mut filling = Filling { image, known, fills };
    // Inside its chart an invalid texel takes from known ones, ring by ring until nothing changes.
    let rest = filling.fill(invalid, true, progress)?;
    let states = &filling.image.states;
    let is_free = |(_, at): (usize, usize)| states[at] == TexelState::Empty;
    let is_border = |&at: &usize| states[at] != TexelState::Empty && neighbors(filling.image, at).any(is_free);
    let mut front: Vec<usize> = (0..states.len()).filter(is_border).collect();
    let mut gutter: Vec<usize> = Vec::new();
    for _ in 0..GUTTER {
        progress.check()?;
        front = filling.grow_around(&front, |state| state == TexelState::Empty);
        gutter.extend_from_slice(&front);
    }
    filling.reach(rest, progress)?;
    gutter.iter().for_each(|&at| filling.image.states[at] = TexelState::Gutter);
    Ok(filling.fills)
}

/// Finds out which texels take from which.
struct Filling<'a> {
    image: &'a mut LightmapImage,
    known: Vec<bool>,
    fills: Fills,
}

impl Filling<'_> {
    /// Ring after ring until nothing changes; returns what could not be reached.
    fn fill(&mut self, mut wanted: Vec<usize>, same_chart: bool, progress: &Progress) -> Result<Vec<usize>, Cancelled> {
        while !wanted.is_empty() && !self.grow(&wanted, same_chart).is_empty() {
            progress.check()?;
            wanted.retain(|&at| !self.known[at]);
        }
        Ok(wanted)
    }

    /// Charts without a valid texel take from whatever is near, over empty texels if need be.
    fn reach(&mut self, mut wanted: Vec<usize>, progress: &Progress) -> Result<(), Cancelled> {
        let mut front: Vec<usize> = (0..self.known.len()).filter(|&at| !wanted.is_empty() && self.known[at]).collect();
        while !wanted.is_empty() && !front.is_empty() {
            progress.check()?;
            front = self.grow_around(&front, |_| true);
            wanted.retain(|&at| !self.known[at]);
        }
        Ok(())
    }

    /// One ring of unknown texels in a state that counts around others.
    fn grow_around(&mut self, front: &[usize], counts: impl Fn(TexelState) -> bool) -> Vec<usize> {
        let mut ring: Vec<usize> = front.iter().flat_map(|&at| neighbors(self.image, at)).map(|(_, at)| at).collect();
        ring.retain(|&at| counts(self.image.states[at]) && !self.known[at]);
        ring.sort_unstable();
        ring.dedup();
        self.grow(&ring, false)
    }

    /// One ring: those of `wanted` that have known neighbors. Returns them.
    fn grow(&mut self, wanted: &[usize], same_chart: bool) -> Vec<usize> {
        let with_sources = wanted.iter().map(|&at| (at, self.sources(at, same_chart)));
        let ring: Vec<(usize, u8)> = with_sources.filter(|&(_, sources)| sources != 0).collect();
        for &(at, sources) in &ring {
            self.known[at] = true;
            self.fills.texels.push(at as u32);
            self.fills.from.push(sources);
        }
        for &(at, sources) in &ring {
            self.image.texels[at] = self.mean(at, sources);
        }
        self.fills.rings.push(self.fills.texels.len() as u32);
        ring.into_iter().map(|(at, _)| at).collect()
    }

    /// The known texels beside one, a bit each; those at its corners where there are no others, or where only those are
    /// dark. A mean with those at the corners would smear what lies along the border of a chart.
    fn sources(&self, at: usize, same_chart: bool) -> u8 {
        let charts = &self.image.charts;
        let is_source =
            |&(_, other): &(usize, usize)| self.known[other] && (!same_chart || charts[other] == charts[at]);
        let all: u8 = neighbors(self.image, at).filter(is_source).map(|(k, _)| 1 << k).sum();
        let all = if same_chart { self.without_bright(at, all) } else { all };
        if all & BESIDE != 0 { all & BESIDE } else { all }
    }

    /// The sources without those that are far brighter than the darkest.
    ///
    /// What is hidden in a wall between a bright and a dark room would carry light from one to the other.
    fn without_bright(&self, at: usize, sources: u8) -> u8 {
        let light = |source: u8| self.mean(at, source).element_sum();
        let darkest = bits(sources).map(light).fold(f32::INFINITY, f32::min);
        bits(sources).filter(|&source| light(source) <= CONTRAST * darkest).sum()
    }

    /// The mean of the texels around one that are given as bits.
    fn mean(&self, at: usize, sources: u8) -> Vec3 {
        let given = neighbors(self.image, at).filter(|(k, _)| sources >> k & 1 == 1);
        given.map(|(_, other)| self.image.texels[other]).sum::<Vec3>() / sources.count_ones().max(1) as f32
    }
}

/// Each bit that is set, alone.
fn bits(bits: u8) -> impl Iterator<Item = u8> {
    (0..8).map(|k| 1 << k).filter(move |bit| bits & bit != 0)
}

/// The up to eight texels around one, each with its place in [`NEIGHBORS`].
fn neighbors(image: &LightmapImage, at: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
    let (width, height) = (image.width as i32, image.height as i32);
    let (x, y) = (at as i32 % width, at as i32 / width);
    NEIGHBORS.iter().enumerate().filter_map(move |(k, &[dx, dy])| {
        let (x, y) = (x + dx, y + dy);
        let is_inside = x >= 0 && y >= 0 && x < width && y < height;
        is_inside.then_some((k, (y * width + x) as usize))
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
            errors: vec![0.0; 12],
        };
        dilate(&mut image, &Progress::with_clock(|| 0.0)).unwrap();
        let values: Vec<f32> = image.texels.iter().map(|texel| texel.x).collect();
        assert_eq!(values, [1.0, 1.0, 1.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 0.0, 0.0]);
        assert_eq!(image.states[2], TexelState::Invalid);
        assert_eq!(image.states[9], TexelState::Gutter);
        assert_eq!(image.states[10], TexelState::Empty);
    }

    /// What is hidden between a bright and a dark room is dark; where light merely changes, it is in between.
    #[test]
    fn hidden_texels_do_not_carry_light_through_walls() {
        let (v, i) = (TexelState::Valid, TexelState::Invalid);
        let mut image = LightmapImage {
            width: 6,
            height: 1,
            texels: [9.0, 7.0, 0.5, 4.0, 7.0, 6.0].map(Vec3::splat).to_vec(),
            states: vec![v, i, v, v, i, v],
            charts: vec![0; 6],
            ..Default::default()
        };
        dilate(&mut image, &Progress::with_clock(|| 0.0)).unwrap();
        let values: Vec<f32> = image.texels.iter().map(|texel| texel.x).collect();
        assert_eq!(values, [9.0, 0.5, 0.5, 4.0, 5.0, 6.0]);
    }
}
