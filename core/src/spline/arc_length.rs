//! How long a curve is, and travel along it at constant speed.

use super::{Curve, Jet, Parameter};
use crate::math::{Real, VectorSpace};

/// The length of a curve between two parameters of its domain, negative if they descend.
///
/// Off by at most about `tolerance`, an absolute length, or by rounding if that is more. The speed is integrated by the
/// rule of Gauss and Kronrod with 15 points between breaks; intervals on which the rule of Gauss with 7 of them differs
/// too much are cut in halves. Piessens et al., "QUADPACK", 1983.
pub fn arc_length<C: Curve>(curve: &C, [from, to]: [Parameter<C>; 2], tolerance: Parameter<C>) -> Parameter<C> {
    if from > to {
        return -arc_length(curve, [to, from], tolerance);
    }
    let (mut length, mut start) = (Parameter::<C>::ZERO, from);
    while start < to {
        let next = curve.next_break(start);
        let end = if next > start && next < to { next } else { to };
        length += integrate(curve, [start, end], tolerance, DEEPEST);
        start = end;
    }
    length
}

/// The parameter at a distance along a curve from another parameter; the end of the domain if it is not as long.
///
/// The distance on the curve to the one asked for is at most about `tolerance`. Newton's method, held between bounds
/// that close in: the derivative of the length is the speed.
pub fn parameter_at<C: Curve>(
    curve: &C,
    from: Parameter<C>,
    distance: Parameter<C>,
    tolerance: Parameter<C>,
) -> Parameter<C> {
    let end = curve.domain()[1];
    let length = arc_length(curve, [from, end], tolerance);
    if distance >= length {
        return end;
    }
    let guess = from + (end - from) * (distance / length);
    invert(curve, [from, end], distance, guess, tolerance)
}

/// A curve by the distance travelled along it: all its points are passed at speed 1.
///
/// Keeps `N` parameters and the lengths up to them, in `2 N` numbers.
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
        let ([start, end], tolerance) = (curve.domain(), tolerance / Parameter::<C>::from_usize(N.max(1)));
        let share = |i: usize| Parameter::<C>::from_usize(i) / Parameter::<C>::from_usize(N.max(2) - 1);
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
        invert(&self.curve, interval, distance - *before, guess, self.tolerance)
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

fn integrate<C: Curve>(
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
    integrate(curve, [from, middle], tolerance, depth - 1) + integrate(curve, [middle, to], tolerance, depth - 1)
}

/// The parameter between two others at a distance from the first one; it lies between them.
fn invert<C: Curve>(
    curve: &C,
    [from, to]: [Parameter<C>; 2],
    distance: Parameter<C>,
    guess: Parameter<C>,
    tolerance: Parameter<C>,
) -> Parameter<C> {
    let (mut low, mut high, mut t) = (from, to, guess);
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
