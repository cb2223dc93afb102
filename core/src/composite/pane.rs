//! A flat pane of glass with a picture on it.

use glam::{Vec2, Vec3, Vec4};

use super::{PremultipliedRgba, Sprite};
use crate::geometry::Ray;

/// A parallelogram that shows a picture, from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlassPane<'a> {
    /// Where the upper left corner of the picture is.
    pub corner: Vec3,
    /// From there to the upper right one.
    pub across: Vec3,
    /// From there to the lower left one.
    pub down: Vec3,
    /// What is painted on it; where alpha is below one the glass lets light through.
    pub picture: Sprite<'a>,
}

impl GlassPane<'_> {
    /// Where a ray meets it, in multiples of the direction, and what it shows there.
    pub fn hit(&self, ray: &Ray) -> Option<(f32, PremultipliedRgba)> {
        let normal = self.across.cross(self.down);
        let place = normal.dot(self.corner - ray.origin) / normal.dot(ray.direction);
        if !(place > 0.0 && place <= ray.end) {
            return None;
        }
        let point = ray.origin + ray.direction * place - self.corner;
        let area = normal.length_squared();
        let uv = Vec2::new(point.cross(self.down).dot(normal), self.across.cross(point).dot(normal)) / area;
        let inside = uv.cmpge(Vec2::ZERO) & uv.cmple(Vec2::ONE);
        inside.all().then(|| (place, self.picture.at(uv)))
    }
}

impl Sprite<'_> {
    /// The color at a place in `[0, 1]`, `y` down: mixed from the four nearest pixels, premultiplied, so that transparent
    /// ones do not show.
    pub fn at(&self, uv: Vec2) -> PremultipliedRgba {
        let [width, height] = self.size();
        let most = Vec2::new(width as f32, height as f32) - 1.0;
        let place = (uv * (most + 1.0) - 0.5).clamp(Vec2::ZERO, most.max(Vec2::ZERO));
        let corner = place.floor();
        let share = place - corner;
        let next = (corner + 1.0).min(most);
        let pixel = |x: f32, y: f32| Vec4::from_array(self.pixel(x as usize, y as usize).to_array());
        let row = |y| pixel(corner.x, y).lerp(pixel(next.x, y), share.x);
        PremultipliedRgba::new(row(corner.y).lerp(row(next.y), share.y).to_array())
    }
}
