//! Surfaces as components.

use std::f32::consts::TAU;

use bevy::prelude::*;
use radiosity::spline::{Axis, Homogeneous, OwnedSurface, clamped_knots, coons, extrusion, loft, revolution, ruled};

use super::curve::weighted;
use super::{ShapeError, SplineCurve, SplineTolerance};

/// A surface of splines, in the space of its entity; change it as you like, and its mesh follows.
///
/// The mesh has `UV_0` over `0..1`, and `UV_1` so that texels of a lightmap have the same area: a bake takes them as they
/// are, with the true normals of the surface. What makes no surface is told in a warning, and the mesh stays as it was.
#[derive(Component, Reflect, Clone, Debug, PartialEq)]
#[reflect(Component)]
#[require(SplineTolerance, Transform, Visibility)]
pub enum SplineSurface {
    /// A net of control points: Bezier, B-spline or NURBS.
    Net(ControlNet),
    /// A curve that turns around an axis.
    Revolution {
        /// For an axis that points up and a curve that rises, the front is outside.
        profile: SplineCurve,
        /// A point on the axis.
        foot: Vec3,
        /// Of any length but zero.
        axis: Vec3,
        /// In radians, at most a full turn either way.
        angle: f32,
    },
    /// A curve that moves straight on.
    Extrusion {
        /// `u` runs along it.
        curve: SplineCurve,
        /// Its way.
        along: Vec3,
    },
    /// Straight lines from one curve to another.
    Ruled {
        /// Where `v` begins.
        first: SplineCurve,
        /// Where `v` ends.
        last: SplineCurve,
    },
    /// A skin over curves.
    Loft {
        /// In their order along `v`, at least two.
        curves: Vec<SplineCurve>,
        /// Along `v`, less than the number of curves.
        degree: usize,
    },
    /// What fills four curves that meet at corners.
    Coons {
        /// Bottom, right, top and left; bottom and top run along `u`, left and right along `v`.
        edges: Vec<SplineCurve>,
    },
}

/// The control points of a surface, in rows along `u`.
#[derive(Reflect, Clone, Debug, PartialEq)]
pub struct ControlNet {
    /// Along `u` and `v`; 3 is usual.
    pub degrees: [usize; 2],
    /// Along `u` and `v`, in non-decreasing order, `degree + 1` more than points.
    pub knots: [Vec<f32>; 2],
    /// In meters, row by row.
    pub points: Vec<Vec3>,
    /// How much each point pulls, positive; none at all means 1 for each.
    pub weights: Vec<f32>,
}

impl ControlNet {
    /// One polynomial over rows of so many points.
    pub fn bezier(columns: usize, points: Vec<Vec3>) -> Self {
        let rows = points.len() / columns.max(1);
        Self::open([columns, rows].map(|count| count.saturating_sub(1)), columns, points)
    }

    /// From the first to the last row and column of points, with equal distances between knots.
    pub fn open(degrees: [usize; 2], columns: usize, points: Vec<Vec3>) -> Self {
        let counts = [columns, points.len() / columns.max(1)];
        let knots = [0, 1].map(|k| {
            let mut knots = vec![0.0; counts[k] + degrees[k] + 1];
            clamped_knots(&mut knots, degrees[k]);
            knots
        });
        Self { degrees, knots, points, weights: Vec::new() }
    }

    /// With a weight for each control point.
    pub fn with_weights(mut self, weights: Vec<f32>) -> Self {
        self.weights = weights;
        self
    }

    fn surface(&self) -> Result<OwnedSurface<Homogeneous<Vec3>>, ShapeError> {
        Ok(OwnedSurface::new(self.knots.clone(), self.degrees, weighted(&self.points, &self.weights)?)?)
    }
}

impl SplineSurface {
    /// A curve that turns once around the vertical through the origin; `x` of its points is the radius, `y` the height.
    pub fn revolution(profile: SplineCurve) -> Self {
        Self::Revolution { profile, foot: Vec3::ZERO, axis: Vec3::Y, angle: TAU }
    }

    /// The surface of the core.
    ///
    /// # Errors
    ///
    /// Says what is wrong with knots, points, weights or curves.
    pub fn surface(&self) -> Result<OwnedSurface<Homogeneous<Vec3>>, ShapeError> {
        Ok(match self {
            Self::Net(net) => net.surface()?,
            Self::Revolution { profile, foot, axis, angle } => {
                revolution(&profile.nurbs()?.curve(), Axis { origin: *foot, direction: *axis }, *angle)?
            }
            Self::Extrusion { curve, along } => extrusion(&curve.nurbs()?.curve(), *along)?,
            Self::Ruled { first, last } => ruled(&first.nurbs()?.curve(), &last.nurbs()?.curve())?,
            Self::Loft { curves, degree } => {
                let curves = curves.iter().map(SplineCurve::nurbs).collect::<Result<Vec<_>, _>>()?;
                let curves: Vec<_> = curves.iter().map(|curve| curve.curve()).collect();
                loft(&curves, *degree)?
            }
            Self::Coons { edges } => {
                let [bottom, right, top, left] = &edges[..] else {
                    return Err(ShapeError::Edges { edges: edges.len() });
                };
                let edges = [bottom.nurbs()?, right.nurbs()?, top.nurbs()?, left.nurbs()?];
                let [bottom, right, top, left] = [0, 1, 2, 3].map(|k| edges[k].curve());
                coons([&bottom, &right, &top, &left])?
            }
        })
    }
}

impl From<ControlNet> for SplineSurface {
    fn from(net: ControlNet) -> Self {
        Self::Net(net)
    }
}

impl From<&OwnedSurface<Homogeneous<Vec3>>> for ControlNet {
    fn from(surface: &OwnedSurface<Homogeneous<Vec3>>) -> Self {
        use radiosity::spline::Direction::{U, V};
        let surface = surface.surface();
        let knots = [U, V].map(|direction| surface.knots(direction));
        Self {
            degrees: knots.map(|knots| knots.degree()),
            knots: knots.map(|knots| knots.knots().to_vec()),
            points: surface.points().iter().map(|point| point.scaled / point.weight).collect(),
            weights: surface.weights().collect(),
        }
    }
}
