//! What an estimate cannot see: small pieces of an element, asked directly.

use super::exchange::exchanged;
use super::{Element, Enclosure, Field, Patch, Shape};
use crate::math::{Real, Vector};
use crate::spectrum::Spectrum;

/// An estimate is not trusted where the error is so many times as large.
const BLIND: f64 = 2.0;

/// What is known of the error of an element beyond what its neighbors tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hidden<R> {
    /// It was not probed.
    Unknown,
    /// The estimate missed this error, a root mean square.
    Found(R),
    /// The estimate saw what probing saw, here or on the element that this one was cut from.
    Nothing,
}

impl<R: Real> Hidden<R> {
    /// The error of an element that has this estimate.
    pub fn error(self, estimate: R) -> R {
        match self {
            Self::Found(error) => error.max(estimate),
            _ => estimate,
        }
    }

    /// What is known of the pieces: where the estimate failed they are probed again.
    pub fn of_pieces(self) -> Self {
        if self == Self::Nothing { Self::Nothing } else { Self::Unknown }
    }
}

impl<V: Vector, S: Spectrum<Scalar = V::Scalar>> Enclosure<V, S> {
    /// Probes the elements that were not probed yet and that reflect.
    pub(super) fn confirm(
        &mut self,
        shapes: &[Shape<V, S>],
        field: &Field<V, S>,
        hidden: &mut [Hidden<V::Scalar>],
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
    ) {
        for (i, hidden) in hidden.iter_mut().enumerate().filter(|(_, hidden)| **hidden == Hidden::Unknown) {
            let error = self.miss(shapes, field, i, form_factor);
            *hidden = if error > V::Scalar::from_f64(BLIND) * field.errors[i] {
                Hidden::Found(error)
            } else {
                Hidden::Nothing
            };
        }
    }

    /// How far the field is from what pieces of element `i` gather, as a root mean square in the brightest band.
    fn miss(
        &mut self,
        shapes: &[Shape<V, S>],
        field: &Field<V, S>,
        i: usize,
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
    ) -> V::Scalar {
        let element = self.elements[i];
        let shape = &shapes[element.shape];
        let (mut sum, mut area) = (V::Scalar::ZERO, V::Scalar::ZERO);
        let reflects = shape.reflectance.max_abs() > V::Scalar::ZERO;
        for piece in pieces(&element, &shape.patches[element.patch]).iter().filter(|_| reflects) {
            let radiosity = shape.exitance + shape.reflectance * self.gather(i, piece, form_factor);
            let miss = (radiosity - field.value(i, &element, piece.center)).max_abs();
            sum += miss * miss * piece.area;
            area += piece.area;
        }
        if area > V::Scalar::ZERO { (sum / area).sqrt() } else { area }
    }

    /// The irradiation of a piece of element `i` by the elements as they are.
    fn gather(
        &mut self,
        i: usize,
        piece: &Element<V>,
        form_factor: &mut impl FnMut(&Element<V>, &Element<V>) -> V::Scalar,
    ) -> S {
        let mut power = S::default();
        for (j, (element, &radiosity)) in self.elements.iter().zip(&self.radiosity).enumerate() {
            let is_lit = j != i && radiosity.max_abs() > V::Scalar::ZERO;
            if let Some(exchange) = is_lit.then(|| exchanged(piece, element, form_factor)).flatten() {
                power += radiosity * exchange;
                self.pairs += 1;
            }
        }
        if piece.area > V::Scalar::ZERO { power * (V::Scalar::ONE / piece.area) } else { power }
    }
}

/// Two pieces of a sixteenth, one at a corner and one at the center.
///
/// Quarters would not do: under a lamp above its center all quarters of a square have the mean of the whole.
fn pieces<V: Vector>(element: &Element<V>, patch: &Patch<V>) -> [Element<V>; 2] {
    let quarters = element.split(patch);
    [0, 2].map(|k| quarters[k].split(patch)[0])
}
