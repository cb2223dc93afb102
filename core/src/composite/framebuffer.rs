//! A picture of pixels that remember depth: triangles in any order, transparent ones among them.

use core::ops::Range;

use glam::{Vec2, Vec4};

use super::{Fragment, PremultipliedRgba, RasterError, rasterize_rows};

/// What arrives in a pixel: a color at a depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// What it adds and blocks.
    pub color: PremultipliedRgba,
    /// Larger is nearer.
    pub depth: f32,
}

/// What a pixel remembers of the layers that arrived: [`DepthPixel`](super::DepthPixel) one, [`Layers`](super::Layers)
/// several.
pub trait Pixel: Clone + Send {
    /// Nothing has arrived.
    const EMPTY: Self;

    /// Takes in one more layer.
    fn add(&mut self, layer: Layer);

    /// All layers so far as one.
    fn color(&self) -> PremultipliedRgba;
}

/// Where in a pixel triangles are looked at: each place has a pixel of its own in the memory of a framebuffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Samples {
    /// In its center.
    #[default]
    One,
    /// In four places, none above or beside another: the pattern that graphics hardware has for MSAA 4x. Colors are
    /// computed in each.
    Four,
}

impl Samples {
    /// From the center of the pixel, x to the right and y down, in pixels.
    fn places(self) -> &'static [Vec2] {
        const FOUR: [Vec2; 4] =
            [Vec2::new(-0.125, -0.375), Vec2::new(0.375, -0.125), Vec2::new(-0.375, 0.125), Vec2::new(0.125, 0.375)];
        match self {
            Self::One => &[Vec2::ZERO],
            Self::Four => &FOUR,
        }
    }
}

/// A picture, or some of its rows, on memory of the caller.
///
/// ```
/// use glam::Vec4;
/// use radiosity::composite::{Framebuffer, Layers, Pixel, PremultipliedRgba, Samples, StraightRgba};
///
/// // Two triangles that cross, on a picture of 4 x 4 pixels with room for two layers in each.
/// let mut pixels = [const { Layers::<2>::EMPTY }; 16];
/// let mut picture = Framebuffer::new([4, 4], Samples::One, &mut pixels)?;
/// for (tilt, rgb) in [(0.1, [1.0, 0.0, 0.0]), (-0.1, [0.0, 0.0, 1.0])] {
///     let corner = |x, y| Vec4::new(x, y, 0.5 + tilt * x, 1.0);
///     let color = StraightRgba { rgb, alpha: 0.5 }.premultiplied();
///     picture.draw(&[corner(-1.0, -1.0), corner(3.0, -1.0), corner(-1.0, 3.0)], |_| color);
/// }
/// let mut shown = [PremultipliedRgba::TRANSPARENT; 16];
/// picture.resolve(&mut shown)?;
/// assert_eq!(shown[0].to_array(), [0.25, 0.0, 0.5, 0.75], "blue is nearer on the left");
/// assert_eq!(shown[3].to_array(), [0.5, 0.0, 0.25, 0.75], "red on the right");
/// # Ok::<(), radiosity::composite::RasterError>(())
/// ```
#[derive(Debug)]
pub struct Framebuffer<'a, P> {
    pub(super) size: [u32; 2],
    pub(super) samples: Samples,
    pub(super) rows: Range<u32>,
    /// Row by row; those of a pixel side by side.
    pub(super) pixels: &'a mut [P],
}

impl<'a, P: Pixel> Framebuffer<'a, P> {
    /// A picture on the memory of the caller: for each pixel as many entries as there are samples. It keeps what stands
    /// there; fill it with [`Pixel::EMPTY`] to start anew.
    ///
    /// # Errors
    ///
    /// Where the memory does not fit the size, or a side exceeds 32768.
    pub fn new(size: [u32; 2], samples: Samples, pixels: &'a mut [P]) -> Result<Self, RasterError> {
        RasterError::check(size, samples.places().len(), pixels.len())?;
        Ok(Self { size, samples, rows: 0..size[1], pixels })
    }

    /// Draws a triangle as [`rasterize`](super::rasterize) does; `shade` tells the color of each fragment, which joins the
    /// others of its pixel at its depth. A fragment's `pixel` counts through the whole picture.
    pub fn draw(&mut self, corners: &[Vec4; 3], mut shade: impl FnMut(&Fragment) -> PremultipliedRgba) {
        let before = (self.rows.start * self.size[0]) as usize;
        let places = self.samples.places();
        for (sample, place) in places.iter().enumerate() {
            let moved = corners.map(|corner| self.moved(corner, *place));
            rasterize_rows(self.size, self.rows.clone(), &moved, |fragment| {
                let color = shade(&fragment);
                let pixel = &mut self.pixels[(fragment.pixel - before) * places.len() + sample];
                pixel.add(Layer { color, depth: fragment.depth });
            });
        }
    }

    /// Writes the color of each pixel: the mean of its samples.
    ///
    /// # Errors
    ///
    /// Where `picture` does not have one entry for each pixel.
    pub fn resolve(&self, picture: &mut [PremultipliedRgba]) -> Result<(), RasterError> {
        let samples = self.samples.places().len();
        let pixels = self.pixels.len() / samples;
        if picture.len() != pixels {
            return Err(RasterError::Length { pixels, length: picture.len() });
        }
        for (color, pixels) in picture.iter_mut().zip(self.pixels.chunks_exact(samples)) {
            let sum: Vec4 = pixels.iter().map(|pixel| Vec4::from_array(pixel.color().to_array())).sum();
            *color = PremultipliedRgba::new((sum / samples as f32).to_array());
        }
        Ok(())
    }

    /// The corner such that what lies at a place in the pixel comes to its center.
    fn moved(&self, corner: Vec4, place: Vec2) -> Vec4 {
        let [x, y] = [-2.0 * place.x / self.size[0] as f32, 2.0 * place.y / self.size[1] as f32];
        corner + Vec4::new(x * corner.w, y * corner.w, 0.0, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::composite::{DepthPixel, Layers, StraightRgba};

    const SIZE: [u32; 2] = [16, 16];

    fn triangle([a, b, c]: [[f32; 2]; 3], z: f32) -> [Vec4; 3] {
        [a, b, c].map(|[x, y]| Vec4::new(x, y, z, 1.0))
    }

    fn shown(samples: Samples, triangles: &[([Vec4; 3], PremultipliedRgba)]) -> [PremultipliedRgba; 256] {
        let mut pixels = [const { Layers::<4>::EMPTY }; 1024];
        let count = 256 * samples.places().len();
        let mut picture = Framebuffer::new(SIZE, samples, &mut pixels[..count]).unwrap();
        triangles.iter().for_each(|(corners, color)| picture.draw(corners, |_| *color));
        let mut shown = [PremultipliedRgba::TRANSPARENT; 256];
        picture.resolve(&mut shown).unwrap();
        shown
    }

    /// A triangle with an edge at 45 degrees covers half of the pixels that the edge halves, and all of those within.
    #[test]
    fn edges_are_smooth() {
        let white = StraightRgba::opaque([1.0; 3]).premultiplied();
        let half = triangle([[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]], 0.5);
        let shown = shown(Samples::Four, &[(half, white)]);
        for (k, color) in shown.iter().enumerate() {
            let expected = match (k % 16).cmp(&(k / 16)) {
                core::cmp::Ordering::Less => 1.0,
                core::cmp::Ordering::Equal => 0.5,
                core::cmp::Ordering::Greater => 0.0,
            };
            assert_eq!(color.alpha(), expected, "{k}");
        }
    }

    /// Triangles that share an edge leave no seam, with samples neither.
    #[test]
    fn no_seams() {
        let gray = PremultipliedRgba::new([0.2, 0.2, 0.2, 0.4]);
        let halves = [[[-1.0, -1.0], [1.0, -1.0], [-0.7, 1.0]], [[-0.7, 1.0], [1.0, -1.0], [1.0, 1.0]]];
        let edge = [[-1.0, -1.0], [-0.7, 1.0], [-1.0, 1.0]];
        let triangles = [halves[0], halves[1], edge].map(|corners| (triangle(corners, 0.3), gray));
        for samples in [Samples::One, Samples::Four] {
            assert_eq!(shown(samples, &triangles), [gray; 256]);
        }
    }

    #[test]
    fn memory_must_fit() {
        let mut pixels = [DepthPixel::EMPTY; 6];
        let too_short = RasterError::Length { pixels: 24, length: 6 };
        assert_eq!(Framebuffer::new([3, 2], Samples::Four, &mut pixels).err(), Some(too_short));
        let picture = Framebuffer::new([3, 2], Samples::One, &mut pixels).unwrap();
        let length = RasterError::Length { pixels: 6, length: 5 };
        assert_eq!(picture.resolve(&mut [PremultipliedRgba::TRANSPARENT; 5]), Err(length));
        let too_large = RasterError::TooLarge { size: [40_000, 1] };
        assert_eq!(Framebuffer::new([40_000, 1], Samples::One, &mut pixels).err(), Some(too_large));
    }
}
