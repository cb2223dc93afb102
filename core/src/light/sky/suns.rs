//! The sun of a sky, and what else is small and bright in it, as lights of their own.

use alloc::vec;
use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::Vec3;

use super::density::Densities;
use super::{SkyImage, direction};
use crate::light::DirectionalLight;
use crate::math;

/// A sun is brighter than so many times the mean of the sky...
const BRIGHT: f32 = 30.0;
/// ...ends where it falls below this share of its brightest texel...
const EDGE: f32 = 0.1;
/// ...and is no larger than this, in sr: 3 degrees around its middle.
const LARGEST: f32 = 0.0086;
/// Smaller shares of the light of the sky stay in it.
const LEAST_SHARE: f32 = 0.01;
/// A sky has no more suns.
const MOST: usize = 4;

impl SkyImage {
    /// Takes suns out of the image, so that their shadows are as sharp as they are small. What they covered becomes as
    /// bright as what lies around them.
    pub fn take_suns(&mut self) -> Vec<DirectionalLight> {
        let mut suns = Vec::new();
        while suns.len() < MOST
            && let Some(sun) = self.take_sun()
        {
            suns.push(sun);
        }
        if !suns.is_empty() {
            self.densities = Densities::new(self);
        }
        suns
    }

    fn take_sun(&mut self) -> Option<DirectionalLight> {
        let level = |texel: Vec3| texel.max_element();
        let angles: Vec<f32> = (0..self.height).map(|row| self.solid_angle(row)).collect();
        let row_of = |index: usize| index / self.width as usize;
        let whole: f32 =
            self.texels.iter().enumerate().map(|(index, &texel)| level(texel) * angles[row_of(index)]).sum();
        let brightest =
            (0..self.texels.len()).max_by(|&a, &b| level(self.texels[a]).total_cmp(&level(self.texels[b])))?;
        let least = (EDGE * level(self.texels[brightest])).max(BRIGHT * whole / (4.0 * PI));
        if level(self.texels[brightest]) <= least {
            return None;
        }
        let (members, border) = self.region(brightest, |texel| level(texel) >= least);
        let around = border.iter().map(|&index| self.texels[index]).sum::<Vec3>() / border.len().max(1) as f32;
        let (mut illuminance, mut toward, mut angle) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for &index in &members {
            let more = (self.texels[index] - around).max(Vec3::ZERO) * angles[row_of(index)];
            illuminance += more;
            toward += self.direction_of(index) * level(more);
            angle += angles[row_of(index)];
        }
        if angle > LARGEST || level(illuminance) < LEAST_SHARE * whole {
            return None;
        }
        members.iter().for_each(|&index| self.texels[index] = around);
        // A cone of this half angle has the solid angle pi sin^2, nearly.
        let angular_diameter = 2.0 * math::sqrt(angle / PI);
        Some(DirectionalLight { direction: -(self.rotation * toward.try_normalize()?), illuminance, angular_diameter })
    }

    /// Texels that hang together and belong, from one that does, and those around them.
    fn region(&self, start: usize, belongs: impl Fn(Vec3) -> bool) -> (Vec<usize>, Vec<usize>) {
        let mut known = vec![false; self.texels.len()];
        let (mut members, mut border, mut open) = (Vec::new(), Vec::new(), vec![start]);
        known[start] = true;
        while let Some(index) = open.pop() {
            if !belongs(self.texels[index]) {
                border.push(index);
                continue;
            }
            members.push(index);
            for next in self.neighbors(index) {
                if !core::mem::replace(&mut known[next], true) {
                    open.push(next);
                }
            }
        }
        (members, border)
    }

    /// Texels beside one; rows close, and at a pole all texels touch the one opposite.
    fn neighbors(&self, index: usize) -> [usize; 4] {
        let (width, height) = (self.width as usize, self.height as usize);
        let (x, y) = (index % width, index / width);
        let opposite = y * width + (x + width / 2) % width;
        [
            y * width + (x + 1) % width,
            y * width + (x + width - 1) % width,
            if y > 0 { index - width } else { opposite },
            if y + 1 < height { index + width } else { opposite },
        ]
    }

    /// The middle of a texel, in the image.
    fn direction_of(&self, index: usize) -> Vec3 {
        let place = [index % self.width as usize, index / self.width as usize].map(|place| place as f32 + 0.5);
        direction(glam::Vec2::from(place) / glam::Vec2::new(self.width as f32, self.height as f32))
    }
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;

    const TOWARD: Vec3 = Vec3::new(0.48, 0.64, 0.6);

    fn sunny(cosine: f32, level: f32) -> SkyImage {
        let radiance =
            |direction: Vec3| if direction.dot(TOWARD) > cosine { Vec3::new(1.0, 0.9, 0.8) * level } else { Vec3::ONE };
        SkyImage::from_fn(1024, 512, radiance).unwrap()
    }

    /// A disc of one degree and 20 000 times the sky becomes a lamp with its light, and nothing of it stays.
    #[test]
    fn a_sun_is_taken_out() {
        let cosine = math::cos(PI / 180.0);
        let mut sky = sunny(cosine, 2e4).turned(Quat::from_rotation_y(2.0));
        let suns = sky.take_suns();
        assert_eq!(suns.len(), 1);
        let solid_angle = 2.0 * PI * (1.0 - cosine);
        let expected = (Vec3::new(1.0, 0.9, 0.8) * 2e4 - 1.0) * solid_angle;
        let ratio = suns[0].illuminance / expected;
        assert!((ratio - 1.0).abs().max_element() < 0.05, "{ratio}");
        assert!((suns[0].angular_diameter / (PI / 90.0) - 1.0).abs() < 0.03);
        assert!(suns[0].direction.dot(Quat::from_rotation_y(2.0) * -TOWARD) > 0.99999);
        assert!((sky.density(Vec3::X) * 4.0 * PI - 1.0).abs() < 1e-3, "an even sky is left");
        assert_eq!(sky.take_suns(), []);
    }

    /// What is wide, dim or black is no sun.
    #[test]
    fn other_skies_have_none() {
        assert_eq!(sunny(0.99, 1e4).take_suns(), []);
        assert_eq!(sunny(math::cos(PI / 180.0), 20.0).take_suns(), []);
        assert_eq!(SkyImage::new(2, 1, vec![Vec3::ZERO; 2]).unwrap().take_suns(), []);
        assert_eq!(SkyImage::new(1, 1, vec![Vec3::ONE]).unwrap().take_suns(), []);
    }
}
