//! Which polygons may stand between two others: most do not, and each one that does costs time.

use glam::DVec3;

use crate::geometry::{Geometry, Piece};
use crate::polygon::Polygon;

/// What rounding may do to a coordinate, as a share of the size of the polygons.
const ROUNDING: f64 = 1e-9;

/// The blockers that some parts have before them and some behind: none in a convex room.
pub fn possible_blockers(geometry: &Geometry) -> Vec<&Piece> {
    let is_amid = |blocker: &&Piece| {
        let heights = || {
            let others = geometry.parts.iter().filter(|part| !part.lies_on(blocker));
            others.flat_map(|part| part.polygon.corners.iter()).map(|&corner| blocker.polygon.height(corner))
        };
        let margin = ROUNDING * blocker.polygon.radius;
        heights().any(|height| height > margin) && heights().any(|height| height < -margin)
    };
    geometry.blockers.iter().filter(is_amid).collect()
}

/// The corners of all polygons that may block the view between two parts.
pub fn blockers_between<'a>(possible: &[&'a Piece], a: &Piece, b: &Piece) -> Vec<&'a [DVec3]> {
    let between = |blocker: &&&Piece| {
        let is_surface_of_either = a.lies_on(blocker) || b.lies_on(blocker);
        !is_surface_of_either && may_block(&blocker.polygon, &a.polygon, &b.polygon)
    };
    possible.iter().filter(between).map(|blocker| &blocker.polygon.corners[..]).collect()
}

/// Not, if some plane has the blocker on one side and the space between the two on the other.
fn may_block(blocker: &Polygon, a: &Polygon, b: &Polygon) -> bool {
    a.faces(blocker) && b.faces(blocker) && !separates(blocker, a, b) && !hull_misses(blocker, a, b)
}

/// Both lie on one side of the blocker.
fn separates(blocker: &Polygon, a: &Polygon, b: &Polygon) -> bool {
    let margin = ROUNDING * a.radius.max(b.radius);
    let heights = || a.corners.iter().chain(&b.corners).map(|&corner| blocker.height(corner));
    heights().all(|height| height >= -margin) || heights().all(|height| height <= margin)
}

/// A plane through an edge of one and a corner of the other bounds the space between them and leaves the blocker out.
fn hull_misses(blocker: &Polygon, a: &Polygon, b: &Polygon) -> bool {
    let margin = ROUNDING * a.radius.max(b.radius);
    let side = |one: &Polygon, other: &Polygon| {
        one.edges().any(|(from, to)| {
            other.corners.iter().any(|&corner| {
                let normal = (to - from).cross(corner - from).normalize_or_zero();
                let height = |&point: &DVec3| normal.dot(point - from);
                let hull = || one.corners.iter().chain(&other.corners).map(height);
                let outside = || blocker.corners.iter().map(height);
                normal != DVec3::ZERO
                    && (hull().all(|h| h <= margin) && outside().all(|h| h >= -margin)
                        || hull().all(|h| h >= -margin) && outside().all(|h| h <= margin))
            })
        })
    };
    side(a, b) || side(b, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(side: f64, center: DVec3) -> Polygon {
        let h = 0.5 * side;
        let corner = |x, y| center + DVec3::new(x, y, 0.0);
        Polygon::new(vec![corner(-h, -h), corner(h, -h), corner(h, h), corner(-h, h)])
    }

    /// Two squares that face each other: what is between them may block; what touches the space between them may not.
    #[test]
    fn only_what_is_between() {
        let (floor, ceiling) = (square(1.0, DVec3::ZERO), square(1.0, DVec3::Z).turned());
        let blocks = |side, center| may_block(&square(side, center), &floor, &ceiling);
        assert!(blocks(0.1, DVec3::new(0.0, 0.0, 0.5)));
        assert!(blocks(0.1, DVec3::new(0.5, 0.0, 0.5)));
        assert!(!blocks(0.1, DVec3::new(0.55, 0.0, 0.5)));
        assert!(!blocks(0.1, DVec3::new(0.0, 0.0, -0.5)));
        assert!(!blocks(0.1, DVec3::new(0.0, 0.0, 1.0)));
    }
}
