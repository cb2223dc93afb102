//! Sums that stand for integrals over one variable.

use crate::math::Real;

/// A rule of Gauss and Legendre: the positive half of its points in `[-1, 1]`, each with its weight.
#[derive(Clone, Copy, Debug)]
pub struct Gauss(&'static [(f64, f64)]);

/// 4 points, exact to degree 7.
pub const GAUSS_4: Gauss =
    Gauss(&[(0.861_136_311_594_052_6, 0.347_854_845_137_453_86), (0.339_981_043_584_856_26, 0.652_145_154_862_546_1)]);

/// 6 points, exact to degree 11.
pub const GAUSS_6: Gauss = Gauss(&[
    (0.932_469_514_203_152, 0.171_324_492_379_170_36),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.238_619_186_083_196_9, 0.467_913_934_572_691_04),
]);

/// 8 points, exact to degree 15.
pub const GAUSS_8: Gauss = Gauss(&[
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.183_434_642_495_649_8, 0.362_683_783_378_361_96),
]);

/// 12 points, exact to degree 23.
pub const GAUSS_12: Gauss = Gauss(&[
    (0.981_560_634_246_719_2, 0.047_175_336_386_511_83),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_22),
    (0.587_317_954_286_617_5, 0.203_167_426_723_065_92),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_77),
]);

/// 16 points, exact to degree 31.
pub const GAUSS_16: Gauss = Gauss(&[
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
]);

impl Gauss {
    /// The mean of `f` over `[0, 1]`.
    #[inline]
    pub fn mean(self, mut f: impl FnMut(f64) -> f64) -> f64 {
        let pair = |&(x, weight): &(f64, f64)| weight * (f(0.5 - 0.5 * x) + f(0.5 + 0.5 * x));
        0.5 * self.0.iter().map(pair).sum::<f64>()
    }

    /// The mean of `f` over the triangle `x, y >= 0, x + y <= 1`.
    pub fn mean_over_triangle(self, mut f: impl FnMut(f64, f64) -> f64) -> f64 {
        2.0 * self.mean(|x| (1.0 - x) * self.mean(|y| f(x, (1.0 - x) * y)))
    }
}

/// The integral of `f` from `a` to `b`, where `f` may have roots, logarithms and steep slopes at both ends.
///
/// 81 points of the rule of Takahasi and Mori 1974; full double precision where `f` is analytic inside.
pub fn tanh_sinh(a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    const STEP: f64 = 0.08;
    let half = 0.5 * (b - a);
    let mut at = |t: f64| {
        let grown = t.exp();
        let small = (-core::f64::consts::FRAC_PI_2 * (grown - 1.0 / grown)).exp();
        // The share of the interval beyond the point, and the slope of the substitution.
        let beyond = small / (1.0 + small);
        let slope = core::f64::consts::PI * (grown + 1.0 / grown) * beyond / (1.0 + small);
        slope * (f(a + 2.0 * half * beyond) + f(b - 2.0 * half * beyond))
    };
    let sum: f64 = (1..=40).map(|k| at(STEP * f64::from(k))).sum();
    half * STEP * (sum + 0.5 * at(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_exact() {
        for (rule, degree) in [(GAUSS_4, 7), (GAUSS_6, 11), (GAUSS_8, 15), (GAUSS_12, 23), (GAUSS_16, 31)] {
            let mean = rule.mean(|x| (0..degree).fold(1.0, |power, _| power * x));
            assert!((mean * f64::from(degree + 1) - 1.0).abs() < 1e-14);
            let mean = rule.mean_over_triangle(|x, y| x * x * y);
            assert!((mean - 1.0 / 30.0).abs() < 1e-15);
        }
    }

    #[test]
    fn singular_ends() {
        assert!((tanh_sinh(0.0, 1.0, Real::sqrt) - 2.0 / 3.0).abs() < 1e-15);
        assert!((tanh_sinh(0.0, 2.0, Real::ln) - (2.0 * core::f64::consts::LN_2 - 2.0)).abs() < 1e-14);
        assert!((tanh_sinh(-1.0, 1.0, |x| Real::sqrt(1.0 - x * x)) - core::f64::consts::FRAC_PI_2).abs() < 1e-14);
    }
}
