//! Surfaces in pieces that bounce light: cells of texels, and clusters of triangles that have none.

use alloc::vec;
use alloc::vec::Vec;

use glam::{IVec3, Vec3};

use super::chart::groups;
use super::{BLOCK, NONE, Texels};
use crate::geometry::{Hit, Occluders, Sobol, normal_and_area};
use crate::math;
use crate::scene::World;
use crate::transport::Tracer;

/// One side of a piece of surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// In square meters.
    pub area: f32,
    /// 1 for the front of the surface, -1 for its back.
    pub side: f32,
    /// The members from this one...
    first: u32,
    /// ...to the one before this.
    end: u32,
}

/// A texel or a triangle of a patch, with the area of all members of the patch up to and with this one.
#[derive(Clone, Copy, Debug)]
struct Member {
    site: Site,
    area_end: f32,
}

/// Where on the surfaces a part of a patch lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Site {
    /// Index of a texel.
    Texel(u32),
    /// Index of a triangle of the world.
    Triangle(u32),
}

/// What the triangles of a cluster share: their surface, the axis they face, and a cell of space.
type ClusterKey = (u32, usize, [i32; 3]);

/// All patches of a bake.
#[derive(Clone, Debug, Default)]
pub struct Patches {
    /// The patches.
    pub list: Vec<Patch>,
    /// For each texel the patch of its front, or [`NONE`].
    pub of_texel: Vec<u32>,
    /// For each triangle without texels that blocks light the patch of its front, or [`NONE`].
    of_triangle: Vec<u32>,
    /// For each patch the patch of its other side, or [`NONE`].
    backs: Vec<u32>,
    members: Vec<Member>,
    /// The side of the cells in texels.
    pub cell: u32,
}

impl Patches {
    /// Cuts all surfaces into cells of at most 8 x 8 texels, smaller where that gives fewer than `wanted` patches.
    pub fn new(world: &World, texels: &Texels, is_valid: &[bool], texels_per_meter: f32, wanted: usize) -> Self {
        let mut cell = BLOCK;
        let mut cells = cells(texels, is_valid, cell);
        while cell > 1 && count_groups(&cells) < wanted {
            cell /= 2;
            cells = self::cells(texels, is_valid, cell);
        }
        let mut patches = Self {
            of_texel: vec![NONE; texels.list.len()],
            of_triangle: vec![NONE; world.corners.len()],
            cell,
            ..Self::default()
        };
        patches.add_cells(world, texels, &cells);
        patches.add_clusters(world, texels, cell as f32 / texels_per_meter);
        patches
    }

    /// The patch that a hit falls on, and its texel: none behind a one-sided surface, nor where the surface has no area.
    #[inline]
    pub fn at<O: Occluders>(&self, tracer: &Tracer<O>, texels: &Texels, hit: &Hit) -> Option<(u32, Option<u32>)> {
        if texels.images[hit.triangle as usize] == NONE {
            return self.side(tracer.world, hit, self.of_triangle[hit.triangle as usize]).map(|patch| (patch, None));
        }
        let texel = if hit.front {
            texels.seen(tracer, hit, |texel| self.of_texel[texel as usize] != NONE)?
        } else {
            texels.at(hit)?
        };
        self.side(tracer.world, hit, self.of_texel[texel as usize]).map(|patch| (patch, Some(texel)))
    }

    fn side(&self, world: &World, hit: &Hit, front: u32) -> Option<u32> {
        if front == NONE || hit.front {
            return (front != NONE).then_some(front);
        }
        let both = world.sides[hit.triangle as usize].both;
        (both && self.backs[front as usize] != NONE).then(|| self.backs[front as usize])
    }

    /// The texels or triangles of a patch, each with its area.
    pub fn sites(&self, patch: &Patch) -> impl Iterator<Item = (Site, f32)> + '_ {
        let mut before = 0.0;
        self.members[patch.first as usize..patch.end as usize].iter().map(move |member| {
            let area = member.area_end - before;
            before = member.area_end;
            (member.site, area)
        })
    }

    /// A triangle of a patch, a point on it and the normal of its side, for ray `index` of a sequence whose dimensions 2 and 3 are free.
    pub fn point(
        &self,
        world: &World,
        texels: &Texels,
        patch: &Patch,
        sequence: &Sobol,
        index: u32,
    ) -> (u32, Vec3, Vec3) {
        let members = &self.members[patch.first as usize..patch.end as usize];
        let target = sequence.dimension(index, 2) * patch.area;
        let chosen = members.partition_point(|member| member.area_end <= target).min(members.len() - 1);
        let (triangle, point, normal) = match members[chosen].site {
            Site::Texel(texel) => {
                let texel = &texels.list[texel as usize];
                (texel.triangle, texel.position, texel.normal)
            }
            Site::Triangle(triangle) => {
                let start = if chosen == 0 { 0.0 } else { members[chosen - 1].area_end };
                let along =
                    ((target - start) / (members[chosen].area_end - start).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
                let [a, b, c] = world.corners[triangle as usize];
                let (root, across) = (math::sqrt(along), sequence.dimension(index, 3));
                let point = a * (1.0 - root) + b * (root * (1.0 - across)) + c * (root * across);
                (triangle, point, world.normals[triangle as usize])
            }
        };
        (triangle, point, normal * patch.side)
    }

    fn add_cells(&mut self, world: &World, texels: &Texels, cells: &[(u64, u32)]) {
        for group in cells.chunk_by(|a, b| a.0 == b.0) {
            let sites = group.iter().map(|&(_, texel)| (Site::Texel(texel), texels.list[texel as usize].area));
            let triangle = texels.list[group[0].1 as usize].triangle;
            let patch = self.push(sites, world.sides[triangle as usize].both);
            group.iter().for_each(|&(_, texel)| self.of_texel[texel as usize] = patch);
        }
    }

    /// Triangles without texels that share a surface, a direction and a cell of space become one patch.
    fn add_clusters(&mut self, world: &World, texels: &Texels, size: f32) {
        let mut keys: Vec<(ClusterKey, u32)> = (0..world.blockers as u32)
            .filter(|&triangle| texels.images[triangle as usize] == NONE)
            .map(|triangle| {
                let normal = world.normals[triangle as usize];
                let axis = normal.abs().max_position();
                let facing = 2 * axis + usize::from(normal[axis] < 0.0);
                let [a, b, c] = world.corners[triangle as usize];
                let cell: IVec3 = ((a + b + c) / (3.0 * size)).floor().as_ivec3();
                ((world.sources[triangle as usize].surface, facing, cell.to_array()), triangle)
            })
            .collect();
        keys.sort_unstable();
        for group in keys.chunk_by(|a, b| a.0 == b.0) {
            let area = |triangle: u32| normal_and_area(&world.corners[triangle as usize]).map_or(0.0, |(_, area)| area);
            let sites = group.iter().map(|&(_, triangle)| (Site::Triangle(triangle), area(triangle)));
            let patch = self.push(sites, world.sides[group[0].1 as usize].both);
            group.iter().for_each(|&(_, triangle)| self.of_triangle[triangle as usize] = patch);
        }
    }

    /// Adds a patch, and one for its back if it has one, and returns the front.
    fn push(&mut self, sites: impl Iterator<Item = (Site, f32)>, both_sides: bool) -> u32 {
        let (front, first) = (self.list.len() as u32, self.members.len() as u32);
        let mut area = 0.0;
        for (site, site_area) in sites {
            area += site_area;
            self.members.push(Member { site, area_end: area });
        }
        let patch = Patch { area, side: 1.0, first, end: self.members.len() as u32 };
        self.list.push(patch);
        self.backs.push(if both_sides { front + 1 } else { NONE });
        if both_sides {
            self.list.push(Patch { side: -1.0, ..patch });
            self.backs.push(front);
        }
        front
    }
}

/// The valid texels with a key for the cell and chart of each, in the order of the keys.
fn cells(texels: &Texels, is_valid: &[bool], cell: u32) -> Vec<(u64, u32)> {
    let mut keys: Vec<(u64, u32)> = texels
        .list
        .iter()
        .enumerate()
        .filter(|&(index, texel)| is_valid[index] && texel.area > 0.0)
        .map(|(index, texel)| {
            let [column, row] = texel.pixel.map(|position| u64::from(position) / u64::from(cell));
            // A chart lies in one image, so that chart, row and column tell the cell.
            ((u64::from(texel.chart) << 30) | (row << 18) | (column << 6), index as u32)
        })
        .collect();
    keys.sort_unstable();
    keys.chunk_by_mut(|a, b| a.0 == b.0).for_each(|cell| part(texels, cell));
    keys
}

/// Gives the parts of a cell that walls part keys of their own: the lowest six bits number them.
fn part(texels: &Texels, cell: &mut [(u64, u32)]) {
    if cell.iter().all(|&(_, texel)| texels.links.is_clear(texel, 0)) {
        return;
    }
    let member = |texel: u32| cell.binary_search_by_key(&texel, |&(_, texel)| texel).ok();
    let ahead = |(place, side): (usize, usize)| {
        let texel = cell[place].1;
        let next = texels.beside(texel, side).filter(|_| texels.links.is_open(texel, side))?;
        member(next).map(|other| [place as u32, other as u32])
    };
    let pairs: Vec<[u32; 2]> = (0..cell.len()).flat_map(|place| [(place, 0), (place, 1)]).filter_map(ahead).collect();
    let parts = groups(cell.len(), &pairs);
    cell.iter_mut().zip(parts).for_each(|((key, _), part)| *key |= u64::from(part));
    cell.sort_unstable();
}

fn count_groups(cells: &[(u64, u32)]) -> usize {
    cells.chunk_by(|a, b| a.0 == b.0).count()
}
