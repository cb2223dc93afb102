//! Where light is gathered: at the corners of cells, which are small where what they see is near.

use alloc::vec::Vec;

use glam::Vec3;

use super::{Gather, Gathered, Nodes, Seen, Texel};
use crate::geometry::{Hit, Occluders};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// A square of texels between four corners, in an image.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    image: u16,
    column: u16,
    row: u16,
    /// Texels along each side.
    width: u16,
}

/// The widest cells, in texels.
const WIDEST: u16 = 8;

impl<O: Occluders, C: Fn(Vec3, Option<&Hit>) -> Seen + Sync> Gather<'_, O, C> {
    /// Gathers wherever something has to be gathered; returns the cells between whose corners light is interpolated,
    /// wide ones first.
    ///
    /// Cells of 8 x 8 texels are split until their corners lie close enough for what they see, down to single texels.
    /// Few rays say how far that is; the corners of cells that may stay get more.
    pub(super) fn place(
        &self,
        nodes: &mut Nodes,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Vec<Cell>, Cancelled> {
        let (mut kept, mut cells) = (Vec::new(), self.widest_cells());
        while cells.first().is_some_and(|cell| cell.width > 1) {
            let corners = cells.iter().flat_map(|cell| self.corners(cell)).flatten().collect();
            self.start(corners, nodes, workers, progress)?;
            let wide: Vec<Cell> = cells.iter().copied().filter(|cell| self.is_open(cell, &nodes.gathered)).collect();
            self.deepen(&wide, nodes, workers, progress)?;
            let mut smaller = Vec::new();
            for cell in cells {
                if self.is_open(&cell, &nodes.gathered) && self.is_even(&cell, &nodes.gathered) {
                    kept.push(cell);
                } else {
                    smaller.extend(cell.quarters());
                }
            }
            cells = smaller;
        }
        self.stand(&kept, &mut nodes.gathered);
        self.interpolate(&kept, &mut nodes.gathered);
        let is_left = |&texel: &usize| self.is_valid[texel] && nodes.gathered[texel].width == 0;
        let rest = (0..nodes.gathered.len()).filter(is_left).collect();
        self.start(rest, nodes, workers, progress)?;
        Ok(kept)
    }

    /// Makes nodes of texels that are none yet.
    fn start(
        &self,
        mut wanted: Vec<usize>,
        nodes: &mut Nodes,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        wanted.retain(|&texel| nodes.gathered[texel].width == 0);
        wanted.sort_unstable();
        wanted.dedup();
        let wanted = wanted.into_iter().map(|texel| (texel, self.settings.rays)).collect();
        self.add(wanted, 0, nodes, workers, progress)
    }

    /// Gives the corners of wide cells more rays: nothing smooths the light between them.
    fn deepen(
        &self,
        cells: &[Cell],
        nodes: &mut Nodes,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let mut wanted = Vec::new();
        for cell in cells {
            let rays = (self.settings.rays * u32::from(cell.width)).min(self.settings.most_rays);
            for corner in self.corners(cell).into_iter().flatten() {
                let node = &mut nodes.gathered[corner];
                if node.rays > 0 && node.width < cell.width as u8 {
                    node.width = cell.width as u8;
                    wanted.push((corner, rays));
                }
            }
        }
        self.add(wanted, 1, nodes, workers, progress)
    }

    /// Lets nodes stand for the widest of their cells that were kept; those of cells that were split are like any other
    /// texel, and filtered like it.
    fn stand(&self, kept: &[Cell], gathered: &mut [Gathered]) {
        gathered.iter_mut().for_each(|node| node.width = node.width.min(1));
        for cell in kept {
            for corner in self.corners(cell).into_iter().flatten() {
                gathered[corner].width = gathered[corner].width.max(cell.width as u8);
            }
        }
    }

    fn widest_cells(&self) -> Vec<Cell> {
        let mut cells: Vec<Cell> = Vec::new();
        let valid = self.texels.list.iter().zip(self.is_valid).filter(|(_, is_valid)| **is_valid);
        for (Texel { image, pixel, .. }, _) in valid {
            let [column, row] = pixel.map(|position| position / WIDEST * WIDEST);
            // The list of texels is ordered by blocks of the same size.
            if cells.last().is_none_or(|last| (last.image, last.column, last.row) != (*image, column, row)) {
                cells.push(Cell { image: *image, column, row, width: WIDEST });
            }
        }
        cells
    }

    /// The valid texels at the corners of a cell, in the order of [`super::quarter`].
    fn corners(&self, cell: &Cell) -> [Option<usize>; 4] {
        core::array::from_fn(|k| self.valid_at(cell, [(k as u16 & 1) * cell.width, (k as u16 >> 1) * cell.width]))
    }

    fn valid_at(&self, cell: &Cell, offset: [u16; 2]) -> Option<usize> {
        let (x, y) = (i32::from(cell.column + offset[0]), i32::from(cell.row + offset[1]));
        let texel = self.texels.at_pixel(u32::from(cell.image), x, y)? as usize;
        self.is_valid[texel].then_some(texel)
    }

    /// Whether a cell has four corners on one flat chart without walls, which lie close for what they see.
    fn is_open(&self, cell: &Cell, gathered: &[Gathered]) -> bool {
        let [Some(a), Some(b), Some(c), Some(d)] = self.corners(cell) else { return false };
        let corners = [a, b, c, d];
        let first = &self.texels.list[a];
        let side = first.position.distance(self.texels.list[d].position) * 0.707;
        let nearest = corners.iter().map(|&corner| gathered[corner].distance).fold(f32::INFINITY, f32::min);
        let is_clear = |corner: usize| self.texels.links.is_clear(corner as u32, u32::from(cell.width / 2));
        let is_flat = corners.iter().all(|&corner| self.belongs(first, corner) && is_clear(corner));
        is_flat && side <= self.settings.spacing * nearest
    }

    /// Whether the light at the corners of a cell is much the same.
    fn is_even(&self, cell: &Cell, gathered: &[Gathered]) -> bool {
        let values = self.corners(cell).map(|corner| corner.map_or(Vec3::ZERO, |corner| gathered[corner].irradiance));
        let mean = values.iter().sum::<Vec3>() * 0.25;
        let differs = |value: &Vec3| (*value - mean).abs().max_element() > self.settings.contrast * mean.max_element();
        !values.iter().any(differs)
    }

    /// Whether a texel lies on the same chart as another, in the same direction.
    fn belongs(&self, first: &Texel, texel: usize) -> bool {
        let other = &self.texels.list[texel];
        other.chart == first.chart && other.normal.dot(first.normal) > 0.99
    }

    /// Fills cells from their corners: those texels that are no nodes.
    pub(super) fn interpolate(&self, cells: &[Cell], gathered: &mut [Gathered]) {
        for cell in cells {
            if let [Some(a), Some(b), Some(c), Some(d)] = self.corners(cell) {
                self.fill(cell, [a, b, c, d], gathered);
            }
        }
    }

    fn fill(&self, cell: &Cell, corners: [usize; 4], gathered: &mut [Gathered]) {
        let [a, b, c, d] = corners.map(|corner| gathered[corner]);
        let first = self.texels.list[corners[0]];
        for k in 0..cell.width * cell.width {
            let [column, row] = [k % cell.width, k / cell.width];
            let Some(texel) = self.valid_at(cell, [column, row]) else { continue };
            if gathered[texel].rays > 0 || !self.belongs(&first, texel) {
                continue;
            }
            let [u, v] = [column, row].map(|along| f32::from(along) / f32::from(cell.width));
            let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
            let nodes = || [&a, &b, &c, &d].into_iter().zip(weights);
            let irradiance = nodes().map(|(node, weight)| node.irradiance * weight).sum();
            let variance = nodes().map(|(node, weight)| node.variance * weight * weight).sum();
            let distance = nodes().map(|(node, weight)| node.distance * weight).sum();
            gathered[texel] = Gathered { irradiance, variance, distance, rays: 0, width: cell.width as u8 };
        }
    }
}

impl Cell {
    fn quarters(self) -> [Self; 4] {
        let width = self.width / 2;
        core::array::from_fn(|k| Self {
            column: self.column + (k as u16 & 1) * width,
            row: self.row + (k as u16 >> 1) * width,
            width,
            ..self
        })
    }
}
