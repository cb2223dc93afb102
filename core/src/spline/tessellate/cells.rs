//! The cells between lines of parameters, each with as many columns and rows as it needs, sewn together without gaps.

use alloc::vec;
use alloc::vec::Vec;

use super::Tolerance;
use super::vertices::{Vertex, Vertices};
use crate::math::{Real, Vector};
use crate::spline::{BSplineSurface, Direction, KnotVector, Scalar, Side, SurfaceJet, SurfacePoint};

/// Columns and rows that a cell is to have at most; larger ones are cut, so that each part takes what it needs itself.
const WIDEST: usize = 8;
/// Columns and rows that a piece between knots has at most.
const MOST: usize = 1 << 8;
/// Edges of a surface are cut at multiples of such a share of a piece.
const GRAINS: usize = 1 << 12;
/// Samples of a cell in each direction.
const SAMPLES: usize = 4;
/// The skew of two edges is about the same if it differs by no more than this share.
const ALIKE: f64 = 0.1;
/// Edges from a vertex of an edge of the surface for which no ring is worth while.
const FAN: usize = 4;
/// Samples may miss the worst place by a little.
const SAFETY: f64 = 0.9;

/// How a surface bends between two parameters in each direction, for steps as long as the whole.
struct Bend<V: Vector> {
    /// The second fundamental form.
    second: [V::Scalar; 3],
    /// Turns of the normal.
    turns: [V; 2],
}

/// Bends at places all over a cell.
struct Demand<V: Vector>([Bend<V>; SAMPLES * SAMPLES]);

impl<V: Vector> Demand<V> {
    /// Of a part of the piece in an interval of knots.
    fn new<P: SurfacePoint<Point = V, Scalar = V::Scalar>>(
        surface: &BSplineSurface<P>,
        spans: [usize; 2],
        part: [[V::Scalar; 2]; 2],
    ) -> Self {
        let steps = V::Scalar::from_usize(SAMPLES - 1);
        let size = part.map(|[low, high]| high - low);
        let inner = part.map(|[low, high]| (low + high) * V::Scalar::from_f64(0.5));
        let jets: [SurfaceJet<V>; SAMPLES * SAMPLES] = core::array::from_fn(|index| {
            let share = [index % SAMPLES, index / SAMPLES].map(|i| V::Scalar::from_usize(i) / steps);
            let [u, v] = [0, 1].map(|k| part[k][0] + size[k] * share[k]);
            SurfaceJet::new(surface.derivatives_in::<3>(spans, u, v))
        });
        let normals: [V; SAMPLES * SAMPLES] = core::array::from_fn(|index| {
            let share = [index % SAMPLES, index / SAMPLES].map(|i| V::Scalar::from_usize(i) / steps);
            let [u, v] = [0, 1].map(|k| part[k][0] + size[k] * share[k]);
            jets[index].normal([inner[0] - u, inner[1] - v])
        });
        let turn = |index: usize, along: usize, step: usize| {
            let from = if along + 1 < SAMPLES { index } else { index - step };
            (normals[from + step] - normals[from]) * steps
        };
        Self(core::array::from_fn(|index| {
            let (jet, normal) = (&jets[index], normals[index]);
            let scales = [size[0] * size[0], size[0] * size[1], size[1] * size[1]];
            let second = [jet.duu, jet.duv, jet.dvv].map(|second| second.dot(normal));
            Bend {
                second: [0, 1, 2].map(|k| second[k] * scales[k]),
                turns: [turn(index, index % SAMPLES, 1), turn(index, index / SAMPLES, SAMPLES)],
            }
        }))
    }

    /// The fewest columns and rows with which all edges are near enough, or nearly so.
    fn counts(&self, tolerance: &Tolerance<V::Scalar>, most: usize) -> [usize; 2] {
        let alone = |k: usize| {
            let bends = self.0.iter().map(|bend| {
                let chord = bend.second[2 * k].abs() / tolerance.sagitta();
                chord.max(bend.turns[k].length_squared() / (tolerance.angle * tolerance.angle))
            });
            let least = bends.fold(V::Scalar::ZERO, Real::max).sqrt().to_f64();
            (least.to_usize() + usize::from(least > least.floor())).clamp(1, most)
        };
        let [mut n, mut m] = [alone(0), alone(1)];
        while self.excess([n, m], tolerance) > V::Scalar::ONE && n.max(m) < most {
            let finer = [[n + 1 + n / 16, m], [n, m + 1 + m / 16]];
            let cost = |[n, m]: [usize; 2]| V::Scalar::from_usize(n * m) * self.excess([n, m], tolerance);
            [n, m] = if cost(finer[0]) <= cost(finer[1]) { finer[0] } else { finer[1] };
        }
        [n, m]
    }

    /// By how much the worst edge is too coarse; it falls with the square of the counts.
    fn excess(&self, counts: [usize; 2], tolerance: &Tolerance<V::Scalar>) -> V::Scalar {
        let [a, b] = counts.map(|count| V::Scalar::ONE / V::Scalar::from_usize(count));
        let of = |bend: &Bend<V>| {
            let [along, mixed, across] = bend.second;
            let diagonal = |b: V::Scalar| {
                let height = along * (a * a) + mixed * (a * b + a * b) + across * (b * b);
                tolerance.excess(height.abs(), bend.turns[0] * a + bend.turns[1] * b)
            };
            let sides = tolerance
                .excess((along * (a * a)).abs(), bend.turns[0] * a)
                .max(tolerance.excess((across * (b * b)).abs(), bend.turns[1] * b));
            diagonal(b).min(diagonal(-b)).max(sides)
        };
        self.0.iter().map(of).fold(V::Scalar::ZERO, Real::max)
    }
}

impl<R: Real> Tolerance<R> {
    /// The part `h` of a second derivative along the normal that makes a chord, at its middle, as far from the curve as
    /// it may be: `h / 8`.
    fn sagitta(&self) -> R {
        self.chord * R::from_f64(8.0 * SAFETY)
    }

    /// Above 1 where an edge is too coarse.
    fn excess<V: Vector<Scalar = R>>(&self, second: R, turn: V) -> R {
        (second / self.sagitta()).max(turn.length_squared() / (self.angle * self.angle))
    }

    /// The same by the points and normals at the ends of an edge; what is fine anyway is all the same.
    fn excess_of<V: Vector<Scalar = R>>(&self, [a, b]: [&Vertex<V>; 2]) -> R {
        let turn = b.normal - a.normal;
        self.excess((b.point - a.point).dot(turn).abs(), turn).max(R::from_f64(0.5))
    }
}

/// Where the vertices of an edge of a cell are, both ends among them.
type Line = Vec<u32>;

const DIRECTIONS: [Direction; 2] = [Direction::U, Direction::V];
const SIDES: [Side; 4] = [Side::Bottom, Side::Right, Side::Top, Side::Left];

/// A surface cut into cells.
struct Cells<'a, P: SurfacePoint> {
    surface: &'a BSplineSurface<'a, P>,
    tolerance: &'a Tolerance<Scalar<P>>,
    /// The parameters between cells, and the intervals of knots after them.
    lines: [Vec<Scalar<P>>; 2],
    spans: [Vec<usize>; 2],
    /// Columns and rows of each cell.
    counts: Vec<[usize; 2]>,
    vertices: Vertices<'a, P>,
    triangles: Vec<[u32; 3]>,
}

/// The vertices and triangles of a surface; nearly all edges are near enough.
pub(super) fn sew<'a, P: SurfacePoint>(
    surface: &'a BSplineSurface<'a, P>,
    tolerance: &'a Tolerance<Scalar<P>>,
) -> (Vertices<'a, P>, Vec<[u32; 3]>) {
    let spans = DIRECTIONS.map(|direction| surface.knots(direction).spans().collect::<Vec<_>>());
    let most = most_counts(surface, tolerance, &spans);
    let [(us, of_u), (vs, of_v)] = [0, 1].map(|k| lines(&surface.knots(DIRECTIONS[k]), &spans[k], &most[k]));
    let (counts, triangles) = (Vec::new(), Vec::new());
    let (lines, spans, vertices) = ([us, vs], [of_u, of_v], Vertices::new(surface));
    let mut cells = Cells { surface, tolerance, lines, spans, counts, vertices, triangles };
    cells.sew(&most);
    (cells.vertices, cells.triangles)
}

/// The most columns and rows that any piece between the same knots needs.
fn most_counts<P: SurfacePoint>(
    surface: &BSplineSurface<P>,
    tolerance: &Tolerance<Scalar<P>>,
    spans: &[Vec<usize>; 2],
) -> [Vec<usize>; 2] {
    let mut most = [0, 1].map(|k| vec![1; spans[k].len()]);
    for (j, &y) in spans[1].iter().enumerate() {
        for (i, &x) in spans[0].iter().enumerate() {
            let part = [interval(&surface.knots(Direction::U), x), interval(&surface.knots(Direction::V), y)];
            let [n, m] = Demand::new(surface, [x, y], part).counts(tolerance, MOST);
            (most[0][i], most[1][j]) = (most[0][i].max(n), most[1][j].max(m));
        }
    }
    most
}

impl<P: SurfacePoint> Cells<'_, P> {
    fn sew(&mut self, most: &[Vec<usize>; 2]) {
        let cuts = SIDES.map(|side| self.cuts(side));
        let has_pole = SIDES.iter().any(|&side| self.vertices.is_pole(side));
        let is_whole = |side: Side| cuts[side as usize].is_empty() && !has_pole;
        if most[1] == [1] && is_whole(Side::Left) && is_whole(Side::Right) {
            let [bottom, _, top, _] = self.border(cuts);
            return self.strip(&bottom, &top, 0);
        }
        if most[0] == [1] && is_whole(Side::Bottom) && is_whole(Side::Top) {
            let [_, right, _, left] = self.border(cuts);
            return self.strip(&right, &left, 1);
        }
        let is_met = |side: Side| {
            let lines = &self.lines[side.along()];
            lines[1..lines.len() - 1].iter().all(|line| cuts[side as usize].contains(line))
        };
        if SIDES.iter().all(|&side| self.vertices.is_pole(side) || is_met(side)) {
            self.count();
            let sides = self.border(cuts);
            let lines = SIDES.map(|side| self.shared_out(side, &sides[side as usize]));
            return self.fill_all(lines);
        }
        // Lines of cells do not end at vertices of the edge: between both lie rings, as wide as a column or a row.
        (0..2).for_each(|k| inset(&mut self.lines[k], &most[k]));
        self.count();
        let outer = self.border(cuts);
        let inner = self.inner_border();
        self.sew_rings(&outer, inner.each_ref().map(|lines| joined(lines)));
        self.fill_all(inner);
    }

    /// Fills the place between the edges of the surface and the lines around all cells.
    ///
    /// Where an edge has far less vertices than the lines beside it, as it is straight though the surface twists, rings
    /// halve the number of vertices, and the distance to the edge with them: twice the length of a triangle along the
    /// edge bears half the width.
    fn sew_rings(&mut self, outer: &[Line; 4], mut inner: [Line; 4]) {
        let halvings = |k: usize| ((inner[k].len() - 1) / (FAN * (outer[k].len() - 1))).checked_ilog2().unwrap_or(0);
        for _ in 0..(0..4).map(halvings).max().unwrap_or(0) {
            let ring = self.halfway(&inner, outer);
            self.sew_ring(&ring, &inner);
            inner = ring;
        }
        self.sew_ring(outer, &inner);
    }

    fn sew_ring(&mut self, outer: &[Line; 4], inner: &[Line; 4]) {
        self.strip(&outer[0], &inner[0], 0);
        self.strip(&outer[1], &inner[1], 1);
        self.strip(&inner[2], &outer[2], 0);
        self.strip(&inner[3], &outer[3], 1);
    }

    /// A ring halfway to the edges of the surface, with every second vertex of those lines that have more
    /// than twice the vertices of the edge.
    fn halfway(&mut self, [bottom, right, top, left]: &[Line; 4], outer: &[Line; 4]) -> [Line; 4] {
        let domain = self.surface.domain();
        let at = |cells: &Self, vertex: u32| cells.vertices.all[vertex as usize].uv;
        let (low, high) = (at(self, bottom[0]), at(self, end(top)));
        let outwards = |uv: [Scalar<P>; 2]| {
            [0, 1].map(|k| {
                let half = Scalar::<P>::from_f64(0.5);
                let [start, last] = [(domain[k][0] + low[k]) * half, (domain[k][1] + high[k]) * half];
                start + (last - start) * ((uv[k] - low[k]) / (high[k] - low[k]))
            })
        };
        let [a, b, c, d] = [bottom[0], end(bottom), top[0], end(top)].map(|corner| {
            let uv = outwards(at(self, corner));
            self.vertices.add(uv, None)
        });
        let ends = [[a, b], [b, d], [c, d], [a, c]];
        let lines = [bottom, right, top, left];
        [0, 1, 2, 3].map(|k| {
            let step = if lines[k].len() > 2 * outer[k].len() - 2 { 2 } else { 1 };
            let inner: Vec<u32> =
                lines[k][1..lines[k].len() - 1].iter().copied().skip(step - 1).step_by(step).collect();
            let moved = inner.into_iter().map(|vertex| self.vertices.add(outwards(at(self, vertex)), None));
            let mut line = vec![ends[k][0]];
            line.extend(moved.collect::<Vec<_>>());
            line.push(ends[k][1]);
            line
        })
    }

    /// Finds how many columns and rows each cell needs.
    fn count(&mut self) {
        let [us, vs] = &self.lines;
        for (j, &y) in self.spans[1].iter().enumerate() {
            for (i, &x) in self.spans[0].iter().enumerate() {
                let part = [[us[i], us[i + 1]], [vs[j], vs[j + 1]]];
                self.counts.push(Demand::new(self.surface, [x, y], part).counts(self.tolerance, WIDEST + WIDEST / 2));
            }
        }
    }

    /// The number of cells in each direction.
    fn size(&self) -> [usize; 2] {
        [0, 1].map(|k| self.lines[k].len() - 1)
    }

    /// Fills all cells, between the lines around them.
    fn fill_all(&mut self, [bottom, right, top, left]: [Vec<Line>; 4]) {
        let [width, height] = self.size();
        let mut below = bottom;
        for j in 0..height {
            let ends = [&left, &right].map(|lines| end(&lines[j]));
            let above = if j + 1 == height { top.clone() } else { self.row(j + 1, ends) };
            let mut before = left[j].clone();
            for i in 0..width {
                let ends = [end(&below[i]), end(&above[i])];
                let after = if i + 1 == width { right[j].clone() } else { self.column([i + 1, j], ends) };
                self.fill([i, j], [&below[i], &after, &above[i], &before]);
                before = after;
            }
            below = above;
        }
    }

    /// The four edges of the surface with their ends.
    fn border(&mut self, cuts: [Vec<Scalar<P>>; 4]) -> [Line; 4] {
        let [[west, east], [south, north]] = self.surface.domain();
        let corners = [([west, south], Side::Bottom), ([east, south], Side::Bottom), ([west, north], Side::Top)];
        let [a, b, c] = corners.map(|(uv, side)| self.vertices.add(uv, Some(side)));
        let d = self.vertices.add([east, north], Some(Side::Top));
        let ends = [[a, b], [b, d], [c, d], [a, c]];
        let across = [south, east, north, west];
        SIDES.map(|side| {
            let [first, last] = ends[side as usize];
            let at = |t| if side.is_along_u() { [t, across[side as usize]] } else { [across[side as usize], t] };
            let parameters = if self.vertices.is_pole(side) { self.fan(side) } else { cuts[side as usize].clone() };
            let inner = parameters.into_iter().map(|t| self.vertices.add(at(t), Some(side)));
            [first].into_iter().chain(inner).chain([last]).collect()
        })
    }

    /// Where an edge that is a point gets vertices: at all columns or rows of the cells there.
    fn fan(&self, side: Side) -> Vec<Scalar<P>> {
        let ([width, height], k) = (self.size(), side.along());
        let cell = |i: usize| match side {
            Side::Bottom => i,
            Side::Top => (height - 1) * width + i,
            Side::Left => i * width,
            Side::Right => (i + 1) * width - 1,
        };
        let [start, last] = self.surface.domain()[k];
        let inner = |(i, ends): (usize, &[Scalar<P>])| {
            [ends[0]].into_iter().chain(between([ends[0], ends[1]], self.counts[cell(i)][k])).chain([ends[1]])
        };
        let mut all: Vec<_> = self.lines[k].windows(2).enumerate().flat_map(inner).collect();
        all.retain(|&t| start < t && t < last);
        all.dedup();
        all
    }

    /// The parts of an edge of the surface between lines of cells.
    fn shared_out(&self, side: Side, whole: &[u32]) -> Vec<Line> {
        let lines = &self.lines[side.along()];
        let place = |line: Scalar<P>| {
            whole.partition_point(|&vertex| self.vertices.all[vertex as usize].uv[side.along()] < line)
        };
        lines.windows(2).map(|pair| whole[place(pair[0])..=place(pair[1])].to_vec()).collect()
    }

    /// The lines around all cells.
    fn inner_border(&mut self) -> [Vec<Line>; 4] {
        let [width, height] = self.size();
        let corners = [[0, 0], [width, 0], [0, height], [width, height]];
        let [a, b, c, d] = corners.map(|[i, j]| self.vertices.add([self.lines[0][i], self.lines[1][j]], None));
        [self.row(0, [a, b]), self.columns(width, [b, d]), self.row(height, [c, d]), self.columns(0, [a, c])]
    }

    /// The parameters at which an edge of the surface is cut, without its ends. They depend on the edge alone and not on
    /// its direction: pieces between knots are cut at shares that are powers of two.
    fn cuts(&self, side: Side) -> Vec<Scalar<P>> {
        let knots = self.surface.knots_of(side);
        let of_span = |span: usize| {
            let [low, high] = interval(&knots, span);
            let share =
                move |i: usize| low + (high - low) * (Scalar::<P>::from_usize(i) / Scalar::<P>::from_usize(GRAINS));
            let mut count = 1;
            while count < MOST && !(0..count).all(|i| self.holds(side, [i, i + 1].map(|i| share(mirrored(i, count))))) {
                count += 1 + count / 8;
            }
            let count = count.min(MOST);
            (0..count).map(move |i| share(mirrored(i, count)))
        };
        knots.spans().flat_map(of_span).skip(1).collect()
    }

    /// Whether a straight line between two points of an edge of the surface is near enough to it.
    fn holds(&self, side: Side, [from, to]: [Scalar<P>; 2]) -> bool {
        let step = (to - from) * Scalar::<P>::from_f64(0.25);
        let at = |quarters| self.surface.edge(side, from + step * Scalar::<P>::from_usize(quarters))[0];
        self.tolerance.holds_at_border([0, 1, 2, 3, 4].map(at))
    }

    /// The line below the cells of row `j`, in parts.
    fn row(&mut self, j: usize, [first, last]: [u32; 2]) -> Vec<Line> {
        let [width, height] = self.size();
        let (us, v) = (self.lines[0].clone(), self.lines[1][j]);
        let mut start = first;
        let mut row = Vec::new();
        for i in 0..width {
            let end = if i + 1 == width { last } else { self.vertices.add([us[i + 1], v], None) };
            let beside = [j.saturating_sub(1), j.min(height - 1)].map(|j| self.counts[j * width + i][0]);
            let inner = between([us[i], us[i + 1]], beside[0].max(beside[1])).map(|u| self.vertices.add([u, v], None));
            row.push([start].into_iter().chain(inner).chain([end]).collect());
            start = end;
        }
        row
    }

    /// The line to the left of the cells of column `i`, in parts.
    fn columns(&mut self, i: usize, [first, last]: [u32; 2]) -> Vec<Line> {
        let [_, height] = self.size();
        let mut start = first;
        let mut column = Vec::new();
        for j in 0..height {
            let uv = [self.lines[0][i], self.lines[1][j + 1]];
            let end = if j + 1 == height { last } else { self.vertices.add(uv, None) };
            column.push(self.column([i, j], [start, end]));
            start = end;
        }
        column
    }

    /// The part of it beside row `j`.
    fn column(&mut self, [i, j]: [usize; 2], [first, last]: [u32; 2]) -> Line {
        let [width, _] = self.size();
        let (u, ends) = (self.lines[0][i], [self.lines[1][j], self.lines[1][j + 1]]);
        let beside = [i.saturating_sub(1), i.min(width - 1)].map(|i| self.counts[j * width + i][1]);
        let inner = between(ends, beside[0].max(beside[1])).map(|v| self.vertices.add([u, v], None));
        [first].into_iter().chain(inner).chain([last]).collect()
    }

    /// Cuts a cell into triangles: a grid inside, and a ring between it and the lines around the cell.
    fn fill(&mut self, [i, j]: [usize; 2], [bottom, right, top, left]: [&Line; 4]) {
        let [n, m] = self.counts[j * (self.lines[0].len() - 1) + i];
        if m == 1 && left.len().max(right.len()) <= 2 {
            return self.strip(bottom, top, 0);
        }
        if n == 1 && bottom.len().max(top.len()) <= 2 {
            return self.strip(right, left, 1);
        }
        let parts = [[self.lines[0][i], self.lines[0][i + 1]], [self.lines[1][j], self.lines[1][j + 1]]];
        let columns: Vec<_> = between(parts[0], n.max(2)).collect();
        let inner: Vec<Line> = between(parts[1], m.max(2))
            .map(|v| columns.iter().map(|&u| self.vertices.add([u, v], None)).collect())
            .collect();
        let last = columns.len() - 1;
        let column = |i: usize| inner.iter().map(|row| row[i]).collect::<Line>();
        self.strip(bottom, &inner[0], 0);
        self.strip(&inner[inner.len() - 1], top, 0);
        self.strip(&column(0), left, 1);
        self.strip(right, &column(last), 1);
        inner.windows(2).for_each(|rows| self.grid(&rows[0], &rows[1]));
    }

    /// Two rows of a grid.
    fn grid(&mut self, below: &[u32], above: &[u32]) {
        for i in 1..below.len() {
            self.strip(&below[i - 1..=i], &above[i - 1..=i], 0);
        }
    }

    /// The triangles between two lines that run side by side along a parameter, the first one on the right hand.
    fn strip(&mut self, right: &[u32], left: &[u32], along: usize) {
        let (mut i, mut j) = (0, 0);
        while i + 1 < right.len() || j + 1 < left.len() {
            let is_right = match (right.get(i + 1), left.get(j + 1)) {
                (Some(&a), Some(&b)) => self.is_better([a, left[j]], [right[i], b], along),
                (next, _) => next.is_some(),
            };
            let triangle = if is_right { [right[i], right[i + 1], left[j]] } else { [right[i], left[j + 1], left[j]] };
            if is_right {
                i += 1
            } else {
                j += 1
            }
            let [a, b, c] = triangle;
            if a != b && b != c && c != a {
                self.triangles.push(triangle);
            }
        }
    }

    /// Whether the first of two edges across a strip is more upright, or of two that are about the same nearer to the
    /// surface.
    fn is_better(&self, first: [u32; 2], second: [u32; 2], along: usize) -> bool {
        let edges = [first, second].map(|edge| edge.map(|end| &self.vertices.all[end as usize]));
        let [skew, other] = edges.map(|[a, b]| (a.uv[along] - b.uv[along]).abs());
        if (skew - other).abs() > (skew + other) * Scalar::<P>::from_f64(ALIKE) {
            return skew < other;
        }
        let [excess, other] = edges.map(|edge| self.tolerance.excess_of(edge));
        excess <= other
    }
}

/// The last vertex of a line.
fn end(line: &[u32]) -> u32 {
    line[line.len() - 1]
}

/// Lines one after the other as one.
fn joined(lines: &[Line]) -> Line {
    let rest = lines.iter().flat_map(|line| line[1..].iter().copied());
    [lines[0][0]].into_iter().chain(rest).collect()
}

/// Moves the first and the last line inwards by a column or a row.
fn inset<R: Real>(lines: &mut [R], most: &[usize]) {
    let last = lines.len() - 1;
    let width = |i: usize, most: usize| {
        let parts = if last == 1 { most.max(3) } else { most.div_ceil(most.div_ceil(WIDEST)).max(2) };
        (lines[i + 1] - lines[i]) / R::from_usize(parts)
    };
    let [from_start, from_end] = [width(0, most[0]), width(last - 1, most[most.len() - 1])];
    lines[0] += from_start;
    lines[last] -= from_end;
}

/// Inner parameters at equal distances.
fn between<R: Real>([low, high]: [R; 2], count: usize) -> impl Iterator<Item = R> {
    (1..count).map(move |i| low + (high - low) * (R::from_usize(i) / R::from_usize(count)))
}

/// From where to where an interval of knots goes.
fn interval<R: Real>(knots: &KnotVector<R>, span: usize) -> [R; 2] {
    [knots.knots()[span], knots.knots()[span + 1]]
}

/// Share `i` of `count` in [`GRAINS`], the same from either end.
fn mirrored(i: usize, count: usize) -> usize {
    let rounded = |i: usize| (2 * i * GRAINS + count) / (2 * count);
    if 2 * i <= count { rounded(i) } else { GRAINS - rounded(count - i) }
}

/// Lines at knots and between them, so that no cell needs many columns; and the interval of knots after each.
fn lines<R: Real>(knots: &KnotVector<R>, spans: &[usize], most: &[usize]) -> (Vec<R>, Vec<usize>) {
    let (mut lines, mut of) = (Vec::new(), Vec::new());
    for (&span, &count) in spans.iter().zip(most) {
        let ends = interval(knots, span);
        let before = lines.len();
        lines.push(ends[0]);
        lines.extend(between(ends, count.div_ceil(WIDEST)));
        of.resize(of.len() + lines.len() - before, span);
    }
    lines.push(knots.domain()[1]);
    (lines, of)
}
