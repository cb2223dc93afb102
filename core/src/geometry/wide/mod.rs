//! A tree with eight children a node, whose boxes are tested at once, and leaves of triangles that are tested at once.

mod collapse;
mod lanes;
mod leaf;
mod node;

#[cfg(all(target_arch = "x86_64", feature = "bvh"))]
mod avx2;
#[cfg(not(all(target_arch = "x86_64", feature = "bvh")))]
mod plain;

#[cfg(all(target_arch = "x86_64", feature = "bvh"))]
pub use avx2::Level;
#[cfg(not(all(target_arch = "x86_64", feature = "bvh")))]
pub use plain::Level;

pub use collapse::{Binary, Content};

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use super::occluders::is_before;
use super::{Hit, Ray};
use collapse::Collapse;
use lanes::LANES;
pub use lanes::Lanes;
use leaf::{Leaf, LeafRay};
pub use node::PADDING;
use node::{BoxRay, Node};

/// Marks an index as that of a leaf.
const LEAF: u32 = 1 << 31;
/// Places on the stack that cost nothing; trees that need more are rare.
const DEPTH: usize = 192;

/// The tree.
pub struct Tree {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
    level: Level,
}

/// Work that is done with the widest instructions there are.
pub trait Task {
    type Output;

    fn run<L: Lanes>(self, lanes: L) -> Self::Output;
}

#[inline(never)]
fn run_task<T: Task, L: Lanes>(task: T, lanes: L) -> T::Output {
    task.run(lanes)
}

impl Tree {
    /// Makes a binary tree wide. Its first node is the root; it may be empty.
    pub fn new(binary: &[Binary], triangles: &[[Vec3; 3]]) -> Self {
        let mut tree = Self { nodes: vec![Node::EMPTY], leaves: Vec::new(), level: Level::new() };
        if binary.is_empty() {
            return tree;
        }
        let collapse = Collapse::new(binary, LANES as u32);
        let mut open = vec![(0, 0)];
        while let Some((node, place)) = open.pop() {
            let children =
                if collapse.is_leaf(node) { heapless::Vec::from_array([node]) } else { collapse.children(node) };
            for (lane, &child) in children.iter().enumerate() {
                let Binary { low, high, .. } = binary[child as usize];
                let index = if collapse.is_leaf(child) {
                    tree.leaves.push(Leaf::new(collapse.below(child).filter_map(|node| {
                        match binary[node as usize].content {
                            Content::Triangle(index) => Some((triangles[index as usize], index)),
                            Content::Children(_) => None,
                        }
                    })));
                    LEAF | (tree.leaves.len() - 1) as u32
                } else {
                    tree.nodes.push(Node::EMPTY);
                    open.push((child, tree.nodes.len() - 1));
                    (tree.nodes.len() - 1) as u32
                };
                tree.nodes[place].set(lane, low, high, index);
            }
        }
        tree
    }

    /// The same tree, traversed with what every processor has.
    #[cfg(test)]
    pub fn plain(self) -> Self {
        Self { level: Level::plain(), ..self }
    }

    /// See [`super::Occluders::first`].
    #[inline]
    pub fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        self.level.run(First { tree: self, ray, place })
    }

    /// See [`super::Occluders::any`].
    #[inline]
    pub fn any(&self, ray: &Ray, stop: impl FnMut(&Hit) -> bool) -> bool {
        self.level.run(Any { tree: self, ray, stop })
    }
}

/// What is still to be visited.
struct Stack<T> {
    near: heapless::Vec<T, DEPTH>,
    far: Vec<T>,
}

impl<T> Stack<T> {
    #[inline(always)]
    fn new() -> Self {
        Self { near: heapless::Vec::new(), far: Vec::new() }
    }

    #[inline(always)]
    fn push(&mut self, entry: T) {
        if let Err(entry) = self.near.push(entry) {
            self.far.push(entry);
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<T> {
        self.near.pop().or_else(|| self.far.pop())
    }
}

struct First<'a, P> {
    tree: &'a Tree,
    ray: &'a Ray,
    place: P,
}

impl<P: Fn(&Hit) -> Option<f32>> Task for First<'_, P> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> Option<Hit> {
        let Self { tree, ray, place } = self;
        let (boxes, sheared) = (BoxRay::new(lanes, ray), LeafRay::new(lanes, ray));
        let mut first: Option<(f32, Hit)> = None;
        let mut end = ray.end;
        let mut limit = end * (1.0 + 1e-6);
        let mut stack = Stack::new();
        let mut next = 0;
        loop {
            if next & LEAF == 0 {
                let node = &tree.nodes[next as usize];
                // What lies at the same place must be visited too.
                let (mut met, nears) = boxes.meet(lanes, node, limit);
                if met != 0 {
                    let lane = met.trailing_zeros() as usize & (LANES - 1);
                    met &= met - 1;
                    if met == 0 {
                        next = node.children[lane];
                        continue;
                    }
                    let mut nearest = entry(nears[lane], node.children[lane]);
                    while met != 0 {
                        let lane = met.trailing_zeros() as usize & (LANES - 1);
                        met &= met - 1;
                        let other = entry(nears[lane], node.children[lane]);
                        stack.push(nearest.max(other));
                        nearest = nearest.min(other);
                    }
                    next = nearest as u32;
                    continue;
                }
            } else {
                let leaf = &tree.leaves[(next ^ LEAF) as usize];
                leaf.hits(lanes, &sheared, end, |hit| {
                    if let Some(placed) = place(&hit).map(|place| (place, hit))
                        && first.is_none_or(|known| is_before(&placed, &known))
                    {
                        first = Some(placed);
                        end = placed.0.min(ray.end);
                        limit = end * (1.0 + 1e-6);
                    }
                    false
                });
            }
            loop {
                let Some(entry) = stack.pop() else { return first.map(|(_, hit)| hit) };
                if f32::from_bits((entry >> 32) as u32) <= limit {
                    next = entry as u32;
                    break;
                }
            }
        }
    }
}

/// What is to be visited, ordered by distance.
#[inline(always)]
fn entry(near: f32, child: u32) -> u64 {
    u64::from(near.to_bits()) << 32 | u64::from(child)
}

struct Any<'a, S> {
    tree: &'a Tree,
    ray: &'a Ray,
    stop: S,
}

impl<S: FnMut(&Hit) -> bool> Task for Any<'_, S> {
    type Output = bool;

    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> bool {
        let Self { tree, ray, mut stop } = self;
        let (boxes, sheared) = (BoxRay::new(lanes, ray), LeafRay::new(lanes, ray));
        let mut stack = Stack::new();
        let mut next = 0;
        loop {
            if next & LEAF == 0 {
                let node = &tree.nodes[next as usize];
                let (mut met, _) = boxes.meet(lanes, node, ray.end);
                while met != 0 {
                    let lane = met.trailing_zeros() as usize;
                    met &= met - 1;
                    stack.push(node.children[lane & 7]);
                }
            } else {
                let leaf = &tree.leaves[(next ^ LEAF) as usize];
                if leaf.hits(lanes, &sheared, ray.end, |hit| stop(&hit)) {
                    return true;
                }
            }
            match stack.pop() {
                Some(index) => next = index,
                None => return false,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stack deeper than its first part loses nothing.
    #[test]
    fn deep_stacks() {
        let mut stack = Stack::new();
        (0..1000).for_each(|entry| stack.push(entry));
        let mut popped: Vec<i32> = core::iter::from_fn(|| stack.pop()).collect();
        popped.sort_unstable();
        assert_eq!(popped, (0..1000).collect::<Vec<_>>());
    }
}
