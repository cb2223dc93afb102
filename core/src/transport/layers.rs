//! Groups of lights as layers: switching and dimming them is a weighted sum.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use super::{Lighting, Origin, RelightError, Relighter};
use crate::progress::Progress;

/// The lightmaps of groups of lights, one group for itself each.
///
/// Light adds up, channel by channel: while no surface changes its color, every mixture of the groups is a weighted sum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers {
    /// For each group and each image its texels, row by row: irradiance / pi in cd/m2.
    pub groups: Vec<Vec<Vec<Vec3>>>,
}

impl Layers {
    /// Lights each group of a lighting alone.
    ///
    /// # Errors
    ///
    /// See [`Relighter::relight`].
    pub fn new(
        relighter: &mut Relighter,
        lighting: &Lighting,
        groups: &[Vec<Origin>],
        progress: &Progress,
    ) -> Result<Self, RelightError> {
        let alone = |group: &Vec<Origin>| relighter.relight(&lighting.only(group), progress).map(|relit| relit.images);
        Ok(Self { groups: groups.iter().map(alone).collect::<Result<_, _>>()? })
    }

    /// For each image the sum of all groups, each times its weight per channel; groups without a weight are off.
    pub fn mix(&self, weights: &[Vec3]) -> Vec<Vec<Vec3>> {
        let Some(first) = self.groups.first() else { return Vec::new() };
        let mut images: Vec<Vec<Vec3>> = first.iter().map(|image| vec![Vec3::ZERO; image.len()]).collect();
        for (group, &weight) in self.groups.iter().zip(weights) {
            for (sums, texels) in images.iter_mut().zip(group) {
                sums.iter_mut().zip(texels).for_each(|(sum, texel)| *sum += *texel * weight);
            }
        }
        images
    }

    /// What the layers take, in bytes.
    pub fn bytes(&self) -> usize {
        self.groups.iter().flatten().map(|image| size_of::<Vec3>() * image.len()).sum()
    }
}
