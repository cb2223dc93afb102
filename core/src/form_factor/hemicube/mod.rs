//! The hemicube: all that a point sees, drawn on half a cube around it.
//!
//! Cohen and Greenberg, "The Hemi-Cube: A Radiosity Solution for Complex Environments", 1985. The top has `N x N`
//! pixels, each of the four sides `N x N/2`. An item buffer keeps for each pixel which patch is nearest there; the
//! form factor of a patch is the sum of the delta form factors of its pixels.
//!
//! The error falls with the resolution. Relative to the form factors of 60 parallelograms of any position, each in three
//! turns of the cube, it is
//!
//! | `N` | rms | worst | mean of the bound that a row tells | pixels |
//! |---|---|---|---|---|
//! | 16 | 9 % | 46 % | 90 % | 768 |
//! | 32 | 4 % | 37 % | 43 % | 3 072 |
//! | 64 | 1.1 % | 5 % | 21 % | 12 288 |
//! | 128 | 0.36 % | 2.2 % | 10 % | 49 152 |
//! | 256 | 0.19 % | 1.9 % | 5 % | 196 608 |
//! | 512 | 0.05 % | 0.3 % | 2.6 % | 786 432 |
//!
//! The worst ones are small, of which the error of a few pixels is a large share: a hemicube aliases. Means over points
//! and turns do not.

mod delta;
mod rows;

use core::fmt;
use core::ops::Range;

use glam::{Vec3, Vec4};

use super::{Bins, Estimate};
use crate::composite::DepthBuffer;
use crate::geometry::tangents;
use crate::math::{Real, sin_cos};
use delta::fill_deltas;

/// In the item buffer: nothing is seen in this pixel.
pub const SKY: u32 = u32::MAX;

/// In the item buffer: the back of a patch is seen in this pixel; it blocks and receives nothing.
pub const VOID: u32 = u32::MAX - 1;

/// Distance of the near plane, in the unit of the coordinates: what lies nearer is not seen.
const NEAR: f32 = 1e-12;

/// How many pixels a hemicube has.
pub const fn hemicube_pixels(resolution: usize) -> usize {
    3 * resolution * resolution
}

/// How many delta form factors there are that differ for symmetry alone: a quarter of the top and half of a side.
pub const fn hemicube_deltas(resolution: usize) -> usize {
    resolution * resolution / 2
}

/// The memory of a hemicube.
#[derive(Debug)]
pub struct HemicubeBuffers<'a> {
    /// [`hemicube_pixels`] patches.
    pub items: &'a mut [u32],
    /// [`hemicube_pixels`] depths.
    pub depths: &'a mut [f32],
    /// [`hemicube_deltas`] delta form factors.
    pub deltas: &'a mut [f64],
}

/// Half a cube around a point, with what is nearest in each of its pixels.
#[derive(Debug)]
pub struct Hemicube<'a> {
    resolution: usize,
    buffers: HemicubeBuffers<'a>,
    /// Tangent, bitangent and normal of the point.
    frame: [Vec3; 3],
}

/// A hemicube that cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HemicubeError {
    /// The resolution is odd, zero, or above 32768.
    Resolution(usize),
    /// A buffer does not have the length that the resolution asks for.
    Length {
        /// What [`hemicube_pixels`] or [`hemicube_deltas`] tell.
        expected: usize,
        /// What was given.
        length: usize,
    },
}

impl fmt::Display for HemicubeError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Resolution(resolution) => {
                write!(f, "a hemicube of resolution {resolution}; give it an even number from 2 to 32768")
            }
            Self::Length { expected, length } => {
                write!(
                    f,
                    "a buffer of {length} entries for a hemicube that needs {expected}; see hemicube_pixels and hemicube_deltas"
                )
            }
        }
    }
}

impl core::error::Error for HemicubeError {}

impl<'a> Hemicube<'a> {
    /// A hemicube of `resolution` pixels a side on the memory of the caller, with its delta form factors.
    ///
    /// # Errors
    ///
    /// Where the resolution is odd, zero or above 32768, or a buffer does not fit it.
    pub fn new(resolution: usize, buffers: HemicubeBuffers<'a>) -> Result<Self, HemicubeError> {
        if resolution == 0 || !resolution.is_multiple_of(2) || resolution > 1 << 15 {
            return Err(HemicubeError::Resolution(resolution));
        }
        let pixels = hemicube_pixels(resolution);
        let HemicubeBuffers { items, depths, deltas } = &buffers;
        for (expected, length) in
            [(pixels, items.len()), (pixels, depths.len()), (hemicube_deltas(resolution), deltas.len())]
        {
            if expected != length {
                return Err(HemicubeError::Length { expected, length });
            }
        }
        fill_deltas(resolution / 2, buffers.deltas);
        let mut hemicube = Self { resolution, buffers, frame: [Vec3::X, Vec3::Y, Vec3::Z] };
        hemicube.place(Vec3::Z, 0.0);
        Ok(hemicube)
    }

    /// Starts anew around a point whose normal has length 1, with the cube turned about it by an angle in radians.
    pub fn place(&mut self, normal: Vec3, turn: f32) {
        let (tangent, bitangent) = tangents(normal);
        let (sin, cos) = sin_cos(turn);
        self.frame = [tangent * cos + bitangent * sin, bitangent * cos - tangent * sin, normal];
        self.buffers.items.fill(SKY);
        self.buffers.depths.fill(0.0);
    }

    /// Draws a triangle, given by its corners relative to the point. Of what is nearest a pixel keeps the item; at the
    /// same depth what was drawn first stays.
    pub fn draw(&mut self, corners: &[Vec3; 3], item: u32) {
        let n = self.resolution;
        let local = corners.map(|corner| Vec3::from_array(self.frame.map(|axis| corner.dot(axis))));
        for face in 0..5 {
            let (size, pixels) = face_pixels(n, face);
            let items = &mut self.buffers.items[pixels.clone()];
            let Ok(mut depths) = DepthBuffer::new(size, &mut self.buffers.depths[pixels]) else { continue };
            depths.draw(&local.map(|corner| project(corner, face)), |fragment| items[fragment.pixel] = item);
        }
    }

    /// Which patch is seen in a pixel, or [`SKY`] or [`VOID`]: first the top row by row, then the sides one by one.
    pub fn items(&self) -> &[u32] {
        self.buffers.items
    }

    /// The form factor from the point to what is seen in this pixel: the integral of `cos / pi` over the solid angle of
    /// the pixel. All of them are multiples of `2^-52` and sum to exactly 1.
    pub fn delta(&self, pixel: usize) -> f64 {
        let (n, half) = (self.resolution, self.resolution / 2);
        let column = pixel % n;
        let from_center = if column < half { half - 1 - column } else { column - half };
        self.buffers.deltas[self.delta_row(pixel / n) * half + from_center]
    }

    /// The form factors of all patches, and what is left of one. Items beyond the row belong to the void.
    ///
    /// In double precision row and bins sum to exactly 1. The error is half the delta form factors of all pixels along
    /// the silhouette of the patch, inside and outside, which bounds that of straight edges, and one pixel on top for
    /// what falls between the centers. Parts of a patch that are thinner than a pixel can exceed it.
    pub fn row<R: Real>(&self, row: &mut [Estimate<R>]) -> Bins<R> {
        let mut bins = Bins::default();
        row.fill(Estimate { value: R::ZERO, error: R::from_f64(self.largest_delta()) });
        self.add_to(row, &mut bins, R::ONE);
        self.for_each_silhouette(&mut |item, delta| {
            if let Some(entry) = row.get_mut(item as usize) {
                entry.error += R::from_f64(0.5 * delta);
            }
        });
        bins
    }

    /// Adds a share of the form factors to a row.
    fn add_to<R: Real>(&self, row: &mut [Estimate<R>], bins: &mut Bins<R>, share: R) {
        self.for_each_run(&mut |item, sum| {
            let sum = R::from_f64(sum) * share;
            match (item, row.get_mut(item as usize)) {
                (_, Some(entry)) => entry.value += sum,
                (SKY, None) => bins.sky += sum,
                (_, None) => bins.void += sum,
            }
        });
    }

    /// Calls `run` with the item and the sum of the delta form factors of each run of pixels of a row that show the same.
    fn for_each_run(&self, run: &mut dyn FnMut(u32, f64)) {
        let (n, half) = (self.resolution, self.resolution / 2);
        for (row, items) in self.buffers.items.chunks_exact(n).enumerate() {
            let start = self.delta_row(row) * half;
            let deltas = &self.buffers.deltas[start..start + half];
            let (mut item, mut sum) = (items[0], 0.0);
            for (&next, delta) in items.iter().zip(deltas.iter().rev().chain(deltas)) {
                if next != item {
                    run(item, sum);
                    (item, sum) = (next, 0.0);
                }
                sum += delta;
            }
            run(item, sum);
        }
    }

    /// Which row of the delta form factors belongs to a row of pixels, counted through all faces.
    fn delta_row(&self, row: usize) -> usize {
        let half = self.resolution / 2;
        match row {
            row if row < half => half - 1 - row,
            row if row < 2 * half => row - half,
            row => half + row % half,
        }
    }

    /// That of the pixels around the normal.
    fn largest_delta(&self) -> f64 {
        self.buffers.deltas[0]
    }

    /// Calls `silhouette` with an item and a delta form factor for each pixel through which its silhouette may run: where
    /// a neighbor shows another item, once with each that is seen there.
    fn for_each_silhouette(&self, silhouette: &mut dyn FnMut(u32, f64)) {
        for (pixel, &item) in self.buffers.items.iter().enumerate() {
            let others = self.neighbors(pixel).map(|other| other.map_or(item, |other| self.buffers.items[other]));
            if others == [item; 4] {
                continue;
            }
            let delta = self.delta(pixel);
            silhouette(item, delta);
            for (k, &other) in others.iter().enumerate() {
                if other != item && !others[..k].contains(&other) {
                    silhouette(other, delta);
                }
            }
        }
    }

    /// The pixels above, below, to the left and to the right, across the edges of the cube too; nothing lies below the
    /// horizon.
    fn neighbors(&self, pixel: usize) -> [Option<usize>; 4] {
        let last = self.resolution - 1;
        let Place { face, row, column } = self.place_of(pixel);
        let at = |face, row, column| Some(self.pixel_at(Place { face, row, column }));
        if face == 0 {
            return [
                if row > 0 { Some(pixel - self.resolution) } else { at(4, 0, column) },
                if row < last { Some(pixel + self.resolution) } else { at(2, 0, last - column) },
                if column > 0 { Some(pixel - 1) } else { at(3, 0, last - row) },
                if column < last { Some(pixel + 1) } else { at(1, 0, row) },
            ];
        }
        let above = [at(0, column, last), at(0, last, last - column), at(0, last - column, 0), at(0, 0, column)];
        [
            if row > 0 { Some(pixel - self.resolution) } else { above[face - 1] },
            (row < last / 2).then(|| pixel + self.resolution),
            if column > 0 { Some(pixel - 1) } else { at((face + 2) % 4 + 1, row, last) },
            if column < last { Some(pixel + 1) } else { at(face % 4 + 1, row, 0) },
        ]
    }

    fn place_of(&self, pixel: usize) -> Place {
        let n = self.resolution;
        let (face, inside) = match pixel.checked_sub(n * n) {
            None => (0, pixel),
            Some(beyond) => (1 + beyond / (n * n / 2), beyond % (n * n / 2)),
        };
        Place { face, row: inside / n, column: inside % n }
    }

    fn pixel_at(&self, place: Place) -> usize {
        face_pixels(self.resolution, place.face).1.start + place.row * self.resolution + place.column
    }
}

/// A pixel: the top is face 0, the sides are 1 to 4, each to the right of the one before.
struct Place {
    face: usize,
    row: usize,
    column: usize,
}

/// Width and height of a face, and where its pixels lie in the buffers.
fn face_pixels(n: usize, face: usize) -> ([u32; 2], Range<usize>) {
    match face.checked_sub(1) {
        None => ([n as u32; 2], 0..n * n),
        Some(side) => {
            let start = n * n + side * n * n / 2;
            ([n as u32, n as u32 / 2], start..start + n * n / 2)
        }
    }
}

/// A corner in the frame of the point to the clip space of a face; of the sides only the half above the horizon is seen.
fn project(corner: Vec3, face: usize) -> Vec4 {
    let Vec3 { x, y, z } = corner;
    let (right, ahead) = match face {
        0 => return Vec4::new(x, y, NEAR, z),
        1 => (-y, x),
        2 => (-x, -y),
        3 => (y, -x),
        _ => (x, y),
    };
    Vec4::new(right, 2.0 * z - ahead, NEAR, ahead)
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: usize = 16;

    fn with_hemicube(test: impl FnOnce(&mut Hemicube)) {
        let (mut items, mut depths) = ([0; hemicube_pixels(N)], [0.0; hemicube_pixels(N)]);
        let mut deltas = [0.0; hemicube_deltas(N)];
        let buffers = HemicubeBuffers { items: &mut items, depths: &mut depths, deltas: &mut deltas };
        test(&mut Hemicube::new(N, buffers).unwrap());
    }

    /// The direction from the point through the center of a pixel.
    fn direction(hemicube: &Hemicube, pixel: usize) -> Vec3 {
        let Place { face, row, column } = hemicube.place_of(pixel);
        let [right, down] = [column, row].map(|index| (index as f32 + 0.5) * 2.0 / N as f32 - 1.0);
        let local = match face {
            0 => Vec3::new(right, -down, 1.0),
            1 => Vec3::new(1.0, -right, -down),
            2 => Vec3::new(-right, -1.0, -down),
            3 => Vec3::new(-1.0, right, -down),
            _ => Vec3::new(right, 1.0, -down),
        };
        let local = if face == 0 { local } else { Vec3::new(local.x, local.y, -down) };
        hemicube.frame[0] * local.x + hemicube.frame[1] * local.y + hemicube.frame[2] * local.z
    }

    /// Each pixel shows what lies in its direction: one triangle after the other around it.
    #[test]
    fn pixels_look_where_they_should() {
        with_hemicube(|hemicube| {
            let normal = Vec3::new(0.48, -0.6, 0.64);
            for pixel in 0..hemicube_pixels(N) {
                hemicube.place(normal, 0.3);
                let ahead = direction(hemicube, pixel);
                let (a, b) = tangents(ahead.normalize());
                hemicube.draw(&[a, b, -a - b].map(|side| ahead + side * 1e-3), 7);
                let seen = hemicube.items().iter().position(|&item| item == 7);
                assert_eq!(seen, Some(pixel));
                assert_eq!(hemicube.items().iter().filter(|&&item| item == 7).count(), 1);
            }
        });
    }

    /// Neighbors look in nearly the same direction, and are neighbors of each other.
    #[test]
    fn neighbors_are_near_and_mutual() {
        with_hemicube(|hemicube| {
            let ahead = |pixel| direction(hemicube, pixel).normalize();
            for pixel in 0..hemicube_pixels(N) {
                for neighbor in hemicube.neighbors(pixel).into_iter().flatten() {
                    assert!(ahead(pixel).distance(ahead(neighbor)) < 2.3 / N as f32, "{pixel} {neighbor}");
                    assert!(hemicube.neighbors(neighbor).contains(&Some(pixel)), "{pixel} {neighbor}");
                }
            }
        });
    }

    /// A triangle that holds the whole sky: all items are its own, the sum is exactly 1, and there is no silhouette.
    #[test]
    fn a_lid_over_everything() {
        with_hemicube(|hemicube| {
            hemicube.place(Vec3::Z, 0.2);
            let rim = [Vec3::new(-2e6, -1e6, -1.0), Vec3::new(2e6, -1e6, -1.0), Vec3::new(0.0, 2e6, -1.0)];
            for k in 0..3 {
                hemicube.draw(&[rim[k], rim[(k + 1) % 3], Vec3::Z], 1);
            }
            let mut row = [Estimate::default(); 2];
            let bins = hemicube.row::<f64>(&mut row);
            assert_eq!((row[1].value, bins), (1.0, Bins::default()));
            assert_eq!(row[1].error, hemicube.largest_delta());
        });
    }

    #[test]
    fn memory_must_fit() {
        let mut items = [0; 12];
        let buffers = HemicubeBuffers { items: &mut items, depths: &mut [], deltas: &mut [] };
        assert_eq!(Hemicube::new(2, buffers).err(), Some(HemicubeError::Length { expected: 12, length: 0 }));
        let buffers = HemicubeBuffers { items: &mut [], depths: &mut [], deltas: &mut [] };
        assert_eq!(Hemicube::new(7, buffers).err(), Some(HemicubeError::Resolution(7)));
    }
}
