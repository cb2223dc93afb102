//! Delta form factors: what one pixel of a hemicube contributes.
//!
//! The density on the top is `1 / (pi (x^2 + y^2 + 1)^2)`, on a side `z / (pi (y^2 + z^2 + 1)^2)`. Both have
//! antiderivatives in closed form, the form factors of rectangles from a point (Howell's catalogue, B-3 and B-4). Here
//! each pixel gets the integral of the density, so that a patch whose outline runs along pixels is exact. The value in
//! its center, which Cohen and Greenberg take, is off by 4 % in the worst pixel and by 0.4 % over the whole top at
//! `N = 8`, by 0.07 % and 0.006 % at `N = 64`.

use crate::math::Real;

/// Delta form factors are multiples of this, so that their sums in double precision are exact in any order.
const UNIT: f64 = 1.0 / (1_u64 << 52) as f64;

/// Fills a quarter of the top, row by row from the center, and the right half of a side, row by row from the top. Whole
/// hemicubes sum to exactly 1: the pixels around the normal take up what rounding leaves over.
pub(super) fn fill_deltas(half: usize, deltas: &mut [f64]) {
    let (top, side) = deltas.split_at_mut(half * half);
    let edge = |index: usize| index as f64 / half as f64;
    for row in 0..half {
        for column in 0..half {
            let [x, y, z] = [column, row, half - 1 - row].map(|index| [edge(index), edge(index + 1)]);
            top[row * half + column] = round(integral(top_corner, x, y));
            side[row * half + column] = round(integral(side_corner, x, z));
        }
    }
    let sum = 4.0 * top.iter().sum::<f64>() + 8.0 * side.iter().sum::<f64>();
    top[0] += 0.25 * (1.0 - sum);
}

/// The integral over a rectangle, from that over rectangles with a corner in the origin.
fn integral(corner: fn(f64, f64) -> f64, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
    corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
}

/// The integral of the density of the top over `0..x` and `0..y`.
fn top_corner(x: f64, y: f64) -> f64 {
    let (a, b) = (Real::sqrt(1.0 + x * x), Real::sqrt(1.0 + y * y));
    (x / a * Real::atan(y / a) + y / b * Real::atan(x / b)) / core::f64::consts::TAU
}

/// The integral of the density of a side over `0..y` and `0..z`.
fn side_corner(y: f64, z: f64) -> f64 {
    let a = Real::sqrt(1.0 + z * z);
    (Real::atan(y) - Real::atan(y / a) / a) / core::f64::consts::TAU
}

fn round(share: f64) -> f64 {
    Real::floor(share / UNIT + 0.5) * UNIT
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deltas<const N: usize>(half: usize) -> [f64; N] {
        let mut deltas = [0.0; N];
        fill_deltas(half, &mut deltas);
        deltas
    }

    /// In any order, without any rounding.
    #[test]
    fn all_pixels_sum_to_exactly_one() {
        let deltas = deltas::<2048>(32);
        let weight = |k: usize| if k < 1024 { 4 } else { 8 };
        let sum = |order: &mut dyn Iterator<Item = usize>| -> f64 {
            order.flat_map(|k| core::iter::repeat_n(deltas[k], weight(k))).sum()
        };
        assert_eq!(sum(&mut (0..2048)), 1.0);
        assert_eq!(sum(&mut (0..2048).rev()), 1.0);
        assert!(deltas.iter().all(|&delta| delta > 0.0));
    }

    /// The top of a cube has 0.5541 of the hemisphere above its center: 4 times B-3 at x = y = 1.
    #[test]
    fn the_top_is_a_square() {
        let top: f64 = deltas::<128>(8)[..64].iter().sum();
        assert!((4.0 * top - 4.0 * 0.138_531_605_994_9).abs() < 1e-12);
    }

    /// The integrals are those of the densities: the values in the centers approach them with the square of the pixel.
    #[test]
    fn centers_approach_the_integrals() {
        let error = |half: usize, deltas: &[f64]| {
            let square = |x: f64| x * x;
            let center = |index: usize| (index as f64 + 0.5) / half as f64;
            let density = |k: usize| {
                let (row, column) = (k % (half * half) / half, k % half);
                let y = center(column);
                match k < half * half {
                    true => 1.0 / square(1.0 + square(center(row)) + square(y)),
                    false => center(half - 1 - row) / square(1.0 + square(center(half - 1 - row)) + square(y)),
                }
            };
            let value = |k: usize| density(k) / (core::f64::consts::PI * square(half as f64));
            let top: f64 = (0..half * half).map(value).sum();
            let largest = (0..deltas.len()).map(|k| (value(k) - deltas[k]).abs() / deltas[k]).fold(0.0, f64::max);
            ((4.0 * top / (4.0 * 0.138_531_605_994_9) - 1.0).abs(), largest)
        };
        let (coarse, fine) = (error(4, &deltas::<32>(4)), error(32, &deltas::<2048>(32)));
        assert!(fine.0 < coarse.0 / 50.0 && fine.1 < coarse.1 / 4.0, "{coarse:?} {fine:?}");
    }
}
