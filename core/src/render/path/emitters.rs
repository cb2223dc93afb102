//! Triangles that shine, chosen by what they emit.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::Optics;
use crate::geometry::{Hit, normal_and_area};
use crate::math;
use crate::scatter::Colored;

/// Where the brightness of a triangle is looked up.
const PLACES: [Vec2; 4] = [Vec2::new(0.33, 0.33), Vec2::new(0.1, 0.1), Vec2::new(0.8, 0.1), Vec2::new(0.1, 0.8)];

/// All triangles that emit. What is missing here, as a dark place of a picture may be, is found by the paths alone.
pub(super) struct Emitters {
    /// Triangles with the sum of area times level up to them.
    ends: Vec<(f32, u32)>,
    /// For each triangle of the scene its points for each square meter.
    densities: Vec<f32>,
}

impl Emitters {
    pub fn new<S: Colored>(optics: &impl Optics<S>) -> Self {
        let (mut ends, mut power) = (Vec::new(), 0.0);
        let mut densities = vec![0.0; optics.corners().len()];
        for (triangle, corners) in optics.corners().iter().enumerate() {
            let hit = |barycentric| Hit { triangle: triangle as u32, distance: 0.0, barycentric, front: true };
            let level = PLACES.iter().fold(0.0_f32, |level, &at| level.max(optics.emission(&hit(at)).max_abs()));
            let area = normal_and_area(corners).map_or(0.0, |(_, area)| area);
            if level * area > 0.0 {
                power += level * area;
                densities[triangle] = level;
                ends.push((power, triangle as u32));
            }
        }
        densities.iter_mut().for_each(|density| *density /= power);
        Self { ends, densities }
    }

    /// A point that emits, by three numbers in `[0, 1)`, if there is any.
    pub fn point(&self, numbers: Vec3) -> Option<Hit> {
        let (power, _) = *self.ends.last()?;
        let index = self.ends.partition_point(|(end, _)| *end <= numbers.z * power).min(self.ends.len() - 1);
        let root = math::sqrt(numbers.x);
        let barycentric = Vec2::new(root * (1.0 - numbers.y), root * numbers.y);
        Some(Hit { triangle: self.ends[index].1, distance: 0.0, barycentric, front: true })
    }

    /// How many of the points lie on a square meter of a triangle, on average.
    pub fn density(&self, triangle: u32) -> f32 {
        self.densities[triangle as usize]
    }
}
