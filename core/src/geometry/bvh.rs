//! The bounding volume hierarchy: obvhs builds it with two children a node.

use alloc::vec::Vec;

use glam::Vec3;
use obvhs::Boundable;
use obvhs::aabb::Aabb;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use super::wide::{Binary, Content, PADDING, Tree};
use super::{Hit, Occluders, Ray};

/// Triangles in a tree. Memory: about 110 bytes a triangle.
pub struct Bvh(Tree);

/// What a bake asks for hits.
pub fn tree(triangles: Vec<[Vec3; 3]>) -> Bvh {
    Bvh::new(&triangles)
}

/// A triangle with a box a little too large, so that rounding loses no hit.
struct Padded<'a>(&'a [Vec3; 3]);

impl Boundable for Padded<'_> {
    fn aabb(&self) -> Aabb {
        let [a, b, c] = *self.0;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let padding = Vec3::splat(low.abs().max(high.abs()).max_element() * PADDING);
        Aabb::new((low - padding).to_array().into(), (high + padding).to_array().into())
    }
}

/// Share of the nodes that are tried at better places in each round.
const REINSERTED: f32 = 0.05;

impl Bvh {
    /// Builds a tree over finite triangles.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        Self(Tree::new(&binary(triangles), triangles))
    }
}

/// A binary tree with one triangle a leaf: locally ordered clustering, Meister and Bittner 2018, then reinsertion, of the
/// same 2017.
fn binary(triangles: &[[Vec3; 3]]) -> Vec<Binary> {
    let padded: Vec<_> = triangles.iter().map(Padded).collect();
    let indices = (0..triangles.len() as u32).collect();
    let mut tree = PlocBuilder::with_capacity(padded.len()).build(
        PlocSearchDistance::Medium,
        &padded,
        indices,
        SortPrecision::U64,
        3,
    );
    ReinsertionOptimizer::default().run(&mut tree, REINSERTED, None);
    let wrapped = |node: &Bvh2Node| Binary {
        low: Vec3::new(node.aabb().min.x, node.aabb().min.y, node.aabb().min.z),
        high: Vec3::new(node.aabb().max.x, node.aabb().max.y, node.aabb().max.z),
        content: match node.is_leaf() {
            true => Content::Triangle(tree.primitive_indices[node.first_index as usize]),
            false => Content::Children(node.first_index),
        },
    };
    tree.nodes.iter().map(wrapped).collect()
}

impl Occluders for Bvh {
    #[inline]
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        self.0.first(ray, place)
    }

    #[inline]
    fn any(&self, ray: &Ray, stop: impl FnMut(&Hit) -> bool) -> bool {
        self.0.any(ray, stop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{BruteForce, Sobol, cosine_direction};

    fn cloud(count: u32) -> Vec<[Vec3; 3]> {
        let point = |index: u32, seed: u32| {
            let sequence = Sobol::new(seed);
            Vec3::new(sequence.dimension(index, 0), sequence.dimension(index, 1), sequence.dimension(index, 2))
        };
        (0..count).map(|i| [0, 1, 2].map(|corner| point(i, 11) + 0.2 * point(i, 20 + corner))).collect()
    }

    #[test]
    fn tree_and_brute_force_agree() {
        let triangles = cloud(500);
        let (tree, all) = (Bvh::new(&triangles), BruteForce(&triangles));
        for index in 0..4000 {
            let sequence = Sobol::new(index);
            let origin = Vec3::new(sequence.dimension(0, 0), sequence.dimension(0, 1), sequence.dimension(0, 2));
            let direction = cosine_direction(sequence.square(1), Vec3::Z);
            let ray = Ray { origin, direction, end: if index % 3 == 0 { 0.2 } else { f32::INFINITY } };
            assert_eq!(tree.nearest(&ray), all.nearest(&ray));
            let odd = |hit: &Hit| hit.triangle % 2 == 1;
            let fronts_first = |hit: &Hit| odd(hit).then_some(hit.distance + if hit.front { 0.0 } else { 0.1 });
            assert_eq!(tree.first(&ray, fronts_first), all.first(&ray, fronts_first));
            assert_eq!(tree.any(&ray, odd), all.any(&ray, odd));
        }
    }

    /// Rays along an axis, with zeros of either sign, find what lies there.
    #[test]
    fn axis_parallel_rays() {
        let square = |y: f32| {
            let [a, b, c, d] = [[-2.0, y, 2.0], [2.0, y, 2.0], [2.0, y, -2.0], [-2.0, y, -2.0]].map(Vec3::from_array);
            [[a, b, c], [a, c, d]]
        };
        let triangles: Vec<_> = [0.0, 1.0, 2.0, 3.0].into_iter().flat_map(square).collect();
        let tree = Bvh::new(&triangles);
        for (x, z) in [(-0.0, -0.0), (0.0, -0.0), (-0.0, 0.0), (0.0, 0.0)] {
            for up in [1.0, -1.0] {
                let ray = Ray { origin: Vec3::new(-1.7, 0.5, 1.9), direction: Vec3::new(x, up, z), end: 9.0 };
                let mut met = 0;
                tree.any(&ray, |_| {
                    met += 1;
                    false
                });
                assert_eq!(met, if up > 0.0 { 3 } else { 1 }, "{x} {z} {up}");
            }
        }
    }

    #[test]
    fn lowest_index_wins_at_the_same_distance() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let tree = Bvh::new(&[triangle; 40]);
        let ray = Ray { origin: Vec3::new(0.2, 0.2, 1.0), direction: Vec3::NEG_Z, end: 2.0 };
        assert_eq!(tree.nearest(&ray).map(|hit| hit.triangle), Some(0));
    }
}
