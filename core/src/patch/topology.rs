//! Which elements touch, and where the corner of a small one hangs on the side of a large one.

use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;

use super::element::middle;
use super::{Element, Parameters, Patch, Shape};
use crate::math::{Real, Vector};

/// The vertices of elements, each once for a shape, and the elements around them.
///
/// Each element has a ring: its corners, and between them the vertices that hang on its sides where a neighbor is cut
/// finer (T-junctions). Two neighbors have the same vertices on their common side, so whatever is drawn through rings
/// has no cracks.
#[derive(Clone, Debug, Default)]
pub struct Topology<V> {
    /// Positions.
    pub vertices: Vec<V>,
    rings: Lists,
    around: Lists,
}

/// Lists of indices one after the other.
#[derive(Clone, Debug, Default)]
struct Lists {
    starts: Vec<usize>,
    entries: Vec<usize>,
}

impl Lists {
    fn of(&self, i: usize) -> &[usize] {
        &self.entries[self.starts[i]..self.starts[i + 1]]
    }
}

impl<V: Vector> Topology<V> {
    /// Finds the vertices of elements which come from cutting [`super::uniform`] grids of their shapes.
    pub fn new<S>(shapes: &[Shape<V, S>], elements: &[Element<V>]) -> Self {
        let welded = Welded::new(shapes, elements);
        let rings = elements.iter().map(|element| welded.ring(shapes, element));
        let mut topology = Self { rings: rings.collect(), ..Self::default() };
        topology.around = topology.rings.turned(welded.positions.len());
        topology.vertices = welded.positions;
        topology
    }

    /// The vertices around element `i`, counter-clockwise.
    pub fn ring(&self, i: usize) -> &[usize] {
        self.rings.of(i)
    }

    /// The elements around a vertex, in ascending order.
    pub fn around(&self, vertex: usize) -> &[usize] {
        self.around.of(vertex)
    }
}

impl FromIterator<Vec<usize>> for Lists {
    fn from_iter<I: IntoIterator<Item = Vec<usize>>>(lists: I) -> Self {
        let mut all = Self { starts: vec![0], entries: Vec::new() };
        for list in lists {
            all.entries.extend(list);
            all.starts.push(all.entries.len());
        }
        all
    }
}

impl Lists {
    /// For each of `count` entries the lists that hold it.
    fn turned(&self, count: usize) -> Self {
        let mut holders = vec![Vec::new(); count];
        for i in 0..self.starts.len() - 1 {
            self.of(i).iter().for_each(|&entry| holders[entry].push(i));
        }
        holders.into_iter().collect()
    }
}

/// Cuts element `i` into four: the first piece takes its place, the others go to the end of the list.
pub(super) fn split<V: Vector, S>(shapes: &[Shape<V, S>], elements: &mut Vec<Element<V>>, i: usize) {
    let element = elements[i];
    let [first, rest @ ..] = element.split(&shapes[element.shape].patches[element.patch]);
    elements[i] = first;
    elements.extend(rest);
}

/// Cuts elements until no more than one vertex hangs on a side: the restricted quadtree of Von Herzen and Barr 1987.
///
/// Gives the indices of the elements that were cut, in the order in which [`split`] cut them.
pub(super) fn restrict<V: Vector, S>(shapes: &[Shape<V, S>], elements: &mut Vec<Element<V>>) -> Vec<usize> {
    let mut cut = Vec::new();
    loop {
        let welded = Welded::new(shapes, elements);
        let coarse: Vec<usize> = (0..elements.len()).filter(|&i| welded.hangs_twice(shapes, &elements[i])).collect();
        if coarse.is_empty() {
            return cut;
        }
        coarse.iter().for_each(|&i| split(shapes, elements, i));
        cut.extend(coarse);
    }
}

/// Vertices found by their position, up to rounding.
struct Welded<V: Vector> {
    positions: Vec<V>,
    places: BTreeMap<(usize, [i64; 3]), usize>,
    tolerance: V::Scalar,
}

impl<V: Vector> Welded<V> {
    fn new<S>(shapes: &[Shape<V, S>], elements: &[Element<V>]) -> Self {
        let corners = elements.iter().flat_map(|element| element.corners());
        let largest = corners.fold(V::Scalar::ZERO, |largest, corner| largest.max(corner.length()));
        let rounding = V::Scalar::EPSILON * V::Scalar::from_f64(512.0);
        let mut welded = Self { positions: Vec::new(), places: BTreeMap::new(), tolerance: largest * rounding };
        for element in elements {
            let patch = &shapes[element.shape].patches[element.patch];
            element.parameters().iter().for_each(|&place| welded.add(element.shape, patch.point(place)));
        }
        welded
    }

    fn add(&mut self, shape: usize, position: V) {
        if self.find(shape, position).is_none() {
            self.places.insert((shape, self.cell(position)), self.positions.len());
            self.positions.push(position);
        }
    }

    /// The vertex at a position; cells are large against the tolerance, so that few positions lie near their sides.
    fn find(&self, shape: usize, position: V) -> Option<usize> {
        let offset = V::from_array([self.tolerance; 3]);
        let (low, high) = (self.cell(position - offset), self.cell(position + offset));
        let corners = if low == high { 1 } else { 8 };
        (0..corners).find_map(|corner| {
            let cell = core::array::from_fn(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] });
            let &vertex = self.places.get(&(shape, cell))?;
            ((self.positions[vertex] - position).length() <= self.tolerance).then_some(vertex)
        })
    }

    fn cell(&self, position: V) -> [i64; 3] {
        let side = self.tolerance * V::Scalar::from_f64(16.0);
        position.to_array().map(|x| (x / side).floor().to_f64() as i64)
    }

    /// The vertices around an element, those that hang on its sides included.
    fn ring<S>(&self, shapes: &[Shape<V, S>], element: &Element<V>) -> Vec<usize> {
        let patch = &shapes[element.shape].patches[element.patch];
        let mut ring = Vec::new();
        for side in sides(element) {
            self.walk(element.shape, patch, side, &mut ring);
        }
        ring.dedup();
        if ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        ring
    }

    /// Adds the first end of a side and what hangs on it to a ring.
    fn walk(&self, shape: usize, patch: &Patch<V>, [from, to]: [Parameters<V>; 2], ring: &mut Vec<usize>) {
        let center = middle::<V>(from, to);
        let ends = [from, to].map(|end| self.find(shape, patch.point(end)));
        match self.find(shape, patch.point(center)) {
            // The middle of a collapsed side is its end.
            Some(middle) if ends.iter().all(|&end| end != Some(middle)) => {
                self.walk(shape, patch, [from, center], ring);
                self.walk(shape, patch, [center, to], ring);
            }
            _ => ring.extend(ends[0]),
        }
    }

    /// Whether a vertex hangs between an end and the middle of a side.
    fn hangs_twice<S>(&self, shapes: &[Shape<V, S>], element: &Element<V>) -> bool {
        let patch = &shapes[element.shape].patches[element.patch];
        sides(element).any(|[from, to]| {
            let mut ring = Vec::new();
            self.walk(element.shape, patch, [from, to], &mut ring);
            ring.len() > 2
        })
    }
}

/// The sides of an element in the domain of its patch.
fn sides<V: Vector>(element: &Element<V>) -> impl Iterator<Item = [Parameters<V>; 2]> + '_ {
    let places = element.parameters();
    (0..places.len()).map(|k| [places[k], places[(k + 1) % places.len()]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::uniform;
    use glam::DVec3;

    fn square() -> [Patch<'static, DVec3>; 1] {
        [Patch::Quad([DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y])]
    }

    fn shape<'a>(patches: &'a [Patch<'a, DVec3>]) -> Shape<'a, DVec3, f64> {
        Shape { patches, reflectance: 0.5, exitance: 0.0 }
    }

    /// A grid of 3 x 2 has 12 vertices; inner ones have four elements around them.
    #[test]
    fn vertices_of_a_grid() {
        let square = square();
        let elements: Vec<_> = uniform(0, &square, [3, 2]).collect();
        let topology = Topology::new(&[shape(&square)], &elements);
        assert_eq!(topology.vertices.len(), 12);
        let around: Vec<usize> = (0..12).map(|vertex| topology.around(vertex).len()).collect();
        assert_eq!((around.iter().filter(|&&n| n == 4).count(), around.iter().sum::<usize>()), (2, 24));
    }

    /// Around the origin lengths say nothing of centers; and what has no extent has one vertex, or none.
    #[test]
    fn elements_anywhere() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        for (quad, vertices, ring) in [
            ([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], 4, 4),
            ([DVec3::ZERO; 4], 1, 1),
            ([DVec3::NAN; 4], 4, 0),
        ] {
            let patches = [Patch::Quad(quad)];
            let topology = Topology::new(&[shape(&patches)], &[Element::whole(0, 0, &patches[0])]);
            assert_eq!((topology.vertices.len(), topology.ring(0).len()), (vertices, ring));
        }
    }

    /// Four quarters, one of them cut again: two neighbors have one more vertex each, on the side between.
    #[test]
    fn small_corners_hang_on_large_sides() {
        let square = square();
        let shapes = [shape(&square)];
        let mut elements: Vec<_> = uniform(0, &square, [2, 2]).collect();
        split(&shapes, &mut elements, 0);
        let topology = Topology::new(&shapes, &elements);
        assert_eq!(topology.vertices.len(), 14);
        let sizes: Vec<usize> = (0..elements.len()).map(|i| topology.ring(i).len()).collect();
        assert_eq!(sizes, [4, 5, 5, 4, 4, 4, 4]);
    }

    /// A corner cut again and again takes its neighbors with it: on no side hangs more than one vertex.
    #[test]
    fn restricted_trees_change_size_slowly() {
        let patches = [
            Patch::Triangle([DVec3::ZERO, DVec3::X, DVec3::Y]),
            Patch::Triangle([DVec3::X, DVec3::X + DVec3::Y, DVec3::Y]),
        ];
        let shapes = [shape(&patches)];
        let mut elements: Vec<_> = uniform(0, &patches, [1, 1]).collect();
        for _ in 0..5 {
            let last = elements.iter().position(|e| e.corners().contains(&DVec3::X)).unwrap();
            split(&shapes, &mut elements, last);
        }
        assert!(!restrict(&shapes, &mut elements).is_empty());
        let topology = Topology::new(&shapes, &elements);
        assert!((0..elements.len()).all(|i| topology.ring(i).len() <= 6));
        let area: f64 = elements.iter().map(|element| element.area).sum();
        assert!((area - 1.0).abs() < 1e-12);
    }
}
