//! The system of equations `b = e + rho F b`, and its form factors, a row on demand.

use super::Decay;
use crate::form_factor::DenseRows;
use crate::math::Real;
use crate::spectrum::Spectrum;

/// The form factors of a system, a row on demand.
pub trait FormFactors {
    /// Single or double precision.
    type Scalar: Real;

    /// Calls `entry` with `j` and `F_ij` for each `j` that patch `i` sees, in a fixed order.
    fn row(&self, i: usize, entry: impl FnMut(usize, Self::Scalar));

    /// `sum_j F_ij b_j`: what patch `i` receives.
    fn receive<S: Spectrum<Scalar = Self::Scalar>>(&self, i: usize, radiosity: &[S]) -> S {
        let mut sum = S::default();
        self.row(i, |j, factor| sum += radiosity.get(j).copied().unwrap_or_default() * factor);
        sum
    }

    /// `F b`: what all patches receive. An implementation with threads may do its rows in any order.
    fn receive_all<S: Spectrum<Scalar = Self::Scalar>>(&self, radiosity: &[S], received: &mut [S]) {
        received.iter_mut().enumerate().for_each(|(i, sum)| *sum = self.receive(i, radiosity));
    }

    /// `sum_j F_ij`: the share of the light of patch `i` that stays in the scene.
    fn row_sum(&self, i: usize) -> Self::Scalar {
        let mut sum = Self::Scalar::ZERO;
        self.row(i, |_, factor| sum += factor);
        sum
    }
}

/// A full square matrix, row after row, that is only read; one that is filled or repaired is [`DenseRows`].
#[derive(Clone, Copy, Debug)]
pub struct Dense<'a, R> {
    /// Of one row, and of one column.
    pub count: usize,
    /// `count x count` form factors; `F_ij` stands at `i x count + j`.
    pub factors: &'a [R],
}

impl<R: Real> FormFactors for Dense<'_, R> {
    type Scalar = R;

    fn row(&self, i: usize, mut entry: impl FnMut(usize, R)) {
        let row = &self.factors[i * self.count..(i + 1) * self.count];
        row.iter().enumerate().for_each(|(j, &factor)| entry(j, factor));
    }
}

impl<R: Real> FormFactors for DenseRows<'_, R> {
    type Scalar = R;

    fn row(&self, i: usize, mut entry: impl FnMut(usize, R)) {
        DenseRows::row(self, i).iter().enumerate().for_each(|(j, &factor)| entry(j, factor));
    }
}

/// A radiosity system: what the patches emit and reflect. All slices have one entry for each patch, in the order of the
/// form factors; patches beyond the end of one emit or reflect nothing.
#[derive(Debug)]
pub struct System<'a, S, F> {
    /// Exitance `e` of each patch, or emitted radiance, when all is in radiances.
    pub exitance: &'a [S],
    /// Reflectance `rho` of each patch, in `[0, 1]`.
    pub reflectance: &'a [S],
    /// `F`, with rows that sum to at most 1.
    pub form_factors: &'a F,
    /// How light dies out, which depends on `rho` and `F` only: for other light in the same room, write
    /// `System { exitance, ..system }`.
    pub decay: Decay<S>,
}

impl<S: Copy, F> Clone for System<'_, S, F> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Copy, F> Copy for System<'_, S, F> {}

impl<'a, S: Spectrum, F: FormFactors<Scalar = S::Scalar>> System<'a, S, F> {
    /// The cost is that of a sweep in one band, for the sums of the rows.
    pub fn new(exitance: &'a [S], reflectance: &'a [S], form_factors: &'a F) -> Self {
        let decay = Decay::of_one_bounce(reflectance, form_factors);
        Self { exitance, reflectance, form_factors, decay }
    }

    /// Looks at many bounces instead of one, at most `most_sweeps` of them, to bound errors more tightly.
    ///
    /// This is what to do where [`Decay::amplification`] is infinite, because a patch has reflectance 1 and sees no
    /// way out: where its light is absorbed elsewhere the bound becomes finite. Where nothing absorbs, as in a closed
    /// room of reflectance 1, emitted light gathers forever, no solution exists, and it stays infinite. `scratch` has
    /// at least one entry for each patch.
    pub fn look_ahead(self, scratch: &mut [S], most_sweeps: usize) -> Self {
        let decay = self.decay.of_many_bounces(self.reflectance, self.form_factors, scratch, most_sweeps);
        Self { decay, ..self }
    }

    /// The right-hand side `e_i + rho_i sum_j F_ij b_j`.
    pub(super) fn update(&self, i: usize, radiosity: &[S]) -> S {
        self.reflect(i, self.form_factors.receive(i, radiosity))
    }

    /// What leaves patch `i` that receives this.
    pub(super) fn reflect(&self, i: usize, received: S) -> S {
        let of = |slice: &[S]| slice.get(i).copied().unwrap_or_default();
        of(self.exitance) + of(self.reflectance) * received
    }
}
