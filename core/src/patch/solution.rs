//! The classical method from end to end: elements, their form factors, the radiosity equation.

use alloc::vec;
use alloc::vec::Vec;

use super::{Element, Exchange, Field, Shape};
use crate::math::{Real, Vector};
use crate::solve::{Stop, System, gauss_seidel};
use crate::spectrum::Spectrum;

/// Sweeps at most: reflectances up to 0.99 reach any tolerance before.
const MOST_SWEEPS: usize = 2000;

/// Elements with what they exchange and their radiosities.
#[derive(Clone, Debug)]
pub struct Solution<V: Vector, S> {
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

impl<V: Vector, S: Spectrum<Scalar = V::Scalar>> Solution<V, S> {
    /// Computes the form factors of `elements` by any method and solves for their radiosities.
    ///
    /// `form_factor` gets two elements, the smaller one first, and gives the share of the light leaving the first that
    /// reaches the second. The solution is `tolerance` close, as a share of the largest radiosity.
    pub fn new(
        shapes: &[Shape<V, S>],
        elements: Vec<Element<V>>,
        tolerance: V::Scalar,
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
    ) -> Self {
        let mut exchange = Exchange::default();
        let pairs = exchange.update(&elements, &[], form_factor);
        let radiosity = vec![S::default(); elements.len()];
        let mut solution = Self { elements, exchange, radiosity, sweeps: 0, pairs };
        solution.solve(shapes, tolerance);
        solution
    }

    /// Solves again from the radiosities as they are.
    pub fn solve(&mut self, shapes: &[Shape<V, S>], tolerance: V::Scalar) {
        let of = |get: fn(&Shape<V, S>) -> S| self.elements.iter().map(|e| get(&shapes[e.shape])).collect::<Vec<S>>();
        let (exitance, reflectance) = (of(|shape| shape.exitance), of(|shape| shape.reflectance));
        let system = System::new(&exitance, &reflectance, &self.exchange);
        let stop = Stop { tolerance, most_steps: MOST_SWEEPS };
        self.sweeps += gauss_seidel(&system, &mut self.radiosity, &stop).steps;
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
