//! Seams: edges that lie on each other in the world, but not in the lightmaps.
//!
//! Where a smooth or flat surface goes on from one triangle to the next, its light goes on too. If the two triangles lie in
//! different charts, or belong to different objects, two groups of texels tell of the same light, and their noise and
//! their grids differ. [`Seams`] hold the points where both are sampled; least squares make both agree there.

mod edges;
mod matching;
mod tree;

use alloc::vec::Vec;

use glam::Vec2;

use super::{LightmapImage, Texels};
use crate::geometry::Occluders;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::{Sample, SeamPoint, SeamSolver, SeamSteps, Tracer};
use matching::{Matching, Meeting};

pub use crate::transport::Seams;

/// How firmly a texel holds light of its own, against half a texel of a seam.
const OWN: f32 = 0.05;
/// The same of a texel inside geometry, which was filled from its neighbors.
const FILLED: f32 = 0.01;
/// The same of a texel outside of its chart, which is there for seams.
const OUTSIDE: f32 = 0.005;

/// How far the two sides of seams differ before and after they were solved: |left - right| / (mean of both + a tenth of
/// the mean light).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeamReport {
    /// Points at which both sides are compared.
    pub pairs: usize,
    /// Root mean square step over the length of all seams, before they were solved.
    pub step_before: f32,
    /// The same after.
    pub step_after: f32,
    /// The largest step before.
    pub largest_before: f32,
    /// The largest after.
    pub largest_after: f32,
}

impl Seams {
    /// Finds all seams between the texels of a bake.
    ///
    /// Edges belong together where they run along each other in opposite directions, within a twentieth of a texel, where
    /// normals differ by less than 5 degrees, and where nothing stands between the texels of both sides.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel.
    pub fn new<O: Occluders>(
        texels: &Texels,
        is_valid: &[bool],
        tracer: &Tracer<O>,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        let t0 = progress.seconds();
        let edges = edges::open(tracer.world, texels);
        let t1 = progress.seconds();
        let tree = tree::Tree::new(&edges);
        let matching = Matching { edges: &edges, tree: &tree, tracer };
        let meetings: Vec<Meeting> = workers
            .map(edges.len(), 64, progress, |range| range.flat_map(|edge| matching.meetings(edge)).collect())?;
        let t2 = progress.seconds();
        let seams = Numbering { texels, is_valid }.seams(&meetings);
        std::eprintln!("SEAM edges {} {:.3} match {:.3} number {:.3}", edges.len(), t1-t0, t2-t1, progress.seconds()-t2);
        Ok(seams)
    }

    /// Makes both sides of all seams agree in the images of a bake.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel; the images are as they were.
    pub fn solve(
        &self,
        images: &mut [LightmapImage],
        workers: &Workers,
        progress: &Progress,
    ) -> Result<SeamReport, Cancelled> {
        let mean = mean_light(images);
        let mut light = self.gather(images.iter().map(|image| &image.texels[..]));
        let before = self.steps(&light, mean);
        let t0 = progress.seconds();
        let solver = SeamSolver::new(self, workers, progress)?;
        let t1 = progress.seconds();
        let n = solver.solve(&mut light, workers, progress)?;
        std::eprintln!("SEAM set up {:.3} solve {:.3} iterations {n} touched {} points {} rows {} entries {}", t1-t0, progress.seconds()-t1, self.touched(), self.points.len(), self.rows.len(), solver.entries.len());
        self.scatter(&light, images.iter_mut().map(|image| &mut image.texels[..]));
        let after = self.steps(&light, mean);
        Ok(SeamReport {
            pairs: self.points.len(),
            step_before: before.rms,
            step_after: after.rms,
            largest_before: before.largest,
            largest_after: after.largest,
        })
    }
}

/// The mean of all valid texels and channels.
fn mean_light(images: &[LightmapImage]) -> f32 {
    let texels = images.iter().flat_map(|image| image.texels.iter().zip(&image.states));
    let valid = texels.filter(|(_, state)| **state == super::TexelState::Valid);
    let (sum, count) = valid.fold((0.0_f64, 0_usize), |(sum, count), (texel, _)| {
        (sum + f64::from(texel.element_sum() / 3.0), count + 1)
    });
    (sum / count.max(1) as f64) as f32
}

/// Gives touched texels their numbers.
struct Numbering<'a> {
    texels: &'a Texels,
    is_valid: &'a [bool],
}

/// An image and a texel of it: column and row.
type Place = (u32, [u32; 2]);

impl Numbering<'_> {
    fn seams(&self, meetings: &[Meeting]) -> Seams {
        let corners: Vec<[(Place, Vec2); 2]> =
            meetings.iter().map(|meeting| meeting.sides.map(|(image, point)| self.corner(image, point))).collect();
        let mut touched: Vec<Place> =
            corners.as_flattened().iter().flat_map(|&((image, at), _)| square(at).map(|at| (image, at))).collect();
        sort(&mut touched);
        let rows: Vec<[Place; 3]> = touched.iter().flat_map(|&place| self.rows(place, &touched)).collect();
        touched.extend(rows.as_flattened());
        sort(&mut touched);
        let number = |place: Place| touched.binary_search_by_key(&key(place), |&place| key(place)).unwrap_or(0) as u32;
        let sample = |((image, at), share): (Place, Vec2)| {
            let [upper, _, lower, _] = square(at).map(|at| (image, at));
            Sample { upper: number(upper), lower: number(lower), right: share.x, down: share.y }
        };
        let points = corners.iter().zip(meetings);
        let points = points.map(|(&sides, meeting)| SeamPoint { sides: sides.map(sample), weight: meeting.weight });
        let mut texels: Vec<Vec<u32>> = self.texels.sizes.iter().map(|_| Vec::new()).collect();
        touched.iter().for_each(|&(image, [x, y])| {
            texels[image as usize].push(y * self.texels.sizes[image as usize][0] + x);
        });
        Seams {
            texels,
            holds: touched.iter().map(|&place| self.hold(place)).collect(),
            points: points.collect(),
            rows: rows.iter().map(|row| row.map(number)).collect(),
        }
    }

    /// The upper left of the four texels that are mixed at a point of an image, and the shares of the right and lower.
    fn corner(&self, image: u32, point: Vec2) -> (Place, Vec2) {
        let size = Vec2::from(self.texels.sizes[image as usize].map(|side| side as f32));
        let at = (point - 0.5).clamp(Vec2::ZERO, size - 1.0);
        let low = at.floor().min(size - 2.0);
        ((image, [low.x as u32, low.y as u32]), at - low)
    }

    fn texel(&self, (image, [x, y]): Place) -> Option<usize> {
        self.texels.at_pixel(image, x as i32, y as i32).map(|texel| texel as usize)
    }

    fn hold(&self, place: Place) -> f32 {
        match self.texel(place) {
            Some(texel) if self.is_valid[texel] => OWN,
            Some(_) => FILLED,
            None => OUTSIDE,
        }
    }

    /// From a touched texel outside of a chart the rows of three texels that lead straight into the chart.
    fn rows(&self, place: Place, touched: &[Place]) -> Vec<[Place; 3]> {
        if self.texel(place).is_some() {
            return Vec::new();
        }
        let step = |steps: i32, [dx, dy]: [i32; 2]| {
            let (image, [x, y]) = place;
            (image, [x.wrapping_add_signed(steps * dx), y.wrapping_add_signed(steps * dy)])
        };
        let row = |direction: [i32; 2]| {
            let [border, inside] = [1, 2].map(|steps| step(steps, direction));
            let [first, second] = [self.texel(border)?, self.texel(inside)?].map(|texel| &self.texels.list[texel]);
            let is_touched = touched.binary_search_by_key(&key(border), |&place| key(place)).is_ok();
            (first.chart == second.chart && is_touched).then_some([place, border, inside])
        };
        [[1, 0], [-1, 0], [0, 1], [0, -1]].into_iter().filter_map(row).collect()
    }
}

/// A texel and those right of it, below it, and both.
fn square([x, y]: [u32; 2]) -> [[u32; 2]; 4] {
    [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]]
}

/// The order of texels: image by image, row by row.
fn key((image, [x, y]): Place) -> [u32; 3] {
    [image, y, x]
}

fn sort(places: &mut Vec<Place>) {
    places.sort_unstable_by_key(|&place| key(place));
    places.dedup();
}
