//! The form factors of elements, each pair once: `A_i F_ij = A_j F_ji`.

use alloc::vec;
use alloc::vec::Vec;

use super::Element;
use crate::math::{Real, Vector};
use crate::solve::FormFactors;

/// The symmetric matrix `A_i F_ij`, in square meters: its lower half, row after row.
///
/// By reciprocity half of the form factors are enough, and a new element only adds a row at the end.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exchange<R> {
    areas: Vec<R>,
    /// `A_i F_ij` for `j < i` stands at `i (i - 1) / 2 + j`.
    pairs: Vec<R>,
}

impl<R: Real> Exchange<R> {
    /// Asks `form_factor` once for each pair of elements that face each other.
    ///
    /// It gets the smaller element first and returns the share of the light leaving it that reaches the other one.
    pub fn new<V: Vector<Scalar = R>>(
        elements: &[Element<V>],
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> R,
    ) -> Self {
        let mut exchange = Self::default();
        exchange.update(elements, &[], form_factor);
        exchange
    }

    /// Computes anew what has to do with the `changed` elements, and with those that are new at the end of the list.
    ///
    /// Gives the number of pairs for which `form_factor` was asked.
    pub fn update<V: Vector<Scalar = R>>(
        &mut self,
        elements: &[Element<V>],
        changed: &[usize],
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> R,
    ) -> usize {
        let mut is_changed = vec![false; elements.len()];
        changed.iter().for_each(|&i| is_changed[i] = true);
        is_changed[self.areas.len()..].fill(true);
        self.areas = elements.iter().map(|element| element.area).collect();
        self.pairs.resize(elements.len() * elements.len().saturating_sub(1) / 2, R::ZERO);
        let mut asked = 0;
        for i in 0..elements.len() {
            for j in (0..i).filter(|&j| is_changed[i] || is_changed[j]) {
                let (small, large) = in_order(&elements[i], &elements[j]);
                let sees = small.area > R::ZERO && small.faces(large) && large.faces(small);
                asked += usize::from(sees);
                self.pairs[place(i, j)] = if sees { small.area * form_factor(small, large) } else { R::ZERO };
            }
        }
        asked
    }

    /// `A_i F_ij = A_j F_ji` in square meters.
    pub fn between(&self, i: usize, j: usize) -> R {
        if i == j { R::ZERO } else { self.pairs[place(i, j)] }
    }
}

/// Where the pair of two different elements stands.
fn place(i: usize, j: usize) -> usize {
    let (low, high) = (i.min(j), i.max(j));
    high * (high - 1) / 2 + low
}

/// The smaller one first.
fn in_order<'a, V: Vector>(a: &'a Element<V>, b: &'a Element<V>) -> (&'a Element<V>, &'a Element<V>) {
    if a.area <= b.area { (a, b) } else { (b, a) }
}

impl<R: Real> FormFactors for Exchange<R> {
    type Scalar = R;

    fn row(&self, i: usize, mut entry: impl FnMut(usize, R)) {
        if self.areas[i] > R::ZERO {
            let share = R::ONE / self.areas[i];
            (0..self.areas.len()).filter(|&j| j != i).for_each(|j| entry(j, self.pairs[place(i, j)] * share));
        }
    }
}
