//! Surfaces as triangles: fine where they bend, without cracks, and lightmap charts by nature.

mod blocks;
mod cells;
mod chart;
mod error;
mod flatness;
mod refine;
mod vertices;

pub use chart::ChartScale;
pub use error::*;

use alloc::string::String;
use alloc::vec::Vec;

use glam::Vec2;

use super::{BSplineSurface, Scalar, SurfacePoint};
use crate::geometry::Mesh;
use crate::math::{Real, Vector, VectorSpace};
use chart::Chart;
use refine::Refiner;
use vertices::Vertex;

/// How near triangles come to their surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance<R> {
    chord: R,
    angle: R,
}

impl<R: Real> Tolerance<R> {
    /// Triangles that lie within `chord` of the surface, in meters, and along whose edges the normal turns by no more than
    /// `angle`, in radians; 0.001 and 0.2 are usual. Those without a vertex on an edge of the surface face the way of the
    /// surface within twice the angle.
    ///
    /// Each triangle is checked at the quarters of its edges and at four points inside, with a few percent to spare for
    /// what lies between them; where the weights of a surface differ by hundreds, it may be up to half more. Beside a
    /// straight edge along which a surface twists, normals turn by more: see [`tessellate`]. A piece of a surface between
    /// knots has at most 256 columns and rows, and what is left is cut into at most twice as many triangles and 65 536.
    ///
    /// # Errors
    ///
    /// Where one is not a positive number.
    pub fn new(chord: R, angle: R) -> Result<Self, TessellationError> {
        let is_positive = |x: R| x > R::ZERO && x < R::INFINITY;
        if !is_positive(chord) {
            return Err(TessellationError::Chord { chord: chord.to_f64() });
        }
        if !is_positive(angle) {
            return Err(TessellationError::Angle { angle: angle.to_f64() });
        }
        Ok(Self { chord, angle })
    }
}

/// Indexed triangles that lie near a surface, counter-clockwise seen from its front; every list but `triangles` has one
/// entry for each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Tessellation<V: VectorSpace> {
    /// Points of the surface.
    pub positions: Vec<V>,
    /// The normals of the surface there, of length 1.
    pub normals: Vec<V>,
    /// The parameters of the surface there.
    pub parameters: Vec<[V::Scalar; 2]>,
    /// The same, so that the domain is `0..1`.
    pub uv_0: Vec<[V::Scalar; 2]>,
    /// The same, so that texels have the sizes that [`ChartScale`] says: the surface is one chart that fills `0..1`.
    pub uv_1: Vec<[V::Scalar; 2]>,
    /// Indices into the vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Mean width along `u` and mean height along `v`, in meters.
    pub size: [V::Scalar; 2],
}

/// Cuts a surface into triangles.
///
/// Each part of it gets as many columns and rows as it bends: the chord of Filip, Magedson and Markot 1986, with what
/// bends along the normal alone. Edges of triangles that are still too far away are halved, and triangles with them, so
/// that no vertex lies inside an edge. An edge of the surface is cut for its own sake alone: neighbors that share its
/// control points (see [`BSplineSurface::edge`]) are cut alike there, each on its own, whatever the surface does beside it. Where an inner line of
/// knots is a crease, the vertices on it are double, each with the normal of its side. Triangles without area at poles
/// are left out.
pub fn tessellate<P: SurfacePoint>(
    surface: &BSplineSurface<P>,
    tolerance: &Tolerance<Scalar<P>>,
    scale: ChartScale,
) -> Tessellation<P::Point> {
    let chart = Chart::new(surface, scale);
    let mut result = Tessellation {
        positions: Vec::new(),
        normals: Vec::new(),
        parameters: Vec::new(),
        uv_0: Vec::new(),
        uv_1: Vec::new(),
        triangles: Vec::new(),
        size: chart.size(),
    };
    for block in blocks::blocks(surface) {
        let surface = block.surface();
        let cells = cells::sew(&surface, tolerance);
        let (vertices, triangles) = Refiner::new(cells, tolerance, &chart).run();
        result.append(&vertices, &triangles, &chart);
    }
    result
}

impl<V: Vector> Tessellation<V> {
    /// A mesh for the bake, in single precision; it keeps `uv_1` as lightmap coordinates.
    pub fn mesh(&self, name: String) -> Mesh {
        let vector = |v: &V| v.to_dvec3().as_vec3();
        let uv = |uv: &[V::Scalar; 2]| Vec2::from_array(uv.map(|x| x.to_f64() as f32));
        Mesh {
            name,
            positions: self.positions.iter().map(vector).collect(),
            normals: self.normals.iter().map(vector).collect(),
            uv_0: self.uv_0.iter().map(uv).collect(),
            uv_1: self.uv_1.iter().map(uv).collect(),
            triangles: self.triangles.clone(),
            ..Mesh::default()
        }
    }

    fn append(&mut self, vertices: &[Vertex<V>], triangles: &[[u32; 3]], chart: &Chart<V::Scalar>) {
        let first = self.positions.len() as u32;
        let has_area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| vertices[i as usize].point);
            a != b && b != c && c != a
        };
        self.triangles.extend(triangles.iter().filter(|t| has_area(t)).map(|t| t.map(|i| first + i)));
        self.positions.extend(vertices.iter().map(|vertex| vertex.point));
        self.normals.extend(vertices.iter().map(|vertex| vertex.normal));
        self.parameters.extend(vertices.iter().map(|vertex| vertex.uv));
        self.uv_0.extend(vertices.iter().map(|vertex| chart.linear(vertex.uv)));
        self.uv_1.extend(vertices.iter().map(|vertex| chart.scaled(vertex.uv)));
    }
}
