//! Methods that look from one part at all others at once.

use radiosity::form_factor::{
    Estimate, Hemicube, HemicubeBuffers, Samples, hemicube_deltas, hemicube_pixels, nusselt_rays, polygon_sender,
};
use radiosity::geometry::{Hit, tree};

use crate::geometry::Geometry;
use crate::polygon::{Polygon, fan, single};

/// For each part, the shares of what leaves it that reach the others.
pub type Rows = Vec<Vec<Estimate<f64>>>;

/// Independent repetitions, from whose spread the error is known.
const SCRAMBLES: u32 = 16;
/// Rays of one part: more take minutes.
const MOST_RAYS: f64 = (1 << 22) as f64;
/// Hemicubes on one part.
const MOST_CUBES: f64 = 256.0;
/// Pixels along the side of a hemicube.
const RESOLUTION: usize = 256;

/// By cosine-weighted rays: Nusselt's projection turned around. As many as the accuracy asks for, up to four million.
pub fn nusselt_rows(geometry: &Geometry, accuracy: f64) -> Rows {
    let polygons = all(geometry);
    let owners: Vec<usize> = polygons.iter().enumerate().flat_map(|(i, p)| vec![i; p.corners.len() - 2]).collect();
    let occluders = tree(polygons.iter().flat_map(|polygon| fan(&single(&polygon.corners))).collect());
    let patch = |hit: &Hit| hit.front.then(|| owners[hit.triangle as usize]);
    let count = geometry.parts.len();
    let row = |i: usize| {
        let (mut row, mut hits) = (vec![Estimate::default(); count], vec![0; count]);
        // The error of such a sequence falls a little slower than the number of its points.
        let samples = samples(accuracy.powf(-4.0 / 3.0), MOST_RAYS, i);
        nusselt_rays(polygon_sender(&single(&polygons[i].corners)), &occluders, patch, &samples, &mut row, &mut hits);
        row
    };
    (0..count).map(row).collect()
}

/// By hemicubes at points of each part, at most 256 of them, with 256 pixels along a side.
pub fn hemicube_rows(geometry: &Geometry, accuracy: f64) -> Rows {
    let polygons = all(geometry);
    let patches: Vec<&[glam::DVec3]> = polygons.iter().map(|polygon| &polygon.corners[..]).collect();
    let (mut items, mut depths) = (vec![0; hemicube_pixels(RESOLUTION)], vec![0.0; hemicube_pixels(RESOLUTION)]);
    let mut deltas = vec![0.0; hemicube_deltas(RESOLUTION)];
    let buffers = HemicubeBuffers { items: &mut items, depths: &mut depths, deltas: &mut deltas };
    let mut hemicube = Hemicube::new(RESOLUTION, buffers).expect("the buffers are as long as asked");
    let count = geometry.parts.len();
    let row = |i: usize| {
        let (mut row, mut scratch) = (vec![Estimate::default(); count], vec![Estimate::default(); count]);
        let samples = samples(accuracy.powf(-0.5), MOST_CUBES, i);
        hemicube.polygon_row(patches[i], &patches, &samples, &mut row, &mut scratch);
        row
    };
    (0..count).map(row).collect()
}

/// What can be seen: the parts, then what only blocks.
fn all(geometry: &Geometry) -> Vec<&Polygon> {
    geometry.parts.iter().map(|part| &part.polygon).chain(&geometry.obstacles).collect()
}

/// A power of two, as the sequence fills best.
fn samples(asked: f64, most: f64, part: usize) -> Samples {
    let points = (asked.min(most) / f64::from(SCRAMBLES)).max(4.0) as u32;
    Samples { scrambles: SCRAMBLES, points: points.next_power_of_two(), seed: part as u32 }
}
