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

    /// What elements exchange by form factors that were found row by row, as with a hemicube or with rays.
    ///
    /// Reciprocity holds afterwards: a pair gets the mean of `A_i F_ij` and `A_j F_ji`.
    pub fn from_rows<V: Vector<Scalar = R>>(elements: &[Element<V>], rows: &impl FormFactors<Scalar = R>) -> Self {
        let areas: Vec<R> = elements.iter().map(|element| element.area).collect();
        let mut pairs = vec![R::ZERO; elements.len() * elements.len().saturating_sub(1) / 2];
        let half = R::from_f64(0.5);
        for (i, &area) in areas.iter().enumerate() {
            rows.row(i, |j, factor| {
                if i != j {
                    pairs[place(i, j)] += area * factor * half;
                }
            });
        }
        Self { areas, pairs }
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
                let exchange = exchanged(&elements[i], &elements[j], form_factor);
                asked += usize::from(exchange.is_some());
                self.pairs[place(i, j)] = exchange.unwrap_or(R::ZERO);
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

/// `A_a F_ab` in square meters, asked for if the two face each other.
pub(super) fn exchanged<V: Vector>(
    a: &Element<V>,
    b: &Element<V>,
    form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
) -> Option<V::Scalar> {
    let (small, large) = in_order(a, b);
    let sees = small.area > V::Scalar::ZERO && small.faces(large) && large.faces(small);
    sees.then(|| small.area * form_factor(small, large))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form_factor::polygon_to_polygon;
    use crate::patch::{Patch, uniform};
    use crate::solve::Dense;
    use glam::DVec3;

    /// A box of 1 x 2 x 3, each side in 2 x 2 elements.
    fn box_of_elements() -> Vec<Element<DVec3>> {
        let [x, y, z] = [DVec3::X, DVec3::Y * 2.0, DVec3::Z * 3.0];
        let o = DVec3::ZERO;
        let sides = [[o, x, y], [z, y, x], [o, y, z], [x, z, y], [o, z, x], [y, x, z]];
        let patches = sides.map(|[o, u, v]| [Patch::Quad([o, o + u, o + u + v, o + v])]);
        patches.iter().enumerate().flat_map(|(k, patch)| uniform(k, patch, [2, 2]).collect::<Vec<_>>()).collect()
    }

    fn form_factor(a: &Element<DVec3>, b: &Element<DVec3>) -> f64 {
        polygon_to_polygon(a.corners(), b.corners())
    }

    #[test]
    fn rows_of_a_closed_room_sum_to_one() {
        let elements = box_of_elements();
        let exchange = Exchange::new(&elements, &mut form_factor);
        for i in 0..elements.len() {
            assert!((exchange.row_sum(i) - 1.0).abs() < 1e-9, "{}", exchange.row_sum(i));
            assert_eq!(exchange.between(i, 3), exchange.between(3, i));
        }
    }

    /// Only what changed is computed, and the result is what all of it would be.
    #[test]
    fn updates_compute_only_what_changed() {
        let mut elements = box_of_elements();
        let mut exchange = Exchange::new(&elements, &mut form_factor);
        let whole = elements[5];
        let patch = Patch::Quad([0, 1, 2, 3].map(|k| whole.corners()[k]));
        let [first, rest @ ..] = Element::whole(whole.shape, 0, &patch).split(&patch);
        elements[5] = first;
        elements.extend(rest);
        let mut asked = 0;
        let count = exchange.update(&elements, &[5], &mut |a, b| {
            asked += 1;
            form_factor(a, b)
        });
        assert_eq!(exchange, Exchange::new(&elements, &mut form_factor));
        assert_eq!((asked, count), (4 * 20, 4 * 20), "four pieces, each with the elements of the other five sides");
    }

    #[test]
    fn rows_become_reciprocal() {
        let elements = box_of_elements();
        let exact = Exchange::new(&elements, &mut form_factor);
        let count = elements.len();
        let mut factors = vec![0.0; count * count];
        (0..count).for_each(|i| exact.row(i, |j, factor| factors[i * count + j] = factor));
        let same = Exchange::from_rows(&elements, &Dense { count, factors: &factors });
        factors[5] *= 1.5;
        let uneven = Exchange::from_rows(&elements, &Dense { count, factors: &factors });
        assert!((same.between(0, 5) - exact.between(0, 5)).abs() < 1e-15);
        assert!((uneven.between(5, 0) - 1.25 * exact.between(0, 5)).abs() < 1e-15);
    }
}
