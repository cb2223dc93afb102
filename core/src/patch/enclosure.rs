//! The classical method from end to end: elements, their form factors, the radiosity equation.

use alloc::vec;
use alloc::vec::Vec;

use super::{Element, Exchange, Field, Shape};
use crate::math::{Real, Vector};
use crate::solve::{Solution, Stop, System, gauss_seidel};
use crate::spectrum::Spectrum;

/// Elements with what they exchange and their radiosities.
#[derive(Clone, Debug)]
pub struct Enclosure<V: Vector, S> {
    /// The pieces of the shapes.
    pub elements: Vec<Element<V>>,
    /// What they exchange.
    pub exchange: Exchange<V::Scalar>,
    /// The radiosity of each element.
    pub radiosity: Vec<S>,
    /// Sweeps of the solver, all together.
    pub sweeps: usize,
    /// Pairs of elements whose form factor was asked for, all together.
    pub pairs: usize,
}

impl<V: Vector, S: Spectrum<Scalar = V::Scalar>> Enclosure<V, S> {
    /// Computes the form factors of `elements` by any method and solves for their radiosities.
    ///
    /// `form_factor` gets two elements, the smaller one first, and gives the share of the light leaving the first that
    /// reaches the second.
    pub fn new(
        shapes: &[Shape<V, S>],
        elements: Vec<Element<V>>,
        stop: &Stop<V::Scalar>,
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
    ) -> Self {
        let mut exchange = Exchange::default();
        let pairs = exchange.update(&elements, &[], form_factor);
        let radiosity = vec![S::default(); elements.len()];
        let mut enclosure = Self { elements, exchange, radiosity, sweeps: 0, pairs };
        enclosure.solve(shapes, stop);
        enclosure
    }

    /// Solves by Gauss-Seidel from the radiosities as they are.
    pub fn solve(&mut self, shapes: &[Shape<V, S>], stop: &Stop<V::Scalar>) -> Solution<V::Scalar> {
        let of = |get: fn(&Shape<V, S>) -> S| self.elements.iter().map(|e| get(&shapes[e.shape])).collect::<Vec<S>>();
        let (exitance, reflectance) = (of(|shape| shape.exitance), of(|shape| shape.reflectance));
        let system = System::new(&exitance, &reflectance, &self.exchange);
        let solution = gauss_seidel(&system, &mut self.radiosity, stop);
        self.sweeps += solution.steps;
        solution
    }

    /// The continuous function through the radiosities.
    pub fn field(&self, shapes: &[Shape<V, S>]) -> Field<V, S> {
        Field::new(shapes, &self.elements, &self.radiosity)
    }

    /// The root mean square over all surfaces of the radiosity that is reflected, in its brightest band.
    pub fn reflected(&self, shapes: &[Shape<V, S>]) -> V::Scalar {
        let (mut sum, mut area) = (V::Scalar::ZERO, V::Scalar::ZERO);
        for (element, &radiosity) in self.elements.iter().zip(&self.radiosity) {
            let reflected = (radiosity - shapes[element.shape].exitance).max_abs();
            sum += reflected * reflected * element.area;
            area += element.area;
        }
        if area > V::Scalar::ZERO { (sum / area).sqrt() } else { area }
    }
}
