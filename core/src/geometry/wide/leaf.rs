//! Up to eight triangles, tested at once with the bits of [`ShearedRay::hit`].

use glam::{Vec2, Vec3};

use super::super::triangle::ShearedRay;
use super::super::{Hit, Ray};
use super::lanes::{LANES, Lanes};

/// A ray prepared for leaves.
#[derive(Clone, Copy)]
pub struct LeafRay<L: Lanes> {
    ray: ShearedRay,
    /// In the order across, across, along.
    origin: [L::Numbers; 3],
    shear: [L::Numbers; 3],
}

impl<L: Lanes> LeafRay<L> {
    #[inline(always)]
    pub fn new(lanes: L, ray: &Ray) -> Self {
        let ray = ShearedRay::new(ray);
        let [x, y, z] = ray.axes;
        let origin = [lanes.splat(ray.origin[x]), lanes.splat(ray.origin[y]), lanes.splat(ray.origin[z])];
        let shear = [lanes.splat(ray.shear.x), lanes.splat(ray.shear.y), lanes.splat(ray.shear.z)];
        Self { ray, origin, shear }
    }

    /// Corners seen along the ray: across, across, along.
    #[inline(always)]
    fn shear(&self, lanes: L, corner: &[[f32; LANES]; 3]) -> (L::Numbers, L::Numbers, L::Numbers) {
        let [x, y, z] = self.ray.axes;
        let along = lanes.sub(lanes.load(&corner[z]), self.origin[2]);
        let x = lanes.sub(lanes.load(&corner[x]), self.origin[0]);
        let y = lanes.sub(lanes.load(&corner[y]), self.origin[1]);
        (lanes.sub(x, lanes.mul(self.shear[0], along)), lanes.sub(y, lanes.mul(self.shear[1], along)), along)
    }
}

#[inline(always)]
fn difference_of_products<L: Lanes>(
    lanes: L,
    a: L::Numbers,
    b: L::Numbers,
    c: L::Numbers,
    d: L::Numbers,
) -> L::Numbers {
    lanes.sub(lanes.mul(a, b), lanes.mul(c, d))
}

/// Up to eight triangles.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Leaf {
    /// For each corner and axis; where there is no triangle, not a number.
    corners: [[[f32; LANES]; 3]; 3],
    triangles: [u32; LANES],
}

impl Leaf {
    /// Takes triangles with their indices.
    pub fn new(triangles: impl Iterator<Item = ([Vec3; 3], u32)>) -> Self {
        let mut leaf = Self { corners: [[[f32::NAN; LANES]; 3]; 3], triangles: [0; LANES] };
        for (lane, (corners, index)) in triangles.take(LANES).enumerate() {
            for (corner, place) in corners.iter().zip(&mut leaf.corners) {
                (0..3).for_each(|axis| place[axis][lane] = corner[axis]);
            }
            leaf.triangles[lane] = index;
        }
        leaf
    }

    /// Hands over the hits up to `end` until `stop` returns true, and tells whether it did.
    #[inline(always)]
    pub fn hits<L: Lanes>(&self, lanes: L, ray: &LeafRay<L>, end: f32, mut stop: impl FnMut(Hit) -> bool) -> bool {
        let [a, b, c] = &self.corners;
        let [(ax, ay, az), (bx, by, bz), (cx, cy, cz)] =
            [ray.shear(lanes, a), ray.shear(lanes, b), ray.shear(lanes, c)];
        let u = difference_of_products(lanes, cx, by, cy, bx);
        let v = difference_of_products(lanes, ax, cy, ay, cx);
        let w = difference_of_products(lanes, bx, ay, by, ax);
        let zero = lanes.splat(0.0);
        let low = lanes.min(lanes.min(u, v), w);
        let high = lanes.max(lanes.max(u, v), w);
        let inside = lanes.or(lanes.le(zero, low), lanes.le(high, zero));
        let mut met = lanes.bits(inside);
        if met == 0 {
            return false;
        }
        let edge = lanes.bits(lanes.or(lanes.or(lanes.eq(u, zero), lanes.eq(v, zero)), lanes.eq(w, zero)));
        let determinant = lanes.add(lanes.add(u, v), w);
        let sum = lanes.add(lanes.add(lanes.mul(u, az), lanes.mul(v, bz)), lanes.mul(w, cz));
        let distance = lanes.div(lanes.mul(ray.shear[2], sum), determinant);
        let in_reach = lanes.and(lanes.le(zero, distance), lanes.le(distance, lanes.splat(end)));
        // Zeros are looked at in double precision.
        met &= lanes.bits(in_reach) | edge;
        if met == 0 {
            return false;
        }
        let (v, w) = (lanes.store(v), lanes.store(w));
        let (determinant, distance) = (lanes.store(determinant), lanes.store(distance));
        while met != 0 {
            let lane = met.trailing_zeros() as usize & (LANES - 1);
            let hit = if edge >> lane & 1 == 1 {
                self.exact(&ray.ray, lane, end)
            } else {
                Some(Hit {
                    triangle: self.triangles[lane],
                    distance: distance[lane],
                    barycentric: Vec2::new(v[lane], w[lane]) / determinant[lane],
                    front: determinant[lane] > 0.0,
                })
            };
            if hit.is_some_and(&mut stop) {
                return true;
            }
            met &= met - 1;
        }
        false
    }

    #[inline(never)]
    fn exact(&self, ray: &ShearedRay, lane: usize, end: f32) -> Option<Hit> {
        let corners = self.corners.map(|corner| Vec3::from_array(corner.map(|axis| axis[lane])));
        ray.hit(&corners, self.triangles[lane], end)
    }
}
