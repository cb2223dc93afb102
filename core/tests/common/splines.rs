//! Random control points and knots, the same in each run.

use glam::DVec3;

/// Numbers that look random: SplitMix64.
pub struct Random(pub u64);

impl Random {
    /// In `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In `[low, high)`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// In `low..=high`.
    pub fn count(&mut self, low: usize, high: usize) -> usize {
        low + (self.unit() * (high - low + 1) as f64) as usize
    }

    /// In a cube of side 2 around the origin.
    pub fn point(&mut self) -> DVec3 {
        DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    pub fn points(&mut self, count: usize) -> Vec<DVec3> {
        (0..count).map(|_| self.point()).collect()
    }

    /// Knots of a curve with `count` control points, half of them clamped; some knots are multiple.
    pub fn knots(&mut self, degree: usize, count: usize) -> Vec<f64> {
        let mut inner: Vec<f64> = Vec::new();
        while inner.len() + degree + 1 < count {
            let knot = self.between(0.02, 0.98);
            let copies = if self.unit() < 0.3 { self.count(1, degree.max(1)) } else { 1 };
            let room = count - degree - 1 - inner.len();
            inner.extend(std::iter::repeat_n(knot, copies.min(room)));
        }
        inner.sort_by(f64::total_cmp);
        let is_clamped = self.unit() < 0.5;
        let step = |i: usize| if is_clamped { 0.0 } else { 0.1 * i as f64 };
        let before = (0..=degree).rev().map(|i| -step(i));
        let after = (0..=degree).map(|i| 1.0 + step(i));
        before.chain(inner).chain(after).collect()
    }
}
