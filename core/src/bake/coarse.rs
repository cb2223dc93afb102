//! Numbers of which the order of magnitude matters, in 8 bits each.

use alloc::vec::Vec;

/// Codes for each doubling.
const PER_OCTAVE: u32 = 8;
/// `f32` bits below the exponent that a code leaves out.
const SHIFT: u32 = 23 - PER_OCTAVE.ilog2();

/// Numbers from zero to a largest one in 8 bits each, to 1/16 of themselves: 5 bits of exponent, 3 of mantissa.
///
/// What is below `2^-31` of the largest becomes zero.
pub(super) struct Coarse {
    largest: f32,
    codes: Vec<u8>,
}

impl Coarse {
    /// Codes for numbers that are not negative.
    pub fn new(numbers: impl Iterator<Item = f32> + Clone) -> Self {
        let largest = numbers.clone().fold(0.0, f32::max);
        let scale = 1.0 / largest.max(f32::MIN_POSITIVE);
        Self { largest, codes: numbers.map(|number| encode(number * scale)).collect() }
    }

    /// The three numbers from `3 * index` on.
    pub fn three(&self, index: usize) -> [f32; 3] {
        [0, 1, 2].map(|k| decode(self.codes[3 * index + k]) * self.largest)
    }
}

/// Code 255 stands for 1: the first bits of 1.0, minus this.
const BASE: u32 = (1.0_f32.to_bits() >> SHIFT) - 0xff;

fn encode(number: f32) -> u8 {
    let rounded = (number.clamp(0.0, 1.0).to_bits() + (1 << (SHIFT - 1))) >> SHIFT;
    rounded.saturating_sub(BASE).min(0xff) as u8
}

fn decode(code: u8) -> f32 {
    if code == 0 { 0.0 } else { f32::from_bits((u32::from(code) + BASE) << SHIFT) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_close() {
        let numbers = (0..600).map(|k| 1e6 / (1.0 + k as f32).powi(2)).chain([0.0; 3]);
        let codes = Coarse::new(numbers.clone());
        for (k, number) in numbers.enumerate() {
            let decoded = codes.three(k / 3)[k % 3];
            assert!((decoded - number).abs() <= number / 16.0, "{decoded} for {number}");
        }
    }
}
