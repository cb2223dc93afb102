//! Surfaces in pieces that bounce light: cells of texels, and clusters of triangles that have none.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use glam::{IVec3, Vec3};

use super::chart::groups;
use super::{BLOCK, NONE, PatchMap, Texels};
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
    /// Which list its members are in...
    kind: Kind,
    /// ...from this one...
    first: u32,
    /// ...to the one before this.
    end: u32,
}

/// What a patch consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Texels,
    Triangles,
}

/// A texel or a triangle of a patch, with the area of all members of the patch up to and with this one.
#[derive(Clone, Copy, Debug)]
struct Member {
    index: u32,
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

/// All patches of a bake. Of those made of texels, the members are known while the texels of their images are here.
#[derive(Clone, Debug, Default)]
pub struct Patches {
    /// The patches.
    pub list: Vec<Patch>,
    /// For each texel that is here the patch of its front, or [`NONE`].
    pub of_texel: Vec<u32>,
    /// For each triangle without texels that blocks light the patch of its front, or [`NONE`].
    of_triangle: Vec<u32>,
    /// For each patch the patch of its other side, or [`NONE`].
    backs: Vec<u32>,
    /// Texels of the patches whose texels are here.
    texels: Vec<Member>,
    triangles: Vec<Member>,
    /// For each image the patches of its texels, where not all images are here at once.
    maps: Vec<PatchMap>,
    /// The side of the cells in texels.
    pub cell: u32,
}

impl Patches {
    /// None yet, for a world and so many images.
    pub fn new(world: &World, images: usize) -> Self {
        Self {
            of_triangle: vec![NONE; world.corners.len()],
            maps: vec![PatchMap::default(); images],
            cell: BLOCK,
            ..Self::default()
        }
    }

    /// Cuts the texels that are here into cells of at most `widest` x `widest`, smaller where that gives fewer than
    /// `wanted` patches; returns the new patches.
    pub fn add_texels(
        &mut self,
        world: &World,
        texels: &Texels,
        is_valid: &[bool],
        widest: u32,
        wanted: usize,
    ) -> Range<usize> {
        let first = self.list.len();
        self.cell = widest;
        let mut cells = cells(texels, is_valid, self.cell);
        while self.cell > 1 && count_groups(&cells) < wanted {
            self.cell /= 2;
            cells = self::cells(texels, is_valid, self.cell);
        }
        self.of_texel = vec![NONE; texels.list.len()];
        for group in cells.chunk_by(|a, b| a.0 == b.0) {
            let triangle = texels.list[group[0].1 as usize].triangle;
            let patch = self.push(Kind::Texels, 0.0, 0..0, world.sides[triangle as usize].both);
            group.iter().for_each(|&(_, texel)| self.of_texel[texel as usize] = patch);
        }
        if texels.here.len() < self.maps.len() {
            // There will be others.
            texels.here.clone().for_each(|image| self.maps[image] = PatchMap::new(texels, image, &self.of_texel));
        }
        let patches = first..self.list.len();
        self.list_texels(texels, patches.clone());
        patches
    }

    /// Finds the members of a range of patches again, whose texels are here.
    pub fn turn_to(&mut self, texels: &Texels, patches: Range<usize>) {
        let of_texel = |texel: &super::Texel| {
            let [x, y] = texel.pixel.map(usize::from);
            self.maps[usize::from(texel.image)].at(x, y)
        };
        self.of_texel = texels.list.iter().map(of_texel).collect();
        self.list_texels(texels, patches);
    }

    /// The patch that a hit falls on, and its texel if that is here: none behind a one-sided surface, nor where the
    /// surface has no area.
    #[inline]
    pub fn at<O: Occluders>(&self, tracer: &Tracer<O>, texels: &Texels, hit: &Hit) -> Option<(u32, Option<u32>)> {
        let Some((image, [x, y])) = texels.place(hit) else {
            return self.side(tracer.world, hit, self.of_triangle[hit.triangle as usize]).map(|patch| (patch, None));
        };
        if !texels.here.contains(&(image as usize)) {
            let patch = self.maps[image as usize].at(x.max(0) as usize, y.max(0) as usize);
            return self.side(tracer.world, hit, patch).map(|patch| (patch, None));
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
        let (mut before, kind) = (0.0, patch.kind);
        self.members(patch).iter().map(move |member| {
            let area = member.area_end - before;
            before = member.area_end;
            (kind.site(member.index), area)
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
        let members = self.members(patch);
        let target = sequence.dimension(index, 2) * patch.area;
        let chosen = members.partition_point(|member| member.area_end <= target).min(members.len() - 1);
        let (triangle, point, normal) = match patch.kind.site(members[chosen].index) {
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

    /// Triangles without texels that share a surface, a direction and a cell of space of this size in meters become one
    /// patch; returns the new patches.
    pub fn add_triangles(&mut self, world: &World, texels: &Texels, size: f32) -> Range<usize> {
        let before = self.list.len();
        let mut keys: Vec<(ClusterKey, u32)> = (0..world.blockers as u32)
            .filter(|&triangle| texels.places[triangle as usize].image == NONE)
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
            let (first, mut area) = (self.triangles.len() as u32, 0.0);
            for &(_, triangle) in group {
                area += normal_and_area(&world.corners[triangle as usize]).map_or(0.0, |(_, area)| area);
                self.triangles.push(Member { index: triangle, area_end: area });
            }
            let members = first..self.triangles.len() as u32;
            let patch = self.push(Kind::Triangles, area, members, world.sides[group[0].1 as usize].both);
            group.iter().for_each(|&(_, triangle)| self.of_triangle[triangle as usize] = patch);
        }
        before..self.list.len()
    }

    fn members(&self, patch: &Patch) -> &[Member] {
        let list = match patch.kind {
            Kind::Texels => &self.texels,
            Kind::Triangles => &self.triangles,
        };
        &list[patch.first as usize..patch.end as usize]
    }

    /// Adds a patch, and one for its back if it has one, and returns the front.
    fn push(&mut self, kind: Kind, area: f32, members: Range<u32>, both_sides: bool) -> u32 {
        let front = self.list.len() as u32;
        let patch = Patch { area, side: 1.0, kind, first: members.start, end: members.end };
        self.list.push(patch);
        self.backs.push(if both_sides { front + 1 } else { NONE });
        if both_sides {
            self.list.push(Patch { side: -1.0, ..patch });
            self.backs.push(front);
        }
        front
    }

    /// Lists the texels that are here by their patches, which are these.
    fn list_texels(&mut self, texels: &Texels, patches: Range<usize>) {
        let mut ends = vec![0_u32; patches.len() + 1];
        let place = |patch: u32| patch as usize - patches.start;
        self.of_texel.iter().filter(|&&patch| patch != NONE).for_each(|&patch| ends[place(patch) + 1] += 1);
        (1..ends.len()).for_each(|k| ends[k] += ends[k - 1]);
        self.texels = vec![Member { index: NONE, area_end: 0.0 }; ends.last().map_or(0, |&count| count as usize)];
        for patch in &mut self.list[patches.clone()] {
            (patch.area, patch.kind) = (0.0, Kind::Texels);
        }
        // Each entry moves from where its patch begins to where it ends.
        for (index, &patch) in self.of_texel.iter().enumerate().filter(|&(_, &patch)| patch != NONE) {
            let (own, end) = (&mut self.list[patch as usize], &mut ends[place(patch)]);
            own.area += texels.list[index].area;
            self.texels[*end as usize] = Member { index: index as u32, area_end: own.area };
            *end += 1;
        }
        let mut first = 0;
        for index in patches.clone() {
            let end = ends[index - patches.start];
            if self.list[index].side < 0.0 {
                // It has no texels of its own: those of its front are its members.
                self.list[index] = Patch { side: -1.0, ..self.list[index - 1] };
            } else {
                (self.list[index].first, self.list[index].end) = (first, end);
            }
            first = end;
        }
    }
}

impl Kind {
    fn site(self, index: u32) -> Site {
        match self {
            Self::Texels => Site::Texel(index),
            Self::Triangles => Site::Triangle(index),
        }
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

/// The number that the last parts of a cell share.
const MOST_PARTS: u32 = 63;

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
    cell.iter_mut().zip(parts).for_each(|((key, _), part)| *key |= u64::from(part.min(MOST_PARTS)));
    cell.sort_unstable();
}

fn count_groups(cells: &[(u64, u32)]) -> usize {
    cells.chunk_by(|a, b| a.0 == b.0).count()
}
