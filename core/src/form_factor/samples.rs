//! Means of independent repetitions, with an error that they tell themselves.

use super::Estimate;
use crate::geometry::{Sobol, hash};
use crate::math::{Real, Vector};

/// How many standard errors a sampled value is given as its error.
///
/// With 16 scrambles the true value lies outside in about one of 1000 cases (Student's t with 15 degrees of freedom).
pub const STANDARD_ERRORS: f64 = 4.0;

/// How many points are taken, in groups that know nothing of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    /// Number of independent Owen scrambles of the Sobol sequence; their spread tells the error. Typical: 16. The error of
    /// one is infinite, and none counts as one.
    pub scrambles: u32,
    /// Points of each scramble; powers of two fill most evenly. None counts as one.
    pub points: u32,
    /// Different seeds give independent results; the same seed gives the same bits.
    pub seed: u32,
}

impl Samples {
    /// With one of each at least: the mean of nothing is not a number.
    pub(super) fn at_least_one(&self) -> Self {
        Self { scrambles: self.scrambles.max(1), points: self.points.max(1), ..*self }
    }

    /// The sequence of one scramble.
    pub(super) fn sequence(&self, scramble: u32) -> Sobol {
        Sobol::new(hash(self.seed, scramble))
    }

    /// All points.
    pub(super) fn total(&self) -> f64 {
        f64::from(self.scrambles) * f64::from(self.points)
    }
}

/// Takes one more repetition into the mean; `error` holds the sum of squared differences from it until [`finish`].
///
/// Welford, Technometrics 1962. `count` is the number of repetitions with this one.
pub(super) fn add<R: Real>(mean: &mut Estimate<R>, value: R, count: u32) {
    let difference = value - mean.value;
    mean.value += difference / R::from_f64(f64::from(count));
    mean.error += difference * (value - mean.value);
}

/// Turns the sum of squares into [`STANDARD_ERRORS`], not below `least`. A single repetition knows nothing: infinite.
pub(super) fn finish<R: Real>(mean: &mut Estimate<R>, count: u32, least: f64) {
    let pairs = f64::from(count) * (f64::from(count) - 1.0);
    let standard = R::from_f64(STANDARD_ERRORS) * (mean.error / R::from_f64(pairs)).sqrt();
    mean.error = if count > 1 { standard.max(R::from_f64(least)) } else { R::INFINITY };
}

/// The point of a convex polygon that belongs to a point of the unit square, equal areas to equal areas.
///
/// The polygon is taken for a fan of triangles; without area its first corner is as good as any.
pub(super) fn point_on_polygon<V: Vector>(polygon: &[V], square: [f32; 2]) -> V {
    let [x, y] = square.map(|x| V::Scalar::from_f64(f64::from(x)));
    let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
    let area = |k: usize| (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]).length();
    let Some(last) = polygon.len().checked_sub(2).filter(|&last| last > 0) else {
        return polygon.first().copied().unwrap_or_default();
    };
    let mut rest = x * (1..=last).map(area).sum::<V::Scalar>();
    let mut k = 1;
    while k < last && rest > area(k) {
        rest -= area(k);
        k += 1;
    }
    let root = if area(k) > zero { (rest / area(k)).clamp(zero, one).sqrt() } else { zero };
    polygon[0] * (one - root) + polygon[k] * (root * (one - y)) + polygon[k + 1] * (root * y)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// The mean of x^2 + y over the square 0..1, given with five corners, is 1/3 + 1/2.
    #[test]
    fn points_on_a_polygon_are_uniform() {
        let polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.6], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 2.0));
        let samples = Samples { scrambles: 16, points: 256, seed: 3 };
        let mut mean = Estimate::default();
        for scramble in 0..16 {
            let sequence = samples.sequence(scramble);
            let points = (0..256).map(|index| point_on_polygon(&polygon, sequence.square(index).to_array()));
            add(&mut mean, points.map(|p| p.x * p.x + p.y).sum::<f64>() / 256.0, scramble + 1);
        }
        finish(&mut mean, 16, 0.0);
        assert!((mean.value - 5.0 / 6.0).abs() < mean.error && mean.error < 4e-3, "{mean:?}");
    }

    #[test]
    fn the_error_is_that_of_the_mean() {
        let mut mean = Estimate::default();
        [1.0, 3.0, 2.0, 6.0].iter().enumerate().for_each(|(k, &value)| add(&mut mean, value, k as u32 + 1));
        finish(&mut mean, 4, 0.0);
        assert_eq!(mean.value, 3.0);
        assert!((mean.error - STANDARD_ERRORS * (14.0_f64 / 12.0).sqrt()).abs() < 1e-12);
        let mut single = Estimate { value: 1.0, error: 0.0 };
        finish(&mut single, 1, 0.0);
        assert_eq!(single.error, f64::INFINITY);
    }
}
