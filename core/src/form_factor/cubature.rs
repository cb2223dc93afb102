//! Integrals over a triangle, refined where the integrand asks for it.

use glam::DVec3;

use super::Estimate;
use super::triangle_rule::mean;
use crate::math::{Real, Vector};

/// Triangles are cut into four at most so often.
const DEPTH: u32 = 30;
/// The error of a sum over quarters is taken for so many differences to coarser sums.
const SAFETY: f64 = 4.0;
/// A sum that misses the accuracy is done again with finer triangles at most so often.
const PASSES: u32 = 5;

/// Adaptive cubature with bounded work and without memory of its own.
#[derive(Debug)]
pub struct Cubature<'a> {
    tolerance: f64,
    /// So many triangles may still be looked at.
    budget: &'a mut u32,
}

impl<'a> Cubature<'a> {
    /// Integrates with the given absolute accuracy: `whole` hands the triangles of the domain to its argument one by
    /// one, and `f` is the integrand. Each triangle looked at takes one from `budget`; with 0 left none is refined.
    pub fn integral(
        accuracy: f64,
        budget: &'a mut u32,
        mut whole: impl FnMut(&mut dyn FnMut([DVec3; 3])),
        mut f: impl FnMut(DVec3) -> f64,
    ) -> Estimate<f64> {
        let mut cubature = Self { tolerance: accuracy / 8.0, budget };
        let mut best = Estimate { value: 0.0, error: f64::INFINITY };
        for _ in 0..PASSES {
            let mut sum = Estimate::default();
            whole(&mut |triangle| add(&mut sum, cubature.triangle(&triangle, &mut f)));
            if sum.error < best.error {
                best = sum;
            }
            if best.error <= accuracy || *cubature.budget == 0 {
                break;
            }
            cubature.tolerance /= 16.0;
        }
        best
    }

    fn triangle(&mut self, triangle: &[DVec3; 3], f: &mut impl FnMut(DVec3) -> f64) -> Estimate<f64> {
        let value = self.sum(triangle, f);
        self.refine(triangle, value, DEPTH, f)
    }

    /// The integral over a triangle whose plain sum is `value`: the sum over its quarters if it agrees with that and
    /// with the sum over its halves, else the quarters refined. The error is a multiple of the larger difference, which
    /// is about the error of the coarser sums.
    fn refine(
        &mut self,
        triangle: &[DVec3; 3],
        value: f64,
        depth: u32,
        f: &mut impl FnMut(DVec3) -> f64,
    ) -> Estimate<f64> {
        let [[a, b], [c, d]] = halves(triangle).map(|half| halves(&half));
        let parts = [a, b, c, d];
        let values = parts.map(|part| self.sum(&part, f));
        let middle: f64 = halves(triangle).iter().map(|half| self.sum(half, f)).sum();
        let fine: f64 = values.iter().sum();
        let error = SAFETY * Real::max((fine - middle).abs(), (fine - value).abs());
        let refines = error > self.tolerance && depth > 0 && *self.budget > 0;
        if !refines {
            return Estimate { value: fine, error };
        }
        let mut sum = Estimate::default();
        for (part, value) in parts.iter().zip(values) {
            add(&mut sum, self.refine(part, value, depth - 1, f));
        }
        sum
    }

    /// The plain sum over the points of one triangle.
    fn sum(&mut self, &[a, b, c]: &[DVec3; 3], f: &mut impl FnMut(DVec3) -> f64) -> f64 {
        *self.budget = self.budget.saturating_sub(1);
        let area = 0.5 * Real::sqrt((b - a).cross(c - a).length_squared());
        area * mean(&[a, b, c], f)
    }
}

fn add(sum: &mut Estimate<f64>, part: Estimate<f64>) {
    sum.value += part.value;
    sum.error += part.error;
}

/// The halves of a triangle, cut at the longest edge, so that slivers become better shaped.
pub fn halves<V: Vector>(&[a, b, c]: &[V; 3]) -> [[V; 3]; 2] {
    let [ab, bc, ca] = [b - a, c - b, a - c].map(V::length_squared);
    let [a, b, c] = if ab >= bc && ab >= ca {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    };
    let middle = a.lerp(b, V::Scalar::from_f64(0.5));
    [[a, middle, c], [middle, b, c]]
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

    fn over_triangle(accuracy: f64, mut budget: u32, f: impl FnMut(DVec3) -> f64) -> Estimate<f64> {
        Cubature::integral(accuracy, &mut budget, |each| each(TRIANGLE), f)
    }

    /// The integral of `1 / (x + y)` over the triangle is 1, that of `|x - y|` is 1/6.
    #[test]
    fn singular_corners_and_kinks() {
        for accuracy in [1e-3, 1e-6, 1e-9] {
            let found = over_triangle(accuracy, 1 << 20, |p| 1.0 / (p.x + p.y));
            assert!(found.error <= accuracy && (found.value - 1.0).abs() <= found.error, "{found:?}");
        }
        let found = over_triangle(1e-5, 1 << 20, |p| (p.x - p.y).abs());
        assert!(found.error <= 1e-5 && (found.value - 1.0 / 6.0).abs() <= found.error, "{found:?}");
    }

    #[test]
    fn work_is_bounded() {
        let mut count = 0;
        let found = over_triangle(0.0, 1000, |p| {
            count += 1;
            if p.x * p.x + p.y * p.y < 0.5 { 1.0 } else { 0.0 }
        });
        assert!(count < 64 * 1000, "{count}");
        assert!((found.value - core::f64::consts::PI / 8.0).abs() <= found.error && found.error < 0.1, "{found:?}");
    }
}
