//! Seams: points where two places of the lightmaps show the same place of a surface, and how the texels there agree.

use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

/// Points on edges that belong together, and the texels that a GPU mixes there.
///
/// Texels that seams touch are numbered through all images: "touched texel 0" is the first of the first image.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seams {
    /// For each image its touched texels: their indices in the image, ascending.
    pub texels: Vec<Vec<u32>>,
    /// For each touched texel how firmly it holds its light; positive.
    pub holds: Vec<f32>,
    /// Where edges meet.
    pub points: Vec<SeamPoint>,
    /// Touched texels in a row across a border of a chart: outside, on it, inside.
    pub rows: Vec<[u32; 3]>,
    /// Touched texels side by side in a chart, which change alike.
    pub links: Vec<[u32; 2]>,
}

/// A point of a seam as both sides sample it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeamPoint {
    /// The two places.
    pub sides: [Sample; 2],
    /// Length of the seam that the point stands for, in half texels of the finer side.
    pub weight: f32,
}

/// Four texels in a square and their weights, as a GPU mixes them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// The touched texel at the upper left; the next is at its right.
    pub upper: u32,
    /// The touched texel at the lower left; the next is at its right.
    pub lower: u32,
    /// Share of the right column, in `[0, 1]`.
    pub right: f32,
    /// Share of the lower row, in `[0, 1]`.
    pub down: f32,
}

/// How far the two sides of seams differ: |left - right| / (mean of both + a tenth of the mean light), of all channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeamSteps {
    /// Root mean square over the length of all seams.
    pub rms: f32,
    /// The largest.
    pub largest: f32,
}

/// A texel that a seam touches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeamTexel {
    /// Index of its image.
    pub image: u32,
    /// Its index in the image.
    pub texel: u32,
    /// The largest step of light at the points that it has a tenth of a say in: |left - right| over the mean of both
    /// and a tenth of the mean light, of the channel where it is largest.
    pub step: f32,
}

impl Sample {
    /// The four touched texels and their weights, which sum to 1.
    pub fn weights(&self) -> [(u32, f32); 4] {
        let Self { upper, lower, right, down } = *self;
        let (left, up) = (1.0 - right, 1.0 - down);
        [(upper, left * up), (upper + 1, right * up), (lower, left * down), (lower + 1, right * down)]
    }

    /// The light there.
    pub fn light(&self, touched: &[Vec3A]) -> Vec3A {
        self.weights().iter().map(|&(texel, weight)| touched[texel as usize] * weight).sum()
    }
}

impl SeamPoint {
    /// The eight touched texels with their weights in left - right.
    pub fn difference(&self) -> [(u32, f32); 8] {
        let [left, right] = self.sides.map(|side| side.weights());
        core::array::from_fn(|k| if k < 4 { left[k] } else { (right[k - 4].0, -right[k - 4].1) })
    }

    /// How far the sides differ in each channel, as [`SeamSteps`] has it.
    fn step(&self, touched: &[Vec3A], mean: f32) -> Vec3A {
        let [left, right] = self.sides.map(|side| side.light(touched));
        let scale = (0.5 * (left + right) + 0.1 * mean).max(Vec3A::splat(f32::MIN_POSITIVE));
        (left - right) / scale
    }
}

impl Seams {
    /// How many texels are touched.
    pub fn touched(&self) -> usize {
        self.holds.len()
    }

    /// The light of all touched texels, from the images in their order.
    pub fn gather<'a>(&self, images: impl IntoIterator<Item = &'a [Vec3]>) -> Vec<Vec3A> {
        let mut touched = Vec::with_capacity(self.touched());
        for (texels, image) in self.texels.iter().zip(images) {
            touched.extend(texels.iter().map(|&at| Vec3A::from(image[at as usize])));
        }
        touched
    }

    /// Puts the light of touched texels back into the images.
    pub fn scatter<'a>(&self, touched: &[Vec3A], images: impl IntoIterator<Item = &'a mut [Vec3]>) {
        let mut next = touched.iter();
        for (texels, image) in self.texels.iter().zip(images) {
            texels.iter().zip(&mut next).for_each(|(&at, &light)| image[at as usize] = light.into());
        }
    }

    /// How far the sides differ; `mean` is the mean light of the lightmaps.
    pub fn steps(&self, touched: &[Vec3A], mean: f32) -> SeamSteps {
        let (mut squares, mut weights, mut largest) = (0.0_f64, 0.0_f64, 0.0_f32);
        for point in &self.points {
            let step = point.step(touched, mean);
            squares += f64::from(point.weight * step.length_squared() / 3.0);
            weights += f64::from(point.weight);
            largest = largest.max(step.abs().max_element());
        }
        if weights == 0.0 {
            return SeamSteps::default();
        }
        SeamSteps { rms: crate::math::sqrt((squares / weights) as f32), largest }
    }

    /// The texels at which seams are seen, with the steps of this light there.
    pub fn texel_steps(&self, touched: &[Vec3A], mean: f32) -> Vec<SeamTexel> {
        const SAY: f32 = 0.1;
        let mut steps = alloc::vec![-1.0_f32; self.touched()];
        for point in &self.points {
            let step = point.step(touched, mean).abs().max_element();
            let seen = point.sides.iter().flat_map(Sample::weights).filter(|(_, weight)| *weight >= SAY);
            seen.for_each(|(texel, _)| steps[texel as usize] = steps[texel as usize].max(step));
        }
        let places =
            (0..).zip(&self.texels).flat_map(|(image, texels)| texels.iter().map(move |&texel| (image, texel)));
        let all = places.zip(steps).map(|((image, texel), step)| SeamTexel { image, texel, step });
        all.filter(|texel| texel.step >= 0.0).collect()
    }

    /// What they take, in bytes.
    pub fn bytes(&self) -> usize {
        8 * self.holds.len() + size_of::<SeamPoint>() * self.points.len() + 12 * self.rows.len() + 8 * self.links.len()
    }

    /// Whether all that is named is there: what a file must show. `sizes` are those of the images in texels.
    pub(super) fn is_sound(&self, sizes: impl ExactSizeIterator<Item = usize>) -> bool {
        let count = self.holds.len();
        let in_image = |(texels, size): (&Vec<u32>, usize)| {
            texels.is_sorted_by(|a, b| a < b) && texels.last().is_none_or(|&last| (last as usize) < size)
        };
        let is_share = |share: f32| (0.0..=1.0).contains(&share);
        let is_sample = |sample: &Sample| {
            let last = sample.upper.max(sample.lower) as usize;
            last < count.saturating_sub(1) && is_share(sample.right) && is_share(sample.down)
        };
        let is_point = |point: &SeamPoint| (0.0..=1e6).contains(&point.weight) && point.sides.iter().all(is_sample);
        self.texels.len() == sizes.len()
            && self.texels.iter().zip(sizes).all(in_image)
            && self.texels.iter().map(Vec::len).sum::<usize>() == count
            && self.holds.iter().all(|hold| (1e-6..=1e6).contains(hold))
            && self.points.iter().all(is_point)
            && self.rows.as_flattened().iter().chain(self.links.as_flattened()).all(|&texel| (texel as usize) < count)
    }
}
