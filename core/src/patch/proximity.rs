//! Before anything is solved: how much light two elements may exchange, and which of them is too large for it.

use super::Element;
use crate::math::{Real, Vector};

/// How much light two elements may exchange at most, for exitance 1: a bound on `A_a F_ab` in square meters.
///
/// The larger one counts as a disc of its area, seen from a point of the smaller one at the distance of the centers:
/// `F <= cos a cos b A / (pi r^2 + A)`, with the best cosines that any corner gives. A good guess rather than a strict
/// bound, as in Hanrahan, Salzman and Aupperle 1991, section 4. Blockers are not looked at.
pub fn expected_exchange<V: Vector>(a: &Element<V>, b: &Element<V>) -> V::Scalar {
    let (small, large) = (a.area.min(b.area), a.area.max(b.area));
    let distance = (a.center - b.center).length_squared();
    let cosines = best_cosine(a, b) * best_cosine(b, a);
    if cosines > V::Scalar::ZERO {
        small * large * cosines / (V::Scalar::PI * distance + large)
    } else {
        V::Scalar::ZERO
    }
}

/// The largest cosine between the normal of `a` and the way from its center to `b`; 0 where `b` lies behind.
fn best_cosine<V: Vector>(a: &Element<V>, b: &Element<V>) -> V::Scalar {
    let cosine = |point: V| (point - a.center).normalize_or_zero().dot(a.normal);
    b.corners().iter().fold(cosine(b.center), |best, &corner| best.max(cosine(corner))).max(V::Scalar::ZERO)
}

#[cfg(feature = "alloc")]
pub use listed::*;

#[cfg(feature = "alloc")]
mod listed {
    use alloc::vec;
    use alloc::vec::Vec;

    use super::expected_exchange;
    use crate::math::Real;
    use crate::math::Vector;
    use crate::patch::topology::{restrict, split};
    use crate::patch::{Element, Shape};
    use crate::spectrum::Spectrum;

    /// When elements are small enough for the light that they are expected to exchange.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Proximity<R> {
        /// The power that any two elements exchange at most, as a share of all that is emitted; 0.001 is usual.
        pub largest_exchange: R,
        /// Elements of less than twice this area, in square meters, are left as they are.
        pub smallest_area: R,
        /// No more is cut where there are as many elements.
        pub most_elements: usize,
    }

    /// Cuts elements until the power that any two of them are expected to exchange is small.
    ///
    /// The power is [`expected_exchange`] times the brightness of the brighter shape, which is its exitance plus the
    /// mean radiosity `sum A e / sum A (1 - rho)` that all surfaces would have if light were spread evenly: BF
    /// refinement, where B is guessed. Of two that exchange too much the larger one is cut. Neighbors in one shape
    /// differ by at most one cut afterwards.
    pub fn by_proximity<V: Vector, S: Spectrum<Scalar = V::Scalar>>(
        shapes: &[Shape<V, S>],
        elements: &mut Vec<Element<V>>,
        settings: &Proximity<V::Scalar>,
    ) {
        let (brightness, emitted) = brightness(shapes, elements);
        let limit = settings.largest_exchange * emitted;
        let mut is_new = vec![true; elements.len()];
        while elements.len() < settings.most_elements {
            let too_much = |a: &Element<V>, b: &Element<V>| {
                expected_exchange(a, b) * brightness[a.shape].max(brightness[b.shape]) > limit
            };
            let room = (settings.most_elements - elements.len()).div_ceil(3);
            let cut = larger_ones(elements, &is_new, settings.smallest_area, too_much, room);
            if cut.is_empty() {
                break;
            }
            is_new = vec![false; elements.len()];
            for i in cut {
                is_new[i] = true;
                split(shapes, elements, i);
            }
            is_new.resize(elements.len(), true);
        }
        restrict(shapes, elements);
    }

    /// Of each pair that exchanges too much the larger element, if it may be cut; `room` of them at most. Pairs without
    /// a new element were looked at before.
    fn larger_ones<V: Vector>(
        elements: &[Element<V>],
        is_new: &[bool],
        smallest_area: V::Scalar,
        too_much: impl Fn(&Element<V>, &Element<V>) -> bool,
        room: usize,
    ) -> Vec<usize> {
        let mut marked = vec![false; elements.len()];
        for (i, a) in elements.iter().enumerate() {
            for (j, b) in elements[..i].iter().enumerate().filter(|&(j, _)| is_new[i] || is_new[j]) {
                let larger = if a.area >= b.area { i } else { j };
                let may_cut = elements[larger].area >= smallest_area * V::Scalar::from_f64(2.0);
                marked[larger] = marked[larger] || (may_cut && too_much(a, b));
            }
        }
        (0..elements.len()).filter(|&i| marked[i]).take(room).collect()
    }

    /// The guessed largest radiosity of each shape, and the emitted power.
    fn brightness<V: Vector, S: Spectrum<Scalar = V::Scalar>>(
        shapes: &[Shape<V, S>],
        elements: &[Element<V>],
    ) -> (Vec<V::Scalar>, V::Scalar) {
        let (mut emitted, mut absorbing) = (V::Scalar::ZERO, V::Scalar::ZERO);
        for element in elements {
            let shape = &shapes[element.shape];
            emitted += shape.exitance.max_abs() * element.area;
            absorbing += (V::Scalar::ONE - shape.reflectance.max_abs()) * element.area;
        }
        let ambient = if absorbing > V::Scalar::ZERO { emitted / absorbing } else { V::Scalar::ZERO };
        (shapes.iter().map(|shape| shape.exitance.max_abs() + ambient).collect(), emitted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::Patch;
    use glam::DVec3;

    fn square(origin: DVec3, x: DVec3, y: DVec3) -> Element<DVec3> {
        Element::whole(0, 0, &Patch::Quad([origin, origin + x, origin + x + y, origin + y]))
    }

    /// Far away it is the point formula; near it is never more than the smaller area.
    #[test]
    fn near_and_far() {
        let floor = square(DVec3::ZERO, DVec3::X, DVec3::Y);
        let above = |height: f64| square(DVec3::new(0.0, 0.0, height), DVec3::Y * 0.5, DVec3::X * 0.5);
        let far = expected_exchange(&floor, &above(100.0));
        assert!((far / (0.25 / (core::f64::consts::PI * 1e4)) - 1.0).abs() < 1e-3);
        for height in [1.0, 0.1, 1e-3] {
            let near = expected_exchange(&floor, &above(height));
            assert!(near <= 0.25 && near == expected_exchange(&above(height), &floor));
        }
    }

    /// Howell's catalogue C-14: unit squares at a common edge exchange 0.20004, at distance 1 face to face 0.19982.
    #[test]
    fn a_guess_of_known_exchanges() {
        let floor = square(DVec3::ZERO, DVec3::X, DVec3::Y);
        let wall = square(DVec3::ZERO, DVec3::Y, DVec3::Z);
        let ceiling = square(DVec3::Z, DVec3::Y, DVec3::X);
        for (other, exact) in [(wall, 0.200_044), (ceiling, 0.199_825)] {
            let guess = expected_exchange(&floor, &other);
            assert!(guess > 0.7 * exact && guess < 2.0 * exact, "{guess}");
        }
        assert_eq!(expected_exchange(&floor, &square(DVec3::X, DVec3::X, DVec3::Y)), 0.0);
        assert_eq!(expected_exchange(&floor, &square(-DVec3::Z, DVec3::X, DVec3::Y)), 0.0);
    }
}
