//! From a point to a polygon past convex blockers, exactly: what the shadows leave of the polygon, piece by piece.
//!
//! A blocker and the point span a pyramid; what lies inside is hidden. The polygon is cut by the planes of the pyramid,
//! so that nothing is projected or divided by, and blockers may cross the horizon of the point or reach behind it.

use crate::math::{Real, Vector};

/// Corners of the convex pieces that a polygon is cut into.
const CORNERS: usize = 40;
/// Corners of the parts in which a larger blocker or receiver is handled.
const FAN_CORNERS: usize = 16;

type Piece<V> = heapless::Vec<V, CORNERS>;

/// Share of the power leaving `point` that lands on the front of a convex `polygon` past convex planar `blockers`.
///
/// `normal` has length 1; `polygon` runs counter-clockwise seen from its front. Blockers stop light from both sides,
/// with their edges and in any order; those in the plane of the polygon, behind it or behind the point stop nothing,
/// and neither do those that the point sees edge-on. In `[0, 1]`; the error is a few units in the last place of 1 for
/// each piece. The pieces are those of Lambert's formula. Time grows with the number of visible pieces, not with the
/// depth in which blockers hide each other. NaN coordinates give NaN or ignore the blocker that has them.
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
        let above = cut(&corners, normal, base.tolerance);
        Some(Eye { point, normal, base }.visible_share(&above, blockers.clone()))
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
        if distance.abs() <= V::Scalar::from_f64(8.0) * V::Scalar::EPSILON * reach {
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
    fn visible_share<'a>(&self, piece: &[V], mut blockers: impl Iterator<Item = Fan<'a, V>> + Clone) -> V::Scalar {
        if piece.len() + FAN_CORNERS + 1 > CORNERS {
            let (first, second) = (&piece[..=piece.len() / 2], &piece[piece.len() / 2..]);
            let second: Piece<V> = second.iter().chain(piece.first()).copied().collect();
            return self.visible_share(first, blockers.clone()) + self.visible_share(&second, blockers);
        }
        while let Some(blocker) = blockers.next() {
            let Some(pyramid) = Pyramid::new(self.point, &blocker, &self.base) else { continue };
            if pyramid.misses(piece, self.base.tolerance) || pyramid.hidden(piece, self.base.tolerance).is_empty() {
                continue;
            }
            return self.around(&pyramid, piece, blockers);
        }
        lambert_sum(piece, self.normal)
    }

    /// Lambert's sum over what further blockers leave of what one leaves: a piece for each of its planes.
    fn around<'a>(
        &self,
        pyramid: &Pyramid<V>,
        piece: &[V],
        blockers: impl Iterator<Item = Fan<'a, V>> + Clone,
    ) -> V::Scalar {
        let mut rest: Piece<V> = piece.iter().copied().collect();
        let mut sum = V::Scalar::ZERO;
        for &plane in &pyramid.planes {
            let outside = cut(&rest, -plane, self.base.tolerance);
            if !outside.is_empty() {
                sum += self.visible_share(&outside, blockers.clone());
                rest = cut(&rest, plane, self.base.tolerance);
            }
        }
        sum
    }
}

/// `1/2pi` times the sum over the edges of the angle they span times the height of the normal of their plane.
fn lambert_sum<V: Vector>(polygon: &[V], normal: V) -> V::Scalar {
    let edges = (0..polygon.len()).map(|i| {
        let (from, to) = (polygon[(i + 1) % polygon.len()], polygon[i]);
        let cross = from.cross(to);
        let length = cross.length();
        if length > V::Scalar::ZERO { length.atan2(from.dot(to)) * cross.dot(normal) / length } else { V::Scalar::ZERO }
    });
    edges.sum::<V::Scalar>() / (V::Scalar::PI + V::Scalar::PI)
}
