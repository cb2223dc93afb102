//! The painter's algorithm with its exceptions: from back to front, cut only where no order will do.

use glam::Vec4;
use heapless::Vec;

use super::piece::{Plane, Side};
use super::{Piece, SplitError, Viewpoint};

/// Puts pieces into an order in which none hides one that comes after it, and cuts those for which there is none: in a
/// cycle each hides the next, and of two that run through each other each hides a part of the other.
///
/// Newell, Newell and Sancha, "A Solution to the Hidden Surface Problem", 1972. A piece may come before another if they
/// are apart on the screen, if it lies behind the plane of the other, or if the other lies in front of its own. Where none
/// may come next, one is cut by the plane of another: pieces that are all on one side of each other's planes have an
/// order. Takes time with the square of their number, more where they are cut.
///
/// # Errors
///
/// Where there is no room for the parts. All pieces are there nevertheless, in an order that is wrong for some.
pub fn paint_order<const N: usize>(pieces: &mut Vec<Piece, N>, viewpoint: Viewpoint) -> Result<(), SplitError> {
    let eye = viewpoint.homogeneous();
    // The farthest first is mostly right at once.
    let depth = |piece: &Piece| piece.corners.iter().map(|&corner| nearness(eye, corner)).fold(f32::INFINITY, f32::min);
    pieces.sort_unstable_by(|a, b| depth(a).total_cmp(&depth(b)));
    let mut placed = 0;
    while placed < pieces.len() {
        let rest = &mut pieces[placed..];
        if let Some(next) = (0..rest.len()).find(|&k| rest.iter().all(|other| rest[k].may_precede(other, eye))) {
            rest[..=next].rotate_right(1);
            placed += 1;
        } else if let Some((cut, knife)) = knot(rest, eye) {
            let [front, back] = rest[cut].cut(&rest[knife].plane)?;
            pieces[placed + cut] = back;
            pieces.push(front).map_err(|_| SplitError::Full { pieces: N })?;
        } else {
            // Rounding alone holds them up.
            placed += 1;
        }
    }
    Ok(())
}

/// Grows towards the eye; the order counts, not the size.
fn nearness(eye: Vec4, corner: glam::Vec3) -> f32 {
    if eye.w > 0.0 { -corner.distance_squared(eye.truncate()) } else { corner.dot(eye.truncate()) }
}

/// A piece that another one runs through, both of which hold each other up.
fn knot(rest: &[Piece], eye: Vec4) -> Option<(usize, usize)> {
    let pairs = || (0..rest.len()).flat_map(|a| (0..rest.len()).map(move |b| (a, b))).filter(|(a, b)| a != b);
    let runs_through = |&(a, b): &(usize, usize)| rest[a].side_of(&rest[b].plane) == Side::Both;
    let holds_up = |a: usize, b: usize| !rest[a].may_precede(&rest[b], eye);
    pairs().filter(|&(a, b)| holds_up(a, b)).find(runs_through).or_else(|| {
        let of_others = pairs().filter(|&(a, b)| holds_up(b, a));
        of_others.into_iter().find(runs_through)
    })
}

impl Piece {
    /// Whether it can be drawn first without hiding too little.
    fn may_precede(&self, other: &Self, eye: Vec4) -> bool {
        core::ptr::eq(self, other)
            || self.is_behind(other, eye)
            || other.is_before(self, eye)
            || self.is_apart(other, eye)
            || other.is_apart(self, eye)
    }

    fn is_behind(&self, other: &Self, eye: Vec4) -> bool {
        match self.side_of(&other.plane) {
            Side::Within => true,
            side => side == far_side(other.plane.height_of_eye(eye)),
        }
    }

    fn is_before(&self, other: &Self, eye: Vec4) -> bool {
        self.side_of(&other.plane) == far_side(-other.plane.height_of_eye(eye))
    }

    /// Whether the line of an edge separates the two on the screen, or this one is seen edge-on.
    fn is_apart(&self, other: &Self, eye: Vec4) -> bool {
        if self.plane.height_of_eye(eye) == 0.0 {
            return true;
        }
        let thickness = self.plane.thickness().max(other.plane.thickness());
        (0..self.corners.len()).any(|k| {
            let [a, b] = [self.corners[k], self.corners[(k + 1) % self.corners.len()]];
            let Some(line) = Plane::of_sight(eye, a, b, thickness) else { return false };
            match self.side_of(&line) {
                Side::Front => matches!(other.side_of(&line), Side::Back | Side::Within),
                Side::Back => matches!(other.side_of(&line), Side::Front | Side::Within),
                Side::Both | Side::Within => false,
            }
        })
    }
}

/// The side of a plane that the eye does not see, given the height of the eye above it.
fn far_side(height_of_eye: f32) -> Side {
    if height_of_eye > 0.0 { Side::Back } else { Side::Front }
}
