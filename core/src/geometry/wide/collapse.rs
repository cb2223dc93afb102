//! From two children a node to eight: those cuts of the binary tree that cost a ray the least.
//!
//! Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017,
//! section 4: the expected cost of a subtree by the surface areas of its boxes, for one to seven roots of a forest.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use super::lanes::LANES;

/// A node of a binary tree: its box, and its children or its triangle.
#[derive(Clone, Copy, Debug)]
pub struct Binary {
    pub low: Vec3,
    pub high: Vec3,
    pub content: Content,
}

/// What a node of a binary tree holds.
#[derive(Clone, Copy, Debug)]
pub enum Content {
    /// Index of the first of two neighboring nodes.
    Children(u32),
    /// Index of a triangle.
    Triangle(u32),
}

/// Time to test eight boxes, where the triangles of a leaf take 1.
const NODE: f32 = 1.0;

/// How what lies below a node is cut.
#[derive(Clone, Copy)]
struct Plan {
    /// For at most `k + 1` roots the cost.
    costs: [f32; LANES - 1],
    /// For at most `k + 1` roots how many each child gives; none: the node itself is the one root. The last is for a
    /// wide node.
    splits: [[u8; 2]; LANES],
    /// Triangles below.
    triangles: u32,
    is_leaf: bool,
}

/// How a binary tree becomes a wide one.
pub struct Collapse<'a> {
    tree: &'a [Binary],
    plans: Vec<Plan>,
}

impl<'a> Collapse<'a> {
    /// Plans for leaves of at most so many triangles. The first node is the root.
    pub fn new(tree: &'a [Binary], most: u32) -> Self {
        let mut collapse = Self { tree, plans: vec![Plan::new(0.0, 0); tree.len()] };
        for node in collapse.below(0).collect::<Vec<_>>().into_iter().rev() {
            collapse.plans[node as usize] = collapse.plan(node as usize, most);
        }
        collapse
    }

    /// A node and all below it, each before its children.
    pub fn below(&self, node: u32) -> impl Iterator<Item = u32> + use<'a> {
        let tree = self.tree;
        let mut open = vec![node];
        core::iter::from_fn(move || {
            let node = open.pop()?;
            if let Content::Children(first) = tree[node as usize].content {
                open.extend([first + 1, first]);
            }
            Some(node)
        })
    }

    fn plan(&self, node: usize, most: u32) -> Plan {
        let Binary { low, high, content } = self.tree[node];
        let size = high - low;
        let area = size.x * size.y + size.y * size.z + size.z * size.x;
        let Content::Children(first) = content else { return Plan::new(area, 1) };
        let [left, right] = [first, first + 1].map(|child| &self.plans[child as usize]);
        let best = |roots: usize| {
            let cost = |give: usize| left.costs[give - 1] + right.costs[roots - give - 1];
            let all = (1..roots).map(|give| (cost(give), [give as u8, (roots - give) as u8]));
            all.fold((f32::INFINITY, [1, 1]), |first, other| if other.0 < first.0 { other } else { first })
        };
        let (below, split) = best(LANES);
        let mut plan = Plan::new(below + NODE * area, left.triangles + right.triangles);
        plan.is_leaf = plan.triangles <= most && area <= plan.costs[0];
        if plan.is_leaf {
            plan.costs = [area; LANES - 1];
        }
        plan.splits[LANES - 1] = split;
        for roots in 2..LANES {
            let (cost, split) = best(roots);
            let fewer = (plan.costs[roots - 2], plan.splits[roots - 2]);
            (plan.costs[roots - 1], plan.splits[roots - 1]) = if cost < fewer.0 { (cost, split) } else { fewer };
        }
        plan
    }

    /// Whether all triangles below a node become one leaf.
    pub fn is_leaf(&self, node: u32) -> bool {
        self.plans[node as usize].is_leaf
    }

    /// The children of a wide node.
    pub fn children(&self, node: u32) -> heapless::Vec<u32, LANES> {
        let mut children = heapless::Vec::new();
        let mut open: heapless::Vec<(u32, usize), { 2 * LANES }> = heapless::Vec::new();
        let mut next = Some((node, LANES));
        while let Some((node, roots)) = next {
            match (self.plans[node as usize].splits[roots - 1], self.tree[node as usize].content) {
                ([left, right], Content::Children(first)) if left > 0 => {
                    // Eight roots at most are open.
                    open.push((first + 1, usize::from(right))).ok();
                    open.push((first, usize::from(left))).ok();
                }
                _ => drop(children.push(node)),
            }
            next = open.pop();
        }
        children
    }
}

impl Plan {
    fn new(cost: f32, triangles: u32) -> Self {
        Self { costs: [cost; LANES - 1], splits: [[0; 2]; LANES], triangles, is_leaf: true }
    }
}
