//! The part of a triangle inside one texel.

use glam::Vec2;

/// Area and centroid of the part of a triangle that lies inside the unit square, or nothing where there is none.
///
/// Sutherland and Hodgman 1974, one side of the square after the other.
pub fn clip_to_unit_square(triangle: [Vec2; 3]) -> Option<(f32, Vec2)> {
    let mut polygon = Polygon::default();
    triangle.into_iter().for_each(|corner| polygon.push(corner));
    for (axis, sign, limit) in [(0, 1.0, 0.0), (0, -1.0, -1.0), (1, 1.0, 0.0), (1, -1.0, -1.0)] {
        polygon = polygon.cut(|point| sign * point[axis] - limit);
    }
    polygon.area_and_centroid()
}

/// A convex polygon; each of the four cuts of a triangle adds at most one corner.
#[derive(Default)]
struct Polygon {
    corners: [Vec2; 8],
    count: usize,
}

impl Polygon {
    fn push(&mut self, corner: Vec2) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    fn cut(&self, height: impl Fn(Vec2) -> f32) -> Self {
        let mut kept = Self::default();
        for i in 0..self.count {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % self.count]);
            let (height_a, height_b) = (height(a), height(b));
            if height_a >= 0.0 {
                kept.push(a);
            }
            if (height_a >= 0.0) != (height_b >= 0.0) && kept.count < 8 {
                kept.push(a.lerp(b, height_a / (height_a - height_b)));
            }
        }
        kept
    }

    fn area_and_centroid(&self) -> Option<(f32, Vec2)> {
        let (mut doubled, mut moment) = (0.0, Vec2::ZERO);
        let origin = self.corners[0];
        for i in 2..self.count {
            let (a, b) = (self.corners[i - 1] - origin, self.corners[i] - origin);
            let cross = a.perp_dot(b);
            doubled += cross;
            moment += (a + b) * cross;
        }
        (doubled != 0.0).then(|| (0.5 * doubled.abs(), origin + moment / (3.0 * doubled)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_square() {
        let (area, centroid) = clip_to_unit_square([Vec2::ZERO, Vec2::new(9.0, 0.0), Vec2::new(9.0, 9.0)]).unwrap();
        assert!((area - 0.5).abs() < 1e-6);
        assert!(centroid.distance(Vec2::new(2.0 / 3.0, 1.0 / 3.0)) < 1e-6);
    }

    /// Texels share a triangle out without gap or overlap.
    #[test]
    fn areas_add_up() {
        let triangle = [Vec2::new(0.3, 0.7), Vec2::new(7.9, 2.2), Vec2::new(3.1, 6.6)];
        let whole = 0.5 * (triangle[1] - triangle[0]).perp_dot(triangle[2] - triangle[0]).abs();
        let texels = (0..64).map(|k| Vec2::new((k % 8) as f32, (k / 8) as f32));
        let sum: f32 = texels
            .filter_map(|texel| clip_to_unit_square(triangle.map(|corner| corner - texel)))
            .map(|(area, _)| area)
            .sum();
        assert!((sum - whole).abs() < 1e-4);
    }

    #[test]
    fn nothing_outside() {
        assert!(clip_to_unit_square([Vec2::splat(2.0), Vec2::new(3.0, 2.0), Vec2::splat(3.0)]).is_none());
    }
}
