//! Numbers from zero to a largest one in 16 bits each.

use alloc::vec::Vec;

use glam::Vec3A;

/// `f32` bits that a code leaves out at the end.
const SHIFT: u32 = 12;
/// Code 65535 stands for 1: the first bits of 1.0, minus this.
const BASE: u32 = (1.0_f32.to_bits() >> SHIFT) - 0xffff;

/// Numbers from zero to a largest one in 16 bits each, to 1/4096 of themselves: 5 bits of exponent, 11 of mantissa.
///
/// Zero and the largest number are exact; what is below `2^-32` of the largest becomes zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Codes {
    /// The number that the largest code stands for.
    pub(super) largest: f32,
    pub(super) codes: Vec<u16>,
}

impl Codes {
    /// Codes for numbers that are not negative.
    pub fn new(numbers: impl Iterator<Item = f32> + Clone) -> Self {
        let largest = numbers.clone().fold(0.0, f32::max);
        let scale = 1.0 / largest.max(f32::MIN_POSITIVE);
        Self { largest, codes: numbers.map(|number| encode(number * scale)).collect() }
    }

    /// The number of numbers.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Whether there is no number.
    pub fn is_empty(&self) -> bool {
        self.codes.is_empty()
    }

    /// Number `index`.
    #[inline]
    pub fn get(&self, index: usize) -> f32 {
        decode(self.codes[index]) * self.largest
    }

    /// The three numbers from `3 * index` on.
    #[inline]
    pub fn rgb(&self, index: usize) -> Vec3A {
        let codes = &self.codes[3 * index..3 * index + 3];
        Vec3A::new(decode(codes[0]), decode(codes[1]), decode(codes[2])) * self.largest
    }
}

/// The code of a number in `[0, 1]`.
fn encode(number: f32) -> u16 {
    let rounded = (number.clamp(0.0, 1.0).to_bits() + (1 << (SHIFT - 1))) >> SHIFT;
    rounded.saturating_sub(BASE).min(0xffff) as u16
}

#[inline]
fn decode(code: u16) -> f32 {
    if code == 0 { 0.0 } else { f32::from_bits((u32::from(code) + BASE) << SHIFT) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_close() {
        let numbers: Vec<f32> = (0..600).map(|k| 1e9 / (1.0 + k as f32).powi(3)).chain([0.0]).collect();
        let codes = Codes::new(numbers.iter().copied());
        assert_eq!((codes.get(0), codes.get(600)), (1e9, 0.0));
        for (k, number) in numbers.iter().enumerate() {
            assert!((codes.get(k) - number).abs() <= number / 4096.0, "{number}");
        }
        assert_eq!(Codes::new([0.0, 0.0].into_iter()).get(1), 0.0);
    }
}
