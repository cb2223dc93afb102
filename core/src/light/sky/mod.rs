//! What surrounds a scene, as an image.

mod density;
mod patches;
mod suns;

pub use patches::*;

use alloc::vec::Vec;
use core::f32::consts::{PI, TAU};
use core::fmt;

use glam::{Quat, Vec2, Vec3};

use self::density::Densities;
use crate::math;

/// Radiance that arrives from all directions: an image by longitude and latitude, as panoramas are (equirectangular).
///
/// The first row is at the top, around `+Y`; the middle of a row lies towards `-Z`, and to its right is `+X`. Each texel is
/// of one radiance.
#[derive(Clone, PartialEq)]
pub struct SkyImage {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// How the image is turned, of length 1.
    pub rotation: Quat,
    /// Row by row from the top, not negative; times [`Scene::sky`](crate::scene::Scene::sky) in cd/m2.
    texels: Vec<Vec3>,
    densities: Densities,
}

impl fmt::Debug for SkyImage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "SkyImage {{ {} x {}, rotation: {} }}", self.width, self.height, self.rotation)
    }
}

/// Why texels are no sky.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkyError {
    /// There is another number of them than columns times rows, or none.
    Count {
        /// Columns and rows.
        size: [u32; 2],
        /// How many there are.
        found: usize,
    },
    /// One is negative or not finite.
    Texel {
        /// Its column and row.
        at: [u32; 2],
    },
}

impl fmt::Display for SkyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count { size: [width, height], found } => {
                write!(
                    f,
                    "{found} texels for a sky of {width} x {height}; give it one for each place, and at least one"
                )
            }
            Self::Texel { at: [column, row] } => {
                write!(f, "the sky has a negative or infinite texel in column {column} of row {row}; mend the image")
            }
        }
    }
}

impl core::error::Error for SkyError {}

impl SkyImage {
    /// An image of relative radiances, row by row from the top.
    ///
    /// # Errors
    ///
    /// See [`SkyError`].
    pub fn new(width: u32, height: u32, texels: Vec<Vec3>) -> Result<Self, SkyError> {
        if texels.is_empty() || width as usize * height as usize != texels.len() {
            return Err(SkyError::Count { size: [width, height], found: texels.len() });
        }
        if let Some(index) = texels.iter().position(|texel| !(texel.is_finite() && texel.min_element() >= 0.0)) {
            return Err(SkyError::Texel { at: [index as u32 % width, index as u32 / width] });
        }
        let mut sky = Self { width, height, rotation: Quat::IDENTITY, texels, densities: Densities::default() };
        sky.densities = Densities::new(&sky);
        Ok(sky)
    }

    /// The image of what a function says of directions of length 1.
    ///
    /// # Errors
    ///
    /// See [`SkyError`].
    pub fn from_fn(width: u32, height: u32, radiance: impl Fn(Vec3) -> Vec3) -> Result<Self, SkyError> {
        let size = Vec2::new(width as f32, height as f32);
        let texel = |x: u32, y: u32| radiance(direction((Vec2::new(x as f32, y as f32) + 0.5) / size));
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| texel(x, y)).collect();
        Self::new(width, height, texels)
    }

    /// The same, turned: what lay in a direction lies where the rotation takes it.
    pub fn turned(self, rotation: Quat) -> Self {
        Self { rotation: rotation.normalize(), ..self }
    }

    /// Relative radiance from a direction of any length but 0.
    #[inline]
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        self.texels[self.texel(self.to_image(direction))]
    }

    /// A direction of length 1, by two numbers in `[0, 1)`, with the density of [`SkyImage::density`]; nothing of a black
    /// image.
    pub fn sample(&self, numbers: Vec2) -> Option<Vec3> {
        self.densities.sample(self, numbers).map(|direction| self.rotation * direction)
    }

    /// With which density [`SkyImage::sample`] gives a direction, in 1/sr: as its brightest channel is.
    #[inline]
    pub fn density(&self, direction: Vec3) -> f32 {
        self.radiance(direction).max_element() * self.densities.scale
    }

    fn to_image(&self, direction: Vec3) -> Vec3 {
        if self.rotation == Quat::IDENTITY { direction } else { self.rotation.inverse() * direction }
    }

    /// The texel of a direction of the image.
    fn texel(&self, direction: Vec3) -> usize {
        let size = Vec2::new(self.width as f32, self.height as f32);
        let place = (place(direction) * size).max(Vec2::ZERO).as_uvec2();
        let [x, y] = [place.x.min(self.width - 1), place.y.min(self.height - 1)];
        y as usize * self.width as usize + x as usize
    }

    /// Solid angle in sr of each texel of a row.
    fn solid_angle(&self, row: u32) -> f32 {
        let [top, bottom] = self.heights(row);
        (top - bottom) * TAU / self.width as f32
    }

    /// The cosines of the upper and of the lower border of a row to the zenith.
    fn heights(&self, row: u32) -> [f32; 2] {
        [row, row + 1].map(|border| math::cos(PI * border as f32 / self.height as f32))
    }
}

/// Where a direction lies in the image, in `[0, 1]`.
fn place(direction: Vec3) -> Vec2 {
    let across = math::sqrt(direction.x * direction.x + direction.z * direction.z);
    let longitude = math::atan2(direction.x, -direction.z);
    Vec2::new(0.5 + longitude / TAU, math::atan2(across, direction.y) / PI)
}

/// The direction of a place of the image.
fn direction(place: Vec2) -> Vec3 {
    at(TAU * (place.x - 0.5), math::cos(PI * place.y))
}

/// The direction of a longitude and a height.
fn at(longitude: f32, height: f32) -> Vec3 {
    let across = math::sqrt((1.0 - height * height).max(0.0));
    Vec3::new(across * math::sin(longitude), height, -across * math::cos(longitude))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sobol;

    /// Directions come back to the place that they are of, turned or not.
    #[test]
    fn places_and_directions_are_inverse() {
        for k in 0..500 {
            let place = Sobol::new(7).square(k);
            let found = super::place(direction(place));
            assert!((found - place).abs().max_element() < 2e-4, "{place} {found}");
        }
        let [right, top] = [Vec3::X, Vec3::Y].map(super::place);
        assert!((right - Vec2::new(0.75, 0.5)).abs().max_element() < 1e-6 && top.y < 1e-6);
        let red_right = |direction: Vec3| if direction.x > 0.0 { Vec3::X } else { Vec3::Z };
        let sky = SkyImage::from_fn(64, 32, red_right).unwrap().turned(Quat::from_rotation_y(1.0));
        let turned = Quat::from_rotation_y(1.0) * Vec3::X;
        assert_eq!((sky.radiance(turned * 3.0), sky.radiance(-turned)), (Vec3::X, Vec3::Z));
    }

    #[test]
    fn bad_texels_are_named() {
        assert_eq!(SkyImage::new(2, 2, alloc::vec![Vec3::ONE; 3]), Err(SkyError::Count { size: [2, 2], found: 3 }));
        assert_eq!(SkyImage::new(0, 2, Vec::new()), Err(SkyError::Count { size: [0, 2], found: 0 }));
        let texels = [1.0, 1.0, 1.0, f32::NAN].map(Vec3::splat).to_vec();
        assert_eq!(SkyImage::new(2, 2, texels), Err(SkyError::Texel { at: [1, 1] }));
    }
}
