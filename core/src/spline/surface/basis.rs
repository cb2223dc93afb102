//! Basis functions of B-splines with their derivatives, exactly 1 and 0 where a point is reached.

use crate::math::Real;
use crate::spline::{KnotVector, MAX_DEGREE};

/// What the basis functions are at one parameter: `[k][i]` is the derivative of order `k` of the `i`-th of those
/// `degree + 1` that are not zero there.
pub(super) type Basis<R, const N: usize> = [[R; MAX_DEGREE + 1]; N];

/// The derivatives of order `0..N` of the basis functions on an interval of knots.
///
/// The triangle of Cox and de Boor up to degree `p - k`, then `k` times the rule for the derivative: Piegl and Tiller,
/// "The NURBS Book", equations 2.5 and 2.7.
#[inline]
pub(super) fn basis_at<R: Real, const N: usize>(knots: &KnotVector<R>, span: usize, t: R) -> Basis<R, N> {
    let p = knots.degree();
    basis_on(&knots.knots()[span + 1 - p..=span + p], p, t)
}

/// The same from those `2 p` knots that have an influence: `p` that are not larger than `t` and `p` that are larger.
#[inline]
pub(super) fn basis_on<R: Real, const N: usize>(local: &[R], p: usize, t: R) -> Basis<R, N> {
    let mut basis = [[R::ZERO; MAX_DEGREE + 1]; N];
    let mut values = [R::ZERO; MAX_DEGREE + 1];
    values[0] = R::ONE;
    for m in 0..=p {
        if m > 0 {
            raise(&mut values, local, p, m, t);
        }
        // Orders of which the triangle is needed up to this degree only.
        let order = p - m;
        if order < N {
            basis[order] = values;
            (m + 1..=p).for_each(|m| differentiate(&mut basis[order], local, p, m));
        }
    }
    basis
}

/// From the functions of degree `m - 1` to those of degree `m`.
#[inline]
fn raise<R: Real>(values: &mut [R; MAX_DEGREE + 1], local: &[R], p: usize, m: usize, t: R) {
    let (left, right) = (&local[p - m..p], &local[p..p + m]);
    let mut saved = R::ZERO;
    for ((value, &left), &right) in values.iter_mut().zip(left).zip(right) {
        let share = (t - left) / (right - left);
        let before = *value;
        *value = saved + (R::ONE - share) * before;
        saved = share * before;
    }
    values[m] = saved;
}

/// From functions of degree `m - 1` to the derivative of those of degree `m`.
#[inline]
fn differentiate<R: Real>(values: &mut [R; MAX_DEGREE + 1], local: &[R], p: usize, m: usize) {
    let (left, right) = (&local[p - m..p], &local[p..p + m]);
    let degree = R::from_usize(m);
    let mut saved = R::ZERO;
    for ((value, &left), &right) in values.iter_mut().zip(left).zip(right) {
        let share = degree * *value / (right - left);
        *value = saved - share;
        saved = share;
    }
    values[m] = saved;
}

/// The same with the degree `M - 1` known when compiled: loops vanish.
#[inline(always)]
pub(super) fn basis_of_order<R: Real, const M: usize, const N: usize>(local: &[R], t: R) -> [[R; M]; N] {
    let local = &local[..2 * (M - 1)];
    let mut basis = [[R::ZERO; M]; N];
    let mut values = [R::ZERO; M];
    values[0] = R::ONE;
    for m in 0..M {
        if m > 0 {
            let mut saved = R::ZERO;
            for r in 0..m {
                let (left, right) = (local[M - 1 - m + r], local[M - 1 + r]);
                let share = (t - left) / (right - left);
                let before = values[r];
                values[r] = saved + (R::ONE - share) * before;
                saved = share * before;
            }
            values[m] = saved;
        }
        let order = M - 1 - m;
        if order < N {
            basis[order] = values;
            for m in m + 1..M {
                let mut saved = R::ZERO;
                for r in 0..m {
                    let (left, right) = (local[M - 1 - m + r], local[M - 1 + r]);
                    let share = R::from_usize(m) * basis[order][r] / (right - left);
                    basis[order][r] = saved - share;
                    saved = share;
                }
                basis[order][m] = saved;
            }
        }
    }
    basis
}
