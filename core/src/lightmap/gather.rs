//! Light that reaches a texel from all other surfaces: gathered at nodes, interpolated between them.

use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use super::{Reflectors, Texel, Texels};
use crate::geometry::{Hit, Occluders, Sobol, cosine_direction, hash};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::{Arrival, Contact, Keep, Row, Rows, Tracer};

/// How densely light is gathered, and with how many rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatherSettings {
    /// Rays of a node to begin with; the corners of wide cells get more, with their width.
    pub rays: u32,
    /// Most rays of a node.
    pub most_rays: u32,
    /// Cells are at most this share of the harmonic mean distance of what their corners see.
    pub spacing: f32,
    /// Cells whose corners differ by more than this share of their mean are split; infinite: none are for that.
    pub contrast: f32,
    /// When a node has rays enough.
    pub enough: Enough,
}

/// When a node has rays enough. Errors are standard errors after the filter, as shares of all light at a texel plus a
/// tenth of the mean light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Enough {
    /// When it has so many, whatever they saw.
    Rays(u32),
    /// When the error of its texel is no larger.
    Error(f32),
    /// When the root mean square of the errors of all texels is no larger, or that of its own.
    Rms(f32),
}

/// What a node saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gathered {
    /// Irradiance / pi.
    pub irradiance: Vec3,
    /// Variance of `irradiance`, mean over the channels, from two independent halves of the rays.
    pub variance: f32,
    /// Harmonic mean distance of what was seen, in meters.
    pub distance: f32,
    /// How many rays; 0: no node, the value is interpolated.
    pub rays: u32,
    /// Side in texels of the cell for which the node stands, or within whose corners the value is interpolated.
    pub width: u8,
}

impl Gathered {
    /// Takes in what more rays saw from the same place.
    fn merge(&mut self, more: &Self) {
        let all = (self.rays + more.rays) as f32;
        let (old, new) = (self.rays as f32 / all, more.rays as f32 / all);
        let before = if self.rays > 0 { old / self.distance } else { 0.0 };
        self.irradiance = self.irradiance * old + more.irradiance * new;
        self.variance = self.variance * (old * old) + more.variance * (new * new);
        self.distance = 1.0 / (before + new / more.distance);
        self.rays += more.rays;
        self.width = self.width.max(1);
    }
}

/// What was gathered.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nodes {
    /// For each texel.
    pub gathered: Vec<Gathered>,
    /// What texels see: all that are nodes where the transport is kept, else by their first rays those that touch
    /// something.
    pub rows: BTreeMap<u32, Row>,
    /// What the rows take, in bytes.
    pub bytes: usize,
}

impl Nodes {
    fn new(texels: usize) -> Self {
        Self { gathered: vec![Gathered::default(); texels], ..Self::default() }
    }

    /// Takes in what more rays from a texel saw, and their row if there is one; `room` is what rows may take, in bytes.
    fn merge(&mut self, texel: usize, more: &Gathered, row: Option<Row>, room: usize) {
        self.gathered[texel].merge(more);
        let Some(row) = row.filter(|row| self.bytes + row.bytes() <= room) else { return };
        self.bytes += row.bytes();
        let before = self.rows.entry(texel as u32).or_default();
        *before = before.merge(&row);
    }

    /// What each texel gathered, and which of them see what.
    pub fn split(self) -> (Vec<Gathered>, Vec<Contact>, Rows) {
        let (texels, rows): (Vec<u32>, Vec<Row>) = self.rows.into_iter().unzip();
        let numbered = texels.into_iter().zip(0..).map(|(texel, node)| Contact { texel, node });
        (self.gathered, numbered.collect(), rows.into())
    }
}

/// All that gathering needs to know.
pub struct Gather<'a, O, C> {
    /// The receivers.
    pub texels: &'a Texels,
    /// Which texels count.
    pub is_valid: &'a [bool],
    /// Sends the rays.
    pub tracer: &'a Tracer<'a, O>,
    /// What a ray in a direction sees: the nearest hit, or the sky.
    pub look: C,
    /// The radiance of each column, in cd/m2; that of cells and patches without what is looked for on purpose.
    pub radiance: &'a [Vec3A],
    /// The column of all that neither reflects nor emits.
    pub black: u32,
    /// What is looked for on purpose.
    pub reflectors: &'a Reflectors,
    /// Whether a texel that sees things at this harmonic mean distance, in meters, touches them.
    pub touches: &'a (dyn Fn(usize, f32) -> bool + Sync),
    /// Which nodes keep what they see: all, or those that touch something.
    pub keep: Keep,
    /// What is kept may take so many bytes.
    pub room: usize,
    /// How densely.
    pub settings: GatherSettings,
    /// Of all random decisions.
    pub seed: u32,
}

/// Texels that gather before what they saw is put to its place.
const BATCH: usize = 1 << 18;

/// Texels along the side of a tile that shares a sequence.
const TILE: u32 = 8;

impl<O: Occluders, C: Fn(Vec3, Option<&Hit>) -> Seen + Sync> Gather<'_, O, C> {
    /// Gathers at nodes and interpolates: one entry for each texel, zero for those that are not valid.
    ///
    /// `direct` is the direct light of each texel, mean over the channels: errors are seen against all light.
    pub fn run(&self, direct: &[f32], workers: &Workers, progress: &Progress) -> Result<Nodes, Cancelled> {
        let mut nodes = Nodes::new(self.texels.list.len());
        let cells = self.place(&mut nodes, workers, progress)?;
        self.refine(direct, &cells, &mut nodes, workers, progress)?;
        Ok(nodes)
    }

    /// Gathers with more rays at texels; `round` makes them other rays than before.
    pub(super) fn add(
        &self,
        wanted: Vec<(usize, u32)>,
        round: u32,
        nodes: &mut Nodes,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let seed = hash(self.seed, round);
        for (number, batch) in wanted.chunks(BATCH).enumerate() {
            progress.enter_part(number, wanted.len().div_ceil(BATCH));
            let found = workers.map(batch.len(), 16, progress, |range| {
                let node = |&(texel, rays): &(usize, u32)| self.node(texel, rays, seed, nodes);
                batch[range].iter().map(node).collect()
            })?;
            for (&(texel, _), (more, row)) in batch.iter().zip(found) {
                nodes.merge(texel, &more, row, self.room);
            }
        }
        Ok(())
    }

    /// Gathers at one texel. Two halves of the rays follow sequences of their own.
    ///
    /// The texels of a tile share a sequence and take one run of its points after the other: each run fills the
    /// hemisphere evenly, and so do all runs of neighbors together, which is what the filter mixes.
    fn node(&self, index: usize, rays: u32, seed: u32, known: &Nodes) -> (Gathered, Option<Row>) {
        let texel = &self.texels.list[index];
        let (tile, place) = self.place_in_tile(texel);
        let half = rays / 2;
        let station = self.station(texel, half);
        let seeds = [0, 1].map(|number| hash(hash(seed, number), tile));
        let mut ends: Vec<(Vec3, Option<Hit>)> = Vec::with_capacity(rays as usize);
        let mut ways: Vec<Way> = Vec::new();
        for seed in seeds {
            let sequence = Sobol::new(seed);
            ends.extend((place * half..(place + 1) * half).map(|k| {
                let direction = above(cosine_direction(sequence.square(k), texel.normal), station.flat);
                let ray = self.tracer.leave(texel.triangle, texel.position, station.flat, direction, f32::INFINITY);
                if self.tracer.is_plain {
                    return (direction, self.tracer.nearest(&ray, hash(seed, k)));
                }
                let arrival = self.tracer.follow(&ray, hash(seed, k));
                ways.push(Way { arrival, number: sequence.dimension(k, 3) });
                (direction, arrival.hit)
            }));
        }
        self.tracer.count(ends.len());
        // What is seen lies anywhere in memory: it is asked for at once, not between traversals.
        let last = |k: usize, first: Vec3| ways.get(k).map_or(first, |way| way.arrival.direction);
        let look = |(k, (first, hit)): (usize, &(Vec3, Option<Hit>))| (self.look)(last(k, *first), hit.as_ref());
        let seen: Vec<Seen> = ends.iter().enumerate().map(look).collect();
        let [a, b] = [0, 1].map(|number| {
            let own = number * half as usize..(number + 1) * half as usize;
            let met = own.map(|k| match ways.get(k) {
                None => self.met(&station, &ends[k], seen[k]),
                Some(way) => self.met_by_way(&station, &ends[k], seen[k], &way.arrival),
            });
            let met = met.sum::<Vec3A>() / half as f32;
            met + self.looked_for(&station, &Sobol::new(seeds[number]), place)
        });
        let nearness = |(_, hit): &(Vec3, Option<Hit>)| hit.map_or(0.0, |hit| 1.0 / hit.distance.max(1e-6));
        let inverse_distances: f32 = ends.iter().map(nearness).sum();
        let gathered = Gathered {
            irradiance: ((a + b) * 0.5).into(),
            variance: (a - b).length_squared() / 12.0,
            distance: ends.len() as f32 / f32::max(inverse_distances, 1e-9),
            rays,
            width: 0,
        };
        let keeps = self.keeps(index, gathered.distance, known);
        (gathered, keeps.then(|| Row::count(&mut self.columns(&seen, &ways))))
    }

    /// The columns on which rays end.
    fn columns(&self, seen: &[Seen], ways: &[Way]) -> Vec<u32> {
        if ways.is_empty() {
            return seen.iter().map(|seen| seen.column).collect();
        }
        let all = [self.radiance.len() as u32, self.black];
        let parts = |(seen, way): (&Seen, &Way)| way.arrival.columns(seen.column, all, way.number);
        seen.iter().zip(ways).flat_map(parts).collect()
    }

    /// Whether a texel keeps what these rays see.
    fn keeps(&self, index: usize, distance: f32, known: &Nodes) -> bool {
        match self.keep {
            Keep::Transport => true,
            Keep::Lightmaps => known.gathered[index].rays == 0 && (self.touches)(index, distance),
        }
    }

    /// The tile of a texel, and its place on a Z-curve through the tile.
    fn place_in_tile(&self, texel: &Texel) -> (u32, u32) {
        let [column, row] = texel.pixel.map(u32::from);
        let [width, _] = self.texels.sizes[usize::from(texel.image)];
        let tile = (row / TILE) * width.div_ceil(TILE) + column / TILE;
        let spread = |x: u32| (x & 1) | (x & 2) << 1 | (x & 4) << 2;
        (hash(tile, u32::from(texel.image)), spread(column % TILE) | spread(row % TILE) << 1)
    }
}

/// How a ray got there by way of mirrors and glass.
struct Way {
    arrival: Arrival,
    /// Decides how many of its parts keep a channel.
    number: f32,
}

/// What a ray sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// The column that stands for it.
    pub column: u32,
    /// The texel that was met, or [`NONE`](super::NONE).
    pub texel: u32,
}

/// A direction below the plane of a triangle, as smooth normals give it, mirrored to above.
#[inline]
fn above(direction: Vec3, flat: Vec3) -> Vec3 {
    let height = direction.dot(flat);
    if height < 0.0 { direction - flat * (2.0 * height) } else { direction }
}
