//! A small picture with alpha on a large one: the mouse pointer on a desktop.

use core::fmt;

use super::{Channel, PremultipliedRgba, over_span};

/// A picture on memory of the caller, row by row from the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sprite<'a, C = f32> {
    width: usize,
    pixels: &'a [PremultipliedRgba<C>],
}

/// A picture whose rows do not fit its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowError {
    /// Pixels in a row.
    pub width: usize,
    /// Pixels in all.
    pub pixels: usize,
}

impl fmt::Display for RowError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { width, pixels } = self;
        write!(f, "{pixels} pixels are no whole rows of {width}; give a width that divides them")
    }
}

impl core::error::Error for RowError {}

impl<'a, C: Channel> Sprite<'a, C> {
    /// Takes the pixels row by row.
    ///
    /// # Errors
    ///
    /// Where they are no whole number of rows.
    pub fn new(width: usize, pixels: &'a [PremultipliedRgba<C>]) -> Result<Self, RowError> {
        check_rows(width, pixels.len())?;
        Ok(Self { width, pixels })
    }

    /// Width and height.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.pixels.len() / self.width]
    }

    /// The pixel in a column and a row; transparent outside.
    pub fn pixel(&self, x: usize, y: usize) -> PremultipliedRgba<C> {
        let index = y.saturating_mul(self.width).saturating_add(x);
        let pixel = self.pixels.get(index).filter(|_| x < self.width);
        pixel.copied().unwrap_or(PremultipliedRgba::TRANSPARENT)
    }

    /// Lays it over a picture of rows of `width` pixels, with its upper left corner in column `x` and row `y`, which may
    /// lie outside. What reaches beyond the picture is cut off.
    ///
    /// # Errors
    ///
    /// Where `picture` is no whole number of rows.
    pub fn draw(&self, width: usize, picture: &mut [PremultipliedRgba<C>], [x, y]: [i32; 2]) -> Result<(), RowError> {
        check_rows(width, picture.len())?;
        let [skip, skip_rows] = [x, y].map(|start| start.min(0).unsigned_abs() as usize);
        let [start, start_row] = [x, y].map(|start| start.max(0) as usize);
        if start >= width || skip >= self.width {
            return Ok(());
        }
        let rows = picture.chunks_exact_mut(width).skip(start_row);
        for (row, sprite) in rows.zip(self.pixels.chunks_exact(self.width).skip(skip_rows)) {
            over_span(&sprite[skip..], &mut row[start..]);
        }
        Ok(())
    }
}

fn check_rows(width: usize, pixels: usize) -> Result<(), RowError> {
    if width > 0 && pixels.is_multiple_of(width) { Ok(()) } else { Err(RowError { width, pixels }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each pixel of the sprite lands where it should, wherever the corner lies; all others stay.
    #[test]
    fn cut_off_at_all_sides() {
        let sprite: [_; 6] = core::array::from_fn(|k| PremultipliedRgba::new([0, 0, 0, 10 + k as u8]));
        let sprite = Sprite::new(3, &sprite).unwrap();
        for (x, y) in (-5..9).flat_map(|x| (-5..9).map(move |y| (x, y))) {
            let mut picture = [PremultipliedRgba::TRANSPARENT; 35];
            sprite.draw(7, &mut picture, [x, y]).unwrap();
            for (k, pixel) in picture.iter().enumerate() {
                let (column, row) = (k as i32 % 7 - x, k as i32 / 7 - y);
                let inside = (0..3).contains(&column) && (0..2).contains(&row);
                assert_eq!(pixel.alpha(), if inside { 10 + (row * 3 + column) as u8 } else { 0 });
            }
        }
    }

    #[test]
    fn rows_must_be_whole() {
        let pixels = [PremultipliedRgba::<u8>::TRANSPARENT; 6];
        assert_eq!(Sprite::new(4, &pixels), Err(RowError { width: 4, pixels: 6 }));
        assert_eq!(Sprite::new(0, &pixels), Err(RowError { width: 0, pixels: 6 }));
        let far = Sprite::new(3, &pixels).unwrap().draw(2, &mut pixels.clone(), [i32::MIN, i32::MAX]);
        assert_eq!(far, Ok(()));
    }
}
