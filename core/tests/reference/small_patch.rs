//! Polygons as small patches, for the point formula.

use glam::DVec3;
use radiosity::form_factor::SmallPatch;

/// Centroid, normal, radius and area of a convex polygon.
pub fn small_patch(polygon: &[DVec3]) -> SmallPatch<DVec3> {
    let (mut center, mut vector, mut area) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for k in 2..polygon.len() {
        let [a, b, c] = [polygon[0], polygon[k - 1], polygon[k]];
        let part = 0.5 * (b - a).cross(c - a);
        center += part.length() * (a + b + c) / 3.0;
        vector += part;
        area += part.length();
    }
    center /= area;
    let radius = polygon.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
    SmallPatch { center, normal: vector.normalize(), radius, area }
}
