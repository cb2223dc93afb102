//! Shapes of Bezier surfaces.

use bevy::math::{Vec2, Vec3};
use radiosity::spline::BezierSurface;

use crate::shape::Shape;

/// Inner control points of a cubic that runs along a quarter of a circle, in radii: within 0.03 % of it.
const QUARTER: f32 = 0.552_284_8;

/// A Bezier surface cut into `cuts` quadrilaterals, columns first.
///
/// # Panics
///
/// Where the control points make no surface.
pub fn patch(points: &[Vec3], columns: usize, cuts: [usize; 2]) -> Shape {
    strip(&[points.to_vec()], columns, cuts)
}

/// Bezier surfaces side by side, each cut into `cuts` quadrilaterals; one goes on smoothly where the last one ends.
///
/// # Panics
///
/// Where the control points make no surface.
pub fn strip(patches: &[Vec<Vec3>], columns: usize, cuts: [usize; 2]) -> Shape {
    let surface = |points| BezierSurface::new(points, columns).expect("the control points make a surface");
    let surfaces: Vec<BezierSurface<Vec3>> = patches.iter().map(|points| surface(points)).collect();
    Shape::grid(cuts[0] * surfaces.len(), cuts[1], |column, row| {
        let number = (column / cuts[0]).min(surfaces.len() - 1);
        let (u, v) = ((column - number * cuts[0]) as f32 / cuts[0] as f32, row as f32 / cuts[1] as f32);
        (surfaces[number].at(u, v).point, surfaces[number].normal(u, v))
    })
}

/// A Bezier curve turned around the vertical through `foot`; `x` of its points is the radius, `y` the height.
///
/// From bottom to top its front is outside. `cuts` are those of a quarter turn and of the curve.
pub fn turned(foot: impl Into<Vec3>, profile: &[[f32; 2]], cuts: [usize; 2]) -> Shape {
    let foot = foot.into();
    let quarter = |number: usize| {
        let (from, to) =
            [(Vec3::X, Vec3::NEG_Z), (Vec3::NEG_Z, Vec3::NEG_X), (Vec3::NEG_X, Vec3::Z), (Vec3::Z, Vec3::X)][number];
        let arc = [from, from + QUARTER * to, to + QUARTER * from, to];
        let points: Vec<Vec3> = profile
            .iter()
            .flat_map(|&[radius, height]| arc.map(|outward| foot + radius * outward + height * Vec3::Y))
            .collect();
        patch(&points, 4, cuts)
    };
    Shape::joined((0..4).map(quarter))
}

/// Curves that follow each other, each turned around the vertical through `foot`.
pub fn lathe(foot: impl Into<Vec3>, profiles: &[&[[f32; 2]]], cuts: [usize; 2]) -> Shape {
    let foot = foot.into();
    Shape::joined(profiles.iter().map(|profile| turned(foot, profile, cuts)))
}

/// A cushion around the origin: two bulging surfaces that meet in a rounded rectangle of `size`.
pub fn cushion(size: Vec2, height: f32, cuts: usize) -> Shape {
    let half = 0.5 * size;
    // Corners are rounded off, edges swing inwards.
    let at = |i: usize, j: usize| {
        let inset = |k: usize| [0.94, 1.0, 1.0, 0.94][k];
        let (x, z) = ([-1.0, -0.55, 0.55, 1.0][i] * half.x * inset(j), [1.0, 0.55, -0.55, -1.0][j] * half.y * inset(i));
        let inner = matches!((i, j), (1..=2, 1..=2));
        Vec3::new(x, if inner { 1.1 * height } else { 0.0 }, z)
    };
    let side = |sign: f32| -> Shape {
        let points: Vec<Vec3> = (0..16).map(|k| at(k % 4, k / 4) * Vec3::new(1.0, sign, 1.0)).collect();
        patch(&points, 4, [cuts, cuts])
    };
    Shape::joined([side(1.0), side(-1.0).turned()])
}

/// A grid with a thickness: its front, its back and the rim between them. `cuts` are those of the grid.
pub fn sheet(middle: Shape, cuts: [usize; 2], thickness: f32) -> Shape {
    let moved = |sign: f32| {
        let mut shape = middle.clone();
        let places = shape.positions.iter_mut().zip(&shape.normals);
        places.for_each(|(position, normal)| *position += 0.5 * sign * thickness * normal);
        shape
    };
    let (front, back) = (moved(1.0), moved(-1.0));
    let at = |column: usize, row: usize| row * (cuts[0] + 1) + column;
    let border: Vec<usize> = (0..cuts[0])
        .map(|column| at(column, 0))
        .chain((0..cuts[1]).map(|row| at(cuts[0], row)))
        .chain((1..=cuts[0]).rev().map(|column| at(column, cuts[1])))
        .chain((1..=cuts[1]).rev().map(|row| at(0, row)))
        .collect();
    let rim = (0..border.len()).map(|i| {
        let (a, b) = (border[i], border[(i + 1) % border.len()]);
        Shape::quad([back.positions[a], back.positions[b], front.positions[b], front.positions[a]])
    });
    let rim = Shape::joined(rim);
    Shape::joined([front, back.turned(), rim])
}
