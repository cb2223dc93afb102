//! Exchanges of pairs as form factors for the solvers.

use super::FormFactors;
use crate::form_factor::Exchanges;
use crate::spectrum::Spectrum;

/// [`Exchanges`] with the areas of the patches, which turn them into form factors: a matrix in a quarter of its memory.
#[derive(Clone, Copy, Debug)]
pub struct Reciprocal<'a, T> {
    /// What each pair exchanges.
    pub exchanges: &'a Exchanges<T>,
    /// `1 / A_i` of each patch, in 1/m2.
    pub inverse_areas: &'a [f32],
}

impl<T: AsRef<[u16]>> FormFactors for Reciprocal<'_, T> {
    type Scalar = f32;

    fn row(&self, i: usize, mut entry: impl FnMut(usize, f32)) {
        let scale = self.scale(i);
        let (before, after) = self.exchanges.row(i);
        before.iter().enumerate().for_each(|(j, &code)| entry(j, f32::from(code) * scale));
        (i + 1..self.inverse_areas.len()).zip(after).for_each(|(j, code)| entry(j, f32::from(code) * scale));
    }

    /// The area of the patch divides the sum, not each of its terms.
    #[inline]
    fn receive<S: Spectrum<Scalar = f32>>(&self, i: usize, radiosity: &[S]) -> S {
        let (before, after) = self.exchanges.row(i);
        let mut sum = S::default();
        for (&code, &sent) in before.iter().zip(radiosity) {
            sum += sent * f32::from(code);
        }
        for (&sent, code) in radiosity.iter().skip(i + 1).zip(after) {
            sum += sent * f32::from(code);
        }
        sum * self.scale(i)
    }
}

impl<T: AsRef<[u16]>> Reciprocal<'_, T> {
    /// The form factor that one step of row `i` stands for.
    #[inline]
    fn scale(&self, i: usize) -> f32 {
        self.exchanges.step() * self.inverse_areas.get(i).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form_factor::pairs;
    use crate::solve::{Dense, Stop, System, gauss_seidel};

    /// Three patches of different sizes: rows, sums and the solution are those of the full matrix, to 16 bits.
    #[test]
    fn as_the_full_matrix() {
        let areas = [2.0_f32, 1.0, 0.5];
        let pair = [[0.0, 0.4, 0.2], [0.4, 0.0, 0.25], [0.2, 0.25, 0.0]];
        let full: [f32; 9] = core::array::from_fn(|k| pair[k / 3][k % 3] / areas[k / 3]);
        let mut exchanges = Exchanges::new(2.0, [0; pairs(3)]);
        for (i, row) in pair.iter().enumerate() {
            (0..i).for_each(|j| exchanges.set([i, j], row[j]).unwrap());
        }
        let half = Reciprocal { exchanges: &exchanges, inverse_areas: &areas.map(|area| 1.0 / area) };
        let dense = Dense { count: 3, factors: &full };
        for i in 0..3 {
            half.row(i, |j, factor| assert!((factor - full[3 * i + j]).abs() < 2.0 / areas[i] / 131_000.0));
            assert!((half.row_sum(i) - dense.row_sum(i)).abs() < 1e-4);
        }
        let (exitance, stop) = ([1.0, 0.0, 0.0], Stop { tolerance: 1e-6, most_steps: 100 });
        let (mut by_half, mut by_full) = ([0.0_f32; 3], [0.0_f32; 3]);
        gauss_seidel(&System::new(&exitance, &[0.7; 3], &half), &mut by_half, &stop);
        gauss_seidel(&System::new(&exitance, &[0.7; 3], &dense), &mut by_full, &stop);
        by_half.iter().zip(by_full).for_each(|(half, full)| assert!((half - full).abs() < 1e-4 * full));
    }
}
