//! Binary space partition: pieces that can be put in order for every viewpoint.

use glam::Vec3;
use heapless::Vec;

use super::piece::Side;
use super::{Piece, SplitError, Viewpoint};

/// No node.
const NONE: u32 = u32::MAX;

/// Flat polygons, cut so that for each viewpoint there is an order from back to front; with room for `N` pieces.
///
/// Fuchs, Kedem and Naylor, "On Visible Surface Generation by A Priori Tree Structures", 1980. The plane of each piece
/// parts what was inserted after it; what it runs through is cut. Large pieces that inserted first cut few others.
/// Of two in one plane the later one lies on the side to which the normal of the earlier one points.
///
/// ```
/// use glam::{Vec3, vec3};
/// use radiosity::composite::{BspTree, Viewpoint};
///
/// let mut tree = BspTree::<4>::default();
/// let [low, high] = [vec3(-1.0, -1.0, 0.0), vec3(1.0, 1.0, 0.0)];
/// tree.insert(&[low, vec3(1.0, -1.0, 0.0), high, vec3(-1.0, 1.0, 0.0)], 7)?;
/// tree.insert(&[vec3(0.0, -1.0, -1.0), vec3(0.0, 1.0, -1.0), vec3(0.0, 1.0, 1.0), vec3(0.0, -1.0, 1.0)], 8)?;
/// let order = tree.back_to_front(Viewpoint::Eye(Vec3::Z * 5.0)).map(|piece| piece.source);
/// assert_eq!(order.collect::<Vec<_>>(), [8, 7, 8], "the second runs through the first");
/// # Ok::<(), radiosity::composite::SplitError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BspTree<const N: usize> {
    nodes: Vec<Node, N>,
}

#[derive(Clone, Debug, PartialEq)]
struct Node {
    piece: Piece,
    parent: u32,
    /// Behind the plane of the piece, and in front of it.
    children: [u32; 2],
}

impl<const N: usize> BspTree<N> {
    /// Adds a convex polygon, cut where it runs through others; all of its pieces bear its number.
    ///
    /// # Errors
    ///
    /// Where it is none, or there is no room for its pieces; the tree is then as it was.
    pub fn insert(&mut self, corners: &[Vec3], source: u32) -> Result<(), SplitError> {
        let before = self.nodes.len();
        let result = self.insert_piece(Piece::new(corners, source)?);
        if result.is_err() {
            self.nodes.truncate(before);
            let children = self.nodes.iter_mut().flat_map(|node| &mut node.children);
            children.filter(|child| **child as usize >= before).for_each(|child| *child = NONE);
        }
        result
    }

    fn insert_piece(&mut self, piece: Piece) -> Result<(), SplitError> {
        let mut waiting = Vec::<(Piece, u32), N>::new();
        let mut next = Some((piece, 0));
        while let Some((piece, node)) = next {
            next = match self.nodes.get(node as usize) {
                None => {
                    self.attach(piece, NONE, 0)?;
                    None
                }
                Some(_) => self.descend(piece, node, &mut waiting)?,
            };
            next = next.or_else(|| waiting.pop());
        }
        Ok(())
    }

    /// One step down from a node: where the piece goes on, unless it has found its place.
    fn descend(
        &mut self,
        piece: Piece,
        node: u32,
        waiting: &mut Vec<(Piece, u32), N>,
    ) -> Result<Option<(Piece, u32)>, SplitError> {
        let plane = self.nodes[node as usize].piece.plane;
        let (piece, side) = match piece.side_of(&plane) {
            Side::Back => (piece, 0),
            Side::Front | Side::Within => (piece, 1),
            Side::Both => {
                let [front, back] = piece.cut(&plane)?;
                match self.nodes[node as usize].children[1] {
                    NONE => self.attach(front, node, 1)?,
                    child => waiting.push((front, child)).map_err(|_| SplitError::Full { pieces: N })?,
                }
                (back, 0)
            }
        };
        match self.nodes[node as usize].children[side] {
            NONE => self.attach(piece, node, side).map(|()| None),
            child => Ok(Some((piece, child))),
        }
    }

    fn attach(&mut self, piece: Piece, parent: u32, side: usize) -> Result<(), SplitError> {
        let index = self.nodes.len() as u32;
        let node = Node { piece, parent, children: [NONE; 2] };
        self.nodes.push(node).map_err(|_| SplitError::Full { pieces: N })?;
        if let Some(parent) = self.nodes.get_mut(parent as usize) {
            parent.children[side] = index;
        }
        Ok(())
    }

    /// How many pieces there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// All pieces, in the order in which they were made.
    pub fn pieces(&self) -> impl Iterator<Item = &Piece> {
        self.nodes.iter().map(|node| &node.piece)
    }

    /// All pieces such that none hides one that comes after it.
    pub fn back_to_front(&self, viewpoint: Viewpoint) -> impl Iterator<Item = &Piece> {
        self.order(viewpoint).map(|number| &self.nodes[number].piece)
    }

    /// The same by their places in [`BspTree::pieces`].
    pub fn order(&self, viewpoint: Viewpoint) -> impl Iterator<Item = usize> {
        let eye = viewpoint.homogeneous();
        let near = move |node: u32| usize::from(self.nodes[node as usize].piece.plane.height_of_eye(eye) >= 0.0);
        let farthest_below = move |mut node: u32| {
            while let Some(&Node { children, .. }) = self.nodes.get(node as usize)
                && children[1 - near(node)] != NONE
            {
                node = children[1 - near(node)];
            }
            node
        };
        let mut next = farthest_below(0);
        core::iter::from_fn(move || {
            let mut from = next;
            let number = from as usize;
            let children = self.nodes.get(number)?.children;
            next = match children[near(from)] {
                NONE => loop {
                    let parent = self.nodes[from as usize].parent;
                    if parent == NONE || self.nodes[parent as usize].children[1 - near(parent)] == from {
                        break parent;
                    }
                    from = parent;
                },
                child => farthest_below(child),
            };
            Some(number)
        })
    }
}
