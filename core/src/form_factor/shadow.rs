//! From a point to a polygon past convex blockers, exactly: what the shadows leave of the polygon, piece by piece.
//!
//! A blocker and the point span a pyramid; what lies inside is hidden. The polygon is cut by the planes of the pyramid,
//! so that nothing is projected or divided by, and blockers may cross the horizon of the point or reach behind it.

use crate::math::{Real, Vector};

use super::polygon::lambert_sum;

/// Corners of the convex pieces that a polygon is cut into.
const CORNERS: usize = 40;
/// Corners of the parts in which a larger blocker or receiver is handled.
const FAN_CORNERS: usize = 16;
/// Pieces are cut again inside of others at most so often; each has at most half the area of the one around it.
const DEPTH: u32 = 40;

type Piece<V> = heapless::Vec<V, CORNERS>;

/// Share of the power leaving `point` that lands on the front of a convex `polygon` past convex planar `blockers`.
///
/// `normal` has length 1; `polygon` runs counter-clockwise seen from its front. Blockers stop light from both sides,
/// with their edges and in any order; those in the plane of the polygon, behind it or behind the point stop nothing,
/// and neither do those that the point sees edge-on. In `[0, 1]`; the error is a few units in the last place of 1 for
/// each piece. The pieces are those of Lambert's formula. Time grows with the number of visible pieces times that of the
/// blockers, at worst with the cube of the latter. Memory does not grow with them: pieces below 2^-40 of the area of the
/// polygon are not cut any further and count as visible, so that the stack holds 41 levels of 10 kB (`f64`) at most. NaN coordinates give NaN or ignore the blocker that has them.
pub fn visible_point_to_polygon<V: Vector>(point: V, normal: V, polygon: &[V], blockers: &[&[V]]) -> V::Scalar {
    seen(point, normal, polygon, blockers.iter().flat_map(|blocker| fans(blocker)))
}

/// A convex part of a convex polygon: its first corner and some neighbors among the others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fan<'a, V> {
    apex: V,
    rim: &'a [V],
}

impl<V: Vector> Fan<'_, V> {
    pub(super) fn len(self) -> usize {
        1 + self.rim.len()
    }

    pub(super) fn corners(self) -> impl Iterator<Item = V> + Clone {
        core::iter::once(self.apex).chain(self.rim.iter().copied())
    }

    /// Pairs of corners, from each one to the next.
    pub(super) fn edges(self) -> impl Iterator<Item = (V, V)> + Clone {
        self.corners().zip(self.corners().cycle().skip(1))
    }
}

/// The parts of a convex polygon with few corners each; nothing where there is no area.
pub(super) fn fans<V: Vector>(polygon: &[V]) -> impl Iterator<Item = Fan<'_, V>> + Clone {
    let (apex, rim) = polygon.split_first().map_or((V::default(), polygon), |(&apex, rim)| (apex, rim));
    let step = FAN_CORNERS - 2;
    let starts = (0..rim.len().saturating_sub(1)).step_by(step);
    starts.map(move |start| Fan { apex, rim: &rim[start..rim.len().min(start + step + 1)] })
}

/// [`visible_point_to_polygon`] with blockers in parts.
pub(super) fn seen<'a, V: Vector>(
    point: V,
    normal: V,
    polygon: &[V],
    blockers: impl Iterator<Item = Fan<'a, V>> + Clone,
) -> V::Scalar {
    let parts = fans(polygon).filter_map(|part| {
        let corners: Piece<V> = part.corners().map(|corner| corner - point).collect();
        let base = Base::new(&corners)?;
        Some(Eye { point, normal, base }.visible_share(corners, blockers.clone(), 0))
    });
    parts.sum::<V::Scalar>().max(V::Scalar::ZERO)
}

/// The plane of the receiver, with the point as origin.
struct Base<V: Vector> {
    /// Of length 1, toward the point.
    normal: V,
    /// Of the point above the plane, larger than 0.
    height: V::Scalar,
    /// Distances below this one are rounding errors.
    tolerance: V::Scalar,
}

impl<V: Vector> Base<V> {
    /// Nothing where the point does not lie in front.
    fn new(corners: &[V]) -> Option<Self> {
        let normal = area_vector(corners.iter().copied()).normalize_or_zero();
        let reach = corners.iter().fold(V::Scalar::ZERO, |reach, corner| reach.max(corner.length_squared())).sqrt();
        let height = -normal.dot(corners[0]);
        let tolerance = V::Scalar::from_f64(4.0) * V::Scalar::EPSILON * reach;
        (height > tolerance).then_some(Self { normal, height, tolerance })
    }
}

/// Twice the area of a polygon times its normal (Newell's method).
pub(super) fn area_vector<V: Vector>(corners: impl Iterator<Item = V> + Clone) -> V {
    let Some(first) = corners.clone().next() else { return V::default() };
    let pairs = corners.clone().zip(corners.skip(1));
    pairs.fold(V::default(), |sum, (from, to)| sum + (from - first).cross(to - first))
}

/// Inner normals of the planes of what a blocker hides, with the point as origin: those through the edges and, where
/// the blocker reaches behind the base, the one through the line in which it meets the base.
struct Pyramid<V> {
    planes: heapless::Vec<V, { FAN_CORNERS + 1 }>,
}

impl<V: Vector> Pyramid<V> {
    /// Nothing where the blocker is seen edge-on or does not lie between the point and the base.
    fn new(point: V, blocker: &Fan<V>, base: &Base<V>) -> Option<Self> {
        let zero = V::Scalar::ZERO;
        let corners = blocker.corners().map(|corner| corner - point);
        let mut facing = area_vector(corners.clone()).normalize_or_zero();
        let distance = corners.clone().fold(zero, |sum, corner| sum + facing.dot(corner));
        let reach = corners.clone().fold(zero, |sum, corner| sum + corner.length());
        let is_beside = distance.abs() > V::Scalar::from_f64(8.0) * V::Scalar::EPSILON * reach;
        if !is_beside {
            return None;
        }
        let above = corners.clone().map(|corner| base.normal.dot(corner) + base.height);
        let (low, high) = above.fold((zero, zero), |(low, high), above| (low.min(above), high.max(above)));
        if high <= base.tolerance {
            return None;
        }
        let is_flipped = distance < zero;
        let distance = distance.abs() / V::Scalar::from_usize(blocker.len());
        if is_flipped {
            facing = -facing;
        }
        let edges = corners.clone().zip(corners.clone().cycle().skip(1));
        let planes = edges.map(|(from, to)| if is_flipped { to.cross(from) } else { from.cross(to) });
        let crosses_base = low < -base.tolerance;
        let end = crosses_base.then(|| base.normal * distance + facing * base.height);
        let planes = planes.chain(end).map(V::normalize_or_zero).filter(|plane| *plane != V::default());
        Some(Self { planes: planes.collect() })
    }

    /// Whether one of the planes has the whole piece outside.
    fn misses(&self, piece: &[V], tolerance: V::Scalar) -> bool {
        self.planes.iter().any(|plane| piece.iter().all(|corner| plane.dot(*corner) <= tolerance))
    }

    /// What it hides of a piece.
    fn hidden(&self, piece: &[V], tolerance: V::Scalar) -> Piece<V> {
        let whole = piece.iter().copied().collect();
        self.planes.iter().fold(whole, |rest: Piece<V>, &plane| cut(&rest, plane, tolerance))
    }

    /// The largest of the parts that it leaves of a piece, one for each of its planes at most; `smaller` gets the others.
    fn around(&self, piece: Piece<V>, tolerance: V::Scalar, mut smaller: impl FnMut(Piece<V>)) -> Piece<V> {
        let (mut largest, mut rest) = (Piece::new(), piece);
        for &plane in &self.planes {
            let outside = cut(&rest, -plane, tolerance);
            if !outside.is_empty() {
                rest = cut(&rest, plane, tolerance);
                let [larger, other] = larger_first(largest, outside);
                largest = larger;
                if !other.is_empty() {
                    smaller(other);
                }
            }
        }
        largest
    }
}

/// The part of a convex piece on the positive side of a plane through the origin; empty where it has no area.
pub(super) fn cut<V: Vector>(piece: &[V], plane: V, tolerance: V::Scalar) -> Piece<V> {
    let mut part = Piece::new();
    let Some(&last) = piece.last() else { return part };
    let (mut from, mut from_height) = (last, plane.dot(last));
    let mut is_inside = false;
    for &to in piece {
        let to_height = plane.dot(to);
        let low = from_height.min(to_height);
        let high = from_height.max(to_height);
        if low < -tolerance && high > tolerance {
            let _ = part.push(from.lerp(to, from_height / (from_height - to_height)));
        }
        if to_height >= -tolerance {
            let _ = part.push(to);
        }
        is_inside |= to_height > tolerance;
        (from, from_height) = (to, to_height);
    }
    if !is_inside {
        part.clear();
    }
    part
}

/// A point that looks at a polygon.
struct Eye<V: Vector> {
    point: V,
    normal: V,
    base: Base<V>,
}

impl<V: Vector> Eye<V> {
    /// Lambert's sum over what the blockers leave of a piece.
    ///
    /// Of its parts the largest stays in the loop and the smaller ones recurse, so that each call gets at most half the
    /// area of the one above it, however many blockers there are.
    fn visible_share<'a>(
        &self,
        mut piece: Piece<V>,
        mut blockers: impl Iterator<Item = Fan<'a, V>> + Clone,
        depth: u32,
    ) -> V::Scalar {
        let mut sum = V::Scalar::ZERO;
        while depth < DEPTH && !piece.is_empty() {
            if piece.len() + FAN_CORNERS + 1 > CORNERS {
                let [larger, smaller] = halves(&piece);
                sum += self.visible_share(smaller, blockers.clone(), depth + 1);
                piece = larger;
                continue;
            }
            let Some(blocker) = blockers.next() else { break };
            let Some(pyramid) = Pyramid::new(self.point, &blocker, &self.base) else { continue };
            let tolerance = self.base.tolerance;
            if !pyramid.misses(&piece, tolerance) && !pyramid.hidden(&piece, tolerance).is_empty() {
                let recurse = |part| self.visible_share(part, blockers.clone(), depth + 1);
                piece = pyramid.around(piece, tolerance, |part| sum += recurse(part));
            }
        }
        let Some(&last) = piece.last() else { return sum };
        sum - lambert_sum(V::default(), self.normal, last, piece.iter().copied())
    }
}

/// Parts of a convex piece with half of the corners each, the larger one first.
fn halves<V: Vector>(piece: &[V]) -> [Piece<V>; 2] {
    let middle = piece.len() / 2;
    let first = piece[..=middle].iter().copied().collect();
    larger_first(first, piece[middle..].iter().chain(piece.first()).copied().collect())
}

fn larger_first<V: Vector>(first: Piece<V>, second: Piece<V>) -> [Piece<V>; 2] {
    let [first_area, second_area] = [&first, &second].map(|piece| area_vector(piece.iter().copied()).length_squared());
    if first_area >= second_area { [first, second] } else { [second, first] }
}
