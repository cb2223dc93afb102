//! How long a curve is, and travel along it at constant speed.

use super::{Curve, Jet, Parameter};
use crate::math::{Real, VectorSpace};

/// The length of a curve between two parameters of its domain, negative if they descend.
///
/// Off by at most about `tolerance`, an absolute length, or by rounding if that is more; each piece between breaks is
/// measured by [`Curve::piece_length`].
#[inline]
pub fn arc_length<C: Curve>(curve: &C, [from, to]: [Parameter<C>; 2], tolerance: Parameter<C>) -> Parameter<C> {
    if from > to {
        return -arc_length(curve, [to, from], tolerance);
    }
    let (mut length, mut start) = (Parameter::<C>::ZERO, from);
    while start < to {
        let next = curve.next_break(start);
        let end = if next > start && next < to { next } else { to };
        length += curve.piece_length([start, end], tolerance);
        start = end;
    }
    length
}

/// The parameter at a distance along a curve from another parameter; the end of the domain if it is not as long.
///
/// The inverse of [`arc_length`] from there: a negative distance leads backwards, at most to the start of the domain. The
/// distance on the curve to the one asked for is at most about `tolerance`. Newton's method, held between bounds
/// that close in: the derivative of the length is the speed.
pub fn parameter_at<C: Curve>(
    curve: &C,
    from: Parameter<C>,
    distance: Parameter<C>,
    tolerance: Parameter<C>,
) -> Parameter<C> {
    let is_backwards = distance < Parameter::<C>::ZERO;
    let end = curve.domain()[usize::from(!is_backwards)];
    let length = arc_length(curve, [from, end], tolerance);
    let is_too_far = if is_backwards { distance <= length } else { distance >= length };
    if is_too_far {
        return end;
    }
    let guess = from + (end - from) * (distance / length);
    let bounds = if is_backwards { [end, from] } else { [from, end] };
    invert(curve, bounds, [from, guess], distance, tolerance)
}

/// A curve by the distance travelled along it: all its points are passed at speed 1.
///
/// Keeps `N` parameters and the lengths up to them, in `2 N` numbers. `N` is at least 2, for both ends; with less it does
/// not compile:
///
/// ```compile_fail
/// # use radiosity::spline::{Cubic, Travel};
/// Travel::<_, 1>::new(Cubic([0.0, 1.0, 0.0, 0.0]), 1e-3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Travel<C: Curve, const N: usize> {
    curve: C,
    parameters: [Parameter<C>; N],
    lengths: [Parameter<C>; N],
    tolerance: Parameter<C>,
}

impl<C: Curve, const N: usize> Travel<C, N> {
    /// Measures a curve, off by at most about `tolerance`, an absolute length.
    pub fn new(curve: C, tolerance: Parameter<C>) -> Self {
        const { assert!(N >= 2, "a way has two ends: N is at least 2") };
        let ([start, end], tolerance) = (curve.domain(), tolerance / Parameter::<C>::from_usize(N));
        let share = |i: usize| Parameter::<C>::from_usize(i) / Parameter::<C>::from_usize(N - 1);
        let parameters = core::array::from_fn(|i| start + (end - start) * share(i));
        let mut lengths = [Parameter::<C>::ZERO; N];
        for i in 1..N {
            lengths[i] = lengths[i - 1] + arc_length(&curve, [parameters[i - 1], parameters[i]], tolerance);
        }
        Self { curve, parameters, lengths, tolerance }
    }

    /// The whole way.
    pub fn length(&self) -> Parameter<C> {
        self.lengths.last().copied().unwrap_or_default()
    }

    /// The parameter of the curve after a distance; at its ends before the first and after the last one.
    pub fn parameter(&self, distance: Parameter<C>) -> Parameter<C> {
        let i = self.lengths.partition_point(|&length| length <= distance);
        let [Some(before), Some(&end)] = [i.checked_sub(1).map(|i| &self.lengths[i]), self.lengths.get(i)] else {
            return self.curve.domain()[usize::from(i > 0)];
        };
        let interval = [self.parameters[i - 1], self.parameters[i]];
        let share = (distance - *before) / (end - *before);
        let guess = interval[0] + (interval[1] - interval[0]) * share;
        invert(&self.curve, interval, [interval[0], guess], distance - *before, self.tolerance)
    }

    /// The point after a distance, with its derivatives by it: the tangent has length 1, the second derivative is the
    /// curvature vector. Zero derivatives where the curve stands still.
    pub fn at(&self, distance: Parameter<C>) -> Jet<C::Point> {
        let Jet { point, first, second } = self.curve.at(self.parameter(distance));
        let tangent = first.normalize_or_zero();
        let squared = first.length_squared();
        if squared > Parameter::<C>::ZERO {
            Jet { point, first: tangent, second: (second - tangent * tangent.dot(second)) / squared }
        } else {
            Jet { point, first: tangent, second: tangent }
        }
    }
}

/// How often an interval is cut in halves.
const DEEPEST: usize = 24;

/// The positive nodes of the rule of Kronrod with 15 points and their weights; every second node is one of Gauss.
const NODES: [[f64; 2]; 7] = [
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_22],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_55],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_18],
    [0.741_531_185_599_394_4, 0.140_653_259_715_525_92],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_4],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_9],
];
/// The weight of the node in the middle.
const MIDDLE: f64 = 0.209_482_141_084_727_82;
/// The weights of Gauss's nodes from the outside to the middle.
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_7, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// The speed is integrated by the rule of Gauss and Kronrod with 15 points; intervals on which the rule of Gauss with 7 of
/// them differs too much are cut in halves. Piessens et al., "QUADPACK", 1983.
pub(super) fn integrate<C: Curve>(curve: &C, interval: [Parameter<C>; 2], tolerance: Parameter<C>) -> Parameter<C> {
    halve_until(curve, interval, tolerance, DEEPEST)
}

fn halve_until<C: Curve>(
    curve: &C,
    [from, to]: [Parameter<C>; 2],
    tolerance: Parameter<C>,
    depth: usize,
) -> Parameter<C> {
    let number = Parameter::<C>::from_f64;
    let (middle, radius) = ((from + to) * number(0.5), (to - from) * number(0.5));
    let speed = curve.speed(middle);
    let (mut kronrod, mut gauss) = (speed * number(MIDDLE), speed * number(GAUSS[3]));
    for (i, [node, weight]) in NODES.into_iter().enumerate() {
        let offset = radius * number(node);
        let both = curve.speed(middle - offset) + curve.speed(middle + offset);
        kronrod += both * number(weight);
        if i % 2 == 1 {
            gauss += both * number(GAUSS[i / 2]);
        }
    }
    let length = kronrod * radius;
    // QUADPACK's estimate from the difference d, (200 d)^(3/2) relative to the length. With 10 for 200 it is half as much
    // work, and too little for one random cubic in a hundred: those that nearly stand still somewhere.
    let relative = ((kronrod - gauss) / kronrod).abs() * number(200.0);
    let error = length * relative * relative.sqrt();
    // Also where nothing can be said, as the speed is NaN.
    if !(error > tolerance && error > length * Parameter::<C>::EPSILON * number(64.0)) || depth == 0 {
        return length;
    }
    let tolerance = tolerance * number(0.5);
    halve_until(curve, [from, middle], tolerance, depth - 1) + halve_until(curve, [middle, to], tolerance, depth - 1)
}

/// The parameter within bounds at a signed distance from a parameter, sought from a guess on.
fn invert<C: Curve>(
    curve: &C,
    [mut low, mut high]: [Parameter<C>; 2],
    [from, guess]: [Parameter<C>; 2],
    distance: Parameter<C>,
    tolerance: Parameter<C>,
) -> Parameter<C> {
    let mut t = guess;
    let mut excess = arc_length(curve, [from, t], tolerance) - distance;
    for _ in 0..64 {
        if excess < Parameter::<C>::ZERO {
            low = t
        } else {
            high = t
        }
        if excess.abs() <= tolerance {
            break;
        }
        let newton = t - excess / curve.speed(t);
        let next = if newton > low && newton < high { newton } else { (low + high) * Parameter::<C>::from_f64(0.5) };
        if next == t {
            break;
        }
        excess += arc_length(curve, [t, next], tolerance);
        t = next;
    }
    t
}

/// The length of the curve whose derivative is `a + b t + c t^2`, between two parameters.
///
/// The rules of Gauss with 8, 16 and 24 points, the first of which is exact enough by an estimate from the change of the
/// velocity; else both halves. The estimates are those that Levien found for cubics and uses in kurbo. In all dimensions
/// the square of the speed is one polynomial of degree 4, of which each rule takes roots.
#[inline]
pub(super) fn cubic_length<V: VectorSpace>(
    derivative: [V; 3],
    interval: [V::Scalar; 2],
    tolerance: V::Scalar,
) -> V::Scalar {
    cubic_halves(derivative, interval, tolerance, DEEPEST)
}

#[inline]
fn cubic_halves<V: VectorSpace>(
    derivative: [V; 3],
    interval: [V::Scalar; 2],
    tolerance: V::Scalar,
    depth: usize,
) -> V::Scalar {
    let number = V::Scalar::from_f64;
    let [from, to] = interval;
    let (middle, radius) = ((from + to) * number(0.5), (to - from) * number(0.5));
    let [a, b, c] = derivative;
    // The derivative by a parameter in [-1, 1].
    let velocity = (a + (b + c * middle) * middle) * radius;
    let change = (b + c * (middle + middle)) * (radius * radius);
    let bend = c * (radius * radius * radius);
    let square = SpeedSquared::new([velocity, change, bend]);
    let (length, turn) = square.gauss_8();
    let chord = velocity + velocity + bend * number(2.0 / 3.0);
    // What the control polygon is longer than the chord: the length lies in the middle (Gravesen 1997).
    let slack = (length - chord.length()) * number(2.0);
    let rounding = length * V::Scalar::EPSILON * number(64.0);
    let tolerance = tolerance.max(rounding);
    let cubed = turn * turn * turn;
    let error = |factor: V::Scalar, scale: f64, most: f64| (factor * number(scale)).min(number(most)) * slack;
    // Not larger is enough: of a curve without length all is 0, the tolerance perhaps too.
    if error(cubed, 2.5e-6, 3e-2) <= tolerance {
        return length;
    }
    if error(cubed * cubed, 1.5e-11, 9e-3) <= tolerance {
        return square.gauss(&GAUSS_16);
    }
    // False also where nothing can be said, as the speed is NaN.
    let is_too_long = error(cubed * cubed * cubed, 3.5e-16, 3.5e-3) > tolerance;
    if !is_too_long || depth == 0 {
        return square.gauss(&GAUSS_24);
    }
    let half = tolerance * number(0.5);
    cubic_halves(derivative, [from, middle], half, depth - 1) + cubic_halves(derivative, [middle, to], half, depth - 1)
}

/// `|p + q x + r x^2|^2` by the powers of `x`, and `|q|^2`.
struct SpeedSquared<R>([R; 5], R);

impl<R: Real> SpeedSquared<R> {
    #[inline]
    fn new<V: VectorSpace<Scalar = R>>([p, q, r]: [V; 3]) -> Self {
        let twice = |a: V, b: V| {
            let product = a.dot(b);
            product + product
        };
        let change = q.dot(q);
        Self([p.dot(p), twice(p, q), change + twice(p, r), twice(q, r), r.dot(r)], change)
    }

    /// The sum of the speeds at `x` and `-x`; rounding may make the smallest squares negative.
    #[inline(always)]
    fn pair(&self, x: R) -> R {
        let [even, odd] = self.halves(x);
        (even + odd).max(R::ZERO).sqrt() + (even - odd).max(R::ZERO).sqrt()
    }

    /// What is the same and what is not at `x` and `-x`.
    #[inline(always)]
    fn halves(&self, x: R) -> [R; 2] {
        let ([a, b, c, d, e], square) = (self.0, x * x);
        [(e * square + c) * square + a, (d * square + b) * x]
    }

    /// Four nodes at a time, as processors have it.
    #[inline(always)]
    fn gauss<const N: usize>(&self, [nodes, weights]: &[[f64; N]; 2]) -> R {
        let mut lengths = [R::ZERO; 4];
        for (nodes, weights) in nodes.chunks_exact(4).zip(weights.chunks_exact(4)) {
            for ((length, &node), &weight) in lengths.iter_mut().zip(nodes).zip(weights) {
                *length += self.pair(R::from_f64(node)) * R::from_f64(weight);
            }
        }
        (lengths[0] + lengths[1]) + (lengths[2] + lengths[3])
    }

    /// The integral of the speed, and that of the squared change of the velocity in its own lengths.
    #[inline(always)]
    fn gauss_8(&self) -> (R, R) {
        let ([.., d, e], change) = (self.0, self.1);
        let (twice, four) = (d + d, e * R::from_f64(4.0));
        let [nodes, weights] = &GAUSS_8;
        let (mut lengths, mut turns) = ([R::ZERO; 4], [R::ZERO; 4]);
        for i in 0..4 {
            let (x, weight) = (R::from_f64(nodes[i]), R::from_f64(weights[i]));
            let [even, odd] = self.halves(x);
            let [before, after] = [(even - odd).max(R::ZERO), (even + odd).max(R::ZERO)];
            lengths[i] = (before.sqrt() + after.sqrt()) * weight;
            let (level, slope) = (change + four * (x * x), twice * x);
            turns[i] = ((level + slope) * before + (level - slope) * after) / (before * after) * weight;
        }
        let sum = |parts: [R; 4]| (parts[0] + parts[1]) + (parts[2] + parts[3]);
        (sum(lengths), sum(turns))
    }
}

/// The positive nodes of the rule of Gauss with 8 points, and their weights.
const GAUSS_8: [[f64; 4]; 2] = [
    [0.183_434_642_495_649_78, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_2],
    [0.362_683_783_378_361_77, 0.313_706_645_877_887_05, 0.222_381_034_453_374_34, 0.101_228_536_290_376_69],
];

/// The positive nodes of the rule of Gauss with 16 points, and their weights.
const GAUSS_16: [[f64; 8]; 2] = [
    [
        0.095_012_509_837_637_45,
        0.281_603_550_779_258_9,
        0.458_016_777_657_227_37,
        0.617_876_244_402_643_8,
        0.755_404_408_355_003,
        0.865_631_202_387_831_8,
        0.944_575_023_073_232_6,
        0.989_400_934_991_649_9,
    ],
    [
        0.189_450_610_455_068_59,
        0.182_603_415_044_923_6,
        0.169_156_519_395_002_62,
        0.149_595_988_816_576_76,
        0.124_628_971_255_534_03,
        0.095_158_511_682_492_59,
        0.062_253_523_938_647_706,
        0.027_152_459_411_754_037,
    ],
];

/// The positive nodes of the rule of Gauss with 24 points, and their weights.
const GAUSS_24: [[f64; 12]; 2] = [
    [
        0.064_056_892_862_605_63,
        0.191_118_867_473_616_3,
        0.315_042_679_696_163_4,
        0.433_793_507_626_045_1,
        0.545_421_471_388_839_6,
        0.648_093_651_936_975_5,
        0.740_124_191_578_554_4,
        0.820_001_985_973_903,
        0.886_415_527_004_401,
        0.938_274_552_002_732_8,
        0.974_728_555_971_309_5,
        0.995_187_219_997_021_3,
    ],
    [
        0.127_938_195_346_752_21,
        0.125_837_456_346_828_3,
        0.121_670_472_927_803_42,
        0.115_505_668_053_725_61,
        0.107_444_270_115_965_6,
        0.097_618_652_104_114_06,
        0.086_190_161_531_953_29,
        0.073_346_481_411_080_41,
        0.059_298_584_915_436_74,
        0.044_277_438_817_419_55,
        0.028_531_388_628_933_743,
        0.012_341_229_799_987_091,
    ],
];
