//! Light that reaches a texel from all other surfaces: gathered at nodes, interpolated between them.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use super::{Texel, Texels};
use crate::geometry::{Hit, Occluders, Sobol, cosine_direction, hash};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::{Keep, Row, Tracer};

/// How densely light is gathered, and with how many rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherSettings {
    /// Rays of a node that stands for one texel; one that stands for a wider cell has more, with its width.
    pub rays: u32,
    /// Most rays of a node.
    pub most_rays: u32,
    /// Cells are at most this share of the harmonic mean distance of what their corners see.
    pub spacing: f32,
    /// Cells whose corners differ by more than this share of their mean are split; infinite: none are for that.
    pub contrast: f32,
    /// Texels whose noise is still above this share of their light get three times as many rays; 0: all do.
    pub noise: f32,
}

/// What a node saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gathered {
    /// Irradiance / pi.
    pub irradiance: Vec3,
    /// Variance of `irradiance`, mean over the channels, from two independent halves of the rays.
    pub variance: f32,
    /// Harmonic mean distance of what was seen, in meters.
    pub distance: f32,
    /// How many rays; 0: no node, the value is interpolated.
    pub rays: u32,
    /// Side in texels of the cell for which the node stands, or within whose corners the value is interpolated.
    pub width: u8,
}

impl Gathered {
    /// Takes in what more rays saw from the same place.
    fn merge(&mut self, more: &Self) {
        let all = (self.rays + more.rays) as f32;
        let (old, new) = (self.rays as f32 / all, more.rays as f32 / all);
        self.irradiance = self.irradiance * old + more.irradiance * new;
        self.variance = self.variance * (old * old) + more.variance * (new * new);
        self.distance = 1.0 / (old / self.distance + new / more.distance);
        self.rays += more.rays;
    }
}

/// What was gathered.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nodes {
    /// For each texel.
    pub gathered: Vec<Gathered>,
    /// For each texel what it sees, where that is kept: empty rows for those that are no nodes.
    pub rows: Vec<Row>,
}

impl Nodes {
    fn new(texels: usize, keep: Keep) -> Self {
        let rows = match keep {
            Keep::Lightmaps => 0,
            Keep::Transport => texels,
        };
        Self { gathered: vec![Gathered::default(); texels], rows: vec![Row::default(); rows] }
    }
}

/// All that gathering needs to know.
pub struct Gather<'a, O, C> {
    /// The receivers.
    pub texels: &'a Texels,
    /// Which texels count.
    pub is_valid: &'a [bool],
    /// Sends the rays.
    pub tracer: &'a Tracer<'a, O>,
    /// What a ray sees, of which there are so many as `radiance` has entries: the nearest hit, or the sky.
    pub column: C,
    /// The radiance of each, in cd/m2.
    pub radiance: &'a [Vec3A],
    /// Whether the nodes keep what they see.
    pub keep: Keep,
    /// How densely.
    pub settings: GatherSettings,
    /// Of all random decisions.
    pub seed: u32,
}

/// A square of texels between four corners, in an image.
#[derive(Clone, Copy)]
struct Cell {
    image: u16,
    column: u16,
    row: u16,
}

/// Texels along the side of a tile that shares a sequence.
const TILE: u32 = 8;

/// The widest cells.
const WIDEST: u16 = 8;

impl<O: Occluders, C: Fn(Option<&Hit>) -> u32 + Sync> Gather<'_, O, C> {
    /// Gathers at nodes and interpolates: one entry for each texel, zero for those that are not valid.
    ///
    /// Cells of 8 x 8 texels are split until their corners lie close enough for what they see, down to single texels.
    pub fn run(&self, workers: &Workers, progress: &Progress) -> Result<Nodes, Cancelled> {
        let mut nodes = Nodes::new(self.texels.list.len(), self.keep);
        let mut is_done = vec![false; self.texels.list.len()];
        let mut cells = self.widest_cells();
        let mut width = WIDEST;
        while width > 1 {
            let corners = cells.iter().flat_map(|cell| self.corners(cell, width)).flatten();
            self.gather_at(corners, width as u8, &mut nodes, &mut is_done, workers, progress)?;
            let mut smaller = Vec::new();
            for cell in &cells {
                match self.accepted(cell, width, &nodes.gathered) {
                    Some(corners) => self.interpolate(cell, width, corners, &mut nodes.gathered, &mut is_done),
                    None => smaller.extend(cell.quarters(width / 2)),
                }
            }
            cells = smaller;
            width /= 2;
        }
        let rest = (0..is_done.len()).filter(|&texel| self.is_valid[texel]);
        self.gather_at(rest, 1, &mut nodes, &mut is_done, workers, progress)?;
        Ok(nodes)
    }

    fn gather_at(
        &self,
        wanted: impl Iterator<Item = usize>,
        width: u8,
        nodes: &mut Nodes,
        is_done: &mut [bool],
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let mut new: Vec<usize> = Vec::new();
        for texel in wanted {
            if !is_done[texel] {
                is_done[texel] = true;
                new.push(texel);
            }
        }
        let rays = (self.settings.rays * u32::from(width) * u32::from(width)).min(self.settings.most_rays);
        let found = workers.map(new.len(), 32, progress, |range| {
            new[range].iter().map(|&texel| self.node(texel, rays, self.seed)).collect()
        })?;
        for (texel, (gathered, row)) in new.into_iter().zip(found) {
            nodes.gathered[texel] = Gathered { width, ..gathered };
            if let Some(kept) = nodes.rows.get_mut(texel) {
                *kept = row;
            }
        }
        Ok(())
    }

    /// Gathers again at texels that stand for themselves and whose noise is too large for their light.
    ///
    /// `light` is the mean level of all light at a texel, plus a tenth of the mean of all: what noise is seen against.
    pub fn refine(
        &self,
        nodes: &mut Nodes,
        light: impl Fn(usize) -> f32,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let gathered = &nodes.gathered;
        let is_noisy = |&texel: &usize| {
            let limit = self.settings.noise * light(texel);
            let node = &gathered[texel];
            node.rays > 0 && node.width == 1 && self.variance_around(texel, gathered) >= limit * limit
        };
        let noisy: Vec<usize> = (0..gathered.len()).filter(is_noisy).collect();
        let found = workers.map(noisy.len(), 16, progress, |range| {
            let more = 2 * self.settings.rays;
            noisy[range].iter().map(|&texel| self.node(texel, more, hash(self.seed, 1))).collect()
        })?;
        for (texel, (more, row)) in noisy.into_iter().zip(found) {
            nodes.gathered[texel].merge(&more);
            if let Some(kept) = nodes.rows.get_mut(texel) {
                *kept = kept.merge(&row);
            }
        }
        Ok(())
    }

    /// The mean variance of the nodes around a texel: that of one alone is too uncertain.
    fn variance_around(&self, index: usize, gathered: &[Gathered]) -> f32 {
        let Texel { pixel: [x, y], image, chart, .. } = self.texels.list[index];
        let (mut sum, mut count) = (0.0, 0.0);
        for k in 0..9 {
            let (x, y) = (i32::from(x) + k % 3 - 1, i32::from(y) + k / 3 - 1);
            let Some(other) = self.texels.at_pixel(u32::from(image), x, y) else { continue };
            let other = other as usize;
            if self.is_valid[other] && self.texels.list[other].chart == chart {
                sum += gathered[other].variance;
                count += 1.0;
            }
        }
        sum / count
    }

    /// Gathers at one texel. Two halves of the rays follow sequences of their own.
    ///
    /// The texels of a tile share a sequence and take one run of its points after the other: each run fills the
    /// hemisphere evenly, and so do all runs of neighbors together, which is what the filter mixes.
    fn node(&self, index: usize, rays: u32, seed: u32) -> (Gathered, Row) {
        let texel = &self.texels.list[index];
        let (tile, place) = self.place_in_tile(texel);
        let flat = self.tracer.world.normals[texel.triangle as usize];
        let mut halves = [Vec3A::ZERO; 2];
        let mut inverse_distances = 0.0;
        let mut seen = Vec::new();
        for (half, sum) in halves.iter_mut().enumerate() {
            let seed = hash(hash(seed, half as u32), tile);
            let sequence = Sobol::new(seed);
            for k in place * (rays / 2)..(place + 1) * (rays / 2) {
                let direction = above(cosine_direction(sequence.square(k), texel.normal), flat);
                let ray = self.tracer.leave(texel.triangle, texel.position, flat, direction, f32::INFINITY);
                let hit = self.tracer.nearest(&ray, hash(seed, k));
                inverse_distances += hit.map_or(0.0, |hit| 1.0 / hit.distance.max(1e-6));
                let column = (self.column)(hit.as_ref());
                *sum += self.radiance[column as usize];
                self.keep.push(column, &mut seen);
            }
        }
        self.tracer.count(rays as usize);
        let half = (rays / 2) as f32;
        let [a, b] = halves.map(|sum| sum / half);
        let gathered = Gathered {
            irradiance: ((a + b) * 0.5).into(),
            variance: (a - b).length_squared() / 12.0,
            distance: 2.0 * half / f32::max(inverse_distances, 1e-9),
            rays,
            width: 0,
        };
        (gathered, Row::count(&mut seen))
    }

    /// The tile of a texel, and its place on a Z-curve through the tile.
    fn place_in_tile(&self, texel: &Texel) -> (u32, u32) {
        let [column, row] = texel.pixel.map(u32::from);
        let [width, _] = self.texels.sizes[usize::from(texel.image)];
        let tile = (row / TILE) * width.div_ceil(TILE) + column / TILE;
        let spread = |x: u32| (x & 1) | (x & 2) << 1 | (x & 4) << 2;
        (hash(tile, u32::from(texel.image)), spread(column % TILE) | spread(row % TILE) << 1)
    }

    fn widest_cells(&self) -> Vec<Cell> {
        let mut cells: Vec<Cell> = Vec::new();
        let valid = self.texels.list.iter().zip(self.is_valid).filter(|(_, is_valid)| **is_valid);
        for (Texel { image, pixel, .. }, _) in valid {
            let [column, row] = pixel.map(|position| position / WIDEST * WIDEST);
            // The list of texels is ordered by blocks of the same size.
            if cells.last().is_none_or(|last| (last.image, last.column, last.row) != (*image, column, row)) {
                cells.push(Cell { image: *image, column, row });
            }
        }
        cells
    }

    /// The valid texels at the corners of a cell, in the order of [`super::quarter`].
    fn corners(&self, cell: &Cell, width: u16) -> [Option<usize>; 4] {
        core::array::from_fn(|k| self.valid_at(cell, [(k as u16 & 1) * width, (k as u16 >> 1) * width]))
    }

    fn valid_at(&self, cell: &Cell, offset: [u16; 2]) -> Option<usize> {
        let (x, y) = (i32::from(cell.column + offset[0]), i32::from(cell.row + offset[1]));
        let texel = self.texels.at_pixel(u32::from(cell.image), x, y)? as usize;
        self.is_valid[texel].then_some(texel)
    }

    /// The corners of a cell if values between them may be interpolated.
    fn accepted(&self, cell: &Cell, width: u16, gathered: &[Gathered]) -> Option<[usize; 4]> {
        let [Some(a), Some(b), Some(c), Some(d)] = self.corners(cell, width) else { return None };
        let corners = [a, b, c, d];
        let first = &self.texels.list[a];
        let is_clear = |&corner: &usize| self.texels.links.is_clear(corner as u32, u32::from(width / 2));
        let is_flat = corners.iter().all(|&corner| self.belongs(first, corner)) && corners.iter().all(is_clear);
        let side = self.texels.list[a].position.distance(self.texels.list[d].position) * 0.707;
        let nearest = corners.iter().map(|&corner| gathered[corner].distance).fold(f32::INFINITY, f32::min);
        let values = corners.map(|corner| gathered[corner].irradiance);
        let mean = values.iter().sum::<Vec3>() * 0.25;
        let differs = |value: &Vec3| (*value - mean).abs().max_element() > self.settings.contrast * mean.max_element();
        (is_flat && side <= self.settings.spacing * nearest && !values.iter().any(differs)).then_some(corners)
    }

    /// Whether a texel lies on the same chart as another, in the same direction.
    fn belongs(&self, first: &Texel, texel: usize) -> bool {
        let other = &self.texels.list[texel];
        other.chart == first.chart && other.normal.dot(first.normal) > 0.99
    }

    fn interpolate(&self, cell: &Cell, width: u16, corners: [usize; 4], all: &mut [Gathered], is_done: &mut [bool]) {
        let [a, b, c, d] = corners.map(|corner| all[corner]);
        let first = self.texels.list[corners[0]];
        for row in 0..width {
            for column in 0..width {
                let Some(texel) = self.valid_at(cell, [column, row]) else { continue };
                if is_done[texel] || !self.belongs(&first, texel) {
                    continue;
                }
                let (u, v) = (f32::from(column) / f32::from(width), f32::from(row) / f32::from(width));
                let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
                let mix = |pick: fn(&Gathered) -> f32| {
                    [a, b, c, d].iter().zip(weights).map(|(node, weight)| pick(node) * weight).sum::<f32>()
                };
                let irradiance = [a, b, c, d].iter().zip(weights).map(|(node, weight)| node.irradiance * weight).sum();
                let (variance, distance) = (mix(|node| node.variance), mix(|node| node.distance));
                all[texel] = Gathered { irradiance, variance, distance, rays: 0, width: width as u8 };
                is_done[texel] = true;
            }
        }
    }
}

impl Cell {
    fn quarters(self, width: u16) -> [Self; 4] {
        core::array::from_fn(|k| Self {
            column: self.column + (k as u16 & 1) * width,
            row: self.row + (k as u16 >> 1) * width,
            ..self
        })
    }
}

/// A direction below the plane of a triangle, as smooth normals give it, mirrored to above.
#[inline]
fn above(direction: Vec3, flat: Vec3) -> Vec3 {
    let height = direction.dot(flat);
    if height < 0.0 { direction - flat * (2.0 * height) } else { direction }
}
