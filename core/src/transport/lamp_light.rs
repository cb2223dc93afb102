//! The direct light of one lamp, for any strength of it.

use alloc::vec::Vec;
use core::ops::Range;

use glam::{Vec3, Vec3A};

use super::{Codes, Lighting, Origin};

/// Zeros that a run of lit receivers may hold: a run of its own would take more.
const MOST_ZEROS: usize = 4;

/// The direct light of one lamp: what receivers get when the lamp has strength 1 in the channels of `color`.
#[derive(Clone, Debug, PartialEq)]
pub struct LampLight {
    /// The lamp.
    pub origin: Origin,
    /// White, or one channel of a lamp whose color differs from place to place.
    pub(super) color: Vec3,
    /// Receivers in a row that are lit.
    pub(super) runs: Vec<Run>,
    /// Irradiance / pi of the lit receivers.
    pub(super) light: Codes,
}

/// Receivers in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    /// The first receiver.
    pub start: u32,
    /// Where in the list of numbers the run begins; it ends where the next one begins.
    pub first: u32,
}

impl LampLight {
    /// Keeps irradiance / pi for all receivers from a lamp of strength 1: one list where it is white, else three.
    pub fn new(origin: Origin, irradiance: &[Vec3]) -> impl Iterator<Item = Self> + '_ {
        let is_white = irradiance.iter().all(|light| light.x == light.y && light.x == light.z);
        let colors = if is_white { &[Vec3::ONE][..] } else { &Vec3::AXES[..] };
        let channel = |color: &Vec3| color.max_position();
        colors.iter().map(move |color| Self::of_channel(origin, *color, channel(color), irradiance))
    }

    fn of_channel(origin: Origin, color: Vec3, channel: usize, irradiance: &[Vec3]) -> Self {
        let (mut runs, mut numbers, mut end) = (Vec::new(), Vec::new(), 0);
        let lit = irradiance.iter().map(|light| light[channel]).enumerate().filter(|&(_, light)| light > 0.0);
        for (receiver, light) in lit {
            if runs.is_empty() || receiver > end + MOST_ZEROS {
                runs.push(Run { start: receiver as u32, first: numbers.len() as u32 });
            } else {
                numbers.extend((end..receiver).map(|_| 0.0));
            }
            numbers.push(light);
            end = receiver + 1;
        }
        Self { origin, color, runs, light: Codes::new(numbers.iter().copied()) }
    }

    /// Adds irradiance / pi to `sums`, which belong to a range of receivers.
    pub fn add(&self, lighting: &Lighting, receivers: &Range<usize>, sums: &mut [Vec3A]) {
        let strength = Vec3A::from(lighting.strength(self.origin) * self.color);
        if strength == Vec3A::ZERO {
            return;
        }
        let first = self.runs.partition_point(|run| (run.start as usize) < receivers.start).saturating_sub(1);
        for (index, run) in self.runs.iter().enumerate().skip(first) {
            let start = run.start as usize;
            if start >= receivers.end {
                break;
            }
            let end = start + self.length(index);
            for receiver in start.max(receivers.start)..end.min(receivers.end) {
                sums[receiver - receivers.start] += strength * self.light.get(run.first as usize + receiver - start);
            }
        }
    }

    /// What it takes, in bytes.
    pub fn bytes(&self) -> usize {
        2 * self.light.len() + 8 * self.runs.len()
    }

    /// Whether all that is named exists: what a file must show.
    pub(super) fn is_sound(&self, receivers: usize, lighting: &Lighting) -> bool {
        let exists = match self.origin {
            Origin::Lamp(lamp) => (lamp as usize) < lighting.lamps.len(),
            Origin::Material(material) => (material as usize) < lighting.materials.len(),
            Origin::Sky => true,
        };
        let starts_at_zero = self.runs.first().map_or(self.light.is_empty(), |run| run.first == 0);
        let in_order = self.runs.is_sorted_by_key(|run| run.start) && self.runs.is_sorted_by_key(|run| run.first);
        let ends = |index: usize| self.runs[index].start as usize + self.length(index);
        let within = self.runs.iter().all(|run| run.first as usize <= self.light.len());
        exists && starts_at_zero && in_order && within && (0..self.runs.len()).all(|index| ends(index) <= receivers)
    }

    fn length(&self, index: usize) -> usize {
        let end = self.runs.get(index + 1).map_or(self.light.len(), |next| next.first as usize);
        end - self.runs[index].first as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    fn sum(irradiance: &[Vec3], strength: Vec3, receivers: Range<usize>) -> Vec<Vec3A> {
        let lighting = Lighting { lamps: vec![strength], ..Lighting::default() };
        let mut sums = vec![Vec3A::ZERO; receivers.len()];
        LampLight::new(Origin::Lamp(0), irradiance).for_each(|light| light.add(&lighting, &receivers, &mut sums));
        sums
    }

    /// White and colored light come back from any part of the list, with gaps short and long.
    #[test]
    fn what_is_kept_comes_back() {
        let strength = Vec3::new(2.0, 1.0, 0.5);
        for color in [Vec3::ONE, Vec3::new(0.7, 0.0, 0.2)] {
            let at = |k: usize| color * if k % 13 < 6 || k % 5 < 1 { (k % 7) as f32 } else { 0.0 };
            let irradiance: Vec<Vec3> = (0..100).map(at).collect();
            for range in [0..100, 17..64, 99..100, 40..40] {
                for (got, expected) in sum(&irradiance, strength, range.clone()).into_iter().zip(&irradiance[range]) {
                    assert!(Vec3::from(got).abs_diff_eq(*expected * strength, 3e-3), "{got} {expected}");
                }
            }
        }
    }
}
