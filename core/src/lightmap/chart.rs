//! Charts: the parts of a mesh that lie flat in a lightmap; which coordinates of a mesh can serve as such.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::{DVec2, DVec3, Mat3A, Vec2, Vec3, Vec3A};

use super::overlap::find_overlap;
use crate::geometry::Mesh;

/// A mesh cut into charts that lie flat at their true size.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Charts {
    /// For each vertex of the charts, the vertex of the mesh that it repeats.
    pub sources: Vec<u32>,
    /// For each vertex its chart.
    pub vertex_charts: Vec<u32>,
    /// For each vertex its place in the chart, in meters from the chart's corner; not negative.
    pub points: Vec<Vec2>,
    /// The triangles of the mesh, over these vertices.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle its chart.
    pub triangle_charts: Vec<u32>,
    /// Width and height of each chart in meters.
    pub sizes: Vec<Vec2>,
    /// Triangles that became charts of their own because unwrapping refused them.
    pub scattered: usize,
}

/// Coordinates that a mesh brought along and that can serve for a lightmap.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct KeptUv {
    /// For each vertex, in `0..1`; finite.
    pub uv_1: Vec<Vec2>,
    /// For each triangle its chart.
    pub triangle_charts: Vec<u32>,
}

/// How far outside `0..1` coordinates may lie.
const OUTSIDE: f32 = 1e-4;
/// Texels per area below this share of the average are none at all.
const COLLAPSED: f64 = 1e-4;
/// Triangles below this share of the area of the mesh may collapse.
const NEGLIGIBLE: f64 = 1e-6;

/// The second UV set of a mesh, if it can serve for a lightmap; else what is wrong with it.
///
/// It is stretched to fill `0..1` in both directions, unless a texture uses it too.
pub(super) fn judge(mesh: &Mesh) -> Result<KeptUv, String> {
    match mesh.uv_1.len() {
        0 => return Err("it has no second UV set".into()),
        count if count != mesh.positions.len() => {
            return Err(format!("there are {count} coordinates for {} vertices", mesh.positions.len()));
        }
        _ => {}
    }
    let proper: Vec<[u32; 3]> = mesh.triangles.iter().copied().filter(|&t| is_proper(&mesh.positions, t)).collect();
    let (low, high) = bounds(mesh, &proper)?;
    let stretched: Vec<Vec2> = mesh.uv_1.iter().map(|&uv| finite((uv - low) / (high - low))).collect();
    refuse_collapsed(mesh, &stretched, &proper)?;
    let corners: Vec<[Vec2; 3]> = proper.iter().map(|t| t.map(|i| stretched[i as usize])).collect();
    if let Some(place) = find_overlap(&corners) {
        let Vec2 { x, y } = low + place * (high - low);
        return Err(format!("triangles overlap near ({x:.3}, {y:.3})"));
    }
    let uv_1 = if mesh.uv_1_in_use { mesh.uv_1.iter().map(|&uv| finite(uv)).collect() } else { stretched };
    let triangle_charts = connected(mesh);
    Ok(KeptUv { uv_1, triangle_charts })
}

/// Whether the corners of a triangle exist, are finite and span an area that single precision can tell from none.
pub(super) fn is_proper(positions: &[Vec3], triangle: [u32; 3]) -> bool {
    let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    let doubled_area = (b - a).cross(c - a).length();
    doubled_area.is_finite() && doubled_area > 1e-6 * longest
}

/// Area of a mesh in square meters after a linear map; triangles that are not proper count nothing.
pub(super) fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    triangles.iter().filter(|&&t| is_proper(positions, t)).map(|&t| triangle_area(positions, t)).sum()
}

/// The vertices of a mesh after a linear map.
pub(super) fn mapped(positions: &[Vec3], linear: &Mat3A) -> Vec<Vec3> {
    positions.iter().map(|&position| Vec3::from(*linear * Vec3A::from(position))).collect()
}

/// Meters along `u` and along `v` from 0 to 1: the averages over the area, scaled so that the area comes out right.
pub(super) fn meters_per_uv(positions: &[Vec3], triangles: &[[u32; 3]], uv_1: &[Vec2]) -> Vec2 {
    let (mut along, mut meters2, mut uv2) = (DVec2::ZERO, 0.0, 0.0);
    for &triangle in triangles.iter().filter(|&&t| is_proper(positions, t)) {
        let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
        let [p, q, r] = triangle.map(|i| uv_1[i as usize].as_dvec2());
        let (q, r) = (q - p, r - p);
        let determinant = q.perp_dot(r);
        let area = triangle_area(positions, triangle);
        if determinant.abs() < 1e-12 {
            continue;
        }
        let per_u: DVec3 = ((b - a) * r.y - (c - a) * q.y) / determinant;
        let per_v: DVec3 = ((c - a) * q.x - (b - a) * r.x) / determinant;
        along += DVec2::new(per_u.length(), per_v.length()) * area;
        meters2 += area;
        uv2 += 0.5 * determinant.abs();
    }
    let mean = along / meters2;
    let correction = DVec2::splat(meters2 / (uv2 * mean.x * mean.y)).sqrt();
    (mean * correction).as_vec2()
}

/// Gives equal keys equal numbers, counted from 0.
pub(super) fn weld<K: Ord>(keys: &[K]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..keys.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| keys[a as usize].cmp(&keys[b as usize]).then(a.cmp(&b)));
    let mut welded = alloc::vec![0; keys.len()];
    let mut count = 0;
    for (rank, &index) in order.iter().enumerate() {
        let is_new = rank > 0 && keys[order[rank - 1] as usize] != keys[index as usize];
        count += u32::from(is_new);
        welded[index as usize] = count;
    }
    welded
}

/// The two triangles at each edge that exactly two triangles share.
pub(super) fn neighbors(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let mut edges: Vec<(u32, u32, u32)> = Vec::with_capacity(triangles.len() * 3);
    for (index, t) in triangles.iter().enumerate() {
        edges.extend((0..3).map(|i| {
            let (a, b) = (t[i], t[(i + 1) % 3]);
            (a.min(b), a.max(b), index as u32)
        }));
    }
    edges.sort_unstable();
    edges
        .chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
        .filter_map(|edge| if let &[(.., a), (.., b)] = edge { Some([a, b]) } else { None })
        .collect()
}

/// Numbers the groups that pairs connect, in the order of their first members, from 0.
pub(super) fn groups(count: usize, pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut parents: Vec<u32> = (0..count as u32).collect();
    for &[a, b] in pairs {
        let (a, b) = (root(&mut parents, a), root(&mut parents, b));
        parents[a.max(b) as usize] = a.min(b);
    }
    let mut numbers = alloc::vec![0; count];
    let mut next = 0;
    for index in 0..count as u32 {
        let first = root(&mut parents, index);
        if first == index {
            numbers[index as usize] = next;
            next += 1;
        } else {
            numbers[index as usize] = numbers[first as usize];
        }
    }
    numbers
}

/// Position or coordinates as a key by which vertices are the same; the sign of zero does not count.
pub(super) fn bits<const N: usize>(numbers: [f32; N]) -> [u32; N] {
    numbers.map(|number| (number + 0.0).to_bits())
}

fn root(parents: &mut [u32], mut index: u32) -> u32 {
    while parents[index as usize] != index {
        let parent = parents[index as usize];
        parents[index as usize] = parents[parent as usize];
        index = parent;
    }
    index
}

/// Connected triangles: those that share an edge in space and in the plane.
fn connected(mesh: &Mesh) -> Vec<u32> {
    let keys: Vec<_> =
        mesh.positions.iter().zip(&mesh.uv_1).map(|(p, uv)| (bits(p.to_array()), bits(uv.to_array()))).collect();
    let welded = weld(&keys);
    let triangles: Vec<_> = mesh.triangles.iter().map(|t| t.map(|i| welded[i as usize])).collect();
    groups(triangles.len(), &neighbors(&triangles))
}

/// Lower and upper bounds of the coordinates that proper triangles use.
fn bounds(mesh: &Mesh, proper: &[[u32; 3]]) -> Result<(Vec2, Vec2), String> {
    let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    for &index in proper.as_flattened() {
        let uv = mesh.uv_1[index as usize];
        if !uv.is_finite() {
            return Err(format!("the coordinates of vertex {index} are not finite"));
        }
        let inside = uv.cmpge(Vec2::splat(-OUTSIDE)) & uv.cmple(Vec2::splat(1.0 + OUTSIDE));
        if !inside.all() {
            return Err(format!("vertex {index} lies at ({}, {}), outside 0..1", uv.x, uv.y));
        }
        (low, high) = (low.min(uv), high.max(uv));
    }
    let size = high - low;
    if proper.is_empty() || size.cmpgt(Vec2::splat(1e-5)).all() {
        Ok((low, high))
    } else {
        Err(format!("all coordinates lie within {} x {}", size.x, size.y))
    }
}

/// Fails if a triangle that matters has no area in the plane.
fn refuse_collapsed(mesh: &Mesh, uv_1: &[Vec2], proper: &[[u32; 3]]) -> Result<(), String> {
    let areas: Vec<(f64, f64)> = proper
        .iter()
        .map(|&t| {
            let [a, b, c] = t.map(|i| uv_1[i as usize].as_dvec2());
            (triangle_area(&mesh.positions, t), 0.5 * (b - a).perp_dot(c - a).abs())
        })
        .collect();
    let (meters2, uv2) = areas.iter().fold((0.0, 0.0), |sum, area| (sum.0 + area.0, sum.1 + area.1));
    let collapsed =
        |&&(area, flat): &&(f64, f64)| area > NEGLIGIBLE * meters2 && flat * meters2 <= COLLAPSED * area * uv2;
    match areas.iter().filter(collapsed).count() {
        0 => Ok(()),
        count => Err(format!("{count} of {} triangles collapse to lines or points", proper.len())),
    }
}

fn triangle_area(positions: &[Vec3], triangle: [u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
    0.5 * (b - a).cross(c - a).length()
}

/// In `0..1`; 0 for what is not a number.
fn finite(uv: Vec2) -> Vec2 {
    Vec2::select(uv.is_finite_mask(), uv, Vec2::ZERO).clamp(Vec2::ZERO, Vec2::ONE)
}
