//! Eight boxes, and a ray that meets some of them.

use glam::Vec3;

use super::super::Ray;
use super::lanes::{LANES, Lanes};

/// Rounding that boxes and rays allow for, as share of the largest coordinate: 33 units in the last place of numbers
/// whose errors are at most ten of them.
pub const PADDING: f32 = 2e-6;

/// Eight boxes with what they hold.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Node {
    /// Lowest x, y, z, then highest x, y, z.
    planes: [[f32; LANES]; 6],
    pub children: [u32; LANES],
}

impl Node {
    /// No ray meets its boxes.
    pub const EMPTY: Self = Self {
        planes: [
            [f32::INFINITY; LANES],
            [f32::INFINITY; LANES],
            [f32::INFINITY; LANES],
            [f32::NEG_INFINITY; LANES],
            [f32::NEG_INFINITY; LANES],
            [f32::NEG_INFINITY; LANES],
        ],
        children: [0; LANES],
    };

    pub fn set(&mut self, lane: usize, low: Vec3, high: Vec3, child: u32) {
        for axis in 0..3 {
            self.planes[axis][lane] = low[axis];
            self.planes[axis + 3][lane] = high[axis];
        }
        self.children[lane] = child;
    }
}

/// A ray prepared for boxes.
#[derive(Clone, Copy)]
pub struct BoxRay<L: Lanes> {
    /// For each axis, moved so that rounding loses no hit: what the near and the far plane are measured from.
    origins: [[L::Numbers; 2]; 3],
    inverse: [L::Numbers; 3],
    /// For each axis the index of the near planes.
    near: [usize; 3],
}

impl<L: Lanes> BoxRay<L> {
    #[inline(always)]
    pub fn new(lanes: L, ray: &Ray) -> Self {
        let padding = ray.origin.abs().max_element() * PADDING + f32::MIN_POSITIVE;
        let least = (ray.direction.abs().max_element() * 1e-20).max(f32::MIN_POSITIVE);
        let mut near = [0; 3];
        let mut origins = [[lanes.splat(0.0); 2]; 3];
        let mut inverse = [lanes.splat(0.0); 3];
        for axis in 0..3 {
            let (origin, along) = (ray.origin[axis], ray.direction[axis]);
            let (along, shift) = if along < 0.0 { (along.min(-least), -padding) } else { (along.max(least), padding) };
            near[axis] = if along < 0.0 { axis + 3 } else { axis };
            origins[axis] = [lanes.splat(origin + shift), lanes.splat(origin - shift)];
            inverse[axis] = lanes.splat(1.0 / along);
        }
        Self { origins, inverse, near }
    }

    /// The boxes that the ray meets up to `end`, one bit for each, and where it enters them.
    #[inline(always)]
    pub fn meet(&self, lanes: L, node: &Node, end: f32) -> (u32, [f32; LANES]) {
        let (near_x, far_x) = self.cross(lanes, node, 0);
        let (near_y, far_y) = self.cross(lanes, node, 1);
        let (near_z, far_z) = self.cross(lanes, node, 2);
        let enter = lanes.max(lanes.max(near_x, near_y), lanes.max(near_z, lanes.splat(0.0)));
        let leave = lanes.min(lanes.min(far_x, far_y), lanes.min(far_z, lanes.splat(end)));
        (lanes.bits(lanes.le(enter, leave)), lanes.store(enter))
    }

    /// Where the ray crosses the near and the far planes of an axis.
    #[inline(always)]
    fn cross(&self, lanes: L, node: &Node, axis: usize) -> (L::Numbers, L::Numbers) {
        let near = self.near[axis];
        let far = if near < 3 { near + 3 } else { near - 3 };
        let [near_origin, far_origin] = self.origins[axis];
        (
            lanes.mul(lanes.sub(lanes.load(&node.planes[near]), near_origin), self.inverse[axis]),
            lanes.mul(lanes.sub(lanes.load(&node.planes[far]), far_origin), self.inverse[axis]),
        )
    }
}
