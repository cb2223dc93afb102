//! Martin Newell's teapot of 1975, 32 bicubic Bezier patches: eight outlines that are turned, and the halves of handle and
//! spout.

use glam::Vec3;

/// Rows of four control points.
pub type Patch = [Vec3; 16];

/// Distances from the axis and heights, what is outside on the left: rim, upper and lower body, knob, lid, bottom.
const OUTLINES: [[[f32; 2]; 4]; 6] = [
    [[1.4, 2.4], [1.3375, 2.53125], [1.4375, 2.53125], [1.5, 2.4]],
    [[1.5, 2.4], [1.75, 1.875], [2.0, 1.35], [2.0, 0.9]],
    [[2.0, 0.9], [2.0, 0.45], [1.5, 0.225], [1.5, 0.15]],
    [[0.0, 3.15], [0.8, 3.15], [0.0, 2.85], [0.2, 2.7]],
    [[0.2, 2.7], [0.4, 2.55], [1.3, 2.55], [1.3, 2.4]],
    [[1.5, 0.15], [1.5, 0.075], [1.425, 0.0], [0.0, 0.0]],
];

/// Quarters of circles by cubics, as Newell drew them.
const QUARTER: f32 = 0.56;

/// Where a tube ends inside and outside in the plane of symmetry, and how far its control points lie before it; four
/// rows are a patch, the last of which is the first of the next one.
type Row = ([f32; 2], [f32; 2], f32);

const HANDLE: [Row; 7] = [
    ([-1.6, 2.025], [-1.5, 2.25], 0.3),
    ([-2.3, 2.025], [-2.5, 2.25], 0.3),
    ([-2.7, 2.025], [-3.0, 2.25], 0.3),
    ([-2.7, 1.8], [-3.0, 1.8], 0.3),
    ([-2.7, 1.575], [-3.0, 1.35], 0.3),
    ([-2.5, 1.125], [-2.65, 0.9375], 0.3),
    ([-2.0, 0.9], [-1.9, 0.6], 0.3),
];

const SPOUT: [Row; 7] = [
    ([1.7, 1.425], [1.7, 0.6], 0.66),
    ([2.6, 1.425], [3.1, 0.825], 0.66),
    ([2.3, 2.1], [2.4, 2.025], 0.25),
    ([2.7, 2.4], [3.3, 2.4], 0.25),
    ([2.8, 2.475], [3.525, 2.49375], 0.25),
    ([2.9, 2.475], [3.45, 2.5125], 0.15),
    ([2.8, 2.4], [3.2, 2.4], 0.15),
];

/// All patches with their fronts outside, in the units of the original, 3.15 high; `y` is up.
pub fn teapot() -> Vec<Patch> {
    let turned = OUTLINES.iter().flat_map(|outline| (0..4).map(|quarter| turned(outline, quarter)));
    let halves = [HANDLE, SPOUT].into_iter().flat_map(|rows| [half(&rows[..4]), half(&rows[3..])]);
    let halves = halves.flat_map(|patch| [patch, patch.map(|point| point * Vec3::new(1.0, 1.0, -1.0))]);
    turned.chain(halves.map(facing)).collect()
}

/// A quarter of what an outline sweeps on its way around the axis.
fn turned(outline: &[[f32; 2]; 4], quarter: usize) -> Patch {
    let around = [[1.0, 0.0], [1.0, QUARTER], [QUARTER, 1.0], [0.0, 1.0]];
    std::array::from_fn(|k| {
        let ([radius, height], [x, z]) = (outline[k / 4], around[k % 4]);
        let (x, z) = [(x, z), (-z, x), (-x, -z), (z, -x)][quarter];
        Vec3::new(radius * x, height, radius * z)
    })
}

/// The half of a bent tube in front of the plane of symmetry.
fn half(rows: &[Row]) -> Patch {
    std::array::from_fn(|k| {
        let ([x0, y0], [x1, y1], z) = rows[k / 4];
        [Vec3::new(x0, y0, 0.0), Vec3::new(x0, y0, z), Vec3::new(x1, y1, z), Vec3::new(x1, y1, 0.0)][k % 4]
    })
}

/// With its front away from the plane of symmetry.
fn facing(patch: Patch) -> Patch {
    let [along, across] = [patch[6] + patch[10] - patch[5] - patch[9], patch[9] + patch[10] - patch[5] - patch[6]];
    match along.cross(across).z * patch[5].z < 0.0 {
        true => std::array::from_fn(|k| patch[k / 4 * 4 + 3 - k % 4]),
        false => patch,
    }
}
