//! Half a matrix in 16 bits: what two patches exchange is the same in both directions.

use super::{MatrixError, is_share};
use crate::math;

/// How many numbers [`Exchanges`] hold for `count` patches: one for each pair. On 32 bits there are at most 65 536 patches.
pub const fn pairs(count: usize) -> usize {
    count * count.saturating_sub(1) / 2
}

/// Form factors of flat patches as the areas `A_i F_ij = A_j F_ji` that pairs exchange, in 16 bits each: an eighth of the
/// memory of a full matrix of `f64`, a quarter of one of `f32`.
///
/// On an array, `Exchanges<[u16; pairs(150)]>`, the capacity is fixed; on a slice it is the caller's. A step of the 16 bits
/// is `max A / 65535`, which no pair exceeds, so that a form factor is wrong by at most `max A / A_i / 131070`: 7.6e-6
/// between patches of the same size. A row of `n` of them is wrong by about the root of `n` times as much, at most `n`
/// times. Fewer bits are too few: in a Cornell box of 173 patches, 12 instead of 16 make the worst radiosity wrong by 3.5 %
/// instead of 0.8 %.
///
/// ```
/// use radiosity::form_factor::{Exchanges, pairs};
///
/// // Two plates: the first is twice as large and sends a fifth of its light to the other.
/// let mut exchanges = Exchanges::new(2.0, [0; pairs(2)]);
/// exchanges.set([0, 1], 2.0 * 0.2)?;
/// assert!((exchanges.get([1, 0]) / 1.0 - 0.4).abs() < 1.6e-5);
/// # Ok::<(), radiosity::form_factor::MatrixError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Exchanges<T> {
    /// Area that one step stands for.
    step: f32,
    codes: T,
}

impl<T: AsRef<[u16]>> Exchanges<T> {
    /// On memory of [`pairs`] numbers, which keeps what stands there; `largest` is the largest area of all patches.
    pub fn new(largest: f32, codes: T) -> Self {
        Self { step: largest / f32::from(u16::MAX), codes }
    }

    /// `A_i F_ij` of two patches; 0 of a patch with itself or beyond the memory.
    pub fn get(&self, pair: [usize; 2]) -> f32 {
        place(pair).and_then(|place| self.codes.as_ref().get(place)).map_or(0.0, |&code| f32::from(code) * self.step)
    }

    /// Area that one step of the stored numbers stands for.
    pub fn step(&self) -> f32 {
        self.step
    }

    /// The stored numbers of patch `i` with all patches before it, and with all after it.
    #[inline]
    pub(crate) fn row(&self, i: usize) -> (&[u16], impl Iterator<Item = u16>) {
        let codes = self.codes.as_ref();
        let before = codes.get(pairs(i)..pairs(i + 1)).unwrap_or_default();
        let mut place = pairs(i + 1) + i;
        let mut distance = i;
        let after = core::iter::from_fn(move || {
            let code = *codes.get(place)?;
            distance += 1;
            place += distance;
            Some(code)
        });
        (before, after)
    }
}

impl<T: AsMut<[u16]>> Exchanges<T> {
    /// Stores `A_i F_ij` of two different patches, as what both send to each other.
    ///
    /// # Errors
    ///
    /// Where the exchange is not in `[0, max A]` or the pair lies beyond the memory.
    pub fn set(&mut self, pair @ [row, column]: [usize; 2], exchange: f32) -> Result<(), MatrixError> {
        let code = math::round(exchange / self.step);
        if !is_share(exchange) || code > f32::from(u16::MAX) {
            return Err(MatrixError::Factor { row, column });
        }
        let codes = self.codes.as_mut();
        let capacity = codes.len();
        let entry = place(pair).and_then(|place| codes.get_mut(place));
        *entry.ok_or(MatrixError::Full { row, capacity })? = code as u16;
        Ok(())
    }
}

/// Row after row, each up to the diagonal, which is left out.
fn place([i, j]: [usize; 2]) -> Option<usize> {
    let [low, high] = [i.min(j), i.max(j)];
    let before = high.checked_mul(high.checked_sub(1)?)? / 2;
    before.checked_add(low).filter(|_| low != high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every pair has a place of its own, and rows find the same.
    #[test]
    fn rows_and_pairs_agree() {
        const COUNT: usize = 7;
        let mut exchanges = Exchanges::new(1.0, [0; pairs(COUNT)]);
        let value = |i: usize, j: usize| (8 * i.max(j) + i.min(j)) as f32 / 65535.0;
        for i in 0..COUNT {
            (0..i).for_each(|j| exchanges.set([j, i], value(i, j)).unwrap());
        }
        for i in 0..COUNT {
            assert_eq!(exchanges.get([i, i]), 0.0);
            let (before, after) = exchanges.row(i);
            let row: [u16; COUNT - 1] = {
                let mut codes = before.iter().copied().chain(after);
                core::array::from_fn(|_| codes.next().unwrap())
            };
            for (j, code) in (0..COUNT).filter(|&j| j != i).zip(row) {
                assert_eq!(f32::from(code), value(i, j) * 65535.0);
                assert_eq!(exchanges.get([i, j]), exchanges.get([j, i]));
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_an_error() {
        let mut exchanges = Exchanges::new(2.0, [0; pairs(2)]);
        assert_eq!(exchanges.set([0, 1], 2.1), Err(MatrixError::Factor { row: 0, column: 1 }));
        assert_eq!(exchanges.set([0, 1], f32::NAN), Err(MatrixError::Factor { row: 0, column: 1 }));
        assert_eq!(exchanges.set([2, 1], 0.5), Err(MatrixError::Full { row: 2, capacity: 1 }));
        assert_eq!(exchanges.set([1, 1], 0.5), Err(MatrixError::Full { row: 1, capacity: 1 }));
        assert_eq!((exchanges.set([1, 0], 2.0), exchanges.get([0, 1])), (Ok(()), 2.0));
        assert_eq!(exchanges.get([5, 1]), 0.0);
    }
}
