//! Which texels without light of their own take it from which neighbors: found once, done for any light.

use alloc::vec::Vec;

use glam::Vec3;

/// The texels of an image that become means of neighbors, ring after ring.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fills {
    /// Texels in a row of the image.
    pub width: u32,
    /// Where in `texels` each ring ends. A ring takes from what was known before it.
    pub rings: Vec<u32>,
    /// Index of each texel in the image.
    pub texels: Vec<u32>,
    /// For each texel from which of the eight around it: bit `k` stands for [`NEIGHBORS`]`[k]`.
    pub from: Vec<u8>,
}

/// Steps to the texels around one: columns to the right, and rows down.
pub const NEIGHBORS: [[i32; 2]; 8] = [[-1, -1], [0, -1], [1, -1], [-1, 0], [1, 0], [-1, 1], [0, 1], [1, 1]];

impl Fills {
    /// Fills an image.
    pub fn apply(&self, image: &mut [Vec3]) {
        let steps = NEIGHBORS.map(|[x, y]| (x + y * self.width as i32) as isize);
        // In the order of the rings; neighbors within a ring are not taken from.
        for (&at, &from) in self.texels.iter().zip(&self.from) {
            let (at, mut sum, mut rest) = (at as usize, Vec3::ZERO, from);
            while rest != 0 {
                sum += image[at.wrapping_add_signed(steps[rest.trailing_zeros() as usize])];
                rest &= rest - 1;
            }
            image[at] = sum / from.count_ones().max(1) as f32;
        }
    }

    /// What the fills take, in bytes.
    pub fn bytes(&self) -> usize {
        5 * self.texels.len() + 4 * self.rings.len()
    }

    /// Whether all that is named lies within an image: what a file must show.
    pub(super) fn is_sound(&self, width: u32, height: u32) -> bool {
        let is_inside = |(&at, &from): (&u32, &u8)| {
            let (x, y) = ((at % width) as i32, (at / width) as i32);
            let mut sources = NEIGHBORS.iter().enumerate().filter(|(k, _)| from >> k & 1 == 1);
            at < width * height
                && sources.all(|(_, [dx, dy])| {
                    (0..width as i32).contains(&(x + dx)) && (0..height as i32).contains(&(y + dy))
                })
        };
        let in_order = self.rings.is_sorted() && self.rings.last().map_or(0, |&end| end as usize) == self.texels.len();
        let fits = self.width == width && self.from.len() == self.texels.len();
        fits && in_order && self.texels.iter().zip(&self.from).all(is_inside)
    }
}
