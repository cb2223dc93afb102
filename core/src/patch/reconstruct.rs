//! A continuous function through the values of elements.

use alloc::vec;
use alloc::vec::Vec;

use super::{Element, Shape, Topology};
use crate::math::{Real, Vector};
use crate::spectrum::Spectrum;

/// A piecewise linear function on the elements, continuous across each common side within a shape.
///
/// Each element is drawn as a fan of triangles from its center to its ring, in which hanging vertices are vertices like
/// all others (anchored triangulation), so the function has the same values on both sides of an edge.
#[derive(Clone, Debug)]
pub struct Field<V: Vector, S> {
    /// How the elements hang together.
    pub topology: Topology<V>,
    /// The value at each vertex.
    pub at_vertices: Vec<S>,
    /// The value at the center of each element.
    pub at_centers: Vec<S>,
    /// An estimate of how far the function is off on each element, as a root mean square in the brightest band.
    ///
    /// Half of how far the elements around lie off the plane through element and gradient: the error of linear
    /// interpolation where the function is smooth, and about as much as can be said where it jumps.
    pub errors: Vec<V::Scalar>,
}

/// Weights of the differences to neighbors in a gradient: the neighbor and a vector.
type Weights<V> = Vec<(usize, V)>;

impl<V: Vector, S: Spectrum<Scalar = V::Scalar>> Field<V, S> {
    /// Interpolates `values`, one for each element. A linear function on a plane is met exactly.
    ///
    /// The value at a vertex is the mean over the elements around it, weighted by their areas, of each one's value
    /// continued to the vertex with its gradient. Gradients come from least squares over all elements that share a
    /// vertex (Barth and Jespersen 1989), and are shortened so that no element is continued by more than it differs
    /// from a neighbor.
    pub fn new<M>(shapes: &[Shape<V, M>], elements: &[Element<V>], values: &[S]) -> Self {
        let topology = Topology::new(shapes, elements);
        let (mut sums, mut areas) =
            (vec![S::default(); topology.vertices.len()], vec![V::Scalar::ZERO; topology.vertices.len()]);
        let weights: Vec<Weights<V>> = (0..elements.len()).map(|i| gradient(&topology, elements, i)).collect();
        let errors = (0..elements.len()).map(|i| error(&weights, elements, values, i)).collect();
        for (i, element) in elements.iter().enumerate() {
            let ring = topology.ring(i);
            let steps: Vec<S> = ring
                .iter()
                .map(|&vertex| change(&weights[i], values, i, topology.vertices[vertex] - element.center))
                .collect();
            let limit = limiter(&topology, values, i, &steps);
            for (&vertex, &step) in ring.iter().zip(&steps) {
                sums[vertex] += (values[i] + step * limit) * element.area;
                areas[vertex] += element.area;
            }
        }
        let mean =
            |(&sum, &area): (&S, &V::Scalar)| if area > V::Scalar::ZERO { sum * (V::Scalar::ONE / area) } else { sum };
        let at_vertices = sums.iter().zip(&areas).map(mean).collect();
        Self { topology, at_vertices, at_centers: values.to_vec(), errors }
    }

    /// The triangles of element `i`: its center and two neighbors on its ring, by index of vertex.
    pub fn fan(&self, i: usize) -> impl Iterator<Item = [usize; 2]> + '_ {
        let ring = self.topology.ring(i);
        (0..ring.len()).map(move |k| [ring[k], ring[(k + 1) % ring.len()]])
    }

    /// The value at a point of element `i`; points beside it take that of the nearest part of the fan, continued.
    pub fn value(&self, i: usize, element: &Element<V>, point: V) -> S {
        let weights = self.fan(i).map(|[a, b]| {
            let corners = [element.center, self.topology.vertices[a], self.topology.vertices[b]];
            ([a, b], barycentric(corners, element.normal, point))
        });
        let inside = |weights: &[V::Scalar; 3]| weights[1].min(weights[2]);
        let best = weights.reduce(|best, next| if inside(&next.1) > inside(&best.1) { next } else { best });
        match best {
            Some(([a, b], [u, v, w])) => self.at_centers[i] * u + self.at_vertices[a] * v + self.at_vertices[b] * w,
            None => self.at_centers[i],
        }
    }
}

/// How the gradient of a function on element `i` depends on its differences to the elements around.
///
/// Least squares in the plane of the element, weighted by the inverse square of distance. Where all neighbors lie in
/// one direction there is no slope across it.
fn gradient<V: Vector>(topology: &Topology<V>, elements: &[Element<V>], i: usize) -> Weights<V> {
    let element = &elements[i];
    let offset = |j: usize| {
        let offset = elements[j].center - element.center;
        offset - element.normal * offset.dot(element.normal)
    };
    let x_axis =
        element.corners().first().map_or(V::default(), |&corner| (corner - element.center).normalize_or_zero());
    let y_axis = element.normal.cross(x_axis);
    let near = neighbors(topology, i);
    let [mut xx, mut xy, mut yy] = [V::Scalar::ZERO; 3];
    for &j in &near {
        let direction = offset(j).normalize_or_zero();
        let (x, y) = (direction.dot(x_axis), direction.dot(y_axis));
        (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
    }
    let inverse = pseudo_inverse([xx, xy, yy]);
    let weight = |&j: &usize| {
        let offset = offset(j);
        let share = V::Scalar::ONE / offset.length_squared();
        let (x, y) = (offset.dot(x_axis) * share, offset.dot(y_axis) * share);
        let [a, b, c] = inverse;
        (j, x_axis * (a * x + b * y) + y_axis * (b * x + c * y))
    };
    near.iter().filter(|&&j| offset(j).length_squared() > V::Scalar::ZERO).map(weight).collect()
}

/// The elements that share a vertex with element `i`, without itself.
fn neighbors<V: Vector>(topology: &Topology<V>, i: usize) -> Vec<usize> {
    let mut near: Vec<usize> = topology.ring(i).iter().flat_map(|&vertex| topology.around(vertex)).copied().collect();
    near.sort_unstable();
    near.dedup();
    near.retain(|&j| j != i);
    near
}

/// The inverse of a symmetric matrix `[xx, xy, yy]`, or its pseudo-inverse where it has rank one or none.
fn pseudo_inverse<R: Real>([xx, xy, yy]: [R; 3]) -> [R; 3] {
    let (trace, determinant) = (xx + yy, xx * yy - xy * xy);
    if trace == R::ZERO {
        return [R::ZERO; 3];
    }
    if determinant > R::from_f64(1e-4) * trace * trace {
        return [yy / determinant, -xy / determinant, xx / determinant];
    }
    let share = R::ONE / (trace * trace);
    [xx * share, xy * share, yy * share]
}

/// How much the function on element `i` changes over a step.
fn change<V: Vector, S: Spectrum<Scalar = V::Scalar>>(weights: &Weights<V>, values: &[S], i: usize, step: V) -> S {
    let mut sum = S::default();
    weights.iter().for_each(|&(j, weight)| sum += (values[j] - values[i]) * weight.dot(step));
    sum
}

/// Half of the root mean square of how far the values of an element and its neighbors are from what their
/// gradients say of each other.
fn error<V: Vector, S: Spectrum<Scalar = V::Scalar>>(
    weights: &[Weights<V>],
    elements: &[Element<V>],
    values: &[S],
    i: usize,
) -> V::Scalar {
    let miss = |from: usize, to: usize| {
        let slope = change(&weights[from], values, from, elements[to].center - elements[from].center);
        (values[to] - values[from] - slope).max_abs()
    };
    let squares = weights[i].iter().map(|&(j, _)| {
        // An element at the outline meets its neighbors exactly, but theirs do not meet it.
        let miss = miss(i, j).max(miss(j, i));
        miss * miss
    });
    let sum: V::Scalar = squares.sum();
    let count = V::Scalar::from_usize(weights[i].len().max(1));
    (sum / count).sqrt() * V::Scalar::from_f64(0.5)
}

/// The factor that keeps steps within the largest difference to a neighbor.
fn limiter<V: Vector, S: Spectrum<Scalar = V::Scalar>>(
    topology: &Topology<V>,
    values: &[S],
    i: usize,
    steps: &[S],
) -> V::Scalar {
    let largest = steps.iter().fold(V::Scalar::ZERO, |largest, step| largest.max(step.max_abs()));
    let near = neighbors(topology, i).into_iter().map(|j| (values[j] - values[i]).max_abs());
    let limit = near.fold(V::Scalar::ZERO, V::Scalar::max);
    if largest > limit { limit / largest } else { V::Scalar::ONE }
}

/// The weights of the corners of a triangle at a point, by areas seen along `normal`; they sum to one.
fn barycentric<V: Vector>([a, b, c]: [V; 3], normal: V, point: V) -> [V::Scalar; 3] {
    let area = |p: V, q: V, r: V| (q - p).cross(r - p).dot(normal);
    let total = area(a, b, c);
    if total <= V::Scalar::ZERO {
        return [V::Scalar::ONE, -V::Scalar::INFINITY, -V::Scalar::INFINITY];
    }
    let (v, w) = (area(a, point, c) / total, area(a, b, point) / total);
    [V::Scalar::ONE - v - w, v, w]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::patch::topology::split;
    use crate::patch::{Patch, polygon, uniform};
    use crate::spline::BezierSurface;
    use glam::DVec3;

    /// Cuts some elements at random, so that up to four levels meet at a vertex.
    fn cut<V: Vector>(shapes: &[Shape<V, f64>], divisions: [usize; 2]) -> Vec<Element<V>> {
        let mut elements: Vec<Element<V>> = uniform(0, shapes[0].patches, divisions).collect();
        for step in 0..24 {
            let i = crate::geometry::hash(step, 5) as usize % elements.len();
            split(shapes, &mut elements, i);
        }
        elements
    }

    fn shape<'a>(patches: &'a [Patch<'a, DVec3>]) -> [Shape<'a, DVec3, f64>; 1] {
        [Shape { patches, reflectance: 0.5, exitance: 0.0 }]
    }

    /// Pentagons, triangles and quads in a plane, cut unevenly.
    fn planes() -> [Vec<Patch<'static, DVec3>>; 3] {
        let [o, x, y] = [DVec3::new(0.3, -1.0, 2.0), DVec3::new(2.0, 0.0, 1.0), DVec3::new(0.4, 1.5, -0.5)];
        let pentagon = [o, o + x, o + x * 1.3 + y, o + x * 0.5 + y * 1.6, o - x * 0.3 + y];
        let quad = [o, o + x, o + x * 1.2 + y, o + y * 0.9];
        [polygon(&pentagon).collect(), vec![Patch::Triangle([o, o + x, o + y])], vec![Patch::Quad(quad)]]
    }

    #[test]
    fn a_linear_function_is_met_exactly() {
        let linear = |point: DVec3| point.dot(DVec3::new(0.7, -0.3, 1.1)) + 0.4;
        for patches in planes() {
            let shapes = shape(&patches);
            let elements = cut(&shapes, [3, 4]);
            let values: Vec<f64> = elements.iter().map(|element| linear(element.center)).collect();
            let field = Field::new(&shapes, &elements, &values);
            for (&value, &vertex) in field.at_vertices.iter().zip(&field.topology.vertices) {
                assert!((value - linear(vertex)).abs() < 1e-12, "{value} at {vertex}");
            }
            for (i, element) in elements.iter().enumerate() {
                for &corner in element.corners() {
                    let point = element.center.lerp(corner, 0.37);
                    assert!((field.value(i, element, point) - linear(point)).abs() < 1e-12);
                }
            }
        }
    }

    /// Wild values on wildly cut elements: from both sides of an edge the function is the same all along it.
    #[test]
    fn no_cracks() {
        let points: [DVec3; 9] = core::array::from_fn(|k| {
            let (x, y) = ((k % 3) as f64, (k / 3) as f64);
            DVec3::new(x, y, (1.0 - x) * (y - 1.0) * 0.7 + 0.2 * x * x)
        });
        let spline = vec![Patch::Spline(BezierSurface::new(&points, 3).unwrap())];
        for patches in planes().into_iter().chain([spline]) {
            let shapes = shape(&patches);
            let elements = cut(&shapes, [2, 2]);
            let values: Vec<f64> = (0..elements.len()).map(|i| (i as f64 * 1.7).sin()).collect();
            let field = Field::new(&shapes, &elements, &values);
            let mut edges = alloc::collections::BTreeMap::<[usize; 2], usize>::new();
            for i in 0..elements.len() {
                field.fan(i).for_each(|[a, b]| *edges.entry([a.min(b), a.max(b)]).or_default() += 1);
            }
            // An edge that one element has alone lies on the outline: no vertex hangs on it, nor near it.
            assert!(edges.values().all(|&count| count <= 2));
            for (&[a, b], _) in edges.iter().filter(|&(_, &count)| count == 1) {
                let [p, q] = [a, b].map(|vertex| field.topology.vertices[vertex]);
                let hangs =
                    |x: &DVec3| (x.distance(p) + x.distance(q) - p.distance(q)).abs() < 1e-9 && *x != p && *x != q;
                assert!(!field.topology.vertices.iter().any(hangs));
            }
        }
    }

    /// Sampled along common edges of elements in a plane.
    #[test]
    fn the_same_value_from_both_sides() {
        for patches in planes() {
            let shapes = shape(&patches);
            let elements = cut(&shapes, [2, 2]);
            let values: Vec<f64> = (0..elements.len()).map(|i| (i as f64 * 1.7).sin()).collect();
            let field = Field::new(&shapes, &elements, &values);
            let mut compared = 0;
            for i in 0..elements.len() {
                for [a, b] in field.fan(i) {
                    let shared = |&j: &usize| j != i && field.topology.around(b).contains(&j);
                    for &j in field.topology.around(a).iter().filter(|&j| shared(j)) {
                        for step in 0..=10 {
                            let share = f64::from(step) / 10.0;
                            let point = field.topology.vertices[a].lerp(field.topology.vertices[b], share);
                            let is_edge_of_j = field.fan(j).any(|[c, d]| [c, d] == [b, a]);
                            let difference = field.value(i, &elements[i], point) - field.value(j, &elements[j], point);
                            assert!(!is_edge_of_j || difference.abs() < 1e-9, "{difference}");
                            compared += usize::from(is_edge_of_j);
                        }
                    }
                }
            }
            assert!(compared > 500);
        }
    }

    /// The mean square over the square `[-1, 1]^2` of what is between `x^2` and its interpolation on a grid of side `h`
    /// is `h^4 / 120`, when the values at the vertices are those of `x^2`; the function here lies at most `h^2 / 6` off.
    #[test]
    fn the_error_of_a_parabola_is_found() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let patches = [Patch::Quad([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)])];
        let shapes = shape(&patches);
        for n in [8, 16] {
            let h = 2.0 / n as f64;
            let elements: Vec<_> = uniform(0, &patches, [n, n]).collect();
            let values: Vec<f64> = elements.iter().map(|e| e.center.x * e.center.x + h * h / 12.0).collect();
            let field = Field::new(&shapes, &elements, &values);
            let off = |i: usize| {
                let differences = (0..100).map(|k| {
                    let (s, t) = ((k % 10) as f64 / 10.0 + 0.05, (k / 10) as f64 / 10.0 + 0.05);
                    let point = elements[i].center + corner(s - 0.5, t - 0.5) * h;
                    (field.value(i, &elements[i], point) - point.x * point.x).powi(2)
                });
                (differences.sum::<f64>() / 100.0).sqrt()
            };
            for i in 0..elements.len() {
                let ratio = field.errors[i] / off(i);
                assert!(ratio > 1.0 && ratio < 8.0, "{ratio}");
            }
        }
        let one: Vec<_> = uniform(0, &patches, [1, 1]).collect();
        let field = Field::new(&shapes, &one, &[2.0]);
        assert_eq!((field.errors[0], field.value(0, &one[0], corner(0.2, -0.3))), (0.0, 2.0));
    }
}
