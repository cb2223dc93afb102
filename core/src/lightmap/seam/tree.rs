//! A tree of boxes that finds the edges near an edge.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use super::edges::Edge;

/// Edges in a leaf.
const LEAF: usize = 4;

/// Edges in a binary tree, halved at the median.
pub(super) struct Tree {
    order: Vec<u32>,
    /// Nodes in the order of a walk through the tree.
    nodes: Vec<Node>,
}

struct Node {
    low: Vec3,
    high: Vec3,
    /// The range of `order` in a leaf.
    edges: [u32; 2],
    /// The node that follows if this one is left out.
    next: u32,
}

impl Tree {
    pub fn new(edges: &[Edge]) -> Self {
        let mut tree = Self { order: (0..edges.len() as u32).collect(), nodes: Vec::new() };
        let mut order = core::mem::take(&mut tree.order);
        tree.split(edges, &mut order, 0);
        Self { order, ..tree }
    }

    fn split(&mut self, edges: &[Edge], order: &mut [u32], first: usize) {
        let ends = || order.iter().flat_map(|&edge| edges[edge as usize].ends);
        let (low, high) = (ends().fold(Vec3::INFINITY, Vec3::min), ends().fold(Vec3::NEG_INFINITY, Vec3::max));
        let (node, is_leaf) = (self.nodes.len(), order.len() <= LEAF);
        let last = if is_leaf { first + order.len() } else { first };
        self.nodes.push(Node { low, high, edges: [first as u32, last as u32], next: 0 });
        if !is_leaf {
            let axis = (high - low).max_position();
            let middle = |edge: u32| edges[edge as usize].ends[0][axis] + edges[edge as usize].ends[1][axis];
            let half = order.len() / 2;
            order.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)).then(a.cmp(&b)));
            let (left, right) = order.split_at_mut(half);
            self.split(edges, left, first);
            self.split(edges, right, first + half);
        }
        self.nodes[node].next = self.nodes.len() as u32;
    }

    /// Edges whose boxes a line segment comes near, among them all that lie within `distance` of it.
    pub fn near(&self, ends: [Vec3; 2], distance: f32) -> Vec<u32> {
        let (mut found, mut at) = (vec![], 0);
        while let Some(node) = self.nodes.get(at) {
            if crosses(ends, node.low - distance, node.high + distance) {
                found.extend_from_slice(&self.order[node.edges[0] as usize..node.edges[1] as usize]);
                at += 1;
            } else {
                at = node.next as usize;
            }
        }
        found.sort_unstable();
        found
    }
}

/// Whether a line segment comes into a box: slab by slab.
fn crosses([start, end]: [Vec3; 2], low: Vec3, high: Vec3) -> bool {
    let step = end - start;
    let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
    for axis in 0..3 {
        if step[axis] == 0.0 {
            if start[axis] < low[axis] || start[axis] > high[axis] {
                return false;
            }
            continue;
        }
        let to = [low, high].map(|side| (side[axis] - start[axis]) / step[axis]);
        enter = enter.max(to[0].min(to[1]));
        leave = leave.min(to[0].max(to[1]));
    }
    enter <= leave
}
