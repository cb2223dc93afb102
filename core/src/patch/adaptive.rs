//! After solving: cut where the solution varies.

use alloc::vec;
use alloc::vec::Vec;

use super::probe::Hidden;
use super::topology::{restrict, split};
use super::{Element, Enclosure, Field, Shape};
use crate::math::{Real, Vector};
use crate::solve::Stop;
use crate::spectrum::Spectrum;

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement<R> {
    /// The root mean square over all surfaces of how far the radiosity differs from that of its element, as a share of
    /// the root mean square of what is reflected. 0.1 gives a coarse picture, 0.02 a fine one.
    pub tolerance: R,
    /// Elements with less than twice this area, in square meters, are not cut any more.
    pub smallest_area: R,
    /// No more is cut where there are as many elements; keeping neighbors alike may take a few more.
    pub most_elements: usize,
    /// When the solver stops, each time.
    pub stop: Stop<R>,
}

/// Why refinement ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refined {
    /// The tolerance is met.
    Tolerance,
    /// What is left to cut is too small.
    SmallestArea,
    /// There are as many elements as may be.
    MostElements,
}

/// The share of the square of the error that is cut in one step: the bulk criterion of Doerfler 1996.
const BULK: f64 = 0.5;
/// What a cut leaves of the square of the error where the radiosity is smooth: half the side, a quarter of the error.
const LEFT: f64 = 1.0 / 16.0;

impl<V: Vector, S: Spectrum<Scalar = V::Scalar>> Enclosure<V, S> {
    /// Cuts the elements on which the solution varies most, computes the form factors of the pieces and solves again,
    /// until the estimated error is within the tolerance. Gives the reason to end and the estimated error.
    ///
    /// The error of an element is estimated by how far the continuous function through the solution ([`Field`])
    /// differs from its one value, so gradients and jumps between neighbors count alike (Zienkiewicz and Zhu 1987).
    /// What was not cut keeps its form factors, and the solution is the start of the next one.
    ///
    /// Neighbors that are equal by symmetry, or that are missing, tell nothing. So each element of the start is probed:
    /// what two pieces of it gather is compared with the function, and the larger error counts. Pieces of an element
    /// whose estimate fell far short of that are probed again. Each call probes its start anew, by four form factors
    /// for each pair. One element per patch is start enough where the light is smooth. A feature that falls between the
    /// probes, as a shadow much smaller than the first elements, is still not found: there start fine enough.
    pub fn refine(
        &mut self,
        shapes: &[Shape<V, S>],
        settings: &Refinement<V::Scalar>,
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
    ) -> (Refined, V::Scalar) {
        let mut hidden = vec![Hidden::Unknown; self.elements.len()];
        loop {
            let field = self.field(shapes);
            self.confirm(shapes, &field, &mut hidden, form_factor);
            let errors = self.errors(&field, &hidden);
            let scale = self.scale(shapes);
            let error = (errors.iter().copied().sum::<V::Scalar>() / scale).sqrt();
            let marked = self.mark(&errors, settings, settings.tolerance * settings.tolerance * scale);
            if error <= settings.tolerance {
                return (Refined::Tolerance, error);
            }
            if self.elements.len() >= settings.most_elements {
                return (Refined::MostElements, error);
            }
            if marked.is_empty() {
                return (Refined::SmallestArea, error);
            }
            let origins = self.cut(shapes, &field, &marked, form_factor);
            hidden = origins.iter().map(|origin| origin.hidden(&hidden)).collect();
            self.solve(shapes, &settings.stop);
        }
    }

    /// The integral over each element of the square of its error.
    fn errors(&self, field: &Field<V, S>, hidden: &[Hidden<V::Scalar>]) -> Vec<V::Scalar> {
        let of = |(i, element): (usize, &Element<V>)| {
            let error = hidden[i].error(field.errors[i]);
            error * error * element.area
        };
        self.elements.iter().enumerate().map(of).collect()
    }

    /// The square of the root mean square of the reflected radiosity, times all area; 1 where there is no light.
    fn scale(&self, shapes: &[Shape<V, S>]) -> V::Scalar {
        let reflected = self.reflected(shapes);
        let area: V::Scalar = self.elements.iter().map(|element| element.area).sum();
        if reflected > V::Scalar::ZERO { reflected * reflected * area } else { V::Scalar::ONE }
    }

    /// The elements with the largest errors, as many as hold the bulk of the error or, if those are fewer, as many as
    /// have to be cut to come down to `target`.
    fn mark(&self, errors: &[V::Scalar], settings: &Refinement<V::Scalar>, target: V::Scalar) -> Vec<usize> {
        let smallest = settings.smallest_area * V::Scalar::from_f64(2.0);
        let mut order: Vec<usize> = (0..errors.len()).filter(|&i| self.elements[i].area >= smallest).collect();
        order.sort_by(|&i, &j| errors[j].to_f64().total_cmp(&errors[i].to_f64()));
        let bulk = order.iter().map(|&i| errors[i]).sum::<V::Scalar>() * V::Scalar::from_f64(BULK);
        let mut left = errors.iter().copied().sum::<V::Scalar>();
        let mut held = V::Scalar::ZERO;
        let enough = order.iter().position(|&i| {
            let is_enough = held >= bulk || left <= target;
            held += errors[i];
            left += errors[i] * V::Scalar::from_f64(LEFT - 1.0);
            is_enough
        });
        let room = settings.most_elements.saturating_sub(self.elements.len()).div_ceil(3);
        order.truncate(enough.unwrap_or(order.len()).min(room));
        order
    }

    /// Cuts these elements, and others so that neighbors stay alike; the pieces start with the value of the field.
    ///
    /// Gives for each element what it was before.
    fn cut(
        &mut self,
        shapes: &[Shape<V, S>],
        field: &Field<V, S>,
        marked: &[usize],
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
    ) -> Vec<Origin> {
        let before = self.elements.clone();
        let mut parents: Vec<usize> = (0..before.len()).collect();
        marked.iter().for_each(|&i| split(shapes, &mut self.elements, i));
        let restricted = restrict(shapes, &mut self.elements);
        for &i in marked.iter().chain(&restricted) {
            parents.extend([parents[i]; 3]);
        }
        let mut changed: Vec<usize> = marked.iter().chain(&restricted).copied().collect();
        changed.sort_unstable();
        changed.dedup();
        changed.retain(|&i| i < before.len());
        for i in changed.iter().copied().chain(before.len()..self.elements.len()) {
            let (parent, center) = (parents[i], self.elements[i].center);
            let start = field.value(parent, &before[parent], center);
            if i < before.len() { self.radiosity[i] = start } else { self.radiosity.push(start) }
        }
        self.pairs += self.exchange.update(&self.elements, &changed, form_factor);
        let mut origins: Vec<Origin> = parents.into_iter().map(Origin::Piece).collect();
        (0..before.len()).filter(|i| changed.binary_search(i).is_err()).for_each(|i| origins[i] = Origin::Same(i));
        origins
    }
}

/// What an element was before a step.
enum Origin {
    /// Itself.
    Same(usize),
    /// A part of this one.
    Piece(usize),
}

impl Origin {
    /// What is known of an element, from what was known before.
    fn hidden<R: Real>(&self, before: &[Hidden<R>]) -> Hidden<R> {
        match *self {
            Self::Same(i) => before[i],
            Self::Piece(i) => before[i].of_pieces(),
        }
    }
}
