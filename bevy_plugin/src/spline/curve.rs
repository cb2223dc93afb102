//! Curves as components.

use bevy::prelude::*;
use radiosity::spline::{Homogeneous, OwnedBSpline, OwnedNurbs, SplineError, clamped_knots, uniform_knots};

use super::{ShapeError, SplinePath};

/// A curve of splines, given by its control points in the space of its entity; change them as you like.
///
/// It shows nothing by itself: [`SplineSweep`](super::SplineSweep) gives it a mesh, [`TravelAlong`](super::TravelAlong)
/// moves entities along it, [`LightsAlong`](super::LightsAlong) puts lights on it. What makes no curve is told in a
/// warning, and everything stays as it was.
#[derive(Component, Reflect, Clone, Debug, PartialEq)]
#[reflect(Component)]
#[require(SplinePath, Transform)]
pub struct SplineCurve {
    /// Of the polynomials between knots; 3 is usual.
    pub degree: usize,
    /// In non-decreasing order: for an open curve as many as points, plus `degree + 1`; `degree` more for a closed one.
    pub knots: Vec<f32>,
    /// The control points, in meters.
    pub points: Vec<Vec3>,
    /// How much each point pulls, positive; none at all means 1 for each.
    pub weights: Vec<f32>,
    /// The side to which the normal of the first frame shows, as nearly as it can: up for who travels along.
    pub up: Vec3,
}

impl SplineCurve {
    /// With all knots given.
    pub fn new(degree: usize, knots: Vec<f32>, points: Vec<Vec3>) -> Self {
        Self { degree, knots, points, weights: Vec::new(), up: Vec3::Y }
    }

    /// One polynomial from the first to the last control point.
    pub fn bezier(points: Vec<Vec3>) -> Self {
        Self::open(points.len().saturating_sub(1), points)
    }

    /// From the first to the last control point, with equal distances between knots.
    pub fn open(degree: usize, points: Vec<Vec3>) -> Self {
        let mut knots = vec![0.0; points.len() + degree + 1];
        clamped_knots(&mut knots, degree);
        Self::new(degree, knots, points)
    }

    /// Without an end: after the last control point the first one follows again.
    pub fn closed(degree: usize, points: Vec<Vec3>) -> Self {
        let mut knots = vec![0.0; points.len() + 2 * degree + 1];
        uniform_knots(&mut knots, degree);
        Self::new(degree, knots, points)
    }

    /// The cubic curve through points.
    ///
    /// # Errors
    ///
    /// Where there are less than four points, or two that follow each other are the same.
    pub fn through(points: &[Vec3]) -> Result<Self, SplineError> {
        Ok(OwnedBSpline::through(points, 3)?.into())
    }

    /// With a weight for each control point.
    pub fn with_weights(mut self, weights: Vec<f32>) -> Self {
        self.weights = weights;
        self
    }

    /// The curve of the core.
    ///
    /// # Errors
    ///
    /// Says what is wrong with knots, points or weights.
    pub fn nurbs(&self) -> Result<OwnedNurbs<Vec3>, ShapeError> {
        Ok(OwnedBSpline::new(self.knots.clone(), self.degree, weighted(&self.points, &self.weights)?)?)
    }
}

impl From<OwnedBSpline<Vec3>> for SplineCurve {
    fn from(curve: OwnedBSpline<Vec3>) -> Self {
        let curve = curve.curve();
        Self::new(curve.degree(), curve.knots().knots().to_vec(), curve.points().to_vec())
    }
}

impl From<OwnedNurbs<Vec3>> for SplineCurve {
    fn from(curve: OwnedNurbs<Vec3>) -> Self {
        let curve = curve.curve();
        let points = curve.points().iter().map(|point| point.scaled / point.weight).collect();
        let weights = curve.points().iter().map(|point| point.weight).collect();
        Self::new(curve.degree(), curve.knots().knots().to_vec(), points).with_weights(weights)
    }
}

/// Points with their weights.
pub(super) fn weighted(points: &[Vec3], weights: &[f32]) -> Result<Vec<Homogeneous<Vec3>>, ShapeError> {
    if weights.is_empty() {
        return Ok(points.iter().map(|&point| Homogeneous::new(point, 1.0)).collect());
    }
    if weights.len() != points.len() {
        return Err(ShapeError::Weights { weights: weights.len(), points: points.len() });
    }
    Ok(points.iter().zip(weights).map(|(&point, &weight)| Homogeneous::new(point, weight)).collect())
}
