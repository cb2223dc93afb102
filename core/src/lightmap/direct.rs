//! Light that reaches a texel straight from its sources: closed forms times the visible share.
//!
//! Blocks of texels choose their lamps together. A first look tells for each texel and lamp whether all, none or a part
//! of the lamp is seen; where a part is, or where neighbors disagree, a second look takes as many rays as the noise asks
//! for. What remains of many lamps is asked by chance.

use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::blocks::{Blocks, bit};
use super::footprint::Footprint;
use super::penumbra::smooth_penumbrae;
use super::samples::Samples;
use super::{Texel, Texels};
use crate::geometry::{Occluders, Sobol, hash};
use crate::light::{Cut, Guide, Lamps, Region};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::Tracer;

/// How many shadow rays a texel gets for one lamp. Powers of two are best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowRays {
    /// For every texel, for a lamp with an extent; a lamp without needs one.
    pub first: u32,
    /// Where those, or those of a neighbor, disagree: at the border of shadows, for a lamp without extent. With 1 a texel
    /// holds the light of its middle, with more the mean over all of it.
    pub sharp: u32,
    /// At most, for a lamp with an extent, in penumbrae, and for all lamps together that are asked by chance.
    pub most: u32,
    /// Fewer where the standard error is below this share of the direct light of the texel and a tenth of its mean.
    pub noise: f32,
}

/// By how bright channels look, so that the borders of colors are seen: Rec. 709.
const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// A second look at a penumbra starts with so many rays, and so do lamps that are asked by chance.
const FEWEST: u32 = 8;

/// Direct light of a texel, and how far it may be off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectTexel {
    /// Irradiance / pi, in cd/m2.
    pub irradiance: Vec3,
    /// How far that may be off.
    pub error: DirectError,
}

/// How far the direct light of a texel may be off. Irradiance / pi is meant, the mean of its channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectError {
    /// Variance of the value that was found around the mean over the texel, because rays are few: penumbrae.
    pub noise: f32,
    /// Variance of the light within the texel, because an edge of a shadow crosses it: what a lookup at a random point
    /// of the texel misses. No rays make it smaller, only more texels.
    pub spread: f32,
    /// The least light within the texel: with the mean `m` the light is about this in a share `spread / (spread +
    /// (m - darkest)^2)` of the texel and `m + spread / (m - darkest)` in the rest.
    pub darkest: f32,
}

impl DirectTexel {
    /// The same light from a lamp of another strength.
    pub fn times(&self, strength: Vec3) -> Self {
        let irradiance = self.irradiance * strength;
        let level = self.irradiance.element_sum();
        let factor = if level > 0.0 { irradiance.element_sum() / level } else { 0.0 };
        let DirectError { noise, spread, darkest } = self.error;
        let squared = factor * factor;
        let error = DirectError { noise: noise * squared, spread: spread * squared, darkest: darkest * factor };
        Self { irradiance, error }
    }
}

impl core::ops::AddAssign for DirectError {
    /// Errors of different lamps do not depend on each other; edges of their shadows lie in different places.
    fn add_assign(&mut self, other: Self) {
        self.noise += other.noise;
        self.spread += other.spread;
        self.darkest += other.darkest;
    }
}

/// All that direct light needs to know.
pub struct Direct<'a, O> {
    /// The receivers.
    pub texels: &'a Texels,
    /// The same, block by block.
    pub blocks: &'a Blocks,
    /// Which texels count.
    pub is_valid: &'a [bool],
    /// Asks for visibility.
    pub tracer: &'a Tracer<'a, O>,
    /// How often.
    pub rays: ShadowRays,
    /// Of all random decisions.
    pub seed: u32,
}

/// What a block of texels saw at first.
struct BlockLook {
    cut: Cut,
    /// For each lamp of the cut.
    looks: Vec<Look>,
    /// For each texel its light so far, mean of the channels, irradiance / pi.
    levels: Vec<f32>,
}

/// What one ray to a lamp brings.
#[derive(Clone, Copy)]
struct Sample {
    weight: f32,
    /// The weight times what arrives of it, as a luminance.
    value: f32,
    /// The color of what arrives: its luminance is 1.
    tint: Vec3,
}

impl Sample {
    fn share(&self) -> f32 {
        if self.weight > 0.0 { self.value / self.weight } else { 0.0 }
    }
}

impl Default for Sample {
    fn default() -> Self {
        Self { weight: 0.0, value: 0.0, tint: Vec3::ONE }
    }
}

/// The mean color of what samples bring.
#[derive(Default)]
struct Tint {
    sum: Vec3,
    values: f32,
}

impl Tint {
    fn add(&mut self, sample: &Sample) {
        self.sum += sample.tint * sample.value;
        self.values += sample.value;
    }

    /// White where nothing arrives.
    fn mean(&self) -> Vec3 {
        if self.values > 0.0 { self.sum / self.values } else { Vec3::ONE }
    }
}

/// Which texels of a block saw something of a lamp, and which found something in the way; neither: it does not shine on
/// them.
#[derive(Clone, Copy, Default)]
struct Look {
    lit: u64,
    dark: u64,
}

impl Look {
    fn of(&self, bit: u64) -> [bool; 2] {
        [self.lit & bit != 0, self.dark & bit != 0]
    }
}

impl<O: Occluders> Direct<'_, O> {
    /// Light from all lamps for each texel, zero for those that are not valid.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel.
    pub fn light(&self, lamps: &Lamps, workers: &Workers, progress: &Progress) -> Result<Vec<DirectTexel>, Cancelled> {
        let blocks = self.blocks;
        let count = blocks.count();
        progress.enter_part(0, 2);
        let looks = workers.map(count, 8, progress, |range| {
            range.map(|block| self.first_look(lamps, blocks.texels(block))).collect()
        })?;
        let valid = self.is_valid.iter().filter(|&&is_valid| is_valid).count();
        let mean = looks.iter().flat_map(|look| &look.levels).sum::<f32>() / valid.max(1) as f32;
        progress.enter_part(1, 2);
        let lights: Vec<DirectTexel> = workers.map(count, 8, progress, |range| {
            range.flat_map(|block| self.second_look(lamps, &looks, block, mean)).collect()
        })?;
        let light = blocks.scatter(&lights);
        drop(lights);
        smooth_penumbrae(&light, self.texels, self.is_valid, workers, progress)
    }

    /// What a block of texels sees from the middles of its texels by few rays.
    fn first_look(&self, lamps: &Lamps, block: &[u32]) -> BlockLook {
        let cut = self.cut(lamps, block);
        let mut levels = alloc::vec![0.0; block.len()];
        let looks = cut.lamps.iter().map(|&lamp| {
            let mut look = Look::default();
            for (&index, level) in block.iter().zip(&mut levels) {
                let Texel { position, normal, .. } = self.texels.list[index as usize];
                let irradiance = lamps.irradiance(lamp, position, normal);
                if !self.is_valid[index as usize] || irradiance == Vec3::ZERO {
                    continue;
                }
                let (share, is_white) = self.first_share(lamps, lamp, index);
                let bit = bit(&self.texels.list[index as usize]);
                look.lit |= if share > 0.0 { bit } else { 0 };
                look.dark |= if share < 1.0 || !is_white { bit } else { 0 };
                *level += share * irradiance.element_sum() / (3.0 * PI);
            }
            look
        });
        let looks = looks.collect();
        BlockLook { cut, looks, levels }
    }

    /// Which lamps to ask one by one.
    fn cut(&self, lamps: &Lamps, block: &[u32]) -> Cut {
        let valid = block.iter().filter(|&&index| self.is_valid[index as usize]).map(|&index| {
            let texel = &self.texels.list[index as usize];
            (texel.position, texel.normal, Footprint::new(texel, self.texels, self.tracer.world).reach())
        });
        let Some((middle, normal, _)) = valid.clone().nth(valid.clone().count() / 2) else { return Cut::default() };
        lamps.cut(&Region::around(valid), middle, normal)
    }

    /// The share that is seen of a lamp, and whether nothing colors it.
    fn first_share(&self, lamps: &Lamps, lamp: u32, index: u32) -> (f32, bool) {
        let position = self.texels.list[index as usize].position;
        let sequence = self.sequence(lamp, index);
        if lamps.light(lamp).is_sharp() {
            let sample = self.sample(lamps, lamp, index, &sequence, 0, position);
            return (sample.share(), sample.tint == Vec3::ONE);
        }
        let mut samples = Samples::default();
        let mut tint = Tint::default();
        self.sample_more(&mut samples, &mut tint, (lamps, lamp), index, &sequence, self.rays.first, |_| position);
        (samples.mean(), tint.mean() == Vec3::ONE)
    }

    fn sequence(&self, lamp: u32, index: u32) -> Sobol {
        Sobol::new(hash(hash(self.seed, lamp), index))
    }

    /// The light of a block of texels, with more rays where the first were not enough.
    fn second_look(&self, lamps: &Lamps, looks: &[BlockLook], block: usize, mean: f32) -> Vec<DirectTexel> {
        let (texels, own) = (self.blocks.texels(block), &looks[block]);
        let tolerated = |k: usize| self.rays.noise * (own.levels[k] + 0.1 * mean);
        let mut sums: Vec<DirectTexel> = texels.iter().map(|_| DirectTexel::default()).collect();
        let neighbors: Vec<_> = texels.iter().map(|&index| self.neighbors(index)).collect();
        for (slot, &lamp) in own.cut.lamps.iter().enumerate() {
            let look_of = |other: u32| looks[other as usize].of(lamp);
            for (k, &index) in texels.iter().enumerate() {
                let texel = &self.texels.list[index as usize];
                let seen = own.looks[slot].of(bit(texel));
                let is_unlit = seen == [false; 2];
                if is_unlit {
                    continue;
                }
                let agrees = |&(other, bit): &(u32, u64)| {
                    let seen_there =
                        if other == block as u32 { own.looks[slot].of(bit) } else { look_of(other).of(bit) };
                    seen_there == seen || seen_there == [false; 2]
                };
                let is_border = seen == [true; 2] || !neighbors[k].iter().flatten().all(agrees);
                let light = match seen {
                    _ if is_border => self.by_many_rays(lamps, lamp, index, tolerated(k)),
                    [true, _] => certain(lamps.irradiance(lamp, texel.position, texel.normal)),
                    _ => continue,
                };
                sums[k].irradiance += light.irradiance;
                sums[k].error += light.error;
            }
        }
        let mut guide = Guide::new(&own.cut);
        if guide.is_empty() {
            return sums;
        }
        for (k, &index) in texels.iter().enumerate().filter(|(_, index)| self.is_valid[**index as usize]) {
            let rest = self.by_chance(lamps, &own.cut, &mut guide, index, tolerated(k));
            sums[k].irradiance += rest.irradiance;
            sums[k].error += rest.error;
        }
        sums
    }

    /// Light by many rays from all over a texel.
    fn by_many_rays(&self, lamps: &Lamps, lamp: u32, index: u32, tolerated: f32) -> DirectTexel {
        let texel = &self.texels.list[index as usize];
        let points = match self.rays.sharp {
            0 | 1 => Footprint::middle(texel),
            _ => Footprint::new(texel, self.texels, self.tracer.world),
        };
        let sequence = self.sequence(lamp, index);
        if lamps.light(lamp).is_sharp() {
            return self.sharp(lamps, lamp, index, &points, &sequence);
        }
        let full = certain(lamps.irradiance(lamp, texel.position, texel.normal));
        let (mut samples, mut tint, mut rays) = (Samples::default(), Tint::default(), FEWEST.max(self.rays.first));
        let place = |k| points.point(&sequence, k, 2);
        loop {
            self.sample_more(&mut samples, &mut tint, (lamps, lamp), index, &sequence, rays, place);
            let (share, noise) = (samples.mean(), samples.variance() * full.error.darkest * full.error.darkest);
            // A sliver of the lamp that hides from all of these rays, or is all that they would have met.
            let sliver = 0.5 * full.error.darkest / rays as f32;
            let is_certain = noise.max(sliver * sliver) <= tolerated * tolerated;
            if rays >= self.rays.most || is_certain {
                let error = DirectError { noise, spread: 0.0, darkest: full.error.darkest * share };
                return DirectTexel { irradiance: full.irradiance * share * tint.mean(), error };
            }
            rays *= 2;
        }
    }

    /// Light from a lamp without extent, by rays from all over a texel.
    fn sharp(&self, lamps: &Lamps, lamp: u32, index: u32, points: &Footprint, sequence: &Sobol) -> DirectTexel {
        let normal = self.texels.list[index as usize].normal;
        let (mut sum, mut levels) = (Vec3::ZERO, Samples::default());
        let rays = self.rays.sharp.max(1);
        for k in 0..rays {
            let point = points.point(sequence, k, 0);
            let sample = self.sample(lamps, lamp, index, sequence, k, point);
            let lit = lamps.irradiance(lamp, point, normal) * (sample.share() / PI) * sample.tint;
            sum += lit;
            levels.put(sequence.square(k), 1.0, lit.element_sum() / 3.0);
        }
        let error = DirectError { noise: levels.variance(), spread: levels.spread(), darkest: levels.least() };
        DirectTexel { irradiance: sum / rays as f32, error }
    }

    /// Light from the lamps that were not asked one by one: for each ray one of them, the likelier the more it may give.
    fn by_chance(&self, lamps: &Lamps, cut: &Cut, guide: &mut Guide, index: u32, tolerated: f32) -> DirectTexel {
        let Texel { position, normal, .. } = self.texels.list[index as usize];
        let sequence = self.sequence(u32::MAX, index);
        let (mut sum, mut samples, mut gave, mut rays) = (Vec3::ZERO, Samples::line(), Vec::new(), FEWEST);
        loop {
            for k in samples.count()..rays {
                let number = sequence.dimension(k, 2);
                let lit = lamps.choose(cut, guide, position, normal, number).map_or(Vec3::ZERO, |choice| {
                    let irradiance = lamps.irradiance(choice.lamp, position, normal);
                    let sample = self.sample(lamps, choice.lamp, index, &sequence, k, position);
                    let lit = irradiance * (sample.share() / choice.probability) * sample.tint;
                    gave.push((choice, lit.element_sum() / 3.0));
                    lit / PI
                });
                sum += lit;
                samples.put(Vec2::new(number, 0.0), 1.0, lit.element_sum() / 3.0);
            }
            // Chance may hide what is rarely seen: one more ray that sees as much as was expected.
            let expected = guide.expected() / (PI * PI);
            let count = rays as f32;
            let noise = (samples.variance() * count + expected / count) / (count + 1.0);
            if rays >= self.rays.most || noise <= tolerated * tolerated {
                guide.learn(&gave);
                let error = DirectError { noise, spread: 0.0, darkest: samples.mean() };
                return DirectTexel { irradiance: sum / rays as f32, error };
            }
            rays *= 2;
        }
    }

    /// Takes rays to points of a lamp until there are so many, each with its weight.
    #[expect(clippy::too_many_arguments, reason = "what is sampled, from where, and how often")]
    fn sample_more(
        &self,
        samples: &mut Samples,
        tint: &mut Tint,
        (lamps, lamp): (&Lamps, u32),
        index: u32,
        sequence: &Sobol,
        rays: u32,
        point: impl Fn(u32) -> Vec3,
    ) {
        for k in samples.count()..rays {
            let sample = self.sample(lamps, lamp, index, sequence, k, point(k));
            samples.put(sequence.square(k), sample.weight, sample.value);
            tint.add(&sample);
        }
    }

    /// What a ray to a point of a lamp brings. Where normals are smooth the point lies above its triangle, and light may
    /// come from below the plane of that.
    fn sample(&self, lamps: &Lamps, lamp: u32, index: u32, sequence: &Sobol, k: u32, from: Vec3) -> Sample {
        let texel = &self.texels.list[index as usize];
        let flat = self.tracer.world.normals[texel.triangle as usize];
        let ray = lamps.light(lamp).shadow_ray(sequence.square(k), from, texel.normal);
        let weight = ray.weight.max(0.0);
        if weight <= 0.0 {
            return Sample::default();
        }
        self.tracer.count(1);
        if self.tracer.is_plain {
            let visible = self.tracer.visibility(&self.tracer.leave_for(texel.triangle, from, flat, &ray));
            return Sample { weight, value: weight * visible, tint: Vec3::ONE };
        }
        let arriving = self.tracer.arriving((texel.triangle, from, flat), &ray, lamps.mirror(lamp));
        let is_gray = arriving == Vec3::splat(arriving.x);
        let level = if is_gray { arriving.x } else { arriving.dot(LUMINANCE) };
        let tint = if is_gray { Vec3::ONE } else { arriving / level };
        Sample { weight, value: weight * level, tint }
    }

    /// The valid texels of the same chart among the eight around a texel, each by its block and its bit.
    fn neighbors(&self, index: u32) -> [Option<(u32, u64)>; 8] {
        let Texel { pixel: [x, y], image, chart, .. } = self.texels.list[index as usize];
        core::array::from_fn(|k| {
            let k = if k < 4 { k } else { k + 1 } as i32;
            let other = self.texels.at_pixel(u32::from(image), i32::from(x) + k % 3 - 1, i32::from(y) + k / 3 - 1)?;
            let texel = &self.texels.list[other as usize];
            let counts = texel.chart == chart && self.is_valid[other as usize];
            counts.then(|| (self.blocks.of_texel[other as usize], bit(texel)))
        })
    }
}

impl BlockLook {
    /// What the texels of the block saw of a lamp.
    fn of(&self, lamp: u32) -> Look {
        self.cut.lamps.binary_search(&lamp).map_or(Look::default(), |slot| self.looks[slot])
    }
}

/// Light without doubt.
fn certain(irradiance: Vec3) -> DirectTexel {
    let irradiance = irradiance / PI;
    let error = DirectError { darkest: irradiance.element_sum() / 3.0, ..DirectError::default() };
    DirectTexel { irradiance, error }
}
