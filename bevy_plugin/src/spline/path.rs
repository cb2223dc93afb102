//! A curve by the distance along it.

use bevy::prelude::*;
use radiosity::spline::{Curve, Frame, Jet, OwnedNurbs, Travel, close_frames};

use super::{ShapeError, SplineCurve};

/// How long a [`SplineCurve`] is and what lies at a distance along it. Kept up to date with its control points.
#[derive(Component, Clone, Debug, Default)]
pub struct SplinePath(Option<Measured>);

/// Lengths that are kept, whatever the number of knots.
const LENGTHS: usize = 64;
/// Frames between two knots.
const FRAMES: usize = 16;
/// Of the length of the control polygon: how exactly the curve is measured.
const TOLERANCE: f32 = 1e-5;

#[derive(Clone, Debug)]
struct Measured {
    travel: Travel<Own, LENGTHS>,
    /// At equal distances, from the beginning to the end.
    frames: Vec<Frame<Vec3>>,
    is_closed: bool,
}

impl SplinePath {
    /// Measures a curve.
    ///
    /// # Errors
    ///
    /// Says what is wrong with it.
    pub fn new(curve: &SplineCurve) -> Result<Self, ShapeError> {
        let nurbs = curve.nurbs()?;
        let (is_closed, pieces) = (nurbs.curve().is_closed(), nurbs.curve().knots().spans().count());
        let polygon: f32 = curve.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let travel = Travel::new(Own(nurbs), TOLERANCE * polygon);
        if !(travel.length() > 0.0 && travel.length().is_finite()) {
            return Err(ShapeError::Nothing);
        }
        let mut frames: Vec<Frame<Vec3>> = Vec::new();
        for k in 0..=FRAMES * pieces {
            let jet = travel.at(travel.length() * k as f32 / (FRAMES * pieces) as f32);
            frames.push(match frames.last() {
                Some(before) => before.next(jet.point, jet.first),
                None => Frame::new(jet.point, jet.first, curve.up),
            });
        }
        if is_closed {
            close_frames(&mut frames);
        }
        Ok(Self(Some(Measured { travel, frames, is_closed })))
    }

    /// In meters; 0 until there is a curve.
    pub fn length(&self) -> f32 {
        self.0.as_ref().map_or(0.0, |measured| measured.travel.length())
    }

    /// Whether the way goes on at the beginning after the end.
    pub fn is_closed(&self) -> bool {
        self.0.as_ref().is_some_and(|measured| measured.is_closed)
    }

    /// The place at a distance in meters, in the space of the curve, with directions that turn about the curve no more
    /// than they must; none until there is a curve.
    ///
    /// A closed curve goes round; an open one is left at neither end.
    pub fn at(&self, distance: f32) -> Option<Frame<Vec3>> {
        let Measured { travel, frames, is_closed } = self.0.as_ref()?;
        let length = travel.length();
        let distance = if *is_closed { distance.rem_euclid(length) } else { distance.clamp(0.0, length) };
        let jet = travel.at(distance);
        let before = (distance / length * (frames.len() - 1) as f32) as usize;
        Some(frames.get(before).or(frames.last())?.next(jet.point, jet.first))
    }

    /// The places in the middles of equal parts of the way.
    pub fn evenly(&self, parts: usize) -> impl Iterator<Item = Frame<Vec3>> {
        (0..parts).filter_map(move |k| self.at(self.length() * (k as f32 + 0.5) / parts as f32))
    }
}

/// A curve of its own.
#[derive(Clone, Debug)]
struct Own(OwnedNurbs<Vec3>);

impl Curve for Own {
    type Point = Vec3;

    fn domain(&self) -> [f32; 2] {
        self.0.curve().domain()
    }
    fn at(&self, t: f32) -> Jet<Vec3> {
        Curve::at(&self.0.curve(), t)
    }
    fn point(&self, t: f32) -> Vec3 {
        self.0.curve().point(t)
    }
    fn next_break(&self, t: f32) -> f32 {
        self.0.curve().next_break(t)
    }
}

/// Measures the curves that changed.
pub(super) fn update_paths(mut curves: Query<(NameOrEntity, &SplineCurve, &mut SplinePath), Changed<SplineCurve>>) {
    for (name, curve, mut path) in &mut curves {
        match SplinePath::new(curve) {
            Ok(new) => *path = new,
            Err(error) => warn!("the way along the curve \"{name}\" stays as it was: {error}"),
        }
    }
}
