//! Eight numbers at once, with the same bits on every processor: no operation is fused with another.

/// Numbers that are worked on at once.
pub const LANES: usize = 8;

/// Operations on eight numbers. A value proves that the processor has them.
pub trait Lanes: Copy {
    /// Eight numbers.
    type Numbers: Copy;
    /// Eight truth values.
    type Mask: Copy;

    fn load(self, numbers: &[f32; LANES]) -> Self::Numbers;
    fn store(self, numbers: Self::Numbers) -> [f32; LANES];
    fn splat(self, number: f32) -> Self::Numbers;
    fn add(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn sub(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn mul(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn div(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// The second where one is not a number.
    fn min(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// The second where one is not a number.
    fn max(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// Where `a <= b`.
    fn le(self, a: Self::Numbers, b: Self::Numbers) -> Self::Mask;
    /// Where `a == b`.
    fn eq(self, a: Self::Numbers, b: Self::Numbers) -> Self::Mask;
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    fn or(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// One bit for each, the first lowest.
    fn bits(self, mask: Self::Mask) -> u32;
}

/// What every processor has; compilers turn it into the instructions of the target.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

impl Plain {
    #[inline(always)]
    fn each<T>(a: [f32; LANES], b: [f32; LANES], operation: impl Fn(f32, f32) -> T) -> [T; LANES] {
        core::array::from_fn(|lane| operation(a[lane], b[lane]))
    }
}

impl Lanes for Plain {
    type Numbers = [f32; LANES];
    type Mask = [bool; LANES];

    #[inline(always)]
    fn load(self, numbers: &[f32; LANES]) -> Self::Numbers {
        *numbers
    }

    #[inline(always)]
    fn store(self, numbers: Self::Numbers) -> [f32; LANES] {
        numbers
    }

    #[inline(always)]
    fn splat(self, number: f32) -> Self::Numbers {
        [number; LANES]
    }

    #[inline(always)]
    fn add(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers {
        Self::each(a, b, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers {
        Self::each(a, b, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers {
        Self::each(a, b, |a, b| a * b)
    }

    #[inline(always)]
    fn div(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers {
        Self::each(a, b, |a, b| a / b)
    }

    #[inline(always)]
    fn min(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers {
        Self::each(a, b, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers {
        Self::each(a, b, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn le(self, a: Self::Numbers, b: Self::Numbers) -> Self::Mask {
        Self::each(a, b, |a, b| a <= b)
    }

    #[inline(always)]
    fn eq(self, a: Self::Numbers, b: Self::Numbers) -> Self::Mask {
        Self::each(a, b, |a, b| a == b)
    }

    #[inline(always)]
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        core::array::from_fn(|lane| a[lane] & b[lane])
    }

    #[inline(always)]
    fn or(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        core::array::from_fn(|lane| a[lane] | b[lane])
    }

    #[inline(always)]
    fn bits(self, mask: Self::Mask) -> u32 {
        mask.into_iter().enumerate().map(|(lane, is_set)| u32::from(is_set) << lane).sum()
    }
}
