//! Points of a surface with their normals.

use alloc::vec::Vec;

use crate::math::{Real, Vector, VectorSpace as _};
use crate::spline::{BSplineSurface, Direction, Scalar, Side, SurfacePoint};

/// A point of the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex<V: Vector> {
    pub uv: [V::Scalar; 2],
    pub point: V,
    pub normal: V,
    /// Whether it lies on an edge of the surface.
    pub border: bool,
}

/// Points of one surface.
pub(super) struct Vertices<'a, P: SurfacePoint> {
    surface: &'a BSplineSurface<'a, P>,
    /// The middle of the domain.
    middle: [Scalar<P>; 2],
    /// The points to which edges of the surface collapse.
    poles: [Option<P::Point>; 4],
    pub all: Vec<Vertex<P::Point>>,
}

impl<'a, P: SurfacePoint> Vertices<'a, P> {
    pub fn new(surface: &'a BSplineSurface<'a, P>) -> Self {
        let middle = surface.domain().map(|[low, high]| (low + high) * Scalar::<P>::from_f64(0.5));
        let poles = [Side::Bottom, Side::Right, Side::Top, Side::Left].map(|side| pole(surface, side));
        Self { surface, middle, poles, all: Vec::new() }
    }

    /// Adds a vertex; on an edge of the surface as its neighbor has it too.
    pub fn add(&mut self, uv: [Scalar<P>; 2], side: Option<Side>) -> u32 {
        self.all.push(self.at(uv, side));
        self.all.len() as u32 - 1
    }

    /// A vertex that is none yet.
    pub fn at(&self, uv: [Scalar<P>; 2], side: Option<Side>) -> Vertex<P::Point> {
        let [u, v] = uv;
        let [mut point, du, dv] = self.surface.tangents(u, v);
        if let Some(side) = side {
            [point, _] = self.surface.edge(side, if side.is_along_u() { u } else { v });
            point = self.poles.iter().flatten().copied().find(|&pole| is_at(point, pole)).unwrap_or(point);
        }
        Vertex { uv, point, normal: self.normal(uv, du, dv), border: side.is_some() }
    }

    /// A point of the surface.
    pub fn point(&self, [u, v]: [Scalar<P>; 2]) -> P::Point {
        self.surface.point(u, v)
    }

    /// The length of the shortest piece between knots in both directions.
    pub fn shortest_pieces(&self) -> [Scalar<P>; 2] {
        [Direction::U, Direction::V].map(|direction| {
            let knots = self.surface.knots(direction);
            let lengths = knots.spans().map(|span| knots.knots()[span + 1] - knots.knots()[span]);
            lengths.fold(Scalar::<P>::INFINITY, Real::min)
        })
    }

    /// Whether an edge of the surface is a point.
    pub fn is_pole(&self, side: Side) -> bool {
        self.poles[side as usize].is_some()
    }

    fn normal(&self, [u, v]: [Scalar<P>; 2], du: P::Point, dv: P::Point) -> P::Point {
        let (normal, speed) = (du.cross(dv), du.length_squared() + dv.length_squared());
        let length = normal.length();
        let threshold = Scalar::<P>::EPSILON.sqrt() * Scalar::<P>::from_f64(2.0);
        if length > threshold * speed {
            return normal / length;
        }
        self.surface.at(u, v).normal([self.middle[0] - u, self.middle[1] - v])
    }
}

/// The point to which an edge of the surface collapses, if it does.
fn pole<P: SurfacePoint>(surface: &BSplineSurface<P>, side: Side) -> Option<P::Point> {
    let knots = surface.knots_of(side);
    let at = |t: Scalar<P>| surface.edge(side, t)[0];
    let [start, _] = knots.domain();
    let first = at(start);
    let shares = [0.23, 0.5, 0.81, 1.0].map(Scalar::<P>::from_f64);
    let mut places = knots.spans().flat_map(|span| {
        let [low, high] = [knots.knots()[span], knots.knots()[span + 1]];
        shares.map(|share| low + (high - low) * share)
    });
    places.all(|t| is_at(at(t), first)).then_some(first)
}

/// Whether two points are the same to rounding.
fn is_at<V: Vector>(a: V, b: V) -> bool {
    let size = b.to_array().into_iter().fold(V::Scalar::ZERO, |size, x| size.max(x.abs()));
    (a - b).length() <= size * V::Scalar::EPSILON * V::Scalar::from_f64(64.0)
}
