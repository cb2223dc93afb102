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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form_factor::polygon_to_polygon;
    use crate::patch::Patch;
    use glam::{DVec3, Vec3};

    /// The sides of the unit cube, seen from inside; the first and the second are opposite.
    fn cube<V: Vector>() -> [[Patch<'static, V>; 1]; 6] {
        let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let sides = [[o, x, y], [z, y, x], [o, y, z], [x, z, y], [o, z, x], [y, x, z]];
        sides.map(|[o, u, v]| [Patch::Quad([o, o + u, o + u + v, o + v].map(V::from_dvec3))])
    }

    /// One element a side; the first one emits.
    fn solve<V: Vector, S: Spectrum<Scalar = V::Scalar>>(reflectance: S, exitance: S, tolerance: f64) -> Vec<S> {
        let sides = cube::<V>();
        let shape = |k: usize| Shape {
            patches: &sides[k][..],
            reflectance,
            exitance: if k == 0 { exitance } else { S::default() },
        };
        let shapes: [Shape<V, S>; 6] = core::array::from_fn(shape);
        let elements = (0..6).map(|k| Element::whole(k, 0, &sides[k][0])).collect();
        let stop = Stop { tolerance: V::Scalar::from_f64(tolerance), most_steps: 100 };
        Enclosure::new(&shapes, elements, &stop, &mut |a, b| polygon_to_polygon(a.corners(), b.corners())).radiosity
    }

    /// By symmetry three unknowns are left, with F = 0.199825 to the opposite side: 0.1817458 is the radiosity there.
    #[test]
    fn the_cube_of_six_patches() {
        let double = solve::<DVec3, f64>(0.5, 1.0, 1e-12);
        let single = solve::<Vec3, f32>(0.5, 1.0, 1e-5);
        assert!((double[1] - 0.181_745_8).abs() < 1e-7, "{}", double[1]);
        assert!((double.iter().sum::<f64>() - 2.0).abs() < 1e-9);
        double.iter().zip(&single).for_each(|(a, b)| assert!((a - f64::from(*b)).abs() < 1e-5));
    }

    #[test]
    fn colors_are_solved_at_once() {
        let (reflectance, exitance) = (DVec3::new(0.2, 0.5, 0.8), DVec3::new(3.0, 1.0, 0.5));
        let together = solve::<DVec3, DVec3>(reflectance, exitance, 1e-12);
        for band in 0..3 {
            let alone = solve::<DVec3, f64>(reflectance[band], exitance[band], 1e-12);
            alone.iter().zip(&together).for_each(|(a, b)| assert!((a - b[band]).abs() < 1e-9));
        }
    }
}
