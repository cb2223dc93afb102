//! Which meshes enclose something, and in which planes lamps are seen.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use super::World;
use crate::geometry::{Mesh, normal_and_area};
use crate::light::PlaneMirror;

/// Lamps are looked for in planes with at least this share of the area of all mirrors.
const LEAST_SHARE: f32 = 1.0 / 64.0;
/// So many planes are looked at, those of the largest triangles.
const MOST_PLANES: usize = 256;
/// Normals of a plane agree to this cosine.
const SAME: f32 = 0.99999;
/// And places to this share of a meter.
const NEAR: f32 = 1e-3;

/// Whether the triangles of a mesh enclose something: each edge belongs to as many triangles in one direction as in the
/// other. Vertices at the same place are one.
pub(super) fn is_closed(mesh: &Mesh) -> bool {
    let place = |vertex: u32| {
        mesh.positions.get(vertex as usize).map(|position| (*position + 0.0).to_array().map(f32::to_bits))
    };
    let edge = |from: u32, to: u32| {
        let (from, to) = (place(from), place(to));
        if from < to { ((from, to), 1) } else { ((to, from), -1) }
    };
    let of_triangle = |&[a, b, c]: &[u32; 3]| [edge(a, b), edge(b, c), edge(c, a)];
    let mut edges: Vec<_> = mesh.triangles.iter().flat_map(of_triangle).collect();
    edges.retain(|((from, to), _)| from != to);
    edges.sort_unstable();
    let balance = |same: &[(_, i32)]| same.iter().map(|&(_, sign)| sign).sum::<i32>();
    !edges.is_empty() && edges.chunk_by(|a, b| a.0 == b.0).all(|same| balance(same) == 0)
}

/// The planes in which lamps are seen, and for each triangle the number of its plane, or `u32::MAX`.
pub(super) fn plane_mirrors(world: &World) -> (Vec<PlaneMirror>, Vec<u32>) {
    let is_mirror = |&triangle: &u32| world.sides[triangle as usize].is_mirror;
    let area = |triangle: u32| normal_and_area(&world.corners[triangle as usize]).map_or(0.0, |(_, area)| area);
    let mut mirrors: Vec<(f32, u32)> =
        (0..world.blockers as u32).filter(is_mirror).map(|triangle| (area(triangle), triangle)).collect();
    if mirrors.is_empty() {
        return Default::default();
    }
    let whole: f32 = mirrors.iter().map(|&(area, _)| area).sum();
    mirrors.retain(|&(_, triangle)| is_flat(world, triangle));
    mirrors.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let (mut planes, mut areas): (Vec<PlaneMirror>, Vec<f32>) = Default::default();
    let mut mirror_of = vec![u32::MAX; world.corners.len()];
    for (area, triangle) in mirrors {
        let (normal, corners) = (world.normals[triangle as usize], world.corners[triangle as usize]);
        let is_in = |plane: &PlaneMirror| normal.dot(plane.normal) > SAME && plane.height(corners[0]).abs() < NEAR;
        let number = planes.iter().position(is_in).unwrap_or(planes.len());
        if number == MOST_PLANES {
            continue;
        }
        if number == planes.len() {
            let (low, high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
            planes.push(PlaneMirror { normal, offset: normal.dot(corners[0]), low, high, number: number as u32 });
            areas.push(0.0);
        }
        let plane = &mut planes[number];
        areas[number] += area;
        plane.low = corners.iter().copied().fold(plane.low, Vec3::min);
        plane.high = corners.iter().copied().fold(plane.high, Vec3::max);
        mirror_of[triangle as usize] = number as u32;
    }
    let large = planes.iter().zip(&areas).filter(|&(_, &area)| area >= LEAST_SHARE * whole).map(|(plane, _)| *plane);
    (large.flat_map(|plane| sides(world, &mirror_of, plane)).collect(), mirror_of)
}

/// The sides of a plane that are mirrors.
fn sides(world: &World, mirror_of: &[u32], plane: PlaneMirror) -> impl Iterator<Item = PlaneMirror> + use<> {
    let has_back = (0..mirror_of.len()).any(|k| mirror_of[k] == plane.number && world.sides[k].both);
    let back = PlaneMirror { normal: -plane.normal, offset: -plane.offset, ..plane };
    [plane, back].into_iter().take(if has_back { 2 } else { 1 })
}

/// Whether a triangle shows what a plane does.
fn is_flat(world: &World, triangle: u32) -> bool {
    let flat = world.normals[triangle as usize];
    world.corner_normals(triangle).iter().all(|normal| normal.dot(flat) > SAME)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::String;

    fn tetrahedron() -> Mesh {
        Mesh {
            name: String::new(),
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z],
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
            ..Default::default()
        }
    }

    /// Corners may be there several times, with normals of their own; a missing or turned side opens a body.
    #[test]
    fn closed() {
        let mut mesh = tetrahedron();
        assert!(is_closed(&mesh));
        mesh.positions.push(-Vec3::ZERO);
        mesh.triangles[0][0] = 4;
        assert!(is_closed(&mesh));
        let open = Mesh { triangles: mesh.triangles[1..].to_vec(), ..mesh.clone() };
        mesh.triangles[2].swap(0, 1);
        assert!(!is_closed(&open) && !is_closed(&mesh) && !is_closed(&Mesh::default()));
    }
}
