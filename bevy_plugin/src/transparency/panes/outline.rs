//! What pieces cover of the picture.

use bevy::math::{Mat4, Vec2, Vec3};

/// Outlines that share less count as side by side, as a share of half the picture: pieces of one pane touch.
const TOUCH: f32 = 1e-5;

/// A convex polygon as a camera sees it; without corners where a part of it is behind the camera, and it may cover all.
pub struct Outline(Vec<Vec2>);

impl Outline {
    pub fn new(corners: &[Vec3], clip_from_world: &Mat4) -> Self {
        let clip = corners.iter().map(|corner| *clip_from_world * corner.extend(1.0));
        let seen = clip.map(|corner| (corner.w > 1e-6).then(|| corner.truncate().truncate() / corner.w));
        Self(seen.collect::<Option<_>>().unwrap_or_default())
    }

    /// Whether one covers a part of the other; they do not if an edge of one of them separates them.
    pub fn overlaps(&self, other: &Self) -> bool {
        let normals = [self, other].into_iter().flat_map(Self::normals);
        !normals.into_iter().any(|normal| {
            let ([low, high], [other_low, other_high]) = (self.extent(normal), other.extent(normal));
            high <= other_low + TOUCH || other_high <= low + TOUCH
        })
    }

    /// Of its edges that have a length.
    fn normals(&self) -> impl Iterator<Item = Vec2> {
        let next = self.0.iter().cycle().skip(1);
        self.0.iter().zip(next).filter_map(|(&a, &b)| (b - a).perp().try_normalize())
    }

    /// The smallest and the largest place along a direction.
    fn extent(&self, direction: Vec2) -> [f32; 2] {
        if self.0.is_empty() {
            return [f32::NEG_INFINITY, f32::INFINITY];
        }
        let places = || self.0.iter().map(|corner| corner.dot(direction));
        [places().fold(f32::INFINITY, f32::min), places().fold(f32::NEG_INFINITY, f32::max)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(corners: [[f32; 3]; 3]) -> Outline {
        Outline::new(&corners.map(Vec3::from), &Mat4::IDENTITY)
    }

    #[test]
    fn only_what_covers_overlaps() {
        let low = outline([[0.0, 0.0, 0.1], [1.0, 0.0, 0.1], [0.0, 1.0, 0.1]]);
        let high = outline([[1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.5]]);
        let both = outline([[0.4, 0.4, 0.9], [0.7, 0.4, 0.9], [0.4, 0.7, 0.9]]);
        assert!(!low.overlaps(&high) && !high.overlaps(&low), "they share an edge");
        assert!(low.overlaps(&both) && both.overlaps(&low) && high.overlaps(&both));
        let behind = Outline::new(&[Vec3::ZERO], &Mat4::ZERO);
        assert!(behind.overlaps(&low) && low.overlaps(&behind) && behind.overlaps(&behind), "it may cover anything");
    }
}
