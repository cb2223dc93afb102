//! Triangles whose edges are halved until they are fine enough.

use alloc::vec::Vec;

use super::Tolerance;
use super::flatness::angle_above;
use crate::math::{Real, Vector, VectorSpace as _};
use crate::spline::{BSplineSurface, Direction, Scalar, Side, SurfacePoint};

/// How often a piece between knots is halved at most.
const HALVINGS: i32 = 10;
/// How often it is at most for the sake of normals where an edge touches the border. A border that is straight stays
/// whole, even if normals turn along it: then no number of halvings is enough.
const HALVINGS_AT_BORDER: i32 = 6;
/// How often all triangles are looked at; twice the halvings in both directions.
const ROUNDS: i32 = 4 * HALVINGS;
/// The finest edges there over the finest ones elsewhere.
const AT_BORDER: usize = 1 << (HALVINGS - HALVINGS_AT_BORDER);
const NONE: u32 = u32::MAX;

/// A point of the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex<V: Vector> {
    pub uv: [V::Scalar; 2],
    pub point: V,
    pub du: V,
    pub dv: V,
    pub normal: V,
    /// Whether it lies on an edge of the surface.
    pub border: bool,
}

/// Between two vertices.
struct Edge<V: Vector> {
    ends: [u32; 2],
    /// The edge of the surface on which it lies.
    side: Option<Side>,
    middle: Vertex<V>,
    /// Whether it is to be halved.
    coarse: bool,
    /// Whether it may be halved.
    divisible: bool,
    /// The vertex in the middle, and the edges from the first end to it and from it to the second end.
    halves: [u32; 3],
}

/// Vertices `i` and edges `i` from vertex `i` to the next one.
#[derive(Clone, Copy)]
struct Triangle {
    vertices: [u32; 3],
    edges: [u32; 3],
    /// Whether its inside is near enough.
    flat: bool,
}

/// What is left of a surface.
pub(super) struct Refined<V: Vector> {
    pub vertices: Vec<Vertex<V>>,
    pub triangles: Vec<[u32; 3]>,
}

/// Halves edges.
pub(super) struct Refiner<'a, P: SurfacePoint> {
    surface: &'a BSplineSurface<'a, P>,
    tolerance: &'a Tolerance<Scalar<P>>,
    vertices: Vec<Vertex<P::Point>>,
    edges: Vec<Edge<P::Point>>,
    triangles: Vec<Triangle>,
    /// The middle of the domain.
    middle: [Scalar<P>; 2],
    /// Edges not longer than this in both parameters are left as they are.
    finest: [Scalar<P>; 2],
    /// The points to which edges of the surface collapse.
    poles: [Option<P::Point>; 4],
    /// Whether no more edges are to be halved.
    is_last: bool,
}

impl<'a, P: SurfacePoint> Refiner<'a, P> {
    /// Two triangles for each piece of a surface.
    pub fn new(surface: &'a BSplineSurface<'a, P>, tolerance: &'a Tolerance<Scalar<P>>) -> Self {
        let breaks = [Direction::U, Direction::V].map(|direction| breaks(surface, direction));
        let [middle, finest] = [0, 1].map(|what| {
            [0, 1].map(|k| {
                let shortest =
                    breaks[k].windows(2).map(|pair| pair[1] - pair[0]).fold(Scalar::<P>::INFINITY, Real::min);
                let half = Scalar::<P>::from_f64(0.5);
                let center = (breaks[k][0] + breaks[k][breaks[k].len() - 1]) * half;
                if what == 0 { center } else { shortest / Scalar::<P>::from_usize(1 << HALVINGS) }
            })
        });
        let (vertices, edges, triangles) = (Vec::new(), Vec::new(), Vec::new());
        let poles = [None; 4];
        let mut refiner =
            Self { surface, tolerance, vertices, edges, triangles, middle, finest, poles, is_last: false };
        refiner.poles = [Side::Bottom, Side::Right, Side::Top, Side::Left].map(|side| refiner.pole(side));
        refiner.add_grid(&breaks);
        refiner
    }

    /// Until nothing is too coarse.
    pub fn run(mut self) -> Refined<P::Point> {
        for _ in 0..ROUNDS {
            if !self.halve_all() {
                break;
            }
        }
        // What is not halved by now stays whole; triangles beside halved edges are still cut, so that nothing gapes.
        self.is_last = true;
        self.edges.iter_mut().for_each(|edge| edge.coarse &= edge.halves[0] != NONE);
        while self.halve_all() {}
        let triangles = self.triangles.iter().map(|triangle| triangle.vertices).collect();
        Refined { vertices: self.vertices, triangles }
    }

    /// The point to which an edge of the surface collapses, if it does.
    fn pole(&self, side: Side) -> Option<P::Point> {
        let knots = self.surface.knots_of(side);
        let at = |t: Scalar<P>| self.surface.edge(side, t)[0];
        let [start, _] = knots.domain();
        let first = at(start);
        let shares = [0.23, 0.5, 0.81, 1.0].map(Scalar::<P>::from_f64);
        let mut places = knots.spans().flat_map(|span| {
            let [low, high] = [knots.knots()[span], knots.knots()[span + 1]];
            shares.map(|share| low + (high - low) * share)
        });
        places.all(|t| self.is_at(at(t), first)).then_some(first)
    }

    fn add_grid(&mut self, [us, vs]: &[Vec<Scalar<P>>; 2]) {
        let (width, height) = (us.len() as u32, vs.len() as u32);
        let at = |i: u32, j: u32| j * width + i;
        for (j, &v) in vs.iter().enumerate() {
            for (i, &u) in us.iter().enumerate() {
                let side = side_at([i, j].map(|k| k as u32), [width, height]);
                let vertex = self.vertex([u, v], side);
                self.vertices.push(vertex);
            }
        }
        let on = |is_first: bool, is_last: bool, sides: [Side; 2]| match (is_first, is_last) {
            (true, _) => Some(sides[0]),
            (_, true) => Some(sides[1]),
            _ => None,
        };
        let first_along = self.edges.len() as u32;
        for (j, i) in (0..height).flat_map(|j| (0..width - 1).map(move |i| (j, i))) {
            self.add_edge([at(i, j), at(i + 1, j)], on(j == 0, j == height - 1, [Side::Bottom, Side::Top]));
        }
        let first_across = self.edges.len() as u32;
        for (j, i) in (0..height - 1).flat_map(|j| (0..width).map(move |i| (j, i))) {
            self.add_edge([at(i, j), at(i, j + 1)], on(i == 0, i == width - 1, [Side::Left, Side::Right]));
        }
        for (j, i) in (0..height - 1).flat_map(|j| (0..width - 1).map(move |i| (j, i))) {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let along = [j, j + 1].map(|j| first_along + j * (width - 1) + i);
            let across = [i, i + 1].map(|i| first_across + j * width + i);
            let diagonal = self.add_edge([a, c], None);
            self.add_triangle([a, b, c], [along[0], across[1], diagonal]);
            self.add_triangle([a, c, d], [diagonal, along[1], across[0]]);
        }
    }

    /// A point of the surface; on an edge of it as its neighbor has it too.
    fn vertex(&self, uv: [Scalar<P>; 2], side: Option<Side>) -> Vertex<P::Point> {
        let [u, v] = uv;
        let [mut point, du, dv] = self.surface.tangents(u, v);
        let normal = self.normal(uv, du, dv);
        if let Some(side) = side {
            [point, _] = self.surface.edge(side, if is_along_u(side) { u } else { v });
            point = self.poles.iter().flatten().copied().find(|&pole| self.is_at(point, pole)).unwrap_or(point);
        }
        Vertex { uv, point, du, dv, normal, border: side.is_some() }
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

    fn add_edge(&mut self, ends: [u32; 2], side: Option<Side>) -> u32 {
        let [a, b] = ends.map(|end| &self.vertices[end as usize]);
        let half = Scalar::<P>::from_f64(0.5);
        let middle = self.vertex([0, 1].map(|k| (a.uv[k] + b.uv[k]) * half), side);
        let divisible = self.is_divisible([a, b], 1);
        let holds = match side {
            Some(side) => self.holds_at_border(side, [a, &middle, b]),
            None if (a.border || b.border) && !self.is_divisible([a, b], AT_BORDER) => {
                self.tolerance.holds_chord_inside([a, &middle, b])
            }
            None => self.tolerance.holds_inside([a, &middle, b]),
        };
        self.edges.push(Edge {
            ends,
            side,
            middle,
            coarse: divisible && !holds && !self.is_last,
            divisible,
            halves: [NONE; 3],
        });
        self.edges.len() as u32 - 1
    }

    /// Whether an edge is longer than the finest ones times a factor, in each parameter that changes along it.
    fn is_divisible(&self, [a, b]: [&Vertex<P::Point>; 2], factor: usize) -> bool {
        let extent = [0, 1].map(|k| (a.uv[k] - b.uv[k]).abs());
        let least = self.finest.map(|finest| finest * Scalar::<P>::from_usize(factor));
        extent != [Scalar::<P>::ZERO; 2] && (0..2).all(|k| extent[k] == Scalar::<P>::ZERO || extent[k] > least[k])
    }

    /// Whether two points are the same to rounding.
    fn is_at(&self, a: P::Point, b: P::Point) -> bool {
        let size = b.to_array().into_iter().fold(Scalar::<P>::ZERO, |size, x| size.max(x.abs()));
        (a - b).length() <= size * Scalar::<P>::EPSILON * Scalar::<P>::from_f64(64.0)
    }

    fn holds_at_border(&self, side: Side, [a, middle, b]: [&Vertex<P::Point>; 3]) -> bool {
        let along = usize::from(!is_along_u(side));
        if a.point == b.point && a.point == middle.point {
            // A pole: what leaves it must not turn too far from one vertex to the next.
            let [from, to] = [a, b].map(|end| if along == 0 { end.dv } else { end.du });
            return !angle_above(from, to, self.tolerance.angle);
        }
        let step = b.uv[along] - a.uv[along];
        let tangents = [a, b].map(|end| self.surface.edge(side, end.uv[along])[1] * step);
        self.tolerance.holds_at_border([a.point, middle.point, b.point], tangents)
    }

    fn add_triangle(&mut self, vertices: [u32; 3], edges: [u32; 3]) {
        self.triangles.push(Triangle { vertices, edges, flat: false });
    }

    /// Cuts all triangles with an edge that is too coarse; whether there was one.
    fn halve_all(&mut self) -> bool {
        let before = core::mem::take(&mut self.triangles);
        let mut changed = false;
        for mut triangle in before {
            if !triangle.flat && !self.is_last && !self.is_coarse(&triangle) {
                self.judge(&triangle);
                triangle.flat = true;
            }
            if self.is_coarse(&triangle) {
                self.cut(&triangle);
                changed = true;
            } else {
                self.triangles.push(triangle);
            }
        }
        changed
    }

    fn is_coarse(&self, triangle: &Triangle) -> bool {
        triangle.edges.iter().any(|&edge| self.edges[edge as usize].coarse)
    }

    /// Marks the longest edge of a triangle that its neighbors may share if its inside is too far from the surface.
    fn judge(&mut self, triangle: &Triangle) {
        let corners = triangle.vertices.map(|vertex| &self.vertices[vertex as usize]);
        let third = Scalar::<P>::from_f64(1.0 / 3.0);
        let center = [0, 1].map(|k| (corners[0].uv[k] + corners[1].uv[k] + corners[2].uv[k]) * third);
        let center = self.vertex(center, None);
        let is_at_border = corners.iter().filter(|corner| corner.border).count() > 1;
        let factor =
            match (self.tolerance.holds_distance(corners, &center), self.tolerance.holds_normal(corners, &center)) {
                (true, true) => return,
                (true, false) if is_at_border => AT_BORDER,
                _ => 1,
            };
        let length = |edge: u32| {
            let [a, b] = self.edges[edge as usize].ends.map(|end| self.vertices[end as usize].point);
            (b - a).length_squared()
        };
        let may = |edge: &u32| {
            let Edge { ends, side, divisible, .. } = &self.edges[*edge as usize];
            let ends = ends.map(|end| &self.vertices[end as usize]);
            side.is_none() && *divisible && self.is_divisible(ends, factor)
        };
        let longest = triangle.edges.into_iter().filter(may).reduce(|a, b| if length(b) > length(a) { b } else { a });
        if let Some(edge) = longest {
            self.edges[edge as usize].coarse = true;
        }
    }

    /// Replaces a triangle by two to four.
    fn cut(&mut self, triangle: &Triangle) {
        let coarse = triangle.edges.map(|edge| self.edges[edge as usize].coarse);
        let count = coarse.iter().filter(|&&coarse| coarse).count();
        // Turned so that the first edges are the coarse ones.
        let first = match count {
            1 => coarse.iter().position(|&coarse| coarse),
            2 => coarse.iter().position(|&coarse| !coarse).map(|fine| fine + 1),
            _ => Some(0),
        };
        let turn = |k: usize| (k + first.unwrap_or(0)) % 3;
        let v = [0, 1, 2].map(|k| triangle.vertices[turn(k)]);
        let e = [0, 1, 2].map(|k| triangle.edges[turn(k)]);
        match count {
            1 => self.cut_one(v, e),
            2 => self.cut_two(v, e),
            _ => self.cut_three(v, e),
        }
    }

    fn cut_one(&mut self, [a, b, c]: [u32; 3], edges: [u32; 3]) {
        let [middle, before, after] = self.halves(edges[0], a);
        let across = self.add_edge([middle, c], None);
        self.add_triangle([a, middle, c], [before, across, edges[2]]);
        self.add_triangle([middle, b, c], [after, edges[1], across]);
    }

    fn cut_two(&mut self, [a, b, c]: [u32; 3], edges: [u32; 3]) {
        let [m, am, mb] = self.halves(edges[0], a);
        let [n, bn, nc] = self.halves(edges[1], b);
        let mn = self.add_edge([m, n], None);
        self.add_triangle([m, b, n], [mb, bn, mn]);
        let length =
            |x: u32, y: u32| (self.vertices[x as usize].point - self.vertices[y as usize].point).length_squared();
        if length(a, n) < length(m, c) {
            let an = self.add_edge([a, n], None);
            self.add_triangle([a, m, n], [am, mn, an]);
            self.add_triangle([a, n, c], [an, nc, edges[2]]);
        } else {
            let mc = self.add_edge([m, c], None);
            self.add_triangle([a, m, c], [am, mc, edges[2]]);
            self.add_triangle([m, n, c], [mn, nc, mc]);
        }
    }

    fn cut_three(&mut self, [a, b, c]: [u32; 3], edges: [u32; 3]) {
        let [l, al, lb] = self.halves(edges[0], a);
        let [m, bm, mc] = self.halves(edges[1], b);
        let [n, cn, na] = self.halves(edges[2], c);
        let [lm, mn, nl] = [[l, m], [m, n], [n, l]].map(|ends| self.add_edge(ends, None));
        self.add_triangle([a, l, n], [al, nl, na]);
        self.add_triangle([b, m, l], [bm, lm, lb]);
        self.add_triangle([c, n, m], [cn, mn, mc]);
        self.add_triangle([l, m, n], [lm, mn, nl]);
    }

    /// The vertex in the middle of an edge, and its halves as they follow each other from `first`.
    fn halves(&mut self, edge: u32, first: u32) -> [u32; 3] {
        let Edge { ends: [a, b], side, middle, halves, .. } = self.edges[edge as usize];
        let [middle, before, after] = if halves[0] == NONE {
            let vertex = self.vertices.len() as u32;
            self.vertices.push(middle);
            let halves = [vertex, self.add_edge([a, vertex], side), self.add_edge([vertex, b], side)];
            self.edges[edge as usize].halves = halves;
            halves
        } else {
            halves
        };
        if first == a { [middle, before, after] } else { [middle, after, before] }
    }
}

/// The parameters at which pieces begin, and the end of the last one.
fn breaks<P: SurfacePoint>(surface: &BSplineSurface<P>, direction: Direction) -> Vec<Scalar<P>> {
    let knots = surface.knots(direction);
    let [_, end] = knots.domain();
    knots.spans().map(|span| knots.knots()[span]).chain([end]).collect()
}

/// The edge of the surface on which a point of the grid lies.
fn side_at([i, j]: [u32; 2], [width, height]: [u32; 2]) -> Option<Side> {
    match [i, j] {
        [_, 0] => Some(Side::Bottom),
        [_, j] if j == height - 1 => Some(Side::Top),
        [0, _] => Some(Side::Left),
        [i, _] if i == width - 1 => Some(Side::Right),
        _ => None,
    }
}

fn is_along_u(side: Side) -> bool {
    matches!(side, Side::Bottom | Side::Top)
}
