//! Triangles whose edges are halved where they are not near enough.

use alloc::vec::Vec;

use super::Tolerance;
use super::chart::Chart;
use super::vertices::{Vertex, Vertices};
use crate::math::{Real, VectorSpace as _};
use crate::spline::{Scalar, SurfacePoint};

/// How often a piece between knots is halved at most.
const HALVINGS: i32 = 16;
/// So many times the triangles of the cells, and so many more, are there at most: for surfaces that no number follows.
const GROWTH: usize = 2;
const SPARE: usize = 1 << 16;
/// Where the inside of a triangle is looked at besides its center.
const INSIDE: [[f64; 3]; 3] = [[0.5, 0.25, 0.25], [0.25, 0.5, 0.25], [0.25, 0.25, 0.5]];
const NONE: u32 = u32::MAX;

/// Between two vertices.
struct Edge<P: SurfacePoint> {
    ends: [u32; 2],
    middle: Vertex<P::Point>,
    /// The points of the surface below its quarters.
    below: [P::Point; 3],
    /// Whether it is to be halved.
    coarse: bool,
    /// Whether it may be halved: an edge of the surface may not, its neighbor has it too.
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

/// Halves edges.
pub(super) struct Refiner<'a, P: SurfacePoint> {
    tolerance: &'a Tolerance<Scalar<P>>,
    chart: &'a Chart<Scalar<P>>,
    vertices: Vertices<'a, P>,
    edges: Vec<Edge<P>>,
    triangles: Vec<Triangle>,
    /// Edges not longer than this in one of the parameters are left as they are.
    finest: [Scalar<P>; 2],
    /// Whether no more edges are to be halved.
    is_last: bool,
}

impl<'a, P: SurfacePoint> Refiner<'a, P> {
    /// Triangles that share their edges; those of one triangle alone are edges of the surface.
    pub fn new(
        (vertices, triangles): (Vertices<'a, P>, Vec<[u32; 3]>),
        tolerance: &'a Tolerance<Scalar<P>>,
        chart: &'a Chart<Scalar<P>>,
    ) -> Self {
        let finest = vertices.shortest_pieces().map(|length| length / Scalar::<P>::from_usize(1 << HALVINGS));
        let (edges, shared) = (Vec::new(), Vec::with_capacity(triangles.len()));
        let mut refiner = Self { tolerance, chart, vertices, edges, triangles: shared, finest, is_last: false };
        let mut sides: Vec<([u32; 2], usize)> = Vec::with_capacity(3 * triangles.len());
        for (i, vertices) in triangles.iter().enumerate() {
            let [a, b, c] = *vertices;
            let ends = [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]);
            sides.extend(ends.iter().enumerate().map(|(k, &ends)| (ends, 3 * i + k)));
            refiner.triangles.push(Triangle { vertices: *vertices, edges: [NONE; 3], flat: false });
        }
        sides.sort_unstable();
        for same in sides.chunk_by(|a, b| a.0 == b.0) {
            let edge = refiner.add_edge(same[0].0, same.len() > 1);
            same.iter().for_each(|&(_, side)| refiner.triangles[side / 3].edges[side % 3] = edge);
        }
        refiner
    }

    /// Until nothing is too coarse, or there are far more triangles than cells gave: the vertices and the triangles.
    pub fn run(mut self) -> (Vec<Vertex<P::Point>>, Vec<[u32; 3]>) {
        let most = GROWTH * self.triangles.len() + SPARE;
        while self.halve_all() && self.triangles.len() < most {}
        // What is not halved by now stays whole; triangles beside halved edges are still cut, so that nothing gapes.
        self.is_last = true;
        self.edges.iter_mut().for_each(|edge| edge.coarse &= edge.halves[0] != NONE);
        while self.halve_all() {}
        let triangles = self.triangles.iter().map(|triangle| triangle.vertices).collect();
        (self.vertices.all, triangles)
    }

    fn add_edge(&mut self, ends: [u32; 2], is_inner: bool) -> u32 {
        let [a, b] = ends.map(|end| &self.vertices.all[end as usize]);
        let middle = self.vertices.at(self.chart.middle(a.uv, b.uv), None);
        let divisible = is_inner && self.is_divisible([a, b]);
        let [quarter, three_quarters] = [0.25, 0.75].map(|share| self.between([a, b], share));
        let below = [quarter, middle.point, three_quarters];
        let points = [a.point, quarter, middle.point, three_quarters, b.point];
        // Where a straight edge of the surface twists, no number of halvings makes the normals beside it agree.
        let holds = self.tolerance.holds_chord_inside(points, middle.normal)
            && (a.border || b.border || self.tolerance.holds_turn_inside([a, &middle, b]));
        self.edges.push(Edge {
            ends,
            middle,
            below,
            coarse: divisible && !holds && !self.is_last,
            divisible,
            halves: [NONE; 3],
        });
        self.edges.len() as u32 - 1
    }

    /// The point of the surface at a share of the way from one vertex to another.
    fn between(&self, [a, b]: [&Vertex<P::Point>; 2], share: f64) -> P::Point {
        let share = Scalar::<P>::from_f64(share);
        self.vertices.point([0, 1].map(|k| a.uv[k] + (b.uv[k] - a.uv[k]) * share))
    }

    /// Whether an edge is longer than the finest ones in each parameter that changes along it.
    fn is_divisible(&self, [a, b]: [&Vertex<P::Point>; 2]) -> bool {
        let extent = [0, 1].map(|k| (a.uv[k] - b.uv[k]).abs());
        let zero = [Scalar::<P>::ZERO; 2];
        extent != zero && (0..2).all(|k| extent[k] == zero[k] || extent[k] > self.finest[k])
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

    /// Marks the longest edge of a triangle that may be halved if its inside is too far from the surface.
    fn judge(&mut self, triangle: &Triangle) {
        let corners = triangle.vertices.map(|vertex| &self.vertices.all[vertex as usize]);
        let third = Scalar::<P>::from_f64(1.0 / 3.0);
        let center = [0, 1].map(|k| (corners[0].uv[k] + corners[1].uv[k] + corners[2].uv[k]) * third);
        let center = self.vertices.at(center, None);
        let is_at_border = corners.iter().any(|corner| corner.border);
        let inside = INSIDE.map(|shares| {
            let shares = shares.map(Scalar::<P>::from_f64);
            self.vertices.point([0, 1].map(|k| (0..3).map(|i| corners[i].uv[k] * shares[i]).sum()))
        });
        let below = triangle.edges.map(|edge| self.edges[edge as usize].below);
        if self.tolerance.holds_distance(corners, center.point)
            && inside.iter().chain(below.as_flattened()).all(|&point| self.tolerance.holds_distance(corners, point))
            && (is_at_border || self.tolerance.holds_normal(corners, &center))
        {
            return;
        }
        let length = |edge: u32| {
            let [a, b] = self.edges[edge as usize].ends.map(|end| self.vertices.all[end as usize].point);
            (b - a).length_squared()
        };
        let divisible = triangle.edges.into_iter().filter(|&edge| self.edges[edge as usize].divisible);
        if let Some(edge) = divisible.reduce(|a, b| if length(b) > length(a) { b } else { a }) {
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
        let across = self.add_edge([middle, c], true);
        self.add_triangle([a, middle, c], [before, across, edges[2]]);
        self.add_triangle([middle, b, c], [after, edges[1], across]);
    }

    fn cut_two(&mut self, [a, b, c]: [u32; 3], edges: [u32; 3]) {
        let [m, am, mb] = self.halves(edges[0], a);
        let [n, bn, nc] = self.halves(edges[1], b);
        let mn = self.add_edge([m, n], true);
        self.add_triangle([m, b, n], [mb, bn, mn]);
        let point = |vertex: u32| self.vertices.all[vertex as usize].point;
        let length = |x: u32, y: u32| (point(x) - point(y)).length_squared();
        if length(a, n) < length(m, c) {
            let an = self.add_edge([a, n], true);
            self.add_triangle([a, m, n], [am, mn, an]);
            self.add_triangle([a, n, c], [an, nc, edges[2]]);
        } else {
            let mc = self.add_edge([m, c], true);
            self.add_triangle([a, m, c], [am, mc, edges[2]]);
            self.add_triangle([m, n, c], [mn, nc, mc]);
        }
    }

    fn cut_three(&mut self, [a, b, c]: [u32; 3], edges: [u32; 3]) {
        let [l, al, lb] = self.halves(edges[0], a);
        let [m, bm, mc] = self.halves(edges[1], b);
        let [n, cn, na] = self.halves(edges[2], c);
        let [lm, mn, nl] = [[l, m], [m, n], [n, l]].map(|ends| self.add_edge(ends, true));
        self.add_triangle([a, l, n], [al, nl, na]);
        self.add_triangle([b, m, l], [bm, lm, lb]);
        self.add_triangle([c, n, m], [cn, mn, mc]);
        self.add_triangle([l, m, n], [lm, mn, nl]);
    }

    fn add_triangle(&mut self, vertices: [u32; 3], edges: [u32; 3]) {
        self.triangles.push(Triangle { vertices, edges, flat: false });
    }

    /// The vertex in the middle of an edge, and its halves as they follow each other from `first`.
    fn halves(&mut self, edge: u32, first: u32) -> [u32; 3] {
        let Edge { ends: [a, b], middle, halves, .. } = self.edges[edge as usize];
        let [middle, before, after] = if halves[0] == NONE {
            let vertex = self.vertices.all.len() as u32;
            self.vertices.all.push(middle);
            let halves = [vertex, self.add_edge([a, vertex], true), self.add_edge([vertex, b], true)];
            self.edges[edge as usize].halves = halves;
            halves
        } else {
            halves
        };
        if first == a { [middle, before, after] } else { [middle, after, before] }
    }
}
