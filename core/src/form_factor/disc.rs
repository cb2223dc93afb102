//! Discs: from a point to one in any position, and between two on one axis, in closed form.

use crate::math::{Real, Vector};

/// A flat disc.
#[derive(Clone, Copy, Debug)]
pub struct Disc<V: Vector> {
    /// Its center.
    pub center: V,
    /// Of length 1, on the side that sends and receives.
    pub normal: V,
    /// Positive.
    pub radius: V::Scalar,
}

/// Share of the power leaving `point` that lands on the front of a disc in any position, with nothing between.
///
/// `normal` has length 1. What lies below the horizon of `point` does not count. In `[0, 1]`; 0 behind the disc and in
/// its plane. The absolute error is about 5 roundings over the distance of the point from the rim in radii, where that
/// is below 1. The contour integral `1/2pi int n . (r x dr) / r^2` of Lambert's formula over the arc above the horizon
/// and its chord.
pub fn point_to_disc<V: Vector>(point: V, normal: V, disc: &Disc<V>) -> V::Scalar {
    let zero = V::Scalar::ZERO;
    let to_center = disc.center - point;
    let height = -to_center.dot(disc.normal);
    let is_in_front = height > zero;
    if !is_in_front {
        return zero;
    }
    let across = to_center + disc.normal * height;
    let offset = across.length();
    let first = if offset > zero { across / offset } else { any_perpendicular(disc.normal) };
    let second = disc.normal.cross(first);
    // The height of the rim above the horizon is `level + swing cos(angle - turn)`.
    let level = to_center.dot(normal);
    let (along, aside) = (disc.radius * first.dot(normal), disc.radius * second.dot(normal));
    let swing = (along * along + aside * aside).sqrt();
    if level <= -swing {
        return zero;
    }
    let rim = Rim {
        squared: to_center.length_squared() + disc.radius * disc.radius,
        swing: (disc.radius + disc.radius) * offset,
        root: rim_root(disc.radius, height, offset),
        constant: disc.radius * disc.radius * disc.normal.dot(normal),
        cosine: disc.radius * to_center.cross(second).dot(normal),
        sine: -disc.radius * to_center.cross(first).dot(normal),
    };
    let sum = if level >= swing {
        rim.whole()
    } else {
        let (turn, half) = (aside.atan2(along), (-level / swing).acos());
        let place = |angle: V::Scalar| to_center + (first * angle.cos() + second * angle.sin()) * disc.radius;
        let (rise, set) = (place(turn - half), place(turn + half));
        rim.arc(turn + half) - rim.arc(turn - half) + set.cross(rise).dot(normal).atan2(set.dot(rise))
    };
    (-sum / (V::Scalar::PI + V::Scalar::PI)).clamp(zero, V::Scalar::ONE)
}

/// The integrand around a rim: `(constant + cosine cos t + sine sin t) / (squared + swing cos t)`.
#[derive(Clone, Copy, Debug)]
struct Rim<R> {
    squared: R,
    swing: R,
    /// `sqrt(squared^2 - swing^2)`.
    root: R,
    constant: R,
    cosine: R,
    sine: R,
}

impl<R: Real> Rim<R> {
    /// The integral over the whole rim.
    fn whole(&self) -> R {
        (R::PI + R::PI) / self.root * (self.constant - self.cosine * self.swing / (self.squared + self.root))
    }

    /// The integral from 0 to an angle: `t - 2 atan(m sin t / (1 + m cos t))` with `m = swing / (squared + root)` is
    /// `root int dt / (squared + swing cos t)` without jumps.
    fn arc(&self, angle: R) -> R {
        let (sin, cos) = (angle.sin(), angle.cos());
        let sum = self.squared + self.root;
        let ratio = self.swing / sum;
        let is_centered = ratio < R::EPSILON;
        let lag = (ratio * sin).atan2(R::ONE + ratio * cos);
        let lag_over_swing = if is_centered { sin / sum } else { lag / self.swing };
        let ln =
            |x: R| if is_centered { x / self.squared } else { (self.swing / self.squared * x).ln_1p() / self.swing };
        let of_constant = (angle - lag - lag) / self.root;
        let of_cosine =
            (self.squared + self.squared) / self.root * lag_over_swing - self.swing * angle / (self.root * sum);
        self.constant * of_constant + self.cosine * of_cosine - self.sine * ln(cos)
    }
}

/// From a point to a disc that it faces in a parallel plane at `distance`, the center `offset` away from the normal.
///
/// In `[0, 1]`, to a few roundings. Howell's catalogue B-13, and B-12 where the offset is 0.
pub fn point_to_parallel_disc<R: Real>(radius: R, distance: R, offset: R) -> R {
    let (squared, height) = (radius * radius, distance * distance);
    let root = rim_root(radius, distance, offset);
    let beyond = height + offset * offset - squared;
    if beyond > R::ZERO {
        let twice = squared + squared;
        twice / root * (height / (root + beyond))
    } else {
        (R::ONE - beyond / root) / (R::ONE + R::ONE)
    }
}

/// From a point to a disc in a plane parallel to the normal: the plane is `distance` away, and the center is `offset`,
/// at least `radius`, ahead along the normal.
///
/// In `[0, 1/2]`, to a few roundings. Howell's catalogue B-14.
pub fn point_to_perpendicular_disc<R: Real>(radius: R, distance: R, offset: R) -> R {
    let twice = radius * (radius + radius);
    let root = rim_root(radius, distance, offset);
    let sum = radius * radius + distance * distance + offset * offset + root;
    twice / root * (distance * offset / sum)
}

/// From a disc of radius `from` to one of radius `to` on the same axis that faces it at `distance`.
///
/// In `[0, 1]`, to a few roundings. Howell's catalogue C-41.
pub fn coaxial_discs<R: Real>(from: R, to: R, distance: R) -> R {
    let sum = from * from + to * to + distance * distance;
    to * (to + to) / (sum + rim_root(from, distance, to))
}

/// The geometric mean of the squares of the smallest and the largest distance of a point from a rim:
/// `sqrt((r^2 + h^2 + a^2)^2 - 4 r^2 a^2)` without cancellation.
fn rim_root<R: Real>(radius: R, height: R, offset: R) -> R {
    let (near, far) = (offset - radius, offset + radius);
    ((near * near + height * height) * (far * far + height * height)).sqrt()
}

fn any_perpendicular<V: Vector>(normal: V) -> V {
    let [x, y, z] = normal.to_array();
    let zero = V::Scalar::ZERO;
    let axis = if x.abs() < y.abs().min(z.abs()) {
        [zero, -z, y]
    } else if y.abs() < z.abs() {
        [z, zero, -x]
    } else {
        [-y, x, zero]
    };
    V::from_array(axis).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::form_factor::point_to_polygon;

    fn upright(center: DVec3, radius: f64) -> Disc<DVec3> {
        Disc { center, normal: DVec3::NEG_Z, radius }
    }

    /// Howell's forms, for points in special positions.
    #[test]
    fn special_positions() {
        for (radius, distance, offset) in [(1.0, 1.0, 0.5), (1.0, 1.0, 2.0), (0.5, 0.1, 0.0), (3.0, 0.2, 2.9)] {
            let disc = upright(DVec3::new(offset, 0.0, distance), radius);
            let found = point_to_disc(DVec3::ZERO, DVec3::Z, &disc);
            assert!((found - point_to_parallel_disc(radius, distance, offset)).abs() < 1e-14);
        }
        let found = point_to_disc(DVec3::ZERO, DVec3::X, &upright(DVec3::new(1.0, 0.0, 2.0), 0.5));
        assert!((found - point_to_perpendicular_disc(0.5, 2.0, 1.0)).abs() < 1e-15);
    }

    /// Polygons around the rim come to the disc as the square of the number of their corners, clipped or not.
    #[test]
    fn the_limit_of_polygons() {
        const CORNERS: usize = 2000;
        let tilts =
            [DVec3::Z, DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::new(0.48, -0.6, -0.64), DVec3::new(0.0, 0.8, 0.6)];
        for center in [DVec3::new(0.3, 0.2, 1.0), DVec3::new(0.0, 0.0, 0.3), DVec3::new(-4.0, 3.0, 2.0)] {
            let disc = upright(center, 1.0);
            let polygon: [DVec3; CORNERS] = core::array::from_fn(|k| {
                let angle = -core::f64::consts::TAU * k as f64 / CORNERS as f64;
                center + DVec3::new(Real::cos(angle), Real::sin(angle), 0.0)
            });
            for normal in tilts {
                let expected = point_to_polygon(DVec3::ZERO, normal, &polygon);
                let found = point_to_disc(DVec3::ZERO, normal, &disc);
                // The polygon lacks a share of the disc of 2/3 (pi / n)^2.
                assert!((found - expected).abs() < 2e-6, "{center} {normal}: {found} {expected}");
                let (single, single_normal) = (disc.center.as_vec3(), disc.normal.as_vec3());
                let single = Disc { center: single, normal: single_normal, radius: 1.0 };
                let single = point_to_disc(Vec3::ZERO, normal.as_vec3(), &single);
                assert!((f64::from(single) - found).abs() < 2e-6, "{center} {normal}: {single} {found}");
            }
        }
    }

    #[test]
    fn discs_that_see_nothing() {
        assert_eq!(point_to_disc(DVec3::Z * 2.0, DVec3::NEG_Z, &upright(DVec3::Z, 1.0)), 0.0);
        assert_eq!(point_to_disc(DVec3::ZERO, DVec3::NEG_Z, &upright(DVec3::Z, 1.0)), 0.0);
        assert_eq!(point_to_disc(DVec3::Z, DVec3::NEG_Z, &upright(DVec3::Z, 1.0)), 0.0);
        assert_eq!(point_to_disc(DVec3::Z, DVec3::Z, &upright(DVec3::NAN, 1.0)), 0.0);
    }

    #[test]
    fn discs_face_each_other_in_turn() {
        let (there, back) = (coaxial_discs(1.0, 2.0, 1.0), coaxial_discs(2.0, 1.0, 1.0));
        assert!((there - 4.0 * back).abs() < 1e-15);
        assert!((coaxial_discs(1.0, 1.0, 1e-9) - 1.0).abs() < 1e-8);
    }
}
