//! Many lamps in a tree: which of them matter at a place, and which one to ask for all others.
//!
//! Walter et al., "Lightcuts", SIGGRAPH 2005, for the cut; Conty Estevez and Kulla, "Importance Sampling of Many
//! Lights with Adaptive Tree Splitting", HPG 2018, for the bounds of cones and the way down.

use alloc::collections::BinaryHeap;
use alloc::vec::Vec;

use glam::Vec3;

use super::range_window;
use crate::math;

/// The rest of a cut is cut into so many nodes, if it holds as many.
const CLUSTERS: usize = 128;
/// How often a bound counts as seen before anything was: fewer learn faster.
const PRIOR: f32 = 0.25;
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
    /// Nodes that hold all other lamps of which light may arrive, ascending.
    rest: Vec<u32>,
    /// For each node of the rest its bound, in lx.
    bounds: Vec<f32>,
}

/// How much the nodes of the rest of a cut gave so far, so that those which give much are asked often.
///
/// A node is chosen in proportion to the root of the mean square of what it gave, which leaves the least variance. It
/// starts with its bound as if that had been seen once: what is hidden behind a wall is soon asked seldom, and never
/// given up. Vevoda, Kondapaneni and Krivanek, "Bayesian online regression for adaptive direct illumination sampling",
/// SIGGRAPH 2018, do the like.
#[derive(Clone, Debug, Default)]
pub struct Guide {
    /// For each node of the rest how often it was asked, and the sum of the squares of what it gave.
    seen: Vec<[f32; 2]>,
    /// For each node of the rest the sum of the weights up to and with it.
    sums: Vec<f32>,
}

/// A lamp that stands for others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Its index.
    pub lamp: u32,
    /// How likely it was to be chosen, in `(0, 1]`.
    pub probability: f32,
    /// The node of the rest that holds it, by its place in the cut.
    node: usize,
    /// How likely that was.
    of_node: f32,
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
        let (mut open, mut of_lamps) = (Open::default(), 0.0);
        let bound = |node: u32| self.nodes[node as usize].emission.bound(region);
        if !self.nodes.is_empty() {
            open.push(bound(0), 0);
        }
        while cut.lamps.len() < most && (share == 0.0 || open.sum() > share * of_lamps) {
            let Some((_, node)) = open.pop() else { break };
            match self.nodes[node as usize].below {
                Below::Lamp(lamp) => {
                    of_lamps += light(lamp);
                    cut.lamps.push(lamp);
                }
                Below::Second(second) => {
                    open.push(bound(node + 1), node + 1);
                    open.push(bound(second), second);
                }
            }
        }
        cut.lamps.sort_unstable();
        let mut rest = Vec::new();
        while rest.len() + open.0.len() < CLUSTERS {
            let Some((_, node)) = open.pop() else { break };
            match self.nodes[node as usize].below {
                Below::Lamp(_) => rest.push(node),
                Below::Second(second) => {
                    open.push(bound(node + 1), node + 1);
                    open.push(bound(second), second);
                }
            }
        }
        rest.extend(open.0.iter().map(|&(_, node)| node));
        // In the order of the tree neighbors stay together, and equal numbers choose like lamps.
        rest.sort_unstable();
        cut.bounds = rest.iter().map(|&node| bound(node)).collect();
        cut.rest = rest;
        cut
    }

    /// A lamp among the rest of a cut for a point of it, by a number in `[0, 1)`: the likelier the more it may give.
    pub fn choose(&self, cut: &Cut, guide: &Guide, region: &Region, number: f32) -> Option<Choice> {
        let (place, of_node, mut number) = guide.choose(number)?;
        let (mut node, mut probability) = (cut.rest[place], of_node);
        loop {
            let second = match self.nodes[node as usize].below {
                Below::Lamp(lamp) => return Some(Choice { lamp, probability, node: place, of_node }),
                Below::Second(second) => second,
            };
            let [a, b] = [node + 1, second].map(|child| self.nodes[child as usize].emission.bound(region));
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

impl Guide {
    /// A guide to the rest of a cut that has seen nothing yet.
    pub fn new(cut: &Cut) -> Self {
        let mut guide =
            Self { seen: cut.bounds.iter().map(|&bound| [PRIOR, PRIOR * bound * bound]).collect(), sums: Vec::new() };
        guide.learn(&[]);
        guide
    }

    /// Takes in what lamps gave, each with its light in lx over its probability; zero where it was hidden.
    pub fn learn(&mut self, gave: &[(Choice, f32)]) {
        for (choice, light) in gave {
            let [count, squares] = &mut self.seen[choice.node];
            let of_node = light * choice.of_node;
            (*count, *squares) = (*count + 1.0, *squares + of_node * of_node);
        }
        let mut sum = 0.0;
        self.sums.clear();
        self.sums.extend(self.seen.iter().map(|[count, squares]| {
            sum += math::sqrt(squares / count);
            sum
        }));
    }

    /// The mean square of what a choice is expected to give, over its probability, in lx^2.
    pub fn expected(&self) -> f32 {
        self.sums.last().map_or(0.0, |sum| sum * sum)
    }

    /// Whether there is nothing to choose from.
    pub fn is_empty(&self) -> bool {
        self.seen.is_empty()
    }

    /// The place of a node in the cut, how likely it was, and what is left of the number.
    fn choose(&self, number: f32) -> Option<(usize, f32, f32)> {
        let all = *self.sums.last()?;
        let target = number * all;
        let index = self.sums.partition_point(|&sum| sum <= target).min(self.sums.len() - 1);
        let start = if index == 0 { 0.0 } else { self.sums[index - 1] };
        let share = self.sums[index] - start;
        let left = ((target - start) / share.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON);
        (share > 0.0).then(|| (index, share / all, left))
    }
}

/// Nodes by their bounds, the greatest first; those of which nothing arrives are left out. Positive numbers are in the
/// order of their bits.
#[derive(Default)]
struct Open(BinaryHeap<(u32, u32)>);

impl Open {
    fn push(&mut self, bound: f32, node: u32) {
        if bound > 0.0 {
            self.0.push((bound.to_bits(), node));
        }
    }

    /// Of all bounds, added anew each time: what is left of a sum from which a great number was taken is rounding.
    fn sum(&self) -> f32 {
        self.0.iter().map(|&(bits, _)| f32::from_bits(bits)).sum()
    }

    fn pop(&mut self) -> Option<(f32, u32)> {
        self.0.pop().map(|(bits, node)| (f32::from_bits(bits), node))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Sobol, cone_direction};
    use crate::light::{AreaLight, DirectLight, PointLight, SpotLight};
    use alloc::vec;
    use core::iter;

    fn random(seed: u32, k: u32) -> Vec3 {
        let sequence = Sobol::new(seed);
        Vec3::new(sequence.dimension(k, 0), sequence.dimension(k, 1), sequence.dimension(k, 2))
    }

    fn direction(seed: u32, k: u32) -> Vec3 {
        cone_direction(Sobol::new(seed).square(k), Vec3::Y, -1.0)
    }

    /// Points, spots and triangles all over a cube of 10 m.
    fn lights(count: u32) -> Vec<DirectLight> {
        let light = |k: u32| {
            let position = 10.0 * random(1, k);
            let range = if k.is_multiple_of(2) { f32::INFINITY } else { 2.0 + 6.0 * random(2, k).x };
            let point = PointLight { position, intensity: 3.0 * random(3, k), range, radius: 0.0 };
            let outer_angle = 0.1 + 1.4 * random(2, k).y;
            match k % 3 {
                0 => DirectLight::Point(point),
                1 => {
                    let direction = direction(4, k);
                    DirectLight::Spot(SpotLight { point, direction, inner_angle: 0.5 * outer_angle, outer_angle })
                }
                _ => {
                    let corners = [5, 6, 7].map(|seed| position + random(seed, k));
                    let emitters = [(corners, 3.0 * random(3, k))];
                    let mut light = AreaLight::new(emitters.into_iter(), k.is_multiple_of(2));
                    light.range = range;
                    DirectLight::Area(light)
                }
            }
        };
        (0..count).map(light).collect()
    }

    fn tree(lights: &[DirectLight]) -> LightTree {
        let emissions = lights.iter().enumerate().filter_map(|(k, light)| Some((k as u32, light.emission(Vec3::ONE)?)));
        LightTree::new(emissions.collect())
    }

    fn level(light: &DirectLight, (point, normal): (Vec3, Vec3)) -> f32 {
        light.irradiance(point, normal).element_sum() / 3.0
    }

    /// The lamps below a node.
    fn below(tree: &LightTree, node: u32) -> Vec<u32> {
        match tree.nodes[node as usize].below {
            Below::Lamp(lamp) => vec![lamp],
            Below::Second(second) => [below(tree, node + 1), below(tree, second)].concat(),
        }
    }

    /// Points in a small box with normals in a cone.
    fn sites(k: u32) -> Vec<(Vec3, Vec3)> {
        let (corner, axis, size) = (12.0 * random(8, k) - 1.0, direction(9, k), random(10, k).x);
        let cone = |j| cone_direction(Sobol::new(k).square(j), axis, 1.0 - 0.5 * random(10, k).y);
        (0..8).map(|j| (corner + size * random(11 + k, j), cone(j))).collect()
    }

    #[test]
    fn no_lamp_gives_more_than_its_bound() {
        let lights = lights(60);
        let tree = tree(&lights);
        for k in 0..150 {
            let sites = sites(k);
            let region = Region::around(sites.iter().map(|&(point, normal)| (point, normal, 0.0)));
            for node in 0..tree.nodes.len() as u32 {
                let bound = tree.nodes[node as usize].emission.bound(&region);
                for &site in &sites {
                    let sum: f32 = below(&tree, node).iter().map(|&lamp| level(&lights[lamp as usize], site)).sum();
                    assert!(sum <= bound * 1.0001, "{sum} above {bound} at {site:?}");
                }
            }
        }
    }

    /// Each lamp that gives light is either asked by itself or among the rest, and no lamp is both.
    #[test]
    fn cuts_hold_every_lamp_once() {
        let lights = lights(1000);
        let tree = tree(&lights);
        for k in 0..50 {
            let sites = sites(k);
            let region = Region::around(sites.iter().map(|&(point, normal)| (point, normal, 0.0)));
            let cut = tree.cut(&region, 20, 0.0, |lamp| level(&lights[lamp as usize], sites[0]));
            let mut held = cut.lamps.clone();
            cut.rest.iter().for_each(|&node| held.extend(below(&tree, node)));
            held.sort_unstable();
            assert!(held.windows(2).all(|pair| pair[0] < pair[1]));
            for lamp in (0..1000).filter(|lamp| held.binary_search(lamp).is_err()) {
                assert!(sites.iter().all(|&site| level(&lights[lamp as usize], site) == 0.0));
            }
        }
    }

    /// A lamp within the region has a bound a million times above what the others give, and is hidden: once it was asked,
    /// others are asked until the rest is at most the wanted share, and no longer.
    #[test]
    fn what_is_left_of_bounds_is_no_rounding() {
        let at = |position, intensity| {
            DirectLight::Point(PointLight {
                position,
                intensity: Vec3::splat(intensity),
                range: f32::INFINITY,
                radius: 0.0,
            })
        };
        let far = (0..200).map(|k| at(Vec3::new(4.0 * random(1, k).x, 10.0, 4.0 * random(1, k).z), 1.0 + k as f32));
        let lights: Vec<DirectLight> = iter::once(at(Vec3::Y * 0.05, 1e5)).chain(far).collect();
        let tree = tree(&lights);
        let corners = [Vec3::ZERO, Vec3::new(0.1, 0.1, 0.1)];
        let region = Region::around(corners.into_iter().map(|corner| (corner, Vec3::Y, 0.0)));
        let given = |lamp: u32| if lamp == 0 { 0.0 } else { level(&lights[lamp as usize], (Vec3::ZERO, Vec3::Y)) };
        let cut = tree.cut(&region, 201, 0.5, given);
        let of_rest: f32 = cut.bounds.iter().sum();
        let of_lamps: f32 = cut.lamps.iter().map(|&lamp| given(lamp)).sum();
        assert!(cut.lamps[0] == 0 && cut.lamps.len() < 190, "{} lamps", cut.lamps.len());
        assert!(of_rest <= 0.5 * of_lamps, "{of_rest} beside {of_lamps}");
    }

    /// The mean of light over probability is the sum of the light of all lamps of the rest, before and after learning.
    #[test]
    fn choices_are_fair() {
        let lights = lights(300);
        let tree = tree(&lights);
        for k in 0..10 {
            let site = sites(k)[0];
            let region = Region::point(site.0, site.1);
            let cut = tree.cut(&region, 10, 0.0, |lamp| level(&lights[lamp as usize], site));
            let rest = cut.rest.iter().flat_map(|&node| below(&tree, node));
            let exact: f32 = rest.map(|lamp| level(&lights[lamp as usize], site)).sum();
            let mut guide = Guide::new(&cut);
            for pass in 0..2 {
                let choices = (0..4096).filter_map(|i| tree.choose(&cut, &guide, &region, (i as f32 + 0.5) / 4096.0));
                let gave: Vec<(Choice, f32)> = choices
                    .map(|choice| (choice, level(&lights[choice.lamp as usize], site) / choice.probability))
                    .collect();
                let mean = gave.iter().map(|(_, light)| light).sum::<f32>() / 4096.0;
                assert!((mean - exact).abs() <= 0.02 * exact, "{mean} instead of {exact} in pass {pass}");
                guide.learn(&gave);
            }
        }
    }
}
