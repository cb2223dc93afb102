//! Points that fill the unit square more evenly than chance: Owen-scrambled Sobol sequences.
//!
//! Direction numbers of Joe and Kuo 2008; scrambling by hashing as in Burley, "Practical Hash-based Owen Scrambling",
//! JCGT 2020. Every prefix of a power of two is stratified in each pair of dimensions used here.

use glam::Vec2;

/// Direction numbers of the second to fourth dimension; the first is the reversal of the bits.
const DIRECTIONS: [[u32; 32]; 3] =
    [directions(1, 0, [1, 0, 0]), directions(2, 1, [1, 3, 0]), directions(3, 1, [1, 3, 1])];

/// The recurrence of Bratley and Fox for a primitive polynomial of `degree` with middle coefficients `a`.
const fn directions(degree: usize, a: u32, first: [u32; 3]) -> [u32; 32] {
    let mut v = [0; 32];
    let mut i = 0;
    while i < 32 {
        v[i] = if i < degree {
            first[i] << (31 - i)
        } else {
            let mut next = v[i - degree] ^ (v[i - degree] >> degree);
            let mut k = 1;
            while k < degree {
                next ^= ((a >> (degree - 1 - k)) & 1) * v[i - k];
                k += 1;
            }
            next
        };
        i += 1;
    }
    v
}

/// One dimension in `0..4` of point `index`, as a fraction of 2^32.
fn sobol(index: u32, dimension: usize) -> u32 {
    if dimension == 0 {
        return index.reverse_bits();
    }
    let mut rest = index;
    let mut x = 0;
    while rest != 0 {
        x ^= DIRECTIONS[dimension - 1][rest.trailing_zeros() as usize];
        rest &= rest - 1;
    }
    x
}

/// Nested uniform (Owen) scrambling: flips each bit depending on the bits above it.
fn owen(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

/// The place of a point in a shuffled sequence: points of sequences that are shuffled by different seeds are paired by
/// chance, and still every prefix of a power of two is stratified.
pub fn shuffled(index: u32, seed: u32) -> u32 {
    owen(index, seed)
}

/// Mixes two numbers into one that looks random.
pub fn hash(a: u32, b: u32) -> u32 {
    let mut x = a ^ b.wrapping_mul(0x9e37_79b9).rotate_left(15);
    x = (x ^ (x >> 16)).wrapping_mul(0x21f0_aaad);
    x = (x ^ (x >> 15)).wrapping_mul(0x735a_2d97);
    x ^ (x >> 15)
}

/// A scrambled sequence of four dimensions; different seeds give independent sequences.
#[derive(Clone, Copy, Debug)]
pub struct Sobol {
    seeds: [u32; 4],
}

impl Sobol {
    /// The sequence of this seed.
    pub fn new(seed: u32) -> Self {
        Self { seeds: core::array::from_fn(|dimension| hash(seed, 0x5bd1 + dimension as u32)) }
    }

    /// One dimension in `0..4` of point `index`, in `[0, 1)`.
    #[inline]
    pub fn dimension(&self, index: u32, dimension: usize) -> f32 {
        let x = owen(sobol(index, dimension), self.seeds[dimension]);
        (x >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// The first two dimensions of point `index`, in `[0, 1)`.
    #[inline]
    pub fn square(&self, index: u32) -> Vec2 {
        Vec2::new(self.dimension(index, 0), self.dimension(index, 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 2^m points each elementary interval of area 2^-m holds exactly one.
    #[test]
    fn first_two_dimensions_are_a_net() {
        for seed in [0, 1, 77] {
            let sequence = Sobol::new(seed);
            for (columns, rows) in [(256, 1), (64, 4), (16, 16), (4, 64), (1, 256)] {
                let mut met = [0; 256];
                for index in 0..256 {
                    let Vec2 { x, y } = sequence.square(index);
                    met[(x * columns as f32) as usize * rows + (y * rows as f32) as usize] += 1;
                }
                assert_eq!(met, [1; 256], "seed {seed}, {columns} x {rows}");
            }
        }
    }

    #[test]
    fn every_dimension_is_stratified() {
        for dimension in 0..4 {
            let mut met = [0; 64];
            (0..64).for_each(|i| met[(Sobol::new(5).dimension(i, dimension) * 64.0) as usize] += 1);
            assert_eq!(met, [1; 64]);
        }
    }
}
