//! The one ray-triangle test, which every tree and every target uses.

use glam::{Vec2, Vec3};

use super::{Hit, Ray};

/// How far above a triangle rays must start, in meters: beyond the rounding of its corners and of points on it.
#[inline]
pub fn lift(corners: &[Vec3; 3]) -> f32 {
    let [a, b, c] = corners;
    5e-6 * a.abs().max(b.abs()).max(c.abs()).max_element().max(1e-6)
}

/// A ray prepared for many triangles: the axes permuted and sheared so that it runs along +z.
///
/// Neighbors that share an edge leave no gap between them. Woop, Benthin and Wald,
/// "Watertight Ray/Triangle Intersection", JCGT 2013.
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay {
    pub(super) origin: Vec3,
    /// Across, across and along.
    pub(super) axes: [usize; 3],
    pub(super) shear: Vec3,
}

impl ShearedRay {
    /// Prepares a ray whose direction is not zero.
    #[inline]
    pub fn new(ray: &Ray) -> Self {
        let d = ray.direction;
        let z = d.abs().max_position();
        let (x, y) = if d[z] < 0.0 { ((z + 2) % 3, (z + 1) % 3) } else { ((z + 1) % 3, (z + 2) % 3) };
        let shear = Vec3::new(d[x] / d[z], d[y] / d[z], 1.0 / d[z]);
        Self { origin: ray.origin, axes: [x, y, z], shear }
    }

    /// Where the ray meets the triangle at a distance in `[0, end]`; edges belong to the triangle.
    #[inline]
    pub fn hit(&self, corners: &[Vec3; 3], triangle: u32, end: f32) -> Option<Hit> {
        let [x, y, z] = self.axes;
        let [a, b, c] = corners.map(|corner| corner - self.origin);
        let (ax, ay) = (a[x] - self.shear.x * a[z], a[y] - self.shear.y * a[z]);
        let (bx, by) = (b[x] - self.shear.x * b[z], b[y] - self.shear.y * b[z]);
        let (cx, cy) = (c[x] - self.shear.x * c[z], c[y] - self.shear.y * c[z]);
        let u = difference_of_products(cx, by, cy, bx);
        let v = difference_of_products(ax, cy, ay, cx);
        let w = difference_of_products(bx, ay, by, ax);
        let outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
        let determinant = u + v + w;
        if outside || determinant == 0.0 {
            return None;
        }
        let distance = self.shear.z * (u * a[z] + v * b[z] + w * c[z]) / determinant;
        let in_reach = distance >= 0.0 && distance <= end;
        in_reach.then(|| Hit {
            triangle,
            distance,
            barycentric: Vec2::new(v, w) / determinant,
            front: determinant > 0.0,
        })
    }
}

/// `a b - c d`, in double precision where single precision cannot tell its sign.
#[inline]
fn difference_of_products(a: f32, b: f32, c: f32, d: f32) -> f32 {
    let difference = a * b - c * d;
    if difference == 0.0 { (f64::from(a) * f64::from(b) - f64::from(c) * f64::from(d)) as f32 } else { difference }
}

/// Normal of length 1 and area of a triangle, or nothing where it has no area or is not finite.
pub fn normal_and_area(corners: &[Vec3; 3]) -> Option<(Vec3, f32)> {
    let [a, b, c] = *corners;
    let cross = (b - a).as_dvec3().cross((c - a).as_dvec3());
    let length = cross.length();
    let longest = (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared());
    let sliver = length <= 1e-9 * f64::from(longest);
    (length.is_finite() && !sliver).then(|| ((cross / length).as_vec3(), (0.5 * length) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn down(x: f32, y: f32) -> ShearedRay {
        ShearedRay::new(&Ray { origin: Vec3::new(x, y, 2.0), direction: Vec3::NEG_Z, end: 10.0 })
    }

    #[test]
    fn distance_and_barycentric_coordinates_are_those_of_the_point() {
        let hit = down(0.25, 0.5).hit(&TRIANGLE, 7, 10.0).unwrap();
        assert_eq!((hit.triangle, hit.distance, hit.barycentric), (7, 2.0, Vec2::new(0.25, 0.5)));
        assert!(hit.front);
        assert!(!down(0.25, 0.5).hit(&[Vec3::ZERO, Vec3::Y, Vec3::X], 7, 10.0).unwrap().front);
    }

    #[test]
    fn rays_end() {
        assert!(down(0.25, 0.5).hit(&TRIANGLE, 0, 1.9).is_none());
        assert!(down(0.9, 0.9).hit(&TRIANGLE, 0, 10.0).is_none());
    }

    /// A ray through a shared edge or vertex meets at least one of the triangles around it.
    #[test]
    fn no_gap_between_neighbors() {
        let fan: [Vec3; 7] = core::array::from_fn(|k| {
            let (s, c) = crate::math::sin_cos(k as f32 * core::f32::consts::TAU / 6.0);
            Vec3::new(c, s, 0.1 * s)
        });
        let center = Vec3::new(0.0, 0.0, 0.3);
        for step in 0..6000 {
            let (k, t) = (step % 6, (step / 6) as f32 / 1000.0);
            let target = center.lerp(fan[k], t);
            let origin = Vec3::new(0.3, -0.2, 5.0);
            let ray = ShearedRay::new(&Ray { origin, direction: target - origin, end: f32::INFINITY });
            let met = (0..6).any(|i| ray.hit(&[center, fan[i], fan[(i + 1) % 6]], 0, f32::INFINITY).is_some());
            assert!(met || t > 0.999, "edge {k} at {t}");
        }
    }
}
