//! The box as the camera of the photograph sees it: a lens of 35 mm before a film of 25 mm.

use alloc::vec;

use glam::{Vec3, Vec4};
use radiosity::composite::{DepthBuffer, Fragment, RasterError};
use radiosity::render::khronos_pbr_neutral;
use radiosity::spectrum::linear_to_srgb;

const EYE: Vec3 = Vec3::new(0.278, 0.273, -0.8);
const FOCAL_LENGTH: f32 = 2.0 * 35.0 / 25.0;
/// Radiance of what is shown as white, in cd/m2.
const WHITE: f32 = 250.0;

/// Tells which of the things whose fronts are seen stands in which pixel of a square picture.
///
/// Things are triangles with names; what is told last of a pixel holds.
///
/// # Errors
///
/// Where the side is above 32768.
pub fn see<T: Copy>(
    side: u32,
    things: impl Iterator<Item = (T, [Vec3; 3])>,
    mut stands: impl FnMut(T, Fragment),
) -> Result<(), RasterError> {
    let mut depths = vec![0.0; side as usize * side as usize];
    let mut picture = DepthBuffer::new([side; 2], &mut depths)?;
    let is_front = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).dot(EYE - a) > 0.0;
    for (name, corners) in things.filter(|&(_, corners)| is_front(corners)) {
        picture.draw(&corners.map(clip), |fragment| stands(name, fragment));
    }
    Ok(())
}

/// What a radiance in cd/m2 looks like.
pub fn color(radiance: Vec3) -> [u8; 3] {
    khronos_pbr_neutral(radiance / WHITE).to_array().map(linear_to_srgb)
}

fn clip(corner: Vec3) -> Vec4 {
    let to = corner - EYE;
    Vec4::new(-to.x * FOCAL_LENGTH, to.y * FOCAL_LENGTH, 0.1, to.z)
}
