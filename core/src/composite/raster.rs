//! Triangles to pixels, with a depth buffer: what a target without a GPU sees.
//!
//! The hemicube of [`form_factor`](crate::form_factor) draws with it. The preview of a bake does not: the rays of the bake
//! are there already, and need neither clipping nor a buffer.

use core::fmt;
use core::ops::Range;

use glam::{DVec3, Vec2, Vec3, Vec4};
use heapless::Vec;

use crate::math;

/// The longest side of a picture.
const LONGEST: u32 = 1 << 15;

/// Steps of the fixed-point coordinates within a pixel.
const STEPS: i64 = 256;

/// A triangle, cut by the six sides of what can be seen.
type Outline<T> = Vec<T, 9>;

/// What of a triangle stands in the center of one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// Row times width plus column; row 0 is on top.
    pub pixel: usize,
    /// `z / w`: 1 at the near plane, 0 at the far plane, and larger is nearer.
    pub depth: f32,
    /// Barycentric coordinates of the point on the triangle in space, with perspective; they sum to one.
    pub weights: Vec3,
}

/// Calls `fragment` for each pixel whose center lies in a triangle.
///
/// `size` is the width and height of the picture, each at most 32768; larger ones stay empty. The corners are in clip space as Bevy and wgpu
/// have it, with reversed depth: what is seen has `-w <= x <= w`, `-w <= y <= w` (y up) and `0 <= z <= w`; the rest is
/// cut off. Both orientations are drawn. Triangles that share two corners share the pixels along that edge out: each
/// center belongs to exactly one of them, and one on the edge itself to the triangle below or to the right of it. To that
/// end coordinates are rounded to 1/256 of a pixel. Triangles seen edge-on or with corners that are not finite are not
/// drawn.
///
/// Clipping of Sutherland and Hodgman 1974; interpolation without any division at the corners, Olano and Greer,
/// "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997.
#[inline]
pub fn rasterize(size: [u32; 2], corners: &[Vec4; 3], fragment: impl FnMut(Fragment)) {
    rasterize_rows(size, 0..size[1], corners, fragment);
}

/// The same for some rows of the picture alone.
#[inline]
pub fn rasterize_rows(size: [u32; 2], wanted: Range<u32>, corners: &[Vec4; 3], mut fragment: impl FnMut(Fragment)) {
    let Some(planes) = Planes::new(size, corners) else { return };
    let outline = snap(size, &clip(corners));
    let covered = rows(&outline);
    for row in covered.start.max(wanted.start.into())..covered.end.min(wanted.end.into()) {
        let (first, end) = span(&outline, row);
        let values = planes.row(row);
        for column in first..end {
            let (depth, weights) = values.at(column);
            fragment(Fragment { pixel: row as usize * size[0] as usize + column as usize, depth, weights });
        }
    }
}

/// The depth of what is nearest so far in each pixel of a picture.
#[derive(Debug)]
pub struct DepthBuffer<'a> {
    size: [u32; 2],
    depths: &'a mut [f32],
}

/// A picture whose memory does not fit it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RasterError {
    /// A side is longer than 32768 pixels.
    TooLarge {
        /// Width and height.
        size: [u32; 2],
    },
    /// The memory does not have one entry for each pixel, or for each sample of each pixel.
    Length {
        /// Width times height, times samples.
        pixels: usize,
        /// What was given.
        length: usize,
    },
}

impl fmt::Display for RasterError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::TooLarge { size: [width, height] } => {
                write!(f, "a picture of {width} x {height} pixels; at most 32768 a side, draw it in tiles")
            }
            Self::Length { pixels, length } => {
                write!(f, "memory of {length} entries for {pixels} pixels or samples; give it one for each")
            }
        }
    }
}

impl core::error::Error for RasterError {}

impl RasterError {
    /// Whether memory of so many entries fits a picture with so many for each pixel.
    pub(super) fn check(size: [u32; 2], samples: usize, length: usize) -> Result<(), Self> {
        if size.iter().any(|&side| side > LONGEST) {
            return Err(Self::TooLarge { size });
        }
        let pixels = size[0] as usize * size[1] as usize * samples;
        if length == pixels { Ok(()) } else { Err(Self::Length { pixels, length }) }
    }
}

impl<'a> DepthBuffer<'a> {
    /// A buffer on the memory of the caller, one entry for each pixel, row by row. It keeps the depths that stand there:
    /// [`DepthBuffer::clear`] starts a new picture.
    ///
    /// # Errors
    ///
    /// Where `depths` is not as long as `size` tells, or a side exceeds 32768.
    pub fn new(size: [u32; 2], depths: &'a mut [f32]) -> Result<Self, RasterError> {
        RasterError::check(size, 1, depths.len())?;
        Ok(Self { size, depths })
    }

    /// Puts the far plane into every pixel.
    pub fn clear(&mut self) {
        self.depths.fill(0.0);
    }

    /// Draws a triangle as [`rasterize`] does and calls `nearer` for the fragments in front of all before them. At the
    /// same depth what came first stays.
    #[inline]
    pub fn draw(&mut self, corners: &[Vec4; 3], mut nearer: impl FnMut(Fragment)) {
        rasterize(self.size, corners, |fragment| {
            if fragment.depth > self.depths[fragment.pixel] {
                self.depths[fragment.pixel] = fragment.depth;
                nearer(fragment);
            }
        });
    }
}

/// The part of a triangle inside the view; fewer than three corners where there is none.
fn clip(corners: &[Vec4; 3]) -> Outline<Vec4> {
    let heights: [fn(Vec4) -> f32; 6] =
        [|p| p.w - p.x, |p| p.w + p.x, |p| p.w - p.y, |p| p.w + p.y, |p| p.w - p.z, |p| p.z];
    let mut outline = Outline::new();
    corners.iter().for_each(|&corner| push(&mut outline, corner));
    for height in heights {
        if !outline.iter().all(|&corner| height(corner) >= 0.0) {
            outline = cut(&outline, height);
        }
    }
    outline
}

/// Keeps what has no negative height. A cut point depends on the edge alone, not on which way it is run through, so that
/// neighbors agree on it.
fn cut(outline: &Outline<Vec4>, height: fn(Vec4) -> f32) -> Outline<Vec4> {
    let mut kept = Outline::new();
    for (i, &a) in outline.iter().enumerate() {
        let b = outline[(i + 1) % outline.len()];
        let (height_a, height_b) = (height(a), height(b));
        if height_a >= 0.0 {
            push(&mut kept, a);
        }
        match (height_a >= 0.0, height_b >= 0.0) {
            (true, false) => push(&mut kept, a + (b - a) * (height_a / (height_a - height_b))),
            (false, true) => push(&mut kept, b + (a - b) * (height_b / (height_b - height_a))),
            _ => {}
        }
    }
    kept
}

/// Each of the six cuts of a triangle adds one corner at most; what rounding might add to that is dropped.
fn push<T>(outline: &mut Outline<T>, corner: T) {
    let _ = outline.push(corner);
}

/// Corners in steps from the upper left corner of the picture, y down.
fn snap(size: [u32; 2], outline: &Outline<Vec4>) -> Outline<[i64; 2]> {
    let half = Vec2::new(size[0] as f32, -(size[1] as f32)) * 0.5;
    let [right, bottom] = size.map(|side| i64::from(side) * STEPS);
    let place = |corner: &Vec4| {
        let screen = (corner.truncate().truncate() / corner.w * half + half.abs()) * STEPS as f32;
        [(math::round(screen.x) as i64).clamp(0, right), (math::round(screen.y) as i64).clamp(0, bottom)]
    };
    outline.iter().map(place).collect()
}

/// The rows whose centers lie between the highest and the lowest corner.
fn rows(outline: &Outline<[i64; 2]>) -> Range<i64> {
    let low = outline.iter().map(|corner| corner[1]).min().unwrap_or(0);
    let high = outline.iter().map(|corner| corner[1]).max().unwrap_or(0);
    first_center(low, 1)..first_center(high, 1)
}

/// The columns whose centers lie inside, the last one excluded: between the leftmost and the rightmost edge.
fn span(outline: &Outline<[i64; 2]>, row: i64) -> (i64, i64) {
    let y = row * STEPS + STEPS / 2;
    let (mut first, mut end) = (i64::MAX, 0);
    for (i, &from) in outline.iter().enumerate() {
        let to = outline[(i + 1) % outline.len()];
        let ([x, above], [far, below]) = if from[1] <= to[1] { (from, to) } else { (to, from) };
        if above <= y && y < below {
            let height = below - above;
            let column = first_center(x * height + (y - above) * (far - x), height);
            first = first.min(column);
            end = end.max(column);
        }
    }
    (first, end)
}

/// The first pixel whose center is at or beyond `numerator / denominator` steps.
fn first_center(numerator: i64, denominator: i64) -> i64 {
    let beyond = numerator - STEPS / 2 * denominator;
    -(-beyond).div_euclid(STEPS * denominator)
}

/// What is linear on the screen: each barycentric coordinate over `w`, and the depth.
struct Planes {
    /// Change along a row, along a column, and the value in the center of the first pixel.
    planes: [DVec3; 4],
    /// Least and greatest depth of the corners that are seen: rounding leads no fragment out of its triangle.
    range: [f32; 2],
}

/// [`Planes`] in one row: values at its start and slopes.
struct RowValues {
    start: [f32; 4],
    slope: [f32; 4],
    range: [f32; 2],
}

impl Planes {
    /// The planes take the value 1 in one corner and 0 in the two others when multiplied by `w`: the rows of the inverse
    /// of the matrix whose columns are the corners `(x, y, w)`.
    fn new(size: [u32; 2], corners: &[Vec4; 3]) -> Option<Self> {
        if size.iter().any(|&side| side > LONGEST) || corners.iter().any(|corner| !corner.is_finite()) {
            return None;
        }
        let [a, b, c] = corners.map(|corner| Vec3::new(corner.x, corner.y, corner.w).as_dvec3());
        let determinant = a.dot(b.cross(c));
        if determinant == 0.0 || !determinant.is_finite() {
            return None;
        }
        let [e, f, g] = [b.cross(c), c.cross(a), a.cross(b)].map(|edge| edge / determinant);
        let [z, y, x] = [corners[0].z, corners[1].z, corners[2].z].map(f64::from);
        let (right, down) = (2.0 / f64::from(size[0]), -2.0 / f64::from(size[1]));
        let to_pixels = |plane: DVec3| {
            let at_first = plane.x * (0.5 * right - 1.0) + plane.y * (0.5 * down + 1.0) + plane.z;
            DVec3::new(plane.x * right, plane.y * down, at_first)
        };
        Some(Self { planes: [e, f, g, e * z + f * y + g * x].map(to_pixels), range: depth_range(corners) })
    }

    fn row(&self, row: i64) -> RowValues {
        RowValues {
            start: self.planes.map(|plane| (plane.z + plane.y * row as f64) as f32),
            slope: self.planes.map(|plane| plane.x as f32),
            range: self.range,
        }
    }
}

impl RowValues {
    #[inline]
    fn at(&self, column: i64) -> (f32, Vec3) {
        let [a, b, c, depth] = core::array::from_fn(|k| self.start[k] + self.slope[k] * column as f32);
        (depth.clamp(self.range[0], self.range[1]), Vec3::new(a, b, c) / (a + b + c))
    }
}

/// Least and greatest depth of a triangle, each in `[0, 1]`; a corner behind the eye says nothing.
fn depth_range(corners: &[Vec4; 3]) -> [f32; 2] {
    if corners.iter().any(|corner| corner.w <= 0.0) {
        return [0.0, 1.0];
    }
    let depths = corners.map(|corner| (corner.z / corner.w).clamp(0.0, 1.0));
    [depths[0].min(depths[1]).min(depths[2]), depths[0].max(depths[1]).max(depths[2])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sobol;

    const SIZE: [u32; 2] = [96, 64];
    const PIXELS: usize = 96 * 64;

    fn counts(triangles: &[[Vec4; 3]]) -> [u32; PIXELS] {
        let mut counts = [0; PIXELS];
        triangles.iter().for_each(|corners| rasterize(SIZE, corners, |fragment| counts[fragment.pixel] += 1));
        counts
    }

    fn at(x: f32, y: f32) -> Vec4 {
        Vec4::new(x, y, 0.5, 1.0)
    }

    /// What an eye at the origin that looks along -z sees, from 0.1 on.
    fn project(p: Vec3) -> Vec4 {
        Vec4::new(p.x, p.y, 0.1, -p.z)
    }

    /// A fan around any point covers each pixel of the picture once, with spokes through centers of pixels too, and
    /// with rims far outside, behind the eye even.
    #[test]
    fn shared_edges_leave_neither_gap_nor_overlap() {
        for trial in 0..64 {
            let [x, y] = Sobol::new(7).square(trial).to_array();
            let step = |t: f32, side: u32| math::round(t * side as f32 * 2.0) / side as f32 - 1.0;
            let center = if trial % 2 == 0 { at(2.0 * x - 1.0, 2.0 * y - 1.0) } else { at(step(x, 96), step(y, 64)) };
            let rim = |k: usize| {
                let (sin, cos) = math::sin_cos((k % 7) as f32 * core::f32::consts::TAU / 7.0 + 0.1 * trial as f32);
                center + Vec4::new(40.0 * cos, 40.0 * sin, 0.0, 0.2 * (k % 7 % 3) as f32)
            };
            let fan: [_; 7] = core::array::from_fn(|k| [center, rim(k), rim(k + 1)]);
            assert!(counts(&fan).iter().all(|&count| count == 1), "trial {trial}");
        }
    }

    /// An endless floor of triangles reaches from behind the eye to the horizon: each pixel below it is hit once.
    #[test]
    fn a_floor_under_the_eye() {
        let corner = |i: i32, k: i32| project(Vec3::new(i as f32 * 60.0 - 3000.0, -1.0, k as f32 * 60.0 - 3000.0));
        let mut counts = [0; PIXELS];
        for (i, k) in (0..100).flat_map(|i| (0..100).map(move |k| (i, k))) {
            let [a, b, c, d] = [corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1)];
            rasterize(SIZE, &[a, b, c], |fragment| counts[fragment.pixel] += 1);
            rasterize(SIZE, &[a, c, d], |fragment| counts[fragment.pixel] += 1);
        }
        let rows = |range: Range<usize>| &counts[range.start * 96..range.end * 96];
        assert!(rows(0..32).iter().all(|&count| count == 0));
        assert!(rows(33..64).iter().all(|&count| count == 1));
    }

    #[test]
    fn pixels_count_the_area() {
        let triangle = [at(-0.83, -0.61), at(0.77, -0.4), at(0.1, 0.93)];
        let edges = [triangle[1] - triangle[0], triangle[2] - triangle[0]];
        let area = 0.5 * (edges[0].x * edges[1].y - edges[0].y * edges[1].x) * PIXELS as f32 / 4.0;
        let pixels: u32 = counts(&[triangle]).iter().sum();
        assert!((pixels as f32 - area).abs() < 0.01 * area, "{pixels} {area}");
        let [a, b, c] = triangle;
        assert_eq!(counts(&[triangle]), counts(&[[a, c, b]]), "both orientations");
    }

    /// Position and depth of a fragment are those of the point that its weights tell, cut off by the near plane or not.
    #[test]
    fn interpolation_has_perspective() {
        for front in [-0.3, 0.5] {
            let space = [Vec3::new(-0.2, -0.1, front), Vec3::new(4.0, -1.0, -6.0), Vec3::new(0.5, 3.0, -4.0)];
            let mut seen = 0;
            rasterize(SIZE, &space.map(project), |Fragment { pixel, depth, weights }| {
                let point = space[0] * weights.x + space[1] * weights.y + space[2] * weights.z;
                let (column, row) = ((pixel % 96) as f32 + 0.5, (pixel / 96) as f32 + 0.5);
                let screen = Vec2::new(column / 48.0 - 1.0, 1.0 - row / 32.0);
                assert!((point.truncate() / -point.z - screen).length() < 1e-4);
                assert!((depth + 0.1 / point.z).abs() < 1e-5 && point.z <= -0.0999, "{depth} {point}");
                seen += 1;
            });
            assert!(seen > 100, "{seen}");
        }
    }

    /// Two panes cross: in any order of arrival each pixel shows the one that is nearer there.
    #[test]
    fn the_nearer_one_wins() {
        let pane =
            |tilt: f32| [(-1.0, -1.0), (3.0, -1.0), (-1.0, 3.0)].map(|(x, y)| Vec4::new(x, y, 0.5 + tilt * x, 1.0));
        let panes = [pane(0.1), pane(-0.1), pane(0.0).map(|corner| corner - Vec4::Z * 0.2)];
        for order in [[0, 1, 2], [2, 0, 1], [1, 2, 0], [2, 1, 0]] {
            let (mut depths, mut shown) = ([0.0; PIXELS], [usize::MAX; PIXELS]);
            let mut buffer = DepthBuffer::new(SIZE, &mut depths).unwrap();
            buffer.clear();
            for index in order {
                buffer.draw(&panes[index], |fragment| shown[fragment.pixel] = index);
            }
            shown.iter().enumerate().for_each(|(pixel, &index)| assert_eq!(index, usize::from(pixel % 96 < 48)));
        }
    }

    #[test]
    fn nothing_outside_and_nothing_broken() {
        let nan = Vec4::new(f32::NAN, 0.0, 0.5, 1.0);
        let deep = Vec4::new(0.2, 0.3, f32::NAN, 1.0);
        let broken = [
            [nan; 3],
            [at(0.0, 0.0), at(1.0, 0.0), nan],
            [at(0.0, 0.0), at(1.0, 0.0), deep],
            [Vec4::splat(f32::INFINITY), at(1.0, 0.0), at(0.0, 1.0)],
        ];
        let outside =
            [[at(1.1, 0.0), at(2.0, 0.0), at(2.0, 1.0)], [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)].map(|p| p * -1.0)];
        let thin = [[at(0.0, 0.0); 3], [at(-1.0, -1.0), at(0.0, 0.0), at(1.0, 1.0)]];
        for triangles in [&broken[..], &outside, &thin] {
            assert!(counts(triangles).iter().all(|&count| count == 0));
        }
    }

    #[test]
    fn memory_must_fit() {
        assert_eq!(DepthBuffer::new([3, 2], &mut [0.0; 5]).err(), Some(RasterError::Length { pixels: 6, length: 5 }));
        let too_large = RasterError::TooLarge { size: [1, 40_000] };
        assert_eq!(DepthBuffer::new([1, 40_000], &mut []).err(), Some(too_large));
    }
}
