//! Whether triangles in the plane overlap, by exact rasterization on a fine grid.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec2;

/// Steps of the fixed-point coordinates within a sample of the grid.
const STEPS: i64 = 256;

/// A place in `0..1` where triangles with corners in `0..1` overlap, if there is one.
///
/// The grid has 1024 to 4096 samples a side. Coordinates are rounded to 1/256 of its spacing and edges belong to one of
/// the two triangles that share them, so that neighbors never overlap however many there are. Overlaps count from
/// 2 x 2 samples on, thinner ones when they take up a hundredth of the whole: rounding of coordinates is no overlap.
pub(super) fn find_overlap(triangles: &[[Vec2; 3]]) -> Option<Vec2> {
    let mut grid = Grid::new(side_for(triangles.len()));
    for triangle in triangles {
        grid.draw(triangle.map(|corner| grid.fixed_point(corner)));
    }
    grid.overlap()
}

/// About 64 samples for each triangle.
fn side_for(triangles: usize) -> usize {
    let mut side = 1024;
    while side < 4096 && side * side < 64 * triangles {
        side *= 2;
    }
    side
}

/// One bit for each sample that is covered, one for each that is covered twice.
struct Grid {
    side: usize,
    words: usize,
    once: Vec<u64>,
    twice: Vec<u64>,
}

impl Grid {
    fn new(side: usize) -> Self {
        let words = side / 64;
        Self { side, words, once: vec![0; words * side], twice: vec![0; words * side] }
    }

    fn fixed_point(&self, point: Vec2) -> [i64; 2] {
        let scaled = (point.clamp(Vec2::ZERO, Vec2::ONE) * (self.side as i64 * STEPS) as f32).round();
        [scaled.x as i64, scaled.y as i64]
    }

    /// Covers the samples whose centers lie inside, or on an edge that belongs to the triangle.
    fn draw(&mut self, [a, b, c]: [[i64; 2]; 3]) {
        let doubled_area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let corners = if doubled_area > 0 { [a, b, c] } else { [a, c, b] };
        let low = a[1].min(b[1]).min(c[1]).div_euclid(STEPS).max(0);
        let high = a[1].max(b[1]).max(c[1]).div_euclid(STEPS).min(self.side as i64 - 1);
        for row in low..=high {
            let (first, last) = span(&corners, row, self.side as i64);
            if doubled_area != 0 && first <= last {
                self.cover(row as usize, first as usize, last as usize);
            }
        }
    }

    fn cover(&mut self, row: usize, first: usize, last: usize) {
        for word in first / 64..=last / 64 {
            let mut mask = u64::MAX;
            if word == first / 64 {
                mask &= u64::MAX << (first % 64);
            }
            if word == last / 64 {
                mask &= u64::MAX >> (63 - last % 64);
            }
            let index = row * self.words + word;
            self.twice[index] |= self.once[index] & mask;
            self.once[index] |= mask;
        }
    }

    fn overlap(&self) -> Option<Vec2> {
        let count = |bits: &[u64]| bits.iter().map(|word| u64::from(word.count_ones())).sum::<u64>();
        let many = count(&self.twice) * 100 > count(&self.once);
        (0..self.twice.len()).find_map(|index| {
            let found = if many { self.twice[index] } else { self.squares(index) };
            (found != 0).then(|| {
                let column = index % self.words * 64 + found.trailing_zeros() as usize;
                Vec2::new(column as f32 + 0.5, (index / self.words) as f32 + 0.5) / self.side as f32
            })
        })
    }

    /// The samples of a word that start a square of 2 x 2 samples covered twice.
    fn squares(&self, index: usize) -> u64 {
        let both = |index: usize| self.twice[index] & self.twice.get(index + self.words).copied().unwrap_or(0);
        let next = if (index + 1).is_multiple_of(self.words) { 0 } else { both(index + 1) };
        let here = both(index);
        here & (here >> 1 | next << 63)
    }
}

/// First and last sample of a row inside the triangle, whose corners run counter-clockwise; none if first > last.
fn span(corners: &[[i64; 2]; 3], row: i64, side: i64) -> (i64, i64) {
    let y = row * STEPS + STEPS / 2;
    let (mut first, mut last) = (0, side - 1);
    for i in 0..3 {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        // An edge and its reverse: one of them owns the points on it.
        let owned = dy < 0 || (dy == 0 && dx > 0);
        // Inside: dx (y - from.y) - dy (x - from.x) >= 0, with x = STEPS column + STEPS / 2.
        let constant = dx * (y - from[1]) - dy * (STEPS / 2 - from[0]) - i64::from(!owned);
        let slope = -dy * STEPS;
        match slope {
            1.. => first = first.max((-constant).div_euclid(slope) + i64::from((-constant).rem_euclid(slope) != 0)),
            0 if constant < 0 => last = -1,
            0 => {}
            _ => last = last.min(constant.div_euclid(-slope)),
        }
    }
    (first, last)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(min: Vec2, max: Vec2) -> [[Vec2; 3]; 2] {
        let (a, b, c, d) = (min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y));
        [[a, b, c], [a, c, d]]
    }

    /// A fan of thin triangles and its mirror image side by side share edges only.
    #[test]
    fn shared_edges_are_no_overlap() {
        let center = Vec2::new(0.25, 0.5);
        let rim = |i: usize| center + Vec2::from_angle(i as f32 * core::f32::consts::TAU / 5000.0) * 0.249;
        let mut triangles: Vec<[Vec2; 3]> = (0..5000).map(|i| [center, rim(i), rim((i + 1) % 5000)]).collect();
        let mirrored: Vec<_> = triangles.iter().map(|t| t.map(|p| Vec2::new(1.0 - p.x, p.y))).collect();
        triangles.extend(mirrored);
        assert_eq!(find_overlap(&triangles), None);
    }

    /// Two quads whose common border differs by rounding touch; shifted by a hundredth they overlap.
    #[test]
    fn rounding_is_no_overlap() {
        for (shift, overlaps) in [(0.0, false), (1e-6, false), (0.01, true)] {
            let triangles = [quad(Vec2::ZERO, Vec2::new(0.3 + shift, 1.0)), quad(Vec2::new(0.3, 0.0), Vec2::ONE)];
            assert_eq!(find_overlap(triangles.as_flattened()).is_some(), overlaps, "{shift}");
        }
    }

    /// The place that is named lies in both triangles, also where a small chart lies on a large one.
    #[test]
    fn names_the_place() {
        let triangles = [quad(Vec2::ZERO, Vec2::ONE), quad(Vec2::splat(0.7), Vec2::new(0.72, 0.71))];
        let place = find_overlap(triangles.as_flattened()).unwrap();
        assert!(place.cmpge(Vec2::splat(0.7)).all() && place.cmple(Vec2::new(0.72, 0.71)).all(), "{place}");
    }
}
