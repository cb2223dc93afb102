//! Curves with a mesh: tubes, ribbons and lines.

use std::f32::consts::{PI, TAU};

use bevy::asset::RenderAssetUsages;
use bevy::mesh::PrimitiveTopology;
use bevy::prelude::*;
use radiosity::spline::{Frame, Nurbs, Tessellation, arc_length, close_frames, rotation_minimizing_frames};

use super::{ShapeError, SplineCurve, SplineTolerance, mesh};

/// How a [`SplineCurve`] is shown; its mesh follows the control points.
///
/// Tubes and ribbons turn about the curve no more than they must, and have lightmap coordinates of their own: across in
/// `u`, along in `v`.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq)]
#[reflect(Component)]
#[require(SplineTolerance, Visibility)]
pub enum SplineSweep {
    /// A circle along the curve, open at both ends; its front is outside.
    Tube {
        /// In meters.
        radius: f32,
    },
    /// A band; its front shows to the side that [`SplineCurve::up`] says.
    Ribbon {
        /// In meters.
        width: f32,
    },
    /// A line, one pixel wide, which takes no part in bakes.
    Line,
}

/// How often the piece between two knots is cut in halves at most.
const DEEPEST: usize = 8;

impl SplineSweep {
    /// The mesh along a curve.
    ///
    /// # Errors
    ///
    /// Says what is wrong with the curve, the width or the tolerance.
    pub fn mesh(&self, curve: &SplineCurve, tolerance: SplineTolerance) -> Result<Mesh, ShapeError> {
        tolerance.checked()?;
        let (nurbs, up) = (curve.nurbs()?, curve.up);
        let frames = frames(&nurbs.curve(), up, tolerance)?;
        let section = match *self {
            Self::Tube { radius } => circle(checked(radius)?, tolerance),
            Self::Ribbon { width } => band(0.5 * checked(width)?),
            Self::Line => return Ok(line(&frames)),
        };
        Ok(mesh(&along(&section, &frames)))
    }
}

fn checked(width: f32) -> Result<f32, ShapeError> {
    if width > 0.0 && width.is_finite() { Ok(width) } else { Err(ShapeError::Width { width }) }
}

/// A place on the way.
struct Station {
    frame: Frame<Vec3>,
    /// Its share of the way.
    share: f32,
}

/// Frames along a curve, dense where it bends.
fn frames(curve: &Nurbs<Vec3>, up: Vec3, tolerance: SplineTolerance) -> Result<Vec<Station>, ShapeError> {
    let knots = curve.knots();
    let mut parameters = vec![knots.domain()[0]];
    for span in knots.spans() {
        subdivide(curve, [knots.knots()[span], knots.knots()[span + 1]], tolerance, DEEPEST, &mut parameters);
    }
    let mut frames = vec![Frame::default(); parameters.len()];
    rotation_minimizing_frames(curve, up, &parameters, &mut frames);
    if curve.is_closed() {
        close_frames(&mut frames);
    }
    let rough: f32 = frames.windows(2).map(|pair| pair[0].point.distance(pair[1].point)).sum();
    if rough == 0.0 {
        return Err(ShapeError::Nothing);
    }
    let mut ways = vec![0.0];
    for (k, pair) in parameters.windows(2).enumerate() {
        ways.push(ways[k] + arc_length(curve, [pair[0], pair[1]], 1e-4 * rough));
    }
    let whole = ways[ways.len() - 1];
    Ok(frames.into_iter().zip(ways).map(|(frame, way)| Station { frame, share: way / whole }).collect())
}

/// Adds parameters up to the end of an interval, so many that chords are near the curve and its direction changes little
/// between them.
fn subdivide(
    curve: &Nurbs<Vec3>,
    [from, to]: [f32; 2],
    tolerance: SplineTolerance,
    depth: usize,
    parameters: &mut Vec<f32>,
) {
    let middle = 0.5 * (from + to);
    let [a, b, c] = [from, middle, to].map(|t| curve.at(t));
    let turn = a.first.angle_between(b.first) + b.first.angle_between(c.first);
    let sag = b.point.distance(a.point.midpoint(c.point));
    // The first cut is for curves that come back to their direction.
    let is_fine = depth < DEEPEST && turn <= tolerance.angle && sag <= tolerance.chord;
    if is_fine || depth == 0 {
        parameters.push(to);
        return;
    }
    subdivide(curve, [from, middle], tolerance, depth - 1, parameters);
    subdivide(curve, [middle, to], tolerance, depth - 1, parameters);
}

/// What is swept: offsets along the normal and the binormal, with the normal there, in order of `u`.
type Section = Vec<[Vec2; 2]>;

fn circle(radius: f32, tolerance: SplineTolerance) -> Section {
    // A chord over the angle 2 a lies r (1 - cos a) inside of the circle.
    let half_angle = (1.0 - tolerance.chord / radius).clamp(-1.0, 1.0).acos().min(0.5 * tolerance.angle);
    let sides = (PI / half_angle).ceil().clamp(3.0, 256.0) as usize;
    let at = |side: usize| Vec2::from_angle(TAU * (side % sides) as f32 / sides as f32);
    (0..=sides).map(|side| [radius * at(side), at(side)]).collect()
}

fn band(half_width: f32) -> Section {
    [-half_width, half_width].map(|across| [Vec2::new(0.0, across), Vec2::X]).to_vec()
}

/// The section carried along the frames.
fn along(section: &[[Vec2; 2]], stations: &[Station]) -> Tessellation<Vec3> {
    let columns = section.len() as u32;
    let in_space = |frame: &Frame<Vec3>, v: Vec2| frame.normal * v.x + frame.binormal * v.y;
    let uv: Vec<[f32; 2]> = stations
        .iter()
        .flat_map(|station| (0..columns).map(|column| [column as f32 / (columns - 1) as f32, station.share]))
        .collect();
    let each = |of: fn(&Frame<Vec3>, Vec3, Vec3) -> Vec3| -> Vec<Vec3> {
        let ring = |Station { frame, .. }: &Station| {
            let frame = *frame;
            section.iter().map(move |&[offset, normal]| of(&frame, in_space(&frame, offset), in_space(&frame, normal)))
        };
        stations.iter().flat_map(ring).collect()
    };
    let quad = |row: u32, column: u32| {
        let a = row * columns + column;
        [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]]
    };
    let rows = stations.len() as u32 - 1;
    Tessellation {
        positions: each(|frame, offset, _| frame.point + offset),
        normals: each(|_, _, normal| normal),
        parameters: uv.clone(),
        uv_0: uv.clone(),
        uv_1: uv,
        triangles: (0..rows).flat_map(|row| (0..columns - 1).flat_map(move |column| quad(row, column))).collect(),
        size: [0.0; 2],
    }
}

fn line(stations: &[Station]) -> Mesh {
    let positions: Vec<[f32; 3]> = stations.iter().map(|station| station.frame.point.to_array()).collect();
    let uv: Vec<[f32; 2]> = stations.iter().map(|station| [0.0, station.share]).collect();
    Mesh::new(PrimitiveTopology::LineStrip, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        // Lines that were a tube before may still have a lightmap, whose shader wants coordinates.
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uv.clone())
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_1, uv)
}
