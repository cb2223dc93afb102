//! Bright pieces of surface, such as a patch of sunlight on a floor, looked for on purpose.
//!
//! Rays in all directions meet what is small and bright by chance only, and that chance is the noise of a room lit by
//! one patch of sun. What is brighter than surfaces usually are is therefore sampled as a lamp is, too.

use alloc::vec;
use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::{Vec3, Vec3A};

use super::{Texel, Texels};
use crate::scene::World;
use crate::transport::{Size, Surfaces};

/// Only what is brighter than so many times the mean of all surfaces is looked for.
const BRIGHT: f32 = 3.0;
/// And only if it is this share of all light that leaves the surfaces.
const LEAST_SHARE: f32 = 0.05;
/// Bright texels are halved so often to become groups among which each node chooses: at most 254 groups.
const HALVINGS: u32 = 5;
/// Facing the other way counts as much as twice this share of the extent of all.
const TURN: f32 = 0.25;
/// Groups that may give less than this share of the mean are left to chance.
const FAINT: f32 = 0.02;

/// No group.
const NO_GROUP: u8 = u8::MAX;

/// Bright pieces of surface in groups; possibly none.
#[derive(Clone, Debug, Default)]
pub struct Reflectors {
    groups: Vec<Group>,
    members: Vec<Member>,
    /// For each texel its group, or [`NO_GROUP`]; empty where there is no group.
    of_texel: Vec<u8>,
    /// The column of the first texel.
    first: u32,
    /// Of the radiance of all surfaces.
    mean: f32,
}

/// Bright texels that lie close together and face much the same way.
#[derive(Clone, Copy, Debug, Default)]
struct Group {
    center: Vec3,
    radius: f32,
    /// Mean of the normals: the shorter, the more they differ.
    normal: Vec3,
    power: f32,
    /// Where its members end.
    end: u32,
}

/// A texel with the power of all members of its group up to and with this one.
#[derive(Clone, Copy, Debug)]
struct Member {
    texel: u32,
    power_end: f32,
}

/// How a node chooses among the groups.
#[derive(Clone, Debug, Default)]
pub struct Chances {
    /// The sum of the weights of the groups up to and with each.
    ends: Vec<f32>,
    /// For each group the density of points on it over their radiance.
    densities: Vec<f32>,
}

/// A bright texel.
#[derive(Clone, Copy, Debug)]
struct Spot {
    texel: u32,
    power: f32,
}

impl Reflectors {
    /// The bright pieces among the texels that are here, by the radiance of all columns.
    pub fn new(radiance: &[Vec3A], texels: &Texels, surfaces: &Surfaces, world: &World) -> Self {
        let areas = &surfaces.texel_areas;
        let first = surfaces.column(0, Size::Texel);
        let of_texel = |texel: usize| radiance[first as usize + texel];
        let power = |texel: usize| f64::from(level(of_texel(texel)) * areas[texel]);
        let whole: f64 = (0..areas.len()).map(power).sum();
        let area: f64 = areas.iter().map(|&area| f64::from(area)).sum();
        let mean = (whole / area.max(1e-12)) as f32;
        let none = Self { mean, first, ..Self::default() };
        let spot = |texel: usize| {
            let is_opaque = world.sides[texels.list[texel].triangle as usize].is_opaque;
            let (level, area) = (level(of_texel(texel)), areas[texel]);
            let is_bright = is_opaque && level > BRIGHT * mean && area > 0.0;
            is_bright.then_some(Spot { texel: texel as u32, power: level * area })
        };
        let mut spots: Vec<Spot> = (0..areas.len()).filter_map(spot).collect();
        let bright: f64 = spots.iter().map(|spot| f64::from(spot.power)).sum();
        if bright <= f64::from(LEAST_SHARE) * whole {
            return none;
        }
        let mut all = Self { of_texel: vec![NO_GROUP; areas.len()], ..none };
        let extent = extent(spots.iter().map(|spot| texels.list[spot.texel as usize].position));
        all.group(&mut spots, HALVINGS, &|spot, axis| {
            let Texel { position, normal, .. } = texels.list[spot.texel as usize];
            if axis < 3 { position[axis] } else { TURN * extent * normal[axis - 3] }
        });
        all.describe(texels);
        all
    }

    /// Halves bright texels so often by where they lie and where they face, and makes groups of what is left together.
    fn group(&mut self, spots: &mut [Spot], halvings: u32, along: &impl Fn(&Spot, usize) -> f32) {
        if halvings == 0 || spots.len() < 2 {
            return self.push(spots);
        }
        let spread = |axis: usize| {
            let range = spots.iter().map(|spot| along(spot, axis));
            range.clone().fold(f32::NEG_INFINITY, f32::max) - range.fold(f32::INFINITY, f32::min)
        };
        let axis = (0..6).max_by(|&a, &b| spread(a).total_cmp(&spread(b))).unwrap_or(0);
        let middle = spots.len() / 2;
        let order = |a: &Spot, b: &Spot| along(a, axis).total_cmp(&along(b, axis)).then(a.texel.cmp(&b.texel));
        spots.select_nth_unstable_by(middle, order);
        let (low, high) = spots.split_at_mut(middle);
        self.group(low, halvings - 1, along);
        self.group(high, halvings - 1, along);
    }

    /// Adds a group, whose members follow each other as texels do.
    fn push(&mut self, spots: &mut [Spot]) {
        spots.sort_unstable_by_key(|spot| spot.texel);
        let (number, mut power) = (self.groups.len() as u8, 0.0);
        for spot in spots {
            power += spot.power;
            self.members.push(Member { texel: spot.texel, power_end: power });
            self.of_texel[spot.texel as usize] = number;
        }
        self.groups.push(Group { power, end: self.members.len() as u32, ..Group::default() });
    }

    /// Finds out where groups are and where they face.
    fn describe(&mut self, texels: &Texels) {
        let mut first = 0;
        for group in &mut self.groups {
            let members =
                || self.members[first..group.end as usize].iter().map(|member| &texels.list[member.texel as usize]);
            let share = 1.0 / members().len() as f32;
            group.center = members().map(|texel| texel.position * share).sum();
            group.normal = members().map(|texel| texel.normal * share).sum();
            group.radius = members().map(|texel| texel.position.distance(group.center)).fold(0.0, f32::max);
            first = group.end as usize;
        }
    }

    /// Takes what is looked for away from the radiance of the cells and patches that hold it.
    pub fn take_from(&self, radiance: &mut [Vec3A], surfaces: &Surfaces) {
        self.add_to(radiance, -1.0, surfaces);
    }

    /// Undoes [`Reflectors::take_from`], but for rounding.
    pub fn give_back_to(&self, radiance: &mut [Vec3A], surfaces: &Surfaces) {
        self.add_to(radiance, 1.0, surfaces);
    }

    fn add_to(&self, radiance: &mut [Vec3A], sign: f32, surfaces: &Surfaces) {
        if self.members.is_empty() {
            return;
        }
        let sizes = [Size::Patch, Size::Four, Size::Two];
        let mut areas = vec![0.0; self.first as usize];
        for (texel, &area) in surfaces.texel_areas.iter().enumerate() {
            sizes.iter().for_each(|&size| areas[surfaces.column(texel as u32, size) as usize] += area);
        }
        for &Member { texel, .. } in &self.members {
            let power = radiance[self.column(texel) as usize] * surfaces.texel_areas[texel as usize];
            for size in sizes {
                let column = surfaces.column(texel, size) as usize;
                radiance[column] += power * (sign / areas[column]);
            }
        }
    }

    /// Whether a texel is bright.
    #[inline]
    pub fn holds(&self, texel: u32) -> bool {
        self.of_texel.get(texel as usize).is_some_and(|&group| group != NO_GROUP)
    }

    /// The column of a texel.
    #[inline]
    pub fn column(&self, texel: u32) -> u32 {
        self.first + texel
    }

    /// How a point with this normal chooses.
    pub fn chances(&self, point: Vec3, normal: Vec3) -> Chances {
        let mut sum = 0.0;
        let weights: Vec<f32> = self.groups.iter().map(|group| group.weight(point, normal)).collect();
        let ends: Vec<f32> = weights
            .iter()
            .map(|weight| {
                sum += weight;
                sum
            })
            .collect();
        if sum <= FAINT * self.mean {
            return Chances::default();
        }
        let densities = weights.iter().zip(&self.groups).map(|(weight, group)| weight / (sum * group.power)).collect();
        Chances { ends, densities }
    }

    /// The texel that belongs to a number in `[0, 1)`.
    pub fn choose(&self, chances: &Chances, number: f32) -> u32 {
        let last = chances.ends.len() - 1;
        let target = number * chances.ends[last];
        let group = chances.ends.partition_point(|&end| end <= target).min(last);
        let start = if group == 0 { 0.0 } else { chances.ends[group - 1] };
        let along = ((target - start) / (chances.ends[group] - start).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        let first = if group == 0 { 0 } else { self.groups[group - 1].end as usize };
        let Group { power, end, .. } = self.groups[group];
        let members = &self.members[first..end as usize];
        let chosen = members.partition_point(|member| member.power_end <= along * power).min(members.len() - 1);
        members[chosen].texel
    }

    /// The density with which points of a bright texel of this radiance are chosen, per square meter.
    #[inline]
    pub fn density(&self, chances: &Chances, texel: u32, radiance: Vec3A) -> f32 {
        let group = usize::from(self.of_texel[texel as usize]);
        chances.densities.get(group).map_or(0.0, |density| density * level(radiance))
    }
}

impl Chances {
    /// Whether nothing bright shines here.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }
}

impl Group {
    /// About the irradiance / pi that it gives, with nothing between.
    fn weight(&self, point: Vec3, normal: Vec3) -> f32 {
        let to_group = self.center - point;
        let reach = (to_group.length() + self.radius).max(1e-6);
        let cos = ((to_group.dot(normal) + self.radius) / reach).clamp(0.0, 1.0);
        let facing = (self.radius - to_group.dot(self.normal)) / reach + 1.0 - self.normal.length();
        let squared = to_group.length_squared().max(self.radius * self.radius).max(1e-9);
        self.power * cos * facing.clamp(0.0, 1.0) / (PI * squared)
    }
}

#[inline]
fn level(radiance: Vec3A) -> f32 {
    radiance.element_sum() * (1.0 / 3.0)
}

/// The diagonal of the box around some points.
fn extent(points: impl Iterator<Item = Vec3>) -> f32 {
    let start = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    let [low, high] = points.fold(start, |[low, high], point| [low.min(point), high.max(point)]);
    low.distance(high)
}
