//! A flat convex polygon and what a plane makes of it.

use core::fmt;

use glam::{Vec3, Vec4};
use heapless::Vec;

/// Corners that a piece can have. Each cut adds one at most.
pub const CORNERS: usize = 16;

/// What counts as lying in a plane: this share of the largest coordinate.
const THICKNESS: f32 = 4e-6;

/// From where pieces are seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// A camera with perspective, here.
    Eye(Vec3),
    /// A camera without, that looks in this direction.
    Direction(Vec3),
}

impl Viewpoint {
    /// The eye as a homogeneous point; that of a direction lies infinitely far back.
    pub(super) fn homogeneous(self) -> Vec4 {
        match self {
            Self::Eye(eye) => eye.extend(1.0),
            Self::Direction(direction) => (-direction).extend(0.0),
        }
    }
}

/// A flat convex polygon, or what cuts have left of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Counter-clockwise seen from where the normal points.
    pub(super) corners: Vec<Vec3, CORNERS>,
    /// What it belongs to; anything that the caller finds it by. Both parts of a cut keep it.
    pub source: u32,
    pub(super) plane: Plane,
}

/// Points whose scalar product with the normal, of length 1, is the offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    normal: Vec3,
    offset: f32,
    /// What is nearer counts as lying in it.
    thickness: f32,
}

/// A polygon that is none, or pieces for which there is no room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplitError {
    /// The corners span no area, or one is not finite.
    Degenerate,
    /// A corner lies outside the plane of the others.
    Bent {
        /// Which one.
        corner: usize,
        /// How far outside, in the unit of the coordinates.
        distance: f32,
    },
    /// The outline turns inwards.
    Concave {
        /// At this corner.
        corner: usize,
    },
    /// More corners than [`CORNERS`].
    Corners,
    /// More pieces than there is room for.
    Full {
        /// Room for so many.
        pieces: usize,
    },
}

impl fmt::Display for SplitError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Degenerate => write!(f, "a polygon without area; leave it out, nobody sees it"),
            Self::Bent { corner, distance } => {
                write!(f, "corner {corner} lies {distance} outside the plane of its polygon; cut it into triangles")
            }
            Self::Concave { corner } => write!(f, "a polygon is not convex at corner {corner}; cut it into triangles"),
            Self::Corners => write!(f, "a polygon of more than {CORNERS} corners; cut it into smaller ones"),
            Self::Full { pieces } => write!(f, "more than {pieces} pieces; give room for more, or insert less"),
        }
    }
}

impl core::error::Error for SplitError {}

/// Where a piece lies, seen from a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Front,
    Back,
    Within,
    Both,
}

/// A corner at which an outline turns inwards by more than rounding does.
fn dent(corners: &[Vec3], plane: &Plane) -> Option<usize> {
    let count = corners.len();
    (0..count).find(|&k| {
        let [before, here, after] = [k + count - 1, k, k + 1].map(|corner| corners[corner % count]);
        let [arrives, leaves] = [here - before, after - here];
        let turn = arrives.cross(leaves).dot(plane.normal);
        turn < -plane.thickness * (arrives.length() + leaves.length())
    })
}

impl Piece {
    /// A convex polygon from its corners in order.
    ///
    /// # Errors
    ///
    /// Where it has no area, more than [`CORNERS`] corners, or is not flat or not convex.
    pub fn new(corners: &[Vec3], source: u32) -> Result<Self, SplitError> {
        let corners = Vec::from_slice(corners).map_err(|_| SplitError::Corners)?;
        let plane = Plane::through(&corners).ok_or(SplitError::Degenerate)?;
        let distances = || corners.iter().map(|&corner| plane.height(corner).abs()).enumerate();
        match distances().find(|&(_, distance)| distance > 16.0 * plane.thickness) {
            Some((corner, distance)) => Err(SplitError::Bent { corner, distance }),
            None => match dent(&corners, &plane) {
                Some(corner) => Err(SplitError::Concave { corner }),
                None => Ok(Self { corners, source, plane }),
            },
        }
    }

    /// Its corners in order.
    pub fn corners(&self) -> &[Vec3] {
        &self.corners
    }

    /// On which side of a plane it lies.
    pub(super) fn side_of(&self, plane: &Plane) -> Side {
        let heights = || self.corners.iter().map(|&corner| plane.height(corner));
        let (above, below) = (heights().any(|h| h > plane.thickness), heights().any(|h| h < -plane.thickness));
        match (above, below) {
            (true, true) => Side::Both,
            (true, false) => Side::Front,
            (false, true) => Side::Back,
            (false, false) => Side::Within,
        }
    }

    /// Its parts in front of and behind a plane that runs through it.
    pub(super) fn cut(&self, plane: &Plane) -> Result<[Self; 2], SplitError> {
        let (mut front, mut back) = (Vec::new(), Vec::new());
        let put = |part: &mut Vec<Vec3, CORNERS>, corner| part.push(corner).map_err(|_| SplitError::Corners);
        for (k, &a) in self.corners.iter().enumerate() {
            let b = self.corners[(k + 1) % self.corners.len()];
            let [height_a, height_b] = [a, b].map(|corner| plane.height(corner));
            if height_a >= -plane.thickness {
                put(&mut front, a)?;
            }
            if height_a <= plane.thickness {
                put(&mut back, a)?;
            }
            if height_a.min(height_b) < -plane.thickness && height_a.max(height_b) > plane.thickness {
                let cut = a + (b - a) * (height_a / (height_a - height_b));
                put(&mut front, cut)?;
                put(&mut back, cut)?;
            }
        }
        Ok([front, back].map(|corners| Self { corners, ..self.clone() }))
    }
}

impl Plane {
    /// The plane of a polygon; Newell's normal is right for any number of corners, whichever of them lie on a line.
    fn through(corners: &[Vec3]) -> Option<Self> {
        let next = |k: usize| corners[(k + 1) % corners.len()];
        let first = *corners.first()?;
        let doubled: Vec3 = (0..corners.len()).map(|k| (corners[k] - first).cross(next(k) - first)).sum();
        let normal = doubled.try_normalize()?;
        let thickness = THICKNESS * corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f32::max);
        let offset = corners.iter().map(|corner| corner.dot(normal)).sum::<f32>() / corners.len() as f32;
        offset.is_finite().then_some(Self { normal, offset, thickness })
    }

    fn height(&self, point: Vec3) -> f32 {
        self.normal.dot(point) - self.offset
    }

    /// Positive where the eye is in front, negative behind, 0 where the plane is seen edge-on.
    pub(super) fn height_of_eye(&self, eye: Vec4) -> f32 {
        let height = self.normal.dot(eye.truncate()) - self.offset * eye.w;
        if height.abs() <= self.thickness { 0.0 } else { height }
    }

    /// Through the eye and an edge: what separates on the screen. None where the edge is seen from its end.
    pub(super) fn of_sight(eye: Vec4, a: Vec3, b: Vec3, thickness: f32) -> Option<Self> {
        let normal = (eye.truncate() - a * eye.w).cross(b - a).try_normalize()?;
        Some(Self { normal, offset: normal.dot(a), thickness })
    }

    pub(super) fn thickness(&self) -> f32 {
        self.thickness
    }
}
