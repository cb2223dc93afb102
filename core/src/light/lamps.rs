//! All lamps of a scene.

use alloc::vec::Vec;

use glam::Vec3;

use super::{Choice, Cut, DirectLight, Guide, LightTree, PlaneMirror, Region};

/// Up to so many lamps are all asked one by one, wherever their light may arrive.
const FEW: usize = 32;
/// Of more lamps so many of the strongest are asked one by one at each place.
const STRONGEST: usize = 32;
/// Fewer where all others together give less than this share of their light.
const REST: f32 = 1e-3;

/// Lamps, each with its strength.
pub struct Lamps<'a> {
    list: Vec<(&'a DirectLight, Vec3)>,
    /// For each the mirror in which it is seen; empty where none is.
    mirrors: Vec<Option<&'a PlaneMirror>>,
    tree: LightTree,
    /// Those that shine from far away.
    everywhere: Vec<u32>,
}

impl<'a> Lamps<'a> {
    /// Lamps with factors on their strengths, per channel.
    pub fn new(list: Vec<(&'a DirectLight, Vec3)>) -> Self {
        let (mut near, mut everywhere) = (Vec::new(), Vec::new());
        for (index, (light, strength)) in list.iter().enumerate() {
            match light.emission(*strength) {
                Some(emission) => near.push((index as u32, emission)),
                None => everywhere.push(index as u32),
            }
        }
        Self { list, mirrors: Vec::new(), tree: LightTree::new(near), everywhere }
    }

    /// The same lamps, of which some are images that are seen in mirrors only: an entry for each, or none at all.
    pub fn seen_in(self, mirrors: Vec<Option<&'a PlaneMirror>>) -> Self {
        Self { mirrors, ..self }
    }

    /// The mirror in which a lamp is seen, where it is an image.
    pub fn mirror(&self, lamp: u32) -> Option<&'a PlaneMirror> {
        self.mirrors.get(lamp as usize).copied().flatten()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// A lamp without its strength.
    pub fn light(&self, lamp: u32) -> &'a DirectLight {
        self.list[lamp as usize].0
    }

    /// Irradiance in lux from one lamp at a point with this normal of length 1, with nothing between.
    pub fn irradiance(&self, lamp: u32, point: Vec3, normal: Vec3) -> Vec3 {
        let (light, strength) = self.list[lamp as usize];
        light.irradiance(point, normal) * strength
    }

    /// Which lamps are to be asked one by one at a region, of which this is the middle and its normal.
    pub fn cut(&self, region: &Region, middle: Vec3, normal: Vec3) -> Cut {
        let light = |lamp: u32| self.irradiance(lamp, middle, normal).element_sum() / 3.0;
        let (most, share) = if self.list.len() <= FEW { (FEW, 0.0) } else { (STRONGEST, REST) };
        let mut cut = self.tree.cut(region, most, share, light);
        cut.lamps.extend(&self.everywhere);
        cut.lamps.sort_unstable();
        cut
    }

    /// One of the lamps that a cut leaves out, for a point with its normal, by a number in `[0, 1)`.
    pub fn choose(&self, cut: &Cut, guide: &Guide, point: Vec3, normal: Vec3, number: f32) -> Option<Choice> {
        self.tree.choose(cut, guide, &Region::point(point, normal), number)
    }
}
