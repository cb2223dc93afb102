//! Charts for a mesh that has none, by uvunwrap: the only file that knows it.
//!
//! Level geometry wants charts that are flat and end at creases: there texels must not mix two sides. So the mesh is cut
//! at creases first, uvunwrap then merges what it can flatten (charts up to 70 degrees around, areas at most 1.2 off).
//! On a level of 70 691 triangles with 7035 m2, at 8 texels per meter with gutters of 2 texels, this gives (length of
//! creases of more than 32 degrees inside of charts; ratio of the singular values of the map, mean over the area):
//!
//! | how | charts | creases | texels | ratio | seconds |
//! |---|---|---|---|---|---|
//! | 20 degrees, areas 1.1 off | 17 093 | 12 m | 1.56 M | 0.9995 | 0.16 |
//! | 40 degrees, areas 1.1 off | 16 137 | 250 m | 1.53 M | 0.9994 | 0.17 |
//! | 70 degrees, areas 4 off (its defaults) | 13 000 | 1088 m | 1.46 M | 0.9973 | 0.16 |
//! | cut at 30 degrees, 70 degrees, areas 1.1 off | 15 637 | 88 m | 1.53 M | 0.9995 | 0.16 |
//! | cut at 30 degrees, 70 degrees, areas 1.5 off | 15 541 | 98 m | 1.53 M | 0.9994 | 0.14 |
//! | xatlas, its defaults, gutters of 2 texels | 14 427 | | 3.66 M | 0.9726 | 1.04 |
//!
//! Its iterative solver is slow on large curved charts and cannot be stopped: a torus of 200 000 triangles takes 18 s,
//! 11 of them in one go. In pieces of 2000 triangles it takes 3 s, and a cancelled bake ends within
//! 0.1 s.

use std::collections::HashMap;
use std::vec;
use std::vec::Vec;

use glam::{DVec3, Vec2, Vec3};
use uvunwrap::{Density, Error, MeshInput, Options, OutputMesh, Packing};

use super::chart::{self, Charts};
use super::image::NONE;
use super::layout::LayoutError;
use crate::progress::Cancelled;

/// Charts do not go around edges where the surface turns by more than this: 30 degrees.
const COS_CREASE: f64 = 0.866;
/// Normals that differ by less than this belong to one plane: a quarter of a degree.
const COS_FLAT: f64 = 1.0 - 1e-5;
/// Triangles of a curved piece, so that the solver never keeps a cancelled bake waiting.
const PIECE: usize = 2000;
/// Triangles of a flat piece, which needs no solver.
const FLAT_PIECE: usize = 20_000;
/// Triangles that are unwrapped in one go.
const BATCH: usize = 4000;

/// Cuts a mesh into flat charts without overlap. `advance` hears of the share that is done.
///
/// Triangles without area, or with corners that are not finite, collapse into a point of the first chart.
/// `positions` are in meters; the result does not depend on the number of threads.
///
/// # Errors
///
/// Only what `advance` returns.
pub(super) fn unwrap(
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    advance: &(dyn Fn(f32) -> Result<(), Cancelled> + Sync),
) -> Result<Charts, LayoutError> {
    let keys: Vec<_> = positions.iter().map(|p| chart::bits(p.to_array())).collect();
    let mesh = Mesh { positions, triangles, welded: chart::weld(&keys) };
    let check = || advance(0.0);
    check()?;
    let pieces = pieces(&mesh, &check)?;
    let mut builder = Builder::new(triangles.len());
    let (mut start, mut done) = (0, 0);
    while start < pieces.len() {
        let mut end = start + 1;
        let mut count = pieces[start].len();
        while end < pieces.len() && count + pieces[end].len() <= BATCH {
            count += pieces[end].len();
            end += 1;
        }
        let share = |part: f32| (done as f32 + part * count as f32) / triangles.len() as f32;
        builder.add_batch(&mesh, &pieces[start..end], &|part| advance(share(part)))?;
        (start, done) = (end, done + count);
    }
    Ok(builder.finish(&mesh))
}

/// A mesh and which of its vertices lie at the same place.
struct Mesh<'a> {
    positions: &'a [Vec3],
    triangles: &'a [[u32; 3]],
    welded: Vec<u32>,
}

impl Mesh<'_> {
    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|i| self.positions[i as usize].as_dvec3())
    }

    fn normal(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a).normalize_or_zero()
    }
}

/// The proper triangles in pieces that no crease divides; curved pieces are small.
fn pieces(mesh: &Mesh, check: &dyn Fn() -> Result<(), Cancelled>) -> Result<Vec<Vec<u32>>, Cancelled> {
    let proper: Vec<u32> = (0..mesh.triangles.len() as u32)
        .filter(|&t| chart::is_proper(mesh.positions, mesh.triangles[t as usize]))
        .collect();
    check()?;
    let welded: Vec<_> = proper.iter().map(|&t| mesh.triangles[t as usize].map(|i| mesh.welded[i as usize])).collect();
    let mut smooth = chart::neighbors(&welded);
    check()?;
    let normals: Vec<DVec3> = proper.iter().map(|&t| mesh.normal(t)).collect();
    smooth.retain(|&[a, b]| normals[a as usize].dot(normals[b as usize]) >= COS_CREASE);
    let groups = chart::groups(proper.len(), &smooth);
    check()?;
    let count = groups.iter().max().map_or(0, |&last| last as usize + 1);
    let mut pieces = vec![Vec::new(); count];
    for (&triangle, &group) in proper.iter().zip(&groups) {
        pieces[group as usize].push(triangle);
    }
    let mut small = Vec::with_capacity(count);
    for piece in pieces {
        halve(mesh, piece, &mut small, check)?;
    }
    Ok(small)
}

/// Halves a large piece across its longest extent until it is small enough.
fn halve(
    mesh: &Mesh,
    mut piece: Vec<u32>,
    small: &mut Vec<Vec<u32>>,
    check: &dyn Fn() -> Result<(), Cancelled>,
) -> Result<(), Cancelled> {
    if piece.len() <= PIECE || (piece.len() <= FLAT_PIECE && is_flat(mesh, &piece)) {
        small.push(piece);
        return Ok(());
    }
    check()?;
    let mut centers: Vec<(DVec3, u32)> =
        piece.iter().map(|&t| (mesh.corners(t).into_iter().sum::<DVec3>(), t)).collect();
    let low = centers.iter().fold(DVec3::INFINITY, |low, center| low.min(center.0));
    let high = centers.iter().fold(DVec3::NEG_INFINITY, |high, center| high.max(center.0));
    let axis = (high - low).max_position();
    let middle = centers.len() / 2;
    centers.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    piece.clear();
    piece.extend(centers.iter().map(|center| center.1));
    let mut second = piece.split_off(middle);
    piece.sort_unstable();
    second.sort_unstable();
    halve(mesh, piece, small, check)?;
    halve(mesh, second, small, check)
}

fn is_flat(mesh: &Mesh, piece: &[u32]) -> bool {
    let mean = piece.iter().map(|&t| mesh.normal(t)).sum::<DVec3>().normalize_or_zero();
    piece.iter().all(|&t| mesh.normal(t).dot(mean) >= COS_FLAT)
}

/// The charts so far.
struct Builder {
    charts: Charts,
    /// For each triangle the three vertices of its chart, not yet known for those without area.
    corners: Vec<[u32; 3]>,
}

impl Builder {
    fn new(triangles: usize) -> Self {
        let charts = Charts { triangle_charts: vec![NONE; triangles], ..Charts::default() };
        Self { charts, corners: vec![[NONE; 3]; triangles] }
    }

    fn add_batch(
        &mut self,
        mesh: &Mesh,
        pieces: &[Vec<u32>],
        advance: &(dyn Fn(f32) -> Result<(), Cancelled> + Sync),
    ) -> Result<(), LayoutError> {
        let batch = Batch::new(mesh, pieces);
        match batch.unwrap(advance) {
            Ok(unwrapped) => self.add(mesh, &batch, &unwrapped),
            Err(Error::Cancelled) => return Err(LayoutError::Cancelled),
            Err(_) => self.scatter(mesh, &batch.triangles),
        }
        Ok(advance(1.0)?)
    }

    /// Takes over the charts of a batch; its triangles without chart stay without.
    fn add(&mut self, mesh: &Mesh, batch: &Batch, unwrapped: &Unwrapped) {
        let mut numbers: HashMap<u32, u32> = HashMap::new();
        let mut vertices: HashMap<(u32, u32), u32> = HashMap::new();
        for (&triangle, corners) in batch.triangles.iter().zip(unwrapped.mesh.indices.chunks_exact(3)) {
            let Some(number) = unwrapped.mesh.vertices[corners[0] as usize].chart else { continue };
            let points = [0, 1, 2].map(|i| unwrapped.point(corners[i]));
            if (points[1] - points[0]).perp_dot(points[2] - points[0]) == 0.0 {
                continue;
            }
            let chart = *numbers.entry(number).or_insert_with(|| self.charts.sizes.len() as u32);
            if chart as usize == self.charts.sizes.len() {
                self.charts.sizes.push(Vec2::ZERO);
            }
            for i in 0..3 {
                let source = mesh.triangles[triangle as usize][i];
                self.corners[triangle as usize][i] =
                    *vertices.entry((source, corners[i])).or_insert_with(|| self.charts.push(source, chart, points[i]));
            }
            self.charts.triangle_charts[triangle as usize] = chart;
        }
    }

    /// Makes a chart of each triangle.
    fn scatter(&mut self, mesh: &Mesh, triangles: &[u32]) {
        for &triangle in triangles {
            let chart = self.charts.sizes.len() as u32;
            self.charts.sizes.push(Vec2::ZERO);
            let points = flattened(mesh.corners(triangle));
            let sources = mesh.triangles[triangle as usize];
            self.corners[triangle as usize] = [0, 1, 2].map(|i| self.charts.push(sources[i], chart, points[i]));
            self.charts.triangle_charts[triangle as usize] = chart;
        }
        self.charts.scattered += triangles.len();
    }

    /// Puts every chart at its own origin and the triangles without chart into the first one.
    fn finish(mut self, mesh: &Mesh) -> Charts {
        let mut low = vec![Vec2::INFINITY; self.charts.sizes.len()];
        for (&chart, &point) in self.charts.vertex_charts.iter().zip(&self.charts.points) {
            low[chart as usize] = low[chart as usize].min(point);
        }
        for (&chart, point) in self.charts.vertex_charts.iter().zip(&mut self.charts.points) {
            *point -= low[chart as usize];
            let size = &mut self.charts.sizes[chart as usize];
            *size = size.max(*point);
        }
        if !self.charts.sizes.is_empty() {
            self.collapse(mesh);
        }
        self.charts.triangles = self.corners;
        self.charts
    }

    fn collapse(&mut self, mesh: &Mesh) {
        let point = self.charts.points[0];
        let mut vertices: HashMap<u32, u32> = HashMap::new();
        for (triangle, corners) in self.corners.iter_mut().enumerate().filter(|(_, corners)| corners[0] == NONE) {
            *corners = mesh.triangles[triangle]
                .map(|source| *vertices.entry(source).or_insert_with(|| self.charts.push(source, 0, point)));
            self.charts.triangle_charts[triangle] = 0;
        }
    }
}

impl Charts {
    fn push(&mut self, source: u32, chart: u32, point: Vec2) -> u32 {
        self.sources.push(source);
        self.vertex_charts.push(chart);
        self.points.push(point);
        self.sources.len() as u32 - 1
    }
}

/// A triangle in its own plane, its first edge along `u`.
fn flattened([a, b, c]: [DVec3; 3]) -> [Vec2; 3] {
    let (along, side) = (b - a, c - a);
    let length = along.length();
    let height = along.cross(side).length() / length;
    [Vec2::ZERO, Vec2::new(length as f32, 0.0), Vec2::new((along.dot(side) / length) as f32, height as f32)]
}

/// Pieces as uvunwrap takes them.
struct Batch {
    triangles: Vec<u32>,
    /// For each triangle the piece; charts never span two.
    pieces: Vec<u32>,
    positions: Vec<[f32; 3]>,
    indices: Vec<u32>,
    area: f64,
}

/// What uvunwrap made of a batch.
struct Unwrapped {
    mesh: OutputMesh,
    /// Meters from 0 to 1.
    meters: Vec2,
}

impl Unwrapped {
    fn point(&self, vertex: u32) -> Vec2 {
        Vec2::from(self.mesh.vertices[vertex as usize].uv) * self.meters
    }
}

impl Batch {
    fn new(mesh: &Mesh, pieces: &[Vec<u32>]) -> Self {
        let triangles: Vec<u32> = pieces.iter().flatten().copied().collect();
        let numbers = pieces.iter().zip(0..).flat_map(|(piece, number)| piece.iter().map(move |_| number)).collect();
        let mut local: HashMap<u32, u32> = HashMap::new();
        let mut positions = Vec::new();
        let indices = triangles
            .iter()
            .flat_map(|&t| mesh.triangles[t as usize])
            .map(|vertex| {
                *local.entry(mesh.welded[vertex as usize]).or_insert_with(|| {
                    positions.push(mesh.positions[vertex as usize].to_array());
                    positions.len() as u32 - 1
                })
            })
            .collect();
        let area = triangles.iter().map(|&t| {
            let [a, b, c] = mesh.corners(t);
            0.5 * (b - a).cross(c - a).length()
        });
        Self { area: area.sum(), triangles, pieces: numbers, positions, indices }
    }

    fn unwrap(&self, advance: &(dyn Fn(f32) -> Result<(), Cancelled> + Sync)) -> Result<Unwrapped, Error> {
        let input = MeshInput { face_materials: Some(&self.pieces), ..MeshInput::new(&self.positions, &self.indices) };
        // Only the shapes of the charts count, not how uvunwrap packs them: few texels and its fast packing.
        let texels_per_unit = (512.0 / glam::DVec2::splat(self.area).sqrt().x) as f32;
        let options = Options {
            max_chart_angle: 70.0,
            max_area_distortion: 1.2,
            density: Density::Fixed { texels_per_unit, page_size: None },
            padding: 0,
            allow_rotation: false,
            packing: Packing::Fast,
            ..Options::default()
        };
        let atlas = uvunwrap::generate_with_progress(&[input], &options, |progress| {
            let share = match (progress.stage, progress.total) {
                (uvunwrap::Stage::Parameterizing, Some(total)) => progress.done as f32 / total as f32,
                _ => 0.0,
            };
            advance(share).is_ok()
        })?;
        let meters = Vec2::new(atlas.width as f32, atlas.height as f32) / texels_per_unit;
        let mesh = atlas.meshes.into_iter().next().unwrap_or_default();
        Ok(Unwrapped { mesh, meters })
    }
}
