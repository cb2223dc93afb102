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

/// Triangles in a tree. Memory: about 80 bytes a triangle; 290 while it is built.
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
    use alloc::vec;

    use super::*;
    use crate::geometry::{BruteForce, Sobol, cosine_direction};

    fn cloud(count: u32) -> Vec<[Vec3; 3]> {
        let point = |index: u32, seed: u32| {
            let sequence = Sobol::new(seed);
            Vec3::new(sequence.dimension(index, 0), sequence.dimension(index, 1), sequence.dimension(index, 2))
        };
        (0..count).map(|i| [0, 1, 2].map(|corner| point(i, 11) + 0.2 * point(i, 20 + corner))).collect()
    }

    /// The tree at each level of instructions.
    fn trees(triangles: &[[Vec3; 3]]) -> [Bvh; 2] {
        [Bvh::new(triangles), Bvh(Bvh::new(triangles).0.plain())]
    }

    /// All hits, each with the bits of its distance, in the order of triangles.
    fn met(occluders: &impl Occluders, ray: &Ray) -> Vec<(u32, u32)> {
        let mut met = Vec::new();
        occluders.any(ray, |hit| {
            met.push((hit.triangle, hit.distance.to_bits()));
            false
        });
        met.sort_unstable();
        met
    }

    /// All queries give the same bits as if every triangle were tried.
    fn assert_same(triangles: &[[Vec3; 3]], rays: impl Iterator<Item = Ray>) {
        let all = BruteForce(triangles);
        let trees = trees(triangles);
        let odd = |hit: &Hit| hit.triangle % 2 == 1;
        let fronts_first = |hit: &Hit| odd(hit).then_some(hit.distance + if hit.front { 0.0 } else { 0.1 });
        for ray in rays {
            let (near, first) = (all.nearest(&ray), all.first(&ray, fronts_first));
            let every = met(&all, &ray);
            for tree in &trees {
                assert_eq!(tree.nearest(&ray), near, "{ray:?}");
                assert_eq!(tree.first(&ray, fronts_first), first, "{ray:?}");
                assert_eq!(tree.first(&ray, |_| None), None);
                assert_eq!(met(tree, &ray), every, "{ray:?}");
                assert_eq!(tree.any(&ray, odd), all.any(&ray, odd), "{ray:?}");
            }
        }
    }

    /// Rays through the unit cube, some of them short.
    fn rays(count: u32) -> impl Iterator<Item = Ray> {
        (0..count).map(|index| {
            let sequence = Sobol::new(index);
            let origin = Vec3::new(sequence.dimension(0, 0), sequence.dimension(0, 1), sequence.dimension(0, 2));
            let up = if index % 2 == 0 { Vec3::Z } else { Vec3::NEG_Z };
            let direction = cosine_direction(sequence.square(1), up);
            Ray { origin, direction, end: if index % 3 == 0 { 0.2 } else { f32::INFINITY } }
        })
    }

    /// Rays along the axes, with zeros of either sign, that start on a grid.
    fn axis_rays(count: u32) -> impl Iterator<Item = Ray> {
        rays(count).zip(0..).map(|(ray, index): (Ray, u32)| {
            let zero = if index % 4 < 2 { 0.0 } else { -0.0 };
            let mut direction = Vec3::splat(zero);
            direction[index as usize % 3] = if index % 2 == 0 { 1.0 } else { -0.5 };
            Ray { origin: (ray.origin * 8.0).round() / 8.0, direction, ..ray }
        })
    }

    /// Squares of a grid in planes across the axes: flat boxes, shared edges, and twice the same triangles.
    fn grid() -> Vec<[Vec3; 3]> {
        let cell = |index: u32| {
            let (axis, plane) = (index as usize % 3, (index / 3 % 3) as f32 / 2.0);
            let (u, v) = ((index / 9 % 4) as f32 / 4.0, (index / 36 % 4) as f32 / 4.0);
            let corner = |du: f32, dv: f32| {
                let mut corner = Vec3::splat(plane);
                corner[(axis + 1) % 3] = u + du;
                corner[(axis + 2) % 3] = v + dv;
                corner
            };
            let [a, b, c, d] = [corner(0.0, 0.0), corner(0.25, 0.0), corner(0.25, 0.25), corner(0.0, 0.25)];
            [[a, b, c], [a, c, d]]
        };
        let once: Vec<_> = (0..144).flat_map(cell).collect();
        once.repeat(2)
    }

    #[test]
    fn tree_and_brute_force_agree() {
        assert_same(&cloud(500), rays(2000));
        assert_same(&grid(), rays(1000));
        assert_same(&grid(), axis_rays(1000));
        assert_same(&cloud(500), axis_rays(500));
    }

    #[test]
    fn small_trees() {
        for count in [0, 1, 2, 7, 8, 9, 17] {
            assert_same(&cloud(count), rays(200));
        }
    }

    /// Coordinates from nanometers to the size of planets, and scenes far from the origin of coordinates.
    #[test]
    fn any_scale_and_place() {
        for scale in [1e-9, 1e-3, 1e3, 1e7] {
            for place in [0.0, 1.0, 100.0] {
                let moved = |point: Vec3| (point + place) * scale;
                let triangles: Vec<_> = cloud(200).into_iter().map(|corners| corners.map(moved)).collect();
                let ray = |ray: Ray| Ray { origin: moved(ray.origin), end: ray.end * scale, ..ray };
                assert_same(&triangles, rays(200).map(ray));
                let ray = |ray: Ray| Ray { origin: moved(ray.origin), direction: ray.direction * scale, ..ray };
                assert_same(&triangles, rays(200).map(ray));
            }
        }
    }

    /// Rays that start far away round more than the boxes they aim at are wide.
    #[test]
    fn rays_from_afar() {
        let far = |ray: Ray| {
            let origin = ray.origin - ray.direction * 3e4;
            Ray { origin, end: f32::INFINITY, ..ray }
        };
        assert_same(&cloud(300), rays(2000).map(far));
        assert_same(&grid(), rays(1000).map(far));
    }

    #[test]
    fn many_triangles_at_one_place() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let mut triangles = vec![triangle; 3000];
        triangles.extend(cloud(100));
        assert_same(&triangles, rays(50));
    }

    #[test]
    fn a_million_triangles() {
        let side = 708;
        let point = |x: u32, y: u32| {
            let (u, v) = (x as f32 / side as f32, y as f32 / side as f32);
            Vec3::new(u, v, 0.5 + 0.1 * crate::math::sin(20.0 * u) * crate::math::sin(31.0 * v))
        };
        let cell = |index: u32| {
            let (x, y) = (index % side, index / side);
            let [a, b, c, d] = [point(x, y), point(x + 1, y), point(x + 1, y + 1), point(x, y + 1)];
            [[a, b, c], [a, c, d]]
        };
        let triangles: Vec<_> = (0..side * side).flat_map(cell).collect();
        assert!(triangles.len() > 1_000_000);
        let tree = Bvh::new(&triangles);
        let mut met = 0;
        for ray in rays(30) {
            let nearest = tree.nearest(&ray);
            met += usize::from(nearest.is_some());
            assert_eq!(nearest, BruteForce(&triangles).nearest(&ray));
        }
        assert!(met > 5);
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
