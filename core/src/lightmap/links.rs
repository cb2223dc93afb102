//! Which neighboring texels light passes between: walls that stand on a surface part its texels.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use super::{CROSSED, Texel, Texels};
use crate::geometry::{Hit, Occluders, Ray};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::Tracer;

/// Right, down, left, up: steps in the image.
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];
/// A wall stands in the texel, or between it and one beside it.
const CUT: u8 = 1 << 4;
/// Where the distance to the next obstacle begins.
const FREE_SHIFT: u32 = 5;
/// The greatest such distance that is told apart.
const FAR: u8 = 7;
/// Texels of a chart that lie so many steps apart with something else between are near enough to be mixed up.
const GAP: i32 = 3;
/// How high a way over an obstacle may rise, as a share of its length: what is lower is no wall.
const STEP_HEIGHT: f32 = 0.25;

/// For each texel a byte: to which of its four neighbors light passes along the surface, whether it is cut, and how many
/// steps away the next obstacle is.
#[derive(Clone, Debug, Default)]
pub struct Links(Vec<u8>);

impl Links {
    /// Asks for each pair of valid neighbors in a chart whether a wall stands between them.
    pub(super) fn new<O: Occluders>(
        texels: &Texels,
        is_valid: &[bool],
        tracer: &Tracer<O>,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        let walls = Walls { texels, is_valid, tracer };
        let ahead =
            workers.map(is_valid.len(), 256, progress, |range| range.map(|texel| walls.ahead(texel)).collect())?;
        let bytes = workers
            .map(is_valid.len(), 1024, progress, |range| range.map(|texel| walls.around(texel, &ahead)).collect())?;
        let mut links = Self(bytes);
        links.measure(texels);
        progress.check()?;
        Ok(links)
    }

    /// Whether a wall stands in a texel, or between it and one beside it.
    #[inline]
    pub fn is_cut(&self, texel: u32) -> bool {
        self.0[texel as usize] & CUT != 0
    }

    /// Whether nothing parts the texels within so many steps of one, at most six.
    #[inline]
    pub fn is_clear(&self, texel: u32, steps: u32) -> bool {
        u32::from(self.0[texel as usize] >> FREE_SHIFT) > steps
    }

    /// Whether light passes from a texel to the next one right of it (0), below (1), left (2) or above (3).
    #[inline]
    pub fn is_open(&self, texel: u32, side: usize) -> bool {
        self.0[texel as usize] >> side & 1 == 1
    }

    /// Rings around what obstructs: each texel learns its distance.
    fn measure(&mut self, texels: &Texels) {
        let mut ring: Vec<u32> = (0..self.0.len() as u32).filter(|&texel| self.is_obstructed(texels, texel)).collect();
        let mut distances = vec![FAR; self.0.len()];
        ring.iter().for_each(|&texel| distances[texel as usize] = 0);
        for distance in 1..FAR {
            let mut next = Vec::new();
            for other in ring.iter().flat_map(|&texel| around(texels, texel)) {
                if distances[other as usize] == FAR {
                    distances[other as usize] = distance;
                    next.push(other);
                }
            }
            ring = next;
        }
        self.0.iter_mut().zip(distances).for_each(|(byte, distance)| *byte |= distance << FREE_SHIFT);
    }

    /// Whether something parts a texel from others of its chart that are near.
    fn is_obstructed(&self, texels: &Texels, texel: u32) -> bool {
        let Texel { pixel: [x, y], image, chart, .. } = texels.list[texel as usize];
        let again = |&[dx, dy]: &[i32; 2]| {
            let other = |k: i32| texels.at_pixel(u32::from(image), i32::from(x) + k * dx, i32::from(y) + k * dy);
            (1..=GAP).filter_map(other).any(|other| texels.list[other as usize].chart == chart)
        };
        STEPS.iter().enumerate().any(|(side, step)| !self.is_open(texel, side) && again(step))
    }
}

impl Texels {
    /// Whether one comes from a texel to another, so many columns and rows away, along both staircases between them and
    /// without passing a wall.
    pub fn is_connected(&self, texel: u32, columns: i32, rows: i32) -> bool {
        self.links.is_clear(texel, columns.unsigned_abs().max(rows.unsigned_abs()))
            || (self.walk(texel, [columns, rows], 0) && self.walk(texel, [columns, rows], 1))
    }

    /// Goes the steps along one axis of the image, then along the other.
    fn walk(&self, mut texel: u32, steps: [i32; 2], first: usize) -> bool {
        for axis in [first, 1 - first] {
            let side = if steps[axis] > 0 { axis } else { axis + 2 };
            for _ in 0..steps[axis].unsigned_abs() {
                if !self.links.is_open(texel, side) {
                    return false;
                }
                let Some(next) = self.beside(texel, side) else { return false };
                texel = next;
            }
        }
        true
    }

    /// The texel on a side of another: right, below, left, above.
    #[inline]
    pub fn beside(&self, texel: u32, side: usize) -> Option<u32> {
        let Texel { pixel: [x, y], image, .. } = self.list[texel as usize];
        let [dx, dy] = STEPS[side];
        self.at_pixel(u32::from(image), i32::from(x) + dx, i32::from(y) + dy)
    }

    /// The texel that stands for a hit on the front of a surface: usually that on which it falls; where a wall or a
    /// corner of something parts it from that texel's place, the nearest of the three next ones that is not parted.
    #[inline]
    pub fn seen<O: Occluders>(&self, tracer: &Tracer<O>, hit: &Hit, is_valid: impl Fn(u32) -> bool) -> Option<u32> {
        let own = self.at(hit)?;
        if is_valid(own) && !self.links.is_cut(own) { Some(own) } else { self.seen_beside(own, tracer, hit, is_valid) }
    }

    fn seen_beside<O: Occluders>(
        &self,
        own: u32,
        tracer: &Tracer<O>,
        hit: &Hit,
        is_valid: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let point = hit.interpolate(self.places[hit.triangle as usize].corners);
        let Texel { pixel: [x, y], image, chart, .. } = self.list[own as usize];
        let side = |along: f32| if along - crate::math::floor(along) < 0.5 { -1 } else { 1 };
        let (dx, dy) = (side(point.x), side(point.y));
        let place = Place::new(tracer, hit.triangle, hit.interpolate(tracer.world.corners[hit.triangle as usize]));
        [[0, 0], [dx, 0], [0, dy], [dx, dy]].into_iter().find_map(|[dx, dy]| {
            let other = self.at_pixel(u32::from(image), i32::from(x) + dx, i32::from(y) + dy)?;
            let texel = &self.list[other as usize];
            let fits = is_valid(other) && texel.chart == chart;
            (fits && is_open(tracer, &place, &Place::of(tracer, texel))).then_some(other)
        })
    }
}

/// A point just above a surface.
pub(super) struct Place {
    position: Vec3,
    /// Of the flat triangle.
    normal: Vec3,
}

impl Place {
    pub fn new<O: Occluders>(tracer: &Tracer<O>, triangle: u32, position: Vec3) -> Self {
        let normal = tracer.world.normals[triangle as usize];
        Self { position: position + normal * tracer.world.lift(triangle), normal }
    }

    pub fn of<O: Occluders>(tracer: &Tracer<O>, texel: &Texel) -> Self {
        Self::new(tracer, texel.triangle, texel.position)
    }
}

/// Whether one comes from one place to another near it along the surface: straight on, over the ridge between them
/// where the surface falls away on both sides, or over what is low.
pub(super) fn is_open<O: Occluders>(tracer: &Tracer<O>, from: &Place, to: &Place) -> bool {
    let way = to.position - from.position;
    let length = way.length();
    let ridge = (way.dot(to.normal)).max(-way.dot(from.normal));
    let over = |height: f32| {
        let middle = from.position + way * 0.5 + (from.normal + to.normal).normalize_or_zero() * height;
        is_free(tracer, from.position, middle) && is_free(tracer, middle, to.position)
    };
    let straight = if ridge <= 1e-3 * length { is_free(tracer, from.position, to.position) } else { over(0.6 * ridge) };
    straight || over(STEP_HEIGHT * length)
}

/// Whether nothing opaque stands between two points.
pub(super) fn is_free<O: Occluders>(tracer: &Tracer<O>, from: Vec3, to: Vec3) -> bool {
    tracer.count(1);
    from == to || tracer.visibility(&Ray { origin: from, direction: to - from, end: 1.0 }) > 0.0
}

/// The up to eight texels around one.
fn around(texels: &Texels, texel: u32) -> impl Iterator<Item = u32> + '_ {
    let Texel { pixel: [x, y], image, .. } = texels.list[texel as usize];
    (0..9)
        .filter(|&k| k != 4)
        .filter_map(move |k| texels.at_pixel(u32::from(image), i32::from(x) + k % 3 - 1, i32::from(y) + k / 3 - 1))
}

/// Looks for walls between texels.
struct Walls<'a, O> {
    texels: &'a Texels,
    is_valid: &'a [bool],
    tracer: &'a Tracer<'a, O>,
}

impl<O: Occluders> Walls<'_, O> {
    /// Bits 0 and 1: light passes to the right and down.
    fn ahead(&self, texel: usize) -> u8 {
        (0..2).map(|side| u8::from(self.passes(texel, side)) << side).sum()
    }

    fn passes(&self, texel: usize, side: usize) -> bool {
        let Some(next) = self.neighbor(texel, side) else { return false };
        let place = |texel: usize| Place::of(self.tracer, &self.texels.list[texel]);
        is_open(self.tracer, &place(texel), &place(next))
    }

    /// The valid neighbor of a valid texel in its chart.
    fn neighbor(&self, texel: usize, side: usize) -> Option<usize> {
        let next = self.texels.beside(texel as u32, side)? as usize;
        let are_valid = self.is_valid[texel] && self.is_valid[next];
        (are_valid && self.texels.list[next].chart == self.texels.list[texel].chart).then_some(next)
    }

    /// All four sides from what is known of the sides ahead; and whether a wall stands at one of them.
    fn around(&self, texel: usize, ahead: &[u8]) -> u8 {
        let is_crossed = self.texels.list[texel].quarters & CROSSED != 0;
        let mut byte = ahead[texel] | if is_crossed { CUT } else { 0 };
        for side in 0..4 {
            let Some(next) = self.neighbor(texel, side) else { continue };
            if side >= 2 {
                byte |= (ahead[next] >> (side - 2) & 1) << side;
            }
            if byte >> side & 1 == 0 {
                byte |= CUT;
            }
        }
        byte
    }
}
