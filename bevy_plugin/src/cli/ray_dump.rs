//! Rays of a bake in a file, to trace them by other means: each 64th tile of work.
//!
//! A ray is eight little-endian f32: origin, direction, end in multiples of the direction, 0 for the closest hit or 1
//! for any.

use std::fs;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use radiosity::geometry::{Ray, RayKind, RayLog};

use super::error::CliError;

/// Successive rays that make a tile: those of about 32 texels.
const TILE: u64 = 2048;
/// Of so many tiles one is kept.
const EVERY: u64 = 64;

/// Keeps the rays of every 64th tile, in the order of tracing: those of several threads would come mixed.
#[derive(Default)]
pub(super) struct RayDump(Mutex<Kept>);

#[derive(Default)]
struct Kept {
    seen: u64,
    bytes: Vec<u8>,
}

impl RayDump {
    /// Writes what was kept.
    pub fn write(self, file: &Path) -> Result<(), CliError> {
        let kept = self.0.into_inner().unwrap_or_else(PoisonError::into_inner);
        fs::write(file, kept.bytes)
            .map_err(|error| CliError::new(format!("{} cannot be written: {error}", file.display())))
    }
}

impl RayLog for RayDump {
    fn record(&self, ray: &Ray, kind: RayKind) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if (kept.seen / TILE).is_multiple_of(EVERY) {
            let kind = if kind == RayKind::Closest { 0.0 } else { 1.0 };
            let numbers = ray.origin.to_array().into_iter().chain(ray.direction.to_array()).chain([ray.end, kind]);
            kept.bytes.extend(numbers.flat_map(f32::to_le_bytes));
        }
        kept.seen += 1;
    }
}

#[cfg(test)]
mod tests {
    use bevy::math::Vec3;

    use super::*;

    /// Of 200 tiles the first of each 64 is kept: four.
    #[test]
    fn every_64th_tile_is_kept() {
        let dump = RayDump::default();
        for index in 0..200 * TILE {
            let ray = Ray { origin: Vec3::splat(index as f32), direction: Vec3::X, end: f32::INFINITY };
            dump.record(&ray, if index == 1 { RayKind::AnyHit } else { RayKind::Closest });
        }
        let bytes = dump.0.into_inner().unwrap().bytes;
        let numbers: Vec<f32> = bytes.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect();
        assert_eq!(numbers.len() as u64, 4 * TILE * 8);
        assert_eq!(numbers[8..16], [1.0, 1.0, 1.0, 1.0, 0.0, 0.0, f32::INFINITY, 1.0]);
        assert_eq!(numbers[TILE as usize * 8], (EVERY * TILE) as f32);
    }
}
