//! Means of functions over triangles: two rules, so that their difference tells the error.
//!
//! The rule of 7 points is exact to degree 5 (Radon 1948), that of 16 points to degree 8 (Dunavant, "High degree
//! efficient symmetrical Gaussian quadrature rules for the triangle", IJNME 1985; to 18 digits here).

use crate::math::{Real, Vector};

/// Weight and barycentric coordinates of one point of an orbit; the third coordinate makes the sum 1.
type Orbit = (f64, f64, f64);

/// The square root of 15.
const ROOT_15: f64 = 3.872_983_346_207_416_885;

const COARSE: [Orbit; 3] = [
    (0.225, 1.0 / 3.0, 1.0 / 3.0),
    ((155.0 - ROOT_15) / 1200.0, (9.0 + 2.0 * ROOT_15) / 21.0, (6.0 - ROOT_15) / 21.0),
    ((155.0 + ROOT_15) / 1200.0, (9.0 - 2.0 * ROOT_15) / 21.0, (6.0 + ROOT_15) / 21.0),
];

const FINE: [Orbit; 5] = [
    (0.144_315_607_677_787_168, 1.0 / 3.0, 1.0 / 3.0),
    (0.095_091_634_267_284_624_8, 0.081_414_823_414_553_687_9, 0.459_292_588_292_723_156),
    (0.103_217_370_534_718_25, 0.658_861_384_496_479_587, 0.170_569_307_751_760_206),
    (0.032_458_497_623_198_080_3, 0.898_905_543_365_938_049, 0.050_547_228_317_030_975_5),
    (0.027_230_314_174_434_994_3, 0.008_394_777_409_957_605_34, 0.263_112_829_634_638_113),
];

/// The mean of `f` over a triangle by 7 points and by 16 points.
pub(super) fn means<V: Vector>(triangle: &[V; 3], f: impl Fn(V) -> V::Scalar) -> (V::Scalar, V::Scalar) {
    let mean = |rule: &[Orbit]| rule.iter().map(|orbit| orbit_sum(triangle, orbit, &f)).sum();
    (mean(&COARSE), mean(&FINE))
}

/// Weighted sum over the points that arise when the barycentric coordinates change places.
fn orbit_sum<V: Vector>(triangle: &[V; 3], &(weight, a, b): &Orbit, f: impl Fn(V) -> V::Scalar) -> V::Scalar {
    let c = 1.0 - a - b;
    let is_symmetric = (b - c).abs() < 1e-12;
    let [u, v, w] = *triangle;
    let [a_, b_, c_] = [a, b, c].map(V::Scalar::from_f64);
    let at = |u: V, v: V, w: V| f(u * a_ + v * b_ + w * c_);
    let sum = if is_symmetric && (a - b).abs() < 1e-12 {
        at(u, v, w)
    } else if is_symmetric {
        at(u, v, w) + at(v, w, u) + at(w, u, v)
    } else {
        at(u, v, w) + at(v, w, u) + at(w, u, v) + at(u, w, v) + at(w, v, u) + at(v, u, w)
    };
    sum * V::Scalar::from_f64(weight)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// The mean of `x^i y^j` over the triangle of the axes is `2 i! j! / (i + j + 2)!`.
    #[test]
    fn exact_to_degrees_5_and_8() {
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        for (i, j) in (0..=8).flat_map(|i| (0..=8 - i).map(move |j| (i, j))) {
            let exact = 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
            let (coarse, fine) = means(&[DVec3::ZERO, DVec3::X, DVec3::Y], |p| p.x.powi(i) * p.y.powi(j));
            assert!((fine - exact).abs() < 1e-16, "{i} {j}");
            assert_eq!((coarse - exact).abs() < 1e-16, i + j <= 5, "{i} {j}");
        }
    }
}
