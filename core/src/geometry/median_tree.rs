//! A bounding volume hierarchy that needs nothing but a heap: half of the triangles on each side of every cut.
//!
//! It is built without std, and asks rays the same way as the tree that obvhs builds; it has more boxes in the way.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use super::wide::{Binary, Content, PADDING, Tree};
use super::{Hit, Occluders, Ray};

/// Triangles in a tree, cut at the median along the longest axis of their centers.
pub struct MedianTree(Tree);

/// What a bake asks for hits.
#[cfg(not(feature = "bvh"))]
pub fn tree(triangles: Vec<[Vec3; 3]>) -> MedianTree {
    MedianTree::new(&triangles)
}

impl MedianTree {
    /// Builds a tree over finite triangles, in `n log^2 n` time.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        Self(Tree::new(&binary(triangles), triangles))
    }
}

impl Occluders for MedianTree {
    #[inline]
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        self.0.first(ray, place)
    }

    #[inline]
    fn any(&self, ray: &Ray, stop: impl FnMut(&Hit) -> bool) -> bool {
        self.0.any(ray, stop)
    }
}

/// A binary tree with one triangle a leaf; children stand side by side, behind their parent.
fn binary(triangles: &[[Vec3; 3]]) -> Vec<Binary> {
    let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
    let mut nodes = Vec::with_capacity(2 * triangles.len());
    let mut open = vec![(0, &mut order[..])];
    if !triangles.is_empty() {
        nodes.push(bounds(triangles, open[0].1));
    }
    while let Some((place, part)) = open.pop() {
        if part.len() < 2 {
            continue;
        }
        let [low, high] = cut(triangles, part);
        let first = nodes.len() as u32;
        nodes[place].content = Content::Children(first);
        nodes.extend([bounds(triangles, low), bounds(triangles, high)]);
        open.extend([(first as usize, low), (first as usize + 1, high)]);
    }
    nodes
}

/// Two halves of a part, by the places of centers along the axis on which they lie farthest apart.
fn cut<'a>(triangles: &[[Vec3; 3]], part: &'a mut [u32]) -> [&'a mut [u32]; 2] {
    let center = |&index: &u32| triangles[index as usize].iter().sum::<Vec3>();
    let (low, high) = part
        .iter()
        .map(center)
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), center| (low.min(center), high.max(center)));
    let axis = (high - low).max_position();
    // Equal places go by the index, so that the tree depends on the triangles alone.
    part.sort_unstable_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(b)));
    let (low, high) = part.split_at_mut(part.len() / 2);
    [low, high]
}

/// A leaf for the first triangle of a part with a box around all of it, a little too large, so that rounding loses no hit.
fn bounds(triangles: &[[Vec3; 3]], part: &[u32]) -> Binary {
    let corners = part.iter().flat_map(|&index| triangles[index as usize]);
    let (low, high) =
        corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), corner| (low.min(corner), high.max(corner)));
    let padding = Vec3::splat(low.abs().max(high.abs()).max_element() * PADDING);
    Binary { low: low - padding, high: high + padding, content: Content::Triangle(part[0]) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{BruteForce, Sobol, cosine_direction};

    /// Triangles in the unit cube, some of them twice.
    fn cloud(count: u32) -> Vec<[Vec3; 3]> {
        let point = |index: u32, seed: u32| {
            let sequence = Sobol::new(seed);
            Vec3::new(sequence.dimension(index, 0), sequence.dimension(index, 1), sequence.dimension(index, 2))
        };
        (0..count).map(|i| [0, 1, 2].map(|corner| point(i / 2, 11) + 0.2 * point(i / 2, 20 + corner))).collect()
    }

    /// The same hits, bit by bit, as of trying every triangle.
    #[test]
    fn tree_and_brute_force_agree() {
        for count in [0, 1, 2, 9, 300] {
            let triangles = cloud(count);
            let (tree, all) = (MedianTree::new(&triangles), BruteForce(&triangles));
            let mut met = 0;
            for index in 0..500 {
                let sequence = Sobol::new(index);
                let origin = Vec3::new(sequence.dimension(0, 0), sequence.dimension(0, 1), sequence.dimension(0, 2));
                let up = if index % 2 == 0 { Vec3::Z } else { Vec3::NEG_Z };
                let direction = cosine_direction(sequence.square(1), up);
                let ray = Ray { origin, direction, end: if index % 3 == 0 { 0.2 } else { f32::INFINITY } };
                assert_eq!(tree.nearest(&ray), all.nearest(&ray));
                let odd = |hit: &Hit| hit.triangle % 2 == 1;
                assert_eq!(tree.any(&ray, odd), all.any(&ray, odd));
                met += usize::from(tree.nearest(&ray).is_some());
            }
            assert!(count < 300 || met > 0);
        }
    }

    /// All at one place: nothing can be told apart, and the tree is as deep as ever.
    #[test]
    fn many_triangles_at_one_place() {
        let triangles = [[Vec3::ZERO, Vec3::X, Vec3::Y]; 1000];
        let ray = Ray { origin: Vec3::new(0.2, 0.2, 1.0), direction: Vec3::NEG_Z, end: 2.0 };
        assert_eq!(MedianTree::new(&triangles).nearest(&ray).map(|hit| hit.triangle), Some(0));
    }
}
