//! What surfaces do with light, at four sizes: texels, cells of 2 x 2 and of 4 x 4 of them, and patches.

use alloc::vec;
use alloc::vec::Vec;
use core::iter::repeat_n;

use glam::{Vec3, Vec3A};

use super::{Codes, Lighting, Rows, Solution};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// Surfaces that reflect more are taken to reflect this much: nothing real reflects all.
pub const LARGEST_REFLECTANCE: f32 = 0.98;

/// What surfaces do with light, in pieces: the columns of the rows that gather.
///
/// Patches come first, then those of the sky and the black; then cells of 4 x 4 texels, cells of 2 x 2, and texels. A
/// texel that bounces no light belongs to the black.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surfaces {
    /// For each patch its area in square meters.
    pub areas: Vec<f32>,
    /// For each patch the share of the light that meets it and stays: what it lets pass, or mirrors, goes on.
    pub presence: Vec<f32>,
    /// For each patch its material.
    pub materials: Vec<u32>,
    /// Patches without texels on their side: they receive direct light of their own, after the texels.
    pub bare: Vec<u32>,
    /// For each texel the patch of its front.
    pub patch_of: Vec<u32>,
    /// For each texel its area in square meters.
    pub texel_areas: Vec<f32>,
    /// For texels, then patches, what textures make of the reflectance of their materials.
    pub reflectance: Codes,
    /// The same of the emitted radiance; zero where a lamp of its own stands for it.
    pub emission: Codes,
    /// Cells of 4 x 4 and of 2 x 2 texels.
    pub cells: [Cells; 2],
    /// For each texel the patches between which it interpolates what they receive.
    pub around: Rows,
    /// Radiance of each patch of the sky, times that of the lighting.
    pub sky: Vec<Vec3>,
}

/// Texels in groups.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    /// For each texel its group.
    pub of_texel: Vec<u32>,
    /// How many groups.
    pub count: u32,
}

/// How finely a surface is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// By patches.
    Patch,
    /// By cells of 4 x 4 texels.
    Four,
    /// By cells of 2 x 2 texels.
    Two,
    /// By texels.
    Texel,
}

impl Surfaces {
    /// The first column of the sky.
    pub fn sky(&self) -> u32 {
        self.areas.len() as u32
    }

    /// The column of all that neither reflects nor emits.
    pub fn black(&self) -> u32 {
        (self.areas.len() + self.sky.len()) as u32
    }

    /// How many columns the sky and the black have.
    pub fn outside(&self) -> usize {
        self.sky.len() + 1
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.first(Size::Texel) as usize + self.patch_of.len()
    }

    /// What receives direct light: texels, then bare patches.
    pub fn receivers(&self) -> usize {
        self.patch_of.len() + self.bare.len()
    }

    /// What they take, in bytes.
    pub fn bytes(&self) -> usize {
        let texels = 4 * (self.patch_of.len() + self.texel_areas.len() + 2 * self.patch_of.len());
        let patches = 4 * (2 * self.areas.len() + self.materials.len() + self.bare.len() + 3 * self.sky.len());
        texels + patches + 2 * (self.reflectance.len() + self.emission.len()) + self.around.bytes()
    }

    /// The column of a texel, looked at more or less finely.
    #[inline]
    pub fn column(&self, texel: u32, size: Size) -> u32 {
        let index = match size {
            Size::Patch => self.patch_of[texel as usize],
            Size::Four => self.cells[0].of_texel[texel as usize],
            Size::Two => self.cells[1].of_texel[texel as usize],
            Size::Texel => texel,
        };
        self.first(size) + index
    }

    /// Forgets between which patches texels interpolate.
    pub fn forget_neighbors(&mut self) {
        self.around = Rows::default();
    }

    /// Whether all that is named exists: what a file must show.
    pub(super) fn is_sound(&self, materials: usize) -> bool {
        let (patches, texels) = (self.areas.len(), self.patch_of.len());
        let all_below = |list: &[u32], end: usize| list.iter().all(|&index| (index as usize) < end);
        let cells_fit = self.cells.iter().all(|cells| {
            let fits = cells.of_texel.len() == texels && cells.count as usize <= texels;
            fits && all_below(&cells.of_texel, cells.count as usize)
        });
        let [details, around] = [3 * (texels + patches), self.around.len()];
        let lengths_fit = (self.materials.len(), self.texel_areas.len(), around) == (patches, texels, texels)
            && self.presence.len() == patches
            && (self.reflectance.len(), self.emission.len()) == (details, details);
        let all = patches + self.outside();
        let indices_fit = all_below(&self.materials, materials)
            && all_below(&self.bare, patches)
            && all_below(&self.patch_of, all)
            && self.around.is_sound(all);
        let is_light = |sky: &Vec3| sky.is_finite() && sky.min_element() >= 0.0;
        let sky_fits = !self.sky.is_empty() && self.sky.iter().all(is_light);
        cells_fit && lengths_fit && indices_fit && sky_fits && all + 4 * texels < u32::MAX as usize
    }

    #[inline]
    pub(super) fn first(&self, size: Size) -> u32 {
        let after_patches = self.black() + 1;
        match size {
            Size::Patch => 0,
            Size::Four => after_patches,
            Size::Two => after_patches + self.cells[0].count,
            Size::Texel => after_patches + self.cells[0].count + self.cells[1].count,
        }
    }

    /// Reflectance of all patches; zero for the sky and the black.
    pub fn reflectances(&self, lighting: &Lighting) -> Vec<Vec3A> {
        let of_patch = |patch: usize| self.reflectance(lighting, self.patch_of.len() + patch, patch);
        (0..self.areas.len()).map(of_patch).chain(repeat_n(Vec3A::ZERO, self.outside())).collect()
    }

    /// Emitted radiance of all patches, the sky and the black, in cd/m2.
    pub fn emissions(&self, lighting: &Lighting) -> Vec<Vec3A> {
        let of_patch = |patch: usize| self.emission(lighting, self.patch_of.len() + patch, patch);
        let sky = self.sky.iter().map(|&radiance| Vec3A::from(radiance * lighting.sky));
        (0..self.areas.len()).map(of_patch).chain(sky).chain([Vec3A::ZERO]).collect()
    }

    /// Patches that would reflect more than anything real does.
    pub fn count_lowered(&self, lighting: &Lighting) -> usize {
        let is_lowered = |&patch: &usize| {
            let color = Vec3A::from(lighting.materials[self.materials[patch] as usize].base_color);
            (color * self.reflectance.rgb(self.patch_of.len() + patch)).max_element() > LARGEST_REFLECTANCE
        };
        (0..self.areas.len()).filter(is_lowered).count()
    }

    /// Direct irradiance / pi of all patches, the sky and the black, from that of the receivers.
    pub fn direct_of_patches(&self, direct: &[Vec3A]) -> Vec<Vec3A> {
        let mut sums = vec![Vec3A::ZERO; self.areas.len() + self.outside()];
        for ((&patch, &area), &light) in self.patch_of.iter().zip(&self.texel_areas).zip(direct) {
            sums[patch as usize] += light * area;
        }
        sums.iter_mut().zip(&self.areas).for_each(|(sum, &area)| *sum /= area.max(f32::MIN_POSITIVE));
        sums[self.black() as usize] = Vec3A::ZERO;
        self.bare.iter().zip(&direct[self.patch_of.len()..]).for_each(|(&patch, &light)| sums[patch as usize] = light);
        sums
    }

    /// The radiance of all columns in cd/m2: of texels from their own direct light and from what the patches around
    /// them receive, of cells the mean of their texels, of patches as solved.
    pub fn radiance(
        &self,
        lighting: &Lighting,
        direct: &[Vec3A],
        solution: &Solution,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Vec<Vec3A>, Cancelled> {
        let texels = workers.map(self.patch_of.len(), 4096, progress, |range| {
            range.map(|texel| self.of_texel(texel, lighting, direct[texel], solution)).collect()
        })?;
        let mut radiance = Vec::with_capacity(self.columns());
        radiance.extend(&solution.radiance);
        self.cells.iter().for_each(|cells| radiance.extend(self.means(cells, &texels)));
        radiance.extend(texels);
        Ok(radiance)
    }

    fn of_texel(&self, texel: usize, lighting: &Lighting, direct: Vec3A, solution: &Solution) -> Vec3A {
        let patch = self.patch_of[texel] as usize;
        if patch >= self.areas.len() {
            return Vec3A::ZERO;
        }
        let incident = direct + self.around.mean(texel, &solution.received);
        self.emission(lighting, texel, patch) + incident * self.reflectance(lighting, texel, patch)
    }

    /// The mean of each cell by area.
    fn means(&self, cells: &Cells, texels: &[Vec3A]) -> Vec<Vec3A> {
        let mut sums = vec![(Vec3A::ZERO, 0.0); cells.count as usize];
        for ((&cell, &area), &radiance) in cells.of_texel.iter().zip(&self.texel_areas).zip(texels) {
            let (sum, whole) = &mut sums[cell as usize];
            *sum += radiance * area;
            *whole += area;
        }
        sums.into_iter().map(|(sum, area)| sum / area.max(f32::MIN_POSITIVE)).collect()
    }

    /// The reflectance of a texel; zero where it belongs to no patch.
    pub(super) fn reflectance_of(&self, texel: u32, lighting: &Lighting) -> Vec3A {
        match self.patch_of[texel as usize] as usize {
            patch if patch < self.areas.len() => self.reflectance(lighting, texel as usize, patch),
            _ => Vec3A::ZERO,
        }
    }

    /// The cells of a size between patches and texels.
    pub(super) fn cells_of(&self, size: Size) -> Option<&Cells> {
        match size {
            Size::Four => Some(&self.cells[0]),
            Size::Two => Some(&self.cells[1]),
            Size::Patch | Size::Texel => None,
        }
    }

    fn reflectance(&self, lighting: &Lighting, place: usize, patch: usize) -> Vec3A {
        let color = Vec3A::from(lighting.materials[self.materials[patch] as usize].base_color);
        (color * self.reflectance.rgb(place)).min(Vec3A::splat(LARGEST_REFLECTANCE))
    }

    fn emission(&self, lighting: &Lighting, place: usize, patch: usize) -> Vec3A {
        let emissive = lighting.materials[self.materials[patch] as usize].emissive;
        if emissive == Vec3::ZERO { Vec3A::ZERO } else { Vec3A::from(emissive) * self.emission.rgb(place) }
    }
}
