//! Many lamps in a tree: which of them matter at a place, and which one to ask for all others.
//!
//! Walter et al., "Lightcuts", SIGGRAPH 2005, for the cut; Conty Estevez and Kulla, "Importance Sampling of Many
//! Lights with Adaptive Tree Splitting", HPG 2018, for the bounds of cones and the way down.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;

use glam::Vec3;

use super::range_window;
use crate::math;

/// Rounding of cosines: a bound must not fall below what it bounds.
const SLACK: f32 = 1e-5;

/// Where light leaves a lamp or several of them, and how much at most.
#[derive(Clone, Copy, Debug)]
pub struct Emission {
    /// Lowest corner of the box around all points that emit, in meters.
    pub low: Vec3,
    /// Highest corner of that box.
    pub high: Vec3,
    /// The directions in which lamps look. Light leaves up to `beyond` outside of this cone, too.
    pub axes: Cone,
    /// Cosine of the angle to its axis beyond which a lamp is dark. With an angle of `a` to the cone of axes a lamp has
    /// at most `cos a` of its intensity.
    pub cos_beyond: f32,
    /// Intensity along the axes in cd, mean of the channels.
    pub intensity: f32,
    /// No point gets more irradiance than this, however near, in lx.
    pub most: f32,
    /// Beyond this, in meters, all is dark.
    pub range: f32,
}

/// Directions around an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Of length 1.
    pub axis: Vec3,
    /// Cosine of the half angle; -1: all directions.
    pub cos: f32,
}

/// Where light arrives: a box with normals, or a point.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// Lowest corner of the box around all points, in meters.
    pub low: Vec3,
    /// Highest corner of that box.
    pub high: Vec3,
    /// The normals.
    pub normals: Cone,
}

/// Lamps in a tree.
#[derive(Clone, Debug, Default)]
pub struct LightTree {
    /// Each is followed by its first child.
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    emission: Emission,
    below: Below,
}

#[derive(Clone, Copy, Debug)]
enum Below {
    Lamp(u32),
    /// The first child comes next; this is the index of the second.
    Second(u32),
}

/// What a tree says of a place: which lamps to ask one by one, and what remains.
#[derive(Clone, Debug, Default)]
pub struct Cut {
    /// Indices of lamps, ascending.
    pub lamps: Vec<u32>,
    /// Nodes that hold all other lamps of which light may arrive.
    rest: Vec<u32>,
    /// For each node of the rest the sum of bounds up to and with it, in lx.
    sums: Vec<f32>,
}

/// A lamp that stands for others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Its index.
    pub lamp: u32,
    /// How likely it was to be chosen, in `(0, 1]`.
    pub probability: f32,
}

impl Cone {
    /// All directions.
    pub const ALL: Self = Self { axis: Vec3::Z, cos: -1.0 };

    /// One direction of length 1.
    pub fn one(axis: Vec3) -> Self {
        Self { axis, cos: 1.0 }
    }

    /// A cone that holds two others: around the direction in their middle.
    pub fn and(&self, other: &Self) -> Self {
        let middle = self.axis + other.axis;
        if self.cos <= -1.0 || other.cos <= -1.0 || middle.length_squared() < 1e-6 {
            return Self::ALL;
        }
        let axis = middle.normalize();
        let angle = |cone: &Self| math::acos(axis.dot(cone.axis).clamp(-1.0, 1.0)) + math::acos(cone.cos);
        let half = angle(self).max(angle(other)) + SLACK;
        if half >= core::f32::consts::PI { Self::ALL } else { Self { axis, cos: math::cos(half) } }
    }

    /// Cosine of the least angle between a direction of this cone and one of a cone around `direction`.
    fn cos_to(&self, direction: Vec3, other: Angle) -> f32 {
        Angle::new(self.axis.dot(direction)).less(Angle::new(self.cos)).less(other).cos
    }
}

/// An angle in `[0, pi]`.
#[derive(Clone, Copy)]
struct Angle {
    cos: f32,
    sin: f32,
}

impl Angle {
    fn new(cos: f32) -> Self {
        Self { cos, sin: math::sqrt((1.0 - cos * cos).max(0.0)) }
    }

    /// This minus another one, at least 0.
    fn less(self, other: Self) -> Self {
        if self.cos >= other.cos {
            return Self { cos: 1.0, sin: 0.0 };
        }
        Self {
            cos: self.cos * other.cos + self.sin * other.sin,
            sin: (self.sin * other.cos - self.cos * other.sin).max(0.0),
        }
    }
}

impl Region {
    /// A point with a normal of length 1.
    pub fn point(point: Vec3, normal: Vec3) -> Self {
        Self { low: point, high: point, normals: Cone::one(normal) }
    }

    /// Points, each with its normal of length 1 and how far around it light may be looked for.
    pub fn around(points: impl Iterator<Item = (Vec3, Vec3, f32)> + Clone) -> Self {
        let (mut low, mut high, mut sum) = (Vec3::INFINITY, Vec3::NEG_INFINITY, Vec3::ZERO);
        for (point, normal, reach) in points.clone() {
            (low, high, sum) = (low.min(point - reach), high.max(point + reach), sum + normal);
        }
        let axis = sum.normalize_or(Vec3::Z);
        let cos = points.map(|(_, normal, _)| axis.dot(normal)).fold(1.0, f32::min);
        Self { low, high, normals: Cone { axis, cos: cos.max(-1.0) } }
    }
}

impl Emission {
    /// Of no lamp.
    pub(super) const NONE: Self = Self {
        low: Vec3::ZERO,
        high: Vec3::ZERO,
        axes: Cone::ALL,
        cos_beyond: 0.0,
        intensity: 0.0,
        most: 0.0,
        range: 0.0,
    };

    /// Of both together.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            axes: self.axes.and(&other.axes),
            cos_beyond: self.cos_beyond.min(other.cos_beyond),
            intensity: self.intensity + other.intensity,
            most: self.most + other.most,
            range: self.range.max(other.range),
        }
    }

    /// More irradiance than this does not arrive anywhere at the region, in lx, mean of the channels.
    pub fn bound(&self, region: &Region) -> f32 {
        let gap = (self.low - region.high).max(region.low - self.high).max(Vec3::ZERO);
        let squared = gap.length_squared();
        self.most.min(self.intensity_towards(region) * range_window(squared, self.range) / squared.max(1e-12))
    }

    /// What arrives there, about, in lx: zero only where [`Self::bound`] is.
    fn estimate(&self, region: &Region) -> f32 {
        let gap = (self.low - region.high).max(region.low - self.high).max(Vec3::ZERO);
        let window = range_window(gap.length_squared(), self.range);
        let apart = 0.25 * (self.low + self.high - region.low - region.high).length_squared();
        let extent = 0.0625 * (self.high - self.low).length_squared();
        self.most.min(self.intensity_towards(region) * window / apart.max(extent).max(1e-12))
    }

    /// Greatest intensity times the cosine at the region, over all pairs of points.
    fn intensity_towards(&self, region: &Region) -> f32 {
        let to_lamp = 0.5 * (self.low + self.high - region.low - region.high);
        let reach = 0.5 * ((self.high - self.low).length() + (region.high - region.low).length());
        let distance = to_lamp.length();
        if distance <= reach {
            return self.intensity;
        }
        let direction = to_lamp / distance;
        // The directions between all pairs of points.
        let sin = reach / distance;
        let all = Angle { cos: math::sqrt(1.0 - sin * sin), sin };
        let cos = region.normals.cos_to(direction, all) + SLACK;
        let cos_lamp = self.axes.cos_to(-direction, all) + SLACK;
        if cos_lamp < self.cos_beyond { 0.0 } else { self.intensity * cos.max(0.0) * cos_lamp.clamp(0.0, 1.0 + SLACK) }
    }
}

impl LightTree {
    /// A tree of these lamps, each with its index.
    pub fn new(mut lamps: Vec<(u32, Emission)>) -> Self {
        let mut tree = Self::default();
        if !lamps.is_empty() {
            tree.add(&mut lamps);
        }
        tree
    }

    /// Adds lamps as one node and all below it; halves by the longest side of the box around their centers.
    fn add(&mut self, lamps: &mut [(u32, Emission)]) -> Emission {
        let index = self.nodes.len();
        if let [(lamp, emission)] = *lamps {
            self.nodes.push(Node { emission, below: Below::Lamp(lamp) });
            return emission;
        }
        let center = |emission: &Emission| emission.low + emission.high;
        let corners = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) = lamps
            .iter()
            .fold(corners, |(low, high), (_, emission)| (low.min(center(emission)), high.max(center(emission))));
        let axis = (high - low).max_position();
        lamps.sort_by(|(_, a), (_, b)| center(a)[axis].total_cmp(&center(b)[axis]));
        let (left, right) = lamps.split_at_mut(lamps.len() / 2);
        self.nodes.push(Node { emission: left[0].1, below: Below::Second(0) });
        let first = self.add(left);
        let second = self.nodes.len() as u32;
        let emission = first.and(&self.add(right));
        self.nodes[index] = Node { emission, below: Below::Second(second) };
        emission
    }

    /// The strongest lamps at a region, as bounds have it, one by one, until what remains is at most `share` of their
    /// light or there are `most` of them. Lamps of which nothing can arrive are left out.
    ///
    /// `light` tells what a lamp gives there, in lx.
    pub fn cut(&self, region: &Region, most: usize, share: f32, light: impl Fn(u32) -> f32) -> Cut {
        let mut cut = Cut::default();
        let (mut open, mut of_lamps, mut of_rest) = (Open::default(), 0.0, 0.0);
        let bound = |node: u32| self.nodes[node as usize].emission.bound(region);
        if !self.nodes.is_empty() {
            of_rest += open.push(bound(0), 0);
        }
        while cut.lamps.len() < most && (share == 0.0 || of_rest > share * of_lamps) {
            let Some((bound_of_node, node)) = open.pop() else { break };
            of_rest -= bound_of_node;
            match self.nodes[node as usize].below {
                Below::Lamp(lamp) => {
                    of_lamps += light(lamp);
                    cut.lamps.push(lamp);
                }
                Below::Second(second) => {
                    of_rest += open.push(bound(node + 1), node + 1) + open.push(bound(second), second)
                }
            }
        }
        cut.lamps.sort_unstable();
        cut.set_rest(open.0.into_iter().map(|(_, node)| node).collect(), |node| {
            self.nodes[node as usize].emission.estimate(region)
        });
        cut
    }

    /// A lamp among the rest of a cut for a point of it, by a number in `[0, 1)`: the likelier the more it may give.
    pub fn choose(&self, cut: &Cut, region: &Region, number: f32) -> Option<Choice> {
        let (mut node, mut probability, mut number) = cut.choose(number)?;
        loop {
            let second = match self.nodes[node as usize].below {
                Below::Lamp(lamp) => return Some(Choice { lamp, probability }),
                Below::Second(second) => second,
            };
            let [a, b] = [node + 1, second].map(|child| self.nodes[child as usize].emission.estimate(region));
            if a + b <= 0.0 {
                return None;
            }
            let first = a / (a + b);
            if number < first {
                (node, probability, number) = (node + 1, probability * first, number / first);
            } else {
                (node, probability, number) = (second, probability * (1.0 - first), (number - first) / (1.0 - first));
            }
            number = number.min(1.0 - f32::EPSILON);
        }
    }
}

impl Cut {
    fn set_rest(&mut self, mut open: Vec<u32>, estimate: impl Fn(u32) -> f32) {
        // In the order of the tree neighbors stay together, and equal numbers choose like lamps.
        open.sort_unstable();
        let mut sum = 0.0;
        for node in open {
            sum += estimate(node);
            self.rest.push(node);
            self.sums.push(sum);
        }
    }

    /// About what the rest gives unoccluded, in lx.
    pub fn rest(&self) -> f32 {
        self.sums.last().copied().unwrap_or_default()
    }

    /// A node of the rest, how likely it was, and what is left of the number.
    fn choose(&self, number: f32) -> Option<(u32, f32, f32)> {
        let target = number * self.rest();
        let index = self.sums.partition_point(|&sum| sum <= target).min(self.sums.len().checked_sub(1)?);
        let start = if index == 0 { 0.0 } else { self.sums[index - 1] };
        let share = self.sums[index] - start;
        let left = ((target - start) / share.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON);
        Some((self.rest[index], share / self.rest(), left))
    }
}

/// Nodes by their bounds, the greatest first; those of which nothing arrives are left out. Positive numbers are in the
/// order of their bits.
#[derive(Default)]
struct Open(BinaryHeap<(u32, u32)>);

impl Open {
    /// Adds a node and returns its bound.
    fn push(&mut self, bound: f32, node: u32) -> f32 {
        if bound > 0.0 {
            self.0.push((bound.to_bits(), node));
        }
        bound.max(0.0)
    }

    fn pop(&mut self) -> Option<(f32, u32)> {
        self.0.pop().map(|(bits, node)| (f32::from_bits(bits), node))
    }
}
