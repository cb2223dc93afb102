//! The random numbers of a path: a point of a sequence of its own for each decision.

use glam::Vec3;

use crate::geometry::{Sobol, hash, shuffled};

/// The numbers of one path of several.
pub(super) struct Numbers {
    index: u32,
    seed: u32,
    decision: u32,
}

impl Numbers {
    /// Of path `index` of those that share a seed.
    pub fn new(seed: u32, index: u32) -> Self {
        Self { index, seed, decision: 0 }
    }

    /// Three numbers in `[0, 1)` for the next decision, and one more for what else is to be decided with it.
    pub fn next(&mut self) -> (Vec3, f32) {
        let seed = hash(self.seed, self.decision);
        self.decision += 1;
        let (sequence, index) = (Sobol::new(seed), shuffled(self.index, hash(seed, 1)));
        let [x, y, z, rest] = core::array::from_fn(|dimension| sequence.dimension(index, dimension));
        (Vec3::new(x, y, z), rest)
    }

    /// What decides whether light passes something transparent.
    pub fn seed(&self) -> u32 {
        hash(hash(self.seed, self.decision), self.index)
    }
}
