//! A sphere as a NURBS surface: points and normals on a grid, and triangles between them.

use core::f32::consts::{FRAC_1_SQRT_2, PI};

use glam::Vec3;
use radiosity::spline::{Homogeneous, KnotVector, NurbsSurface, SplineError};

use crate::Board;
use crate::checksum::Checksum;
use crate::report::Report;

/// Pieces around the axis and from pole to pole.
pub const GRID: [usize; 2] = [16, 8];
/// Points of a row and of a column.
pub const POINTS: [usize; 2] = [GRID[0] + 1, GRID[1] + 1];
const COUNT: usize = POINTS[0] * POINTS[1];

const AROUND: [f32; 12] = [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];
const UPWARDS: [f32; 8] = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];
/// The square around a circle, with the weights of the circle: nine points that make four arcs.
const SQUARE: [[f32; 3]; 9] = [
    [1.0, 0.0, 1.0],
    [1.0, 1.0, FRAC_1_SQRT_2],
    [0.0, 1.0, 1.0],
    [-1.0, 1.0, FRAC_1_SQRT_2],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, FRAC_1_SQRT_2],
    [0.0, -1.0, 1.0],
    [1.0, -1.0, FRAC_1_SQRT_2],
    [1.0, 0.0, 1.0],
];
/// Radius, height and weight along half a circle.
const PROFILE: [[f32; 3]; 5] =
    [[0.0, -1.0, 1.0], [1.0, -1.0, FRAC_1_SQRT_2], [1.0, 0.0, 1.0], [1.0, 1.0, FRAC_1_SQRT_2], [0.0, 1.0, 1.0]];

/// The control points of a sphere of radius 1: the circle, swept along the profile.
fn control_points() -> [Homogeneous<Vec3>; 45] {
    let mut circles = PROFILE.iter().flat_map(|&[radius, height, weight]| {
        SQUARE.map(|[x, y, pull]| Homogeneous::new(Vec3::new(radius * x, height, -radius * y), weight * pull))
    });
    core::array::from_fn(|_| circles.next().unwrap_or_default())
}

/// The points of the grid, row after row.
pub fn points() -> Result<[Vec3; COUNT], SplineError> {
    let control_points = control_points();
    let knots = [KnotVector::new(&AROUND, 2)?, KnotVector::new(&UPWARDS, 2)?];
    let sphere = NurbsSurface::new(knots, &control_points)?;
    let share = |k: usize, count: usize| k as f32 / count as f32;
    let us: [f32; POINTS[0]] = core::array::from_fn(|k| share(k, GRID[0]));
    let vs: [f32; POINTS[1]] = core::array::from_fn(|k| share(k, GRID[1]));
    let mut points = [Vec3::ZERO; COUNT];
    sphere.sample(&us, &vs, &mut points)?;
    Ok(points)
}

/// Two triangles for each cell of a grid, counter-clockwise seen from outside.
pub fn triangles(points: &[Vec3; COUNT]) -> impl Iterator<Item = [Vec3; 3]> {
    let rows = points.chunks_exact(POINTS[0]).zip(points.chunks_exact(POINTS[0]).skip(1));
    rows.flat_map(|(low, high)| {
        let cells = low.iter().zip(low.iter().skip(1)).zip(high.iter().zip(high.iter().skip(1)));
        cells.flat_map(|((&a, &b), (&d, &c))| [[a, b, c], [a, c, d]])
    })
}

/// The checksum of the surface; that of nothing where the spline refuses.
#[inline(never)]
pub fn tessellate(report: &mut Report<impl Board>) -> Checksum {
    let mut checksum = Checksum::default();
    let mut points = [Vec3::ZERO; COUNT];
    let mut is_sampled = false;
    let spent = report.measure(|| {
        if let Ok(sampled) = self::points() {
            (points, is_sampled) = (sampled, true);
        }
    });
    if !is_sampled {
        report.text("the surface has no points\n");
        return checksum;
    }
    report.count("instructions per point of a NURBS surface", spent / COUNT as u32);
    let mut area = 0.0;
    let spent = report.measure(|| {
        area = triangles(&points)
            .map(|[a, b, c]| 0.5 * radiosity::math::Real::sqrt((b - a).cross(c - a).length_squared()))
            .sum();
    });
    report.count("instructions per triangle", spent / (2 * GRID[0] * GRID[1]) as u32);
    report.numbers("sphere", "thousandths of its area", [1000.0 * area / (4.0 * PI), 0.0, 0.0]);
    points.iter().for_each(|point| checksum.add_all(point.to_array()));
    checksum.add(area);
    report.checksum("surface", checksum);
    checksum
}
