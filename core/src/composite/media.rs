//! Fog, dust and smoke: what fills space between surfaces, as layers.
//!
//! Of light that crosses a medium the share `exp(-tau)` passes, with the optical depth `tau` the integral of the
//! extinction coefficient along the way (Beer and Lambert). So a stretch of it is a layer with `alpha = 1 - exp(-tau)`,
//! in the color of light that the medium itself sends to the eye. Stretches in a row compose to the whole, since
//! `exp(-a) exp(-b) = exp(-a - b)`.

use core::fmt;

use glam::Vec3;

use super::PremultipliedRgba;
use crate::geometry::Ray;
use crate::math::{exp, exp_m1};

/// Pieces into which a stretch with several media is cut, where it has an end.
const PIECES: u32 = 64;

/// An optical depth through which nothing is seen, and that can be added to others.
const ENDLESS: f32 = 1e30;

/// Where endless rays end for media, in multiples of the direction: far enough, and depths up to there have a ratio.
const FAR: f32 = 1e9;

/// What fills a part of space.
pub trait Medium {
    /// The integral of the extinction coefficient along a ray between two places, given in multiples of its direction with
    /// `from <= to`. Not negative; infinite where nothing passes.
    fn optical_depth(&self, ray: &Ray, from: f32, to: f32) -> f32;

    /// What an endless stretch of it looks like: the radiance that it sends to the eye, linear RGB.
    fn color(&self) -> Vec3;

    /// Where along a ray it begins and ends, in multiples of the direction; begin after end where it is not met.
    fn extent(&self, _ray: &Ray) -> [f32; 2] {
        [f32::NEG_INFINITY, f32::INFINITY]
    }

    /// The stretch between two places as one layer.
    fn layer(&self, ray: &Ray, from: f32, to: f32) -> PremultipliedRgba {
        of_optical_depth(self.optical_depth(ray, from, to), self.color())
    }
}

/// A layer of medium; `exp_m1` keeps thin ones exact.
fn of_optical_depth(optical_depth: f32, color: Vec3) -> PremultipliedRgba {
    let alpha = -exp_m1(-optical_depth);
    PremultipliedRgba::adding(color * alpha, alpha)
}

/// Fog or dust that is everywhere the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog {
    /// What an endless stretch looks like: linear RGB radiance.
    pub color: Vec3,
    /// Extinction coefficient in 1/m: in `1 / extinction` meters the light falls to 37 %. Not negative.
    pub extinction: f32,
}

impl Medium for Fog {
    fn optical_depth(&self, ray: &Ray, from: f32, to: f32) -> f32 {
        depth_of(self.extinction, ray.direction.length() * (to - from))
    }

    fn color(&self) -> Vec3 {
        self.color
    }
}

/// Nothing is nothing over endless ways too.
fn depth_of(extinction: f32, length: f32) -> f32 {
    if extinction > 0.0 { extinction * length.max(0.0) } else { 0.0 }
}

/// Fog that thins out upwards: its extinction falls by `e` with each `scale` meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightFog {
    /// What an endless stretch looks like: linear RGB radiance.
    pub color: Vec3,
    /// Extinction coefficient at `base`, in 1/m. Not negative.
    pub extinction: f32,
    /// A point on the ground.
    pub base: Vec3,
    /// Away from the ground, of length 1.
    pub up: Vec3,
    /// Height over which the fog thins out by `e`, in m. Positive.
    pub scale: f32,
}

impl Medium for HeightFog {
    /// `integral of s exp(-(h + v t) / H) dt = s exp(-h / H) d (1 - exp(-x)) / x` with `x = v d / H`.
    fn optical_depth(&self, ray: &Ray, from: f32, to: f32) -> f32 {
        let height = (ray.origin - self.base).dot(self.up) / self.scale;
        let slope = ray.direction.dot(self.up) / self.scale;
        // Upwards even an endless way has a finite depth; along the ground it has none.
        if slope == 0.0 || from >= to {
            return depth_of(self.extinction * exp(-height), ray.direction.length() * (to - from));
        }
        // From its lower end on, where the fog is thickest: nothing overflows but what is endless.
        let lower = if slope > 0.0 { from } else { to };
        let way = ray.direction.length() / slope.abs() * -exp_m1(-slope.abs() * (to - from));
        depth_of(self.extinction * exp(-height - slope * lower), way)
    }

    fn color(&self) -> Vec3 {
        self.color
    }
}

/// Smoke in a box, from a grid of densities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smoke<'a> {
    low: Vec3,
    size: Vec3,
    counts: [usize; 3],
    extinctions: &'a [f32],
    color: Vec3,
}

/// A grid that cannot be interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GridError {
    /// The box has no size along an axis, or its corners are not finite.
    Box,
    /// An entry is negative or not finite.
    Extinction {
        /// Which one.
        entry: usize,
    },
    /// There are less than two entries along an axis.
    Thin {
        /// Entries along x, y and z.
        counts: [usize; 3],
    },
    /// The number of entries is not the product of the counts.
    Length {
        /// The product.
        entries: usize,
        /// What was given.
        length: usize,
    },
}

impl fmt::Display for GridError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Box => write!(f, "the box of a grid is not finite or empty; give it a low and a high corner"),
            Self::Extinction { entry } => write!(f, "entry {entry} of a grid is negative or not finite; mend it"),
            Self::Thin { counts: [x, y, z] } => {
                write!(f, "a grid of {x} x {y} x {z} entries; give it at least two along each axis")
            }
            Self::Length { entries, length } => {
                write!(f, "{length} densities for a grid of {entries}; give one for each")
            }
        }
    }
}

impl core::error::Error for GridError {}

impl<'a> Smoke<'a> {
    /// Smoke in the box from `low` to `high`. The extinction coefficients in 1/m, x running fastest, then y, then z, stand
    /// in the corners of the cells, those of the outer cells on the faces of the box; between them they are interpolated
    /// trilinearly.
    ///
    /// # Errors
    ///
    /// See [`GridError`].
    pub fn new(
        [low, high]: [Vec3; 2],
        counts: [usize; 3],
        extinctions: &'a [f32],
        color: Vec3,
    ) -> Result<Self, GridError> {
        if counts.iter().any(|&count| count < 2) {
            return Err(GridError::Thin { counts });
        }
        let entries = counts.iter().fold(1_usize, |product, &count| product.saturating_mul(count));
        if entries != extinctions.len() {
            return Err(GridError::Length { entries, length: extinctions.len() });
        }
        if !((high - low).is_finite() && low.cmplt(high).all()) {
            return Err(GridError::Box);
        }
        if let Some(entry) = extinctions.iter().position(|extinction| !(extinction.is_finite() && *extinction >= 0.0)) {
            return Err(GridError::Extinction { entry });
        }
        Ok(Self { low, size: high - low, counts, extinctions, color })
    }

    /// A place in cells from the low corner.
    fn in_cells(&self, place: Vec3) -> Vec3 {
        (place - self.low) / self.size * self.cells()
    }

    fn cells(&self) -> Vec3 {
        Vec3::from_array(self.counts.map(|count| (count - 1) as f32))
    }

    /// The coefficient at a place of a cell, both in cells.
    fn extinction(&self, cell: Vec3, place: Vec3) -> f32 {
        let share = (place - cell).clamp(Vec3::ZERO, Vec3::ONE);
        let [x, y, z] = cell.to_array().map(|index| index as usize);
        let row = |y, z| {
            let start = (z * self.counts[1] + y) * self.counts[0] + x;
            self.extinctions[start] * (1.0 - share.x) + self.extinctions[start + 1] * share.x
        };
        let sheet = |z| row(y, z) * (1.0 - share.y) + row(y + 1, z) * share.y;
        sheet(z) * (1.0 - share.z) + sheet(z + 1) * share.z
    }
}

impl Medium for Smoke<'_> {
    /// From cell to cell (Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987). Within a cell the
    /// coefficient is a cubic polynomial along the ray, which two points of Gauss integrate exactly.
    fn optical_depth(&self, ray: &Ray, from: f32, to: f32) -> f32 {
        let [begin, end] = self.extent(ray);
        let (mut at, end) = (begin.max(from), end.min(to));
        let origin = self.in_cells(ray.origin);
        let step = ray.direction / self.size * self.cells();
        let most = self.cells() - Vec3::ONE;
        let mut sum = 0.0;
        // Every plane between cells is crossed at most once.
        let mut crossings = self.counts.iter().sum::<usize>();
        while at < end && crossings > 0 {
            crossings -= 1;
            // A little ahead, the cell that is entered; on its far side its planes are left.
            let ahead = origin + step * at + step.signum() * 1e-4;
            let cell = ahead.floor().clamp(Vec3::ZERO, most);
            let exits = (cell + Vec3::select(step.cmpgt(Vec3::ZERO), Vec3::ONE, Vec3::ZERO) - origin) / step;
            let exits = Vec3::select(step.cmpeq(Vec3::ZERO), Vec3::INFINITY, exits);
            let next = Vec3::select(exits.cmpgt(Vec3::splat(at)), exits, Vec3::INFINITY).min_element().min(end);
            let (middle, half) = (0.5 * (at + next), 0.5 * (next - at));
            let gauss = half * 0.577_350_26;
            let values = [middle - gauss, middle + gauss].map(|t| self.extinction(cell, origin + step * t));
            sum += half * (values[0] + values[1]);
            at = next;
        }
        sum * ray.direction.length()
    }

    fn color(&self) -> Vec3 {
        self.color
    }

    fn extent(&self, ray: &Ray) -> [f32; 2] {
        let [a, b] = [self.low, self.low + self.size].map(|corner| (corner - ray.origin) / ray.direction);
        let inside =
            (ray.origin.cmpge(self.low) & ray.origin.cmple(self.low + self.size)) | ray.direction.cmpne(Vec3::ZERO);
        if !inside.all() {
            return [f32::INFINITY, f32::NEG_INFINITY];
        }
        let still = ray.direction.cmpeq(Vec3::ZERO);
        let begin = Vec3::select(still, Vec3::NEG_INFINITY, a.min(b)).max_element();
        [begin, Vec3::select(still, Vec3::INFINITY, a.max(b)).min_element()]
    }
}

/// What a ray sees of surfaces and of the media between, before and behind them, as one layer over what lies at its end.
///
/// `surfaces` come from the nearest to the farthest, each with its place in multiples of the direction. Media that
/// overlap are mixed: their optical depths add up, and the color is the mean, weighted by them. That is exact for one
/// medium at a time and for homogeneous ones; others are mixed piece by piece, 64 to a stretch.
pub fn through(
    ray: &Ray,
    media: &[&dyn Medium],
    surfaces: impl IntoIterator<Item = (f32, PremultipliedRgba)>,
) -> PremultipliedRgba {
    let mut seen = PremultipliedRgba::TRANSPARENT;
    let mut from = 0.0;
    for (place, surface) in surfaces {
        let place = place.min(ray.end).max(from);
        seen = seen.over(stretch(ray, media, from, place)).over(surface);
        from = place;
        if seen.is_opaque() {
            return seen;
        }
    }
    seen.over(stretch(ray, media, from, ray.end.min(FAR)))
}

/// All media between two places, from where one begins or ends to the next such place.
fn stretch(ray: &Ray, media: &[&dyn Medium], from: f32, to: f32) -> PremultipliedRgba {
    let mut seen = PremultipliedRgba::TRANSPARENT;
    let mut at = from;
    while at < to && !seen.is_opaque() {
        let borders = media.iter().flat_map(|medium| medium.extent(ray));
        let next = borders.filter(|&border| border > at).fold(to, f32::min);
        let met = media.iter().filter(|medium| medium.optical_depth(ray, at, next) > 0.0).count();
        let pieces = if met > 1 && next < FAR { PIECES } else { 1 };
        let place = |k: u32| if k == pieces { next } else { at + (next - at) * (k as f32 / pieces as f32) };
        for k in 0..pieces {
            seen = seen.over(mixed(ray, media, place(k), place(k + 1)));
        }
        at = next;
    }
    seen
}

/// All media between two places as if each filled the way evenly.
fn mixed(ray: &Ray, media: &[&dyn Medium], from: f32, to: f32) -> PremultipliedRgba {
    let (mut sum, mut colors) = (0.0, Vec3::ZERO);
    for medium in media {
        let optical_depth = medium.optical_depth(ray, from, to).min(ENDLESS);
        sum += optical_depth;
        let share = if sum > 0.0 { optical_depth / sum } else { 0.0 };
        colors = colors.lerp(medium.color(), share);
    }
    of_optical_depth(sum, colors)
}
