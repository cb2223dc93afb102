//! Eight numbers in one register of AVX2, where the processor has it.

use pulp::x86::V3;
use pulp::{cast, f32x8};

use super::lanes::{LANES, Lanes, Plain};
use super::{Task, run_task};

/// The widest instructions that the processor has.
#[derive(Clone, Copy, Debug)]
pub struct Level(Option<V3>);

impl Level {
    pub fn new() -> Self {
        Self(V3::try_new())
    }

    /// What every processor has.
    #[cfg(test)]
    pub fn plain() -> Self {
        Self(None)
    }

    /// Runs a task with these instructions.
    #[inline]
    pub fn run<T: Task>(self, task: T) -> T::Output {
        match self.0 {
            Some(v3) => v3.vectorize(With { task, v3 }),
            None => run_task(task, Plain),
        }
    }
}

struct With<T> {
    task: T,
    v3: V3,
}

impl<T: Task> pulp::NullaryFnOnce for With<T> {
    type Output = T::Output;

    #[inline(always)]
    fn call(self) -> T::Output {
        self.task.run(self.v3)
    }
}

impl Lanes for V3 {
    type Numbers = f32x8;
    type Mask = f32x8;

    #[inline(always)]
    fn load(self, numbers: &[f32; LANES]) -> f32x8 {
        cast(*numbers)
    }

    #[inline(always)]
    fn store(self, numbers: f32x8) -> [f32; LANES] {
        cast(numbers)
    }

    #[inline(always)]
    fn splat(self, number: f32) -> f32x8 {
        self.splat_f32x8(number)
    }

    #[inline(always)]
    fn add(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_add_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn sub(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_sub_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn mul(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_mul_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn div(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_div_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn min(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_min_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn max(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_max_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn le(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_cmp_ps::<{ core::arch::x86_64::_CMP_LE_OQ }>(cast(a), cast(b)))
    }

    #[inline(always)]
    fn eq(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_cmp_ps::<{ core::arch::x86_64::_CMP_EQ_OQ }>(cast(a), cast(b)))
    }

    #[inline(always)]
    fn and(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_and_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn or(self, a: f32x8, b: f32x8) -> f32x8 {
        cast(self.avx._mm256_or_ps(cast(a), cast(b)))
    }

    #[inline(always)]
    fn bits(self, mask: f32x8) -> u32 {
        self.avx._mm256_movemask_ps(cast(mask)) as u32
    }
}
