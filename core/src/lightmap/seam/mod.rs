//! Seams: edges that lie on each other in the world, but not in the lightmaps.
//!
//! Where a smooth or flat surface goes on from one triangle to the next, its light goes on too. If the two triangles lie in
//! different charts, or belong to different objects, two groups of texels tell of the same light, and their noise and
//! their grids differ. [`Seams`] hold the points where both are sampled; least squares make both agree there.

mod edges;
mod matching;
mod tree;

use alloc::vec::Vec;
use core::ops::Range;

use glam::Vec2;

use super::{LightmapImage, Texels};
use crate::geometry::Occluders;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::{Sample, SeamPoint, SeamSolver, Tracer};
use matching::{Matching, Meeting};

pub use crate::transport::{SeamTexel, Seams};

/// How firmly a texel holds light of its own, against half a texel of a seam.
const OWN: f32 = 0.02;
/// The same of a texel inside geometry, which was filled from its neighbors.
const FILLED: f32 = 0.005;
/// The same of a texel outside of its chart, which is there for seams.
const OUTSIDE: f32 = 0.005;

/// How many texels beyond those that seams touch change with them.
const FADE: usize = 6;
/// Cosine of the angle, 18 degrees, up to which texels side by side change alike.
const ALIKE: f32 = 0.95;

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
    /// Finds all seams between texels.
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
        errors: &[f32],
        tracer: &Tracer<O>,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        let edges = edges::open(tracer.world, texels, &texels.here);
        let tree = tree::Tree::new(&edges);
        let matching = Matching { edges: &edges, tree: &tree, tracer };
        let meetings: Vec<Meeting> = workers.map(edges.len(), 64, progress, |range| {
            range.flat_map(|edge| matching.meetings(edge, |_| true)).collect()
        })?;
        let numbering = Numbering { texels, is_valid, errors, usual: mean_square(errors), tracer };
        numbering.seams(&meetings, workers, progress)
    }

    /// Makes both sides of all seams agree in the images of those texels, which belong to a bake of this mean light.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel; the images are as they were.
    pub fn solve(
        &self,
        images: &mut [LightmapImage],
        mean: f32,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<SeamReport, Cancelled> {
        let mut light = self.gather(images.iter().map(|image| &image.texels[..]));
        let before = self.steps(&light, mean);
        SeamSolver::new(self, workers, progress)?.solve(&mut light, workers, progress)?;
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

/// The number of points at which seams between images of different groups are seen: what [`Seams::new`] cannot find while
/// the texels of one group are here.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn split_seams<O: Occluders>(
    groups: &[Range<usize>],
    texels: &Texels,
    tracer: &Tracer<O>,
    workers: &Workers,
    progress: &Progress,
) -> Result<usize, Cancelled> {
    if groups.len() < 2 {
        return Ok(0);
    }
    let edges = edges::open(tracer.world, texels, &(0..texels.sizes.len()));
    let tree = tree::Tree::new(&edges);
    let matching = Matching { edges: &edges, tree: &tree, tracer };
    let group = |image: u32| groups.iter().position(|group| group.contains(&(image as usize)));
    let is_split = |images: [u32; 2]| group(images[0]) != group(images[1]);
    let counts = workers
        .map(edges.len(), 64, progress, |range| range.map(|edge| matching.meetings(edge, is_split).len()).collect())?;
    Ok(counts.into_iter().sum())
}

/// The texels at which seams are seen, with the steps that are left there in a bake of this mean light; `first` is the
/// number of the first of these images.
pub fn seam_texels(seams: &Seams, images: &[LightmapImage], mean: f32, first: usize) -> Vec<SeamTexel> {
    let light = seams.gather(images.iter().map(|image| &image.texels[..]));
    let steps = seams.texel_steps(&light, mean);
    steps.into_iter().map(|texel| SeamTexel { image: first as u32 + texel.image, ..texel }).collect()
}

/// Gives touched texels their numbers.
struct Numbering<'a, O> {
    texels: &'a Texels,
    is_valid: &'a [bool],
    errors: &'a [f32],
    /// The mean square of the errors.
    usual: f32,
    tracer: &'a Tracer<'a, O>,
}

/// An image and a texel of it: column and row.
type Place = (u32, [u32; 2]);

impl<O: Occluders> Numbering<'_, O> {
    fn seams(&self, meetings: &[Meeting], workers: &Workers, progress: &Progress) -> Result<Seams, Cancelled> {
        let (corners, weights): (Vec<[(Place, Vec2); 2]>, Vec<f32>) = meetings
            .iter()
            .map(|meeting| (meeting.sides.map(|(image, point)| self.corner(image, point)), meeting.weight))
            .filter(|(sides, _)| sides.iter().any(|&((image, at), _)| self.is_lit(image, at)))
            .unzip();
        let mut touched: Vec<Place> =
            corners.as_flattened().iter().flat_map(|&((image, at), _)| square(at).map(|at| (image, at))).collect();
        sort(&mut touched);
        let rows: Vec<[Place; 3]> = touched.iter().flat_map(|&place| self.rows(place, &touched)).collect();
        touched.extend(rows.as_flattened());
        sort(&mut touched);
        let mut ring = touched.clone();
        for _ in 0..FADE {
            ring = ring.iter().flat_map(|&place| self.around(place)).collect();
            sort(&mut ring);
            ring.retain(|place| find(&touched, *place).is_none());
            touched.extend(&ring);
            sort(&mut touched);
        }
        let number = |place: Place| find(&touched, place).unwrap_or(0) as u32;
        let links = workers.map(touched.len(), 1024, progress, |range| {
            range.flat_map(|texel| self.links(texel as u32, &touched)).collect()
        })?;
        let sample = |((image, at), share): (Place, Vec2)| {
            let [upper, _, lower, _] = square(at).map(|at| (image, at));
            Sample { upper: number(upper), lower: number(lower), right: share.x, down: share.y }
        };
        let points = corners.iter().zip(weights);
        let points = points.map(|(&sides, weight)| SeamPoint { sides: sides.map(sample), weight });
        let here = &self.texels.here;
        let mut texels: Vec<Vec<u32>> = here.clone().map(|_| Vec::new()).collect();
        touched.iter().for_each(|&(image, [x, y])| {
            texels[image as usize - here.start].push(y * self.texels.sizes[image as usize][0] + x);
        });
        Ok(Seams {
            texels,
            holds: touched.iter().map(|&place| self.hold(place)).collect(),
            points: points.collect(),
            rows: rows.iter().map(|row| row.map(number)).collect(),
            links,
        })
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

    /// Whether one of four texels has light of its own: others lie inside geometry, where nobody sees them.
    fn is_lit(&self, image: u32, at: [u32; 2]) -> bool {
        square(at).iter().any(|&at| self.texel((image, at)).is_some_and(|texel| self.is_valid[texel]))
    }

    fn hold(&self, place: Place) -> f32 {
        match self.texel(place) {
            Some(texel) if self.is_valid[texel] => OWN * self.certainty(texel),
            Some(_) => FILLED,
            None => OUTSIDE,
        }
    }

    /// How much less uncertain a texel is than others, as a ratio of variances.
    fn certainty(&self, texel: usize) -> f32 {
        let squared = self.errors[texel] * self.errors[texel];
        if self.usual > 0.0 { (self.usual / squared).clamp(0.25, 16.0) } else { 1.0 }
    }

    /// The texels beside one of a chart that belong to it too.
    fn around(&self, place: Place) -> Vec<Place> {
        let (image, [x, y]) = place;
        let Some(texel) = self.texel(place) else { return Vec::new() };
        let beside = STEPS.map(|[dx, dy]| (image, [x.wrapping_add_signed(dx), y.wrapping_add_signed(dy)]));
        let is_alike = |other: &Place| self.texel(*other).is_some_and(|other| self.are_alike(texel, other));
        beside.into_iter().filter(is_alike).collect()
    }

    fn are_alike(&self, texel: usize, other: usize) -> bool {
        let [texel, other] = [texel, other].map(|texel| &self.texels.list[texel]);
        texel.chart == other.chart && texel.normal.dot(other.normal) > ALIKE
    }

    /// From a touched texel to those right of it and below it, where nothing stands between.
    fn links(&self, number: u32, touched: &[Place]) -> Vec<[u32; 2]> {
        let place = touched[number as usize];
        let Some(texel) = self.texel(place) else { return Vec::new() };
        let after = self.around(place).into_iter().filter(|other| key(*other) > key(place));
        let link = |other: Place| {
            let after = find(touched, other)?;
            let [from, to] = [texel, self.texel(other)?].map(|texel| &self.texels.list[texel]);
            let ray = self.tracer.leave(from.triangle, from.position, from.normal, to.position - from.position, 1.0);
            self.tracer.count(1);
            (self.tracer.visibility(&ray) > 0.5).then_some([number, after as u32])
        };
        after.filter_map(link).collect()
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
            let is_touched = find(touched, border).is_some();
            (first.chart == second.chart && is_touched).then_some([place, border, inside])
        };
        STEPS.into_iter().filter_map(row).collect()
    }
}

/// Right, left, down and up.
const STEPS: [[i32; 2]; 4] = [[1, 0], [-1, 0], [0, 1], [0, -1]];

/// The mean of the squares of all errors but those that are zero.
fn mean_square(errors: &[f32]) -> f32 {
    let known = errors.iter().filter(|error| **error > 0.0);
    let (sum, count) =
        known.fold((0.0_f64, 0_usize), |(sum, count), &error| (sum + f64::from(error * error), count + 1));
    (sum / count.max(1) as f64) as f32
}

/// The number of a touched texel.
fn find(touched: &[Place], place: Place) -> Option<usize> {
    touched.binary_search_by_key(&key(place), |&place| key(place)).ok()
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
