//! The basis functions of B-splines: the recursion of Cox and de Boor.

use super::KnotVector;
use super::bezier::MAX_ORDER;
use crate::math::Real;

impl<R: Real> KnotVector<'_, R> {
    /// The basis functions of a span at `t`: entry `i` is that of control point `span - degree + i`, for
    /// `i <= degree`.
    ///
    /// They sum to 1; for `t` in the span none is negative. "The NURBS Book", algorithm A2.2. `span` comes from
    /// [`span`](Self::span); any other number stands for the piece to which its knot belongs, or for the last one.
    #[inline]
    pub fn basis(&self, span: usize, t: R) -> [R; MAX_ORDER] {
        cox_de_boor(self.around(self.piece(span)), self.degree(), t)
    }

    /// The derivatives of the orders below `K` of the basis functions of a span at `t`.
    #[inline]
    pub(super) fn orders<const K: usize>(&self, span: usize, t: R) -> [[R; MAX_ORDER]; K] {
        cox_de_boor_orders(self.around(span), self.degree(), t)
    }

    /// The derivatives of order 0, 1, 2 ... of the basis functions of a span at `t`, as many as there are rows.
    ///
    /// The derivative of order `k` is found from the basis functions of degree `p - k`, whose sum it is: the formula
    /// of "The NURBS Book", equation 2.7, `k` times. The results are those of algorithm A2.3. Spans are as for
    /// [`basis`](Self::basis).
    pub fn basis_derivatives(&self, span: usize, t: R, rows: &mut [[R; MAX_ORDER]]) {
        let window = self.around(self.piece(span));
        for (k, row) in rows.iter_mut().enumerate() {
            *row = cox_de_boor_derivative(window, self.degree(), k, t);
        }
    }
}

/// The values of the basis functions of degree `degree` between the two middle knots of a window of `2 degree` knots.
///
/// Exactly 1 and 0 where a control point is reached. `N` is larger than the degree.
#[inline(always)]
pub(super) fn cox_de_boor<R: Real, const N: usize>(window: &[R], degree: usize, t: R) -> [R; N] {
    let [values] = cox_de_boor_orders::<R, N, 1>(window, degree, t);
    values
}

/// Where `t` lies between pairs of knots, all found at once, as no quotient waits for another one; one quotient is enough
/// where all pairs are the same, as those of a Bezier piece are.
#[inline(always)]
fn shares<R: Real, const M: usize>(lows: [R; M], highs: [R; M], t: R) -> [R; M] {
    // The last knots are the first and the last of all.
    if lows[M / 2] == lows[0] && highs[M - 1] == highs[0] {
        return [(t - lows[0]) / (highs[0] - lows[0]); M];
    }
    core::array::from_fn(|i| (t - lows[i]) / (highs[i] - lows[i]))
}

/// From the basis functions of degree `j - 1` to those of degree `j`, by where `t` lies in the supports of the former.
#[inline(always)]
fn blend<R: Real>(shares: &[R], j: usize, values: &mut [R]) {
    let mut saved = R::ZERO;
    for r in 0..j {
        let before = values[r];
        values[r] = saved + (R::ONE - shares[r]) * before;
        saved = shares[r] * before;
    }
    values[j] = saved;
}

/// Their derivatives of order `k`.
#[inline(always)]
pub(super) fn cox_de_boor_derivative<R: Real, const N: usize>(window: &[R], degree: usize, k: usize, t: R) -> [R; N] {
    let mut values = [R::ZERO; N];
    if k > degree {
        return values;
    }
    values[0] = R::ONE;
    (0..degree - k).for_each(|j| raise(window, degree, j + 1, t, &mut values));
    (degree - k + 1..degree + 1).for_each(|j| differentiate(window, degree, j, &mut values));
    values
}

/// Their derivatives of the orders below `K`: the triangle of Cox and de Boor up to degree `p - k`, then `k` times the rule
/// for the derivative. "The NURBS Book", equations 2.5 and 2.7.
#[inline(always)]
pub(super) fn cox_de_boor_orders<R: Real, const N: usize, const K: usize>(
    window: &[R],
    degree: usize,
    t: R,
) -> [[R; N]; K] {
    match (degree, window) {
        (2, &[a, b, c, d]) => {
            let shares = shares([b, a, b], [c, c, d], t);
            triangle(window, degree, |j, values| blend(&shares[j * (j - 1) / 2..], j, values))
        }
        (3, &[a, b, c, d, e, f]) => {
            let shares = shares([c, b, c, a, b, c], [d, d, e, d, e, f], t);
            triangle(window, degree, |j, values| blend(&shares[j * (j - 1) / 2..], j, values))
        }
        _ => triangle(window, degree, |j, values| raise(window, degree, j, t, values)),
    }
}

/// The same, where `raise` gives the basis functions of a degree from those of the degree below.
#[inline(always)]
fn triangle<R: Real, const N: usize, const K: usize>(
    window: &[R],
    degree: usize,
    raise: impl Fn(usize, &mut [R]),
) -> [[R; N]; K] {
    let mut orders = [[R::ZERO; N]; K];
    let mut values = [R::ZERO; N];
    values[0] = R::ONE;
    let window = &window[..2 * degree];
    for j in 0..degree + 1 {
        if j > 0 {
            raise(j, &mut values);
        }
        let order = degree - j;
        if order < K {
            orders[order] = values;
            (j + 1..degree + 1).for_each(|j| differentiate(window, degree, j, &mut orders[order]));
        }
    }
    orders
}

/// From the basis functions of degree `j - 1` to those of degree `j`.
///
/// `N_i^j = (t - u_i) / (u_(i+j) - u_i) N_i^(j-1) + (u_(i+j+1) - t) / (u_(i+j+1) - u_(i+1)) N_(i+1)^(j-1)`; the
/// quotients do not wait for the values.
#[inline(always)]
fn raise<R: Real>(window: &[R], degree: usize, j: usize, t: R, values: &mut [R]) {
    let mut saved = R::ZERO;
    for r in 0..j {
        let (low, high) = (window[degree - j + r], window[degree + r]);
        let share = (t - low) / (high - low);
        let before = values[r];
        values[r] = saved + (R::ONE - share) * before;
        saved = share * before;
    }
    values[j] = saved;
}

/// From derivatives of basis functions of degree `j - 1` to those of degree `j`, of an order higher by one.
///
/// `N_i^j' = j (N_i^(j-1) / (u_(i+j) - u_i) - N_(i+1)^(j-1) / (u_(i+j+1) - u_(i+1)))`
#[inline(always)]
fn differentiate<R: Real>(window: &[R], degree: usize, j: usize, values: &mut [R]) {
    let mut saved = R::ZERO;
    for r in 0..j {
        let share = values[r] * (R::from_usize(j) / (window[degree + r] - window[degree - j + r]));
        values[r] = saved - share;
        saved = share;
    }
    values[j] = saved;
}
