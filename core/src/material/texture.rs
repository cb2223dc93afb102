//! Pictures that a material looks up.

use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec2, Vec4};

use super::srgb_to_linear;

/// A picture and how it is read outside `0..1`. Row 0 is at the top, `v` points down.
#[derive(Clone, Debug)]
pub struct Texture {
    /// For messages.
    pub name: String,
    /// Texels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// `width x height` texels, row by row.
    pub texels: Texels,
    /// Outside `0..1` in `u`.
    pub wrap_u: Wrap,
    /// Outside `0..1` in `v`.
    pub wrap_v: Wrap,
    /// Between the centers of texels.
    pub filter: Filter,
}

/// How a texture is read between the centers of its texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The four texels around are mixed.
    #[default]
    Linear,
    /// The nearest texel counts.
    Nearest,
}

/// The texels of a texture. Alpha is linear always.
#[derive(Clone, Debug)]
pub enum Texels {
    /// sRGB, as colors are stored.
    Srgb8(Vec<[u8; 4]>),
    /// Linear, as masks are stored.
    Linear8(Vec<[u8; 4]>),
    /// Linear, with any range.
    Linear32(Vec<[f32; 4]>),
}

/// How a texture goes on outside `0..1`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// It repeats.
    #[default]
    Repeat,
    /// Every second copy is mirrored.
    Mirror,
    /// The border goes on.
    Clamp,
}

impl Texture {
    /// Linear RGBA at `uv`; infinity counts as 0.
    ///
    /// Colors are decoded before they are mixed. A texture without texels is white.
    pub fn sample(&self, uv: Vec2) -> Vec4 {
        let size = Vec2::new(self.width as f32, self.height as f32);
        let inside = Vec2::new(self.wrap_u.into_unit(uv.x), self.wrap_v.into_unit(uv.y));
        if self.filter == Filter::Nearest {
            let texel = inside * size;
            return self.texel(texel.x as i32, texel.y as i32);
        }
        let position = inside * size - 0.5;
        let corner = position.floor();
        let share = position - corner;
        let (left, top) = (corner.x as i32, corner.y as i32);
        let row = |y| self.texel(left, y).lerp(self.texel(left + 1, y), share.x);
        row(top).lerp(row(top + 1), share.y)
    }

    /// Linear RGBA of a texel that may lie one beyond the border.
    fn texel(&self, x: i32, y: i32) -> Vec4 {
        let column = self.wrap_u.neighbor(x, self.width);
        let row = self.wrap_v.neighbor(y, self.height);
        let index = row as usize * self.width as usize + column as usize;
        self.texels.get(index).unwrap_or(Vec4::ONE)
    }
}

impl Texels {
    /// Linear RGBA of one texel, if there is one.
    fn get(&self, index: usize) -> Option<Vec4> {
        match self {
            Self::Srgb8(texels) => texels.get(index).map(|&[r, g, b, a]| {
                Vec4::new(srgb_to_linear(r), srgb_to_linear(g), srgb_to_linear(b), f32::from(a) / 255.0)
            }),
            Self::Linear8(texels) => texels.get(index).map(|texel| Vec4::from(texel.map(f32::from)) / 255.0),
            Self::Linear32(texels) => texels.get(index).copied().map(Vec4::from),
        }
    }
}

impl Wrap {
    /// The coordinate in `[0, 1]` that shows the same.
    fn into_unit(self, coordinate: f32) -> f32 {
        if !coordinate.is_finite() {
            return 0.0;
        }
        match self {
            Self::Repeat => fract(coordinate),
            Self::Mirror => {
                let in_pair = 2.0 * fract(0.5 * coordinate);
                if in_pair > 1.0 { 2.0 - in_pair } else { in_pair }
            }
            Self::Clamp => coordinate.clamp(0.0, 1.0),
        }
    }

    /// The texel that stands at `index`, which is at most one beyond the `size` texels.
    fn neighbor(self, index: i32, size: u32) -> u32 {
        let last = size.saturating_sub(1);
        match self {
            Self::Repeat if index < 0 => last,
            Self::Repeat if index as u32 > last => 0,
            _ => (index.max(0) as u32).min(last),
        }
    }
}

/// The part after the point, counted upwards from the next integer below.
fn fract(x: f32) -> f32 {
    Vec2::splat(x).fract_gl().x
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    fn row(wrap: Wrap, texels: Vec<[f32; 4]>) -> Texture {
        let width = texels.len() as u32;
        let texels = Texels::Linear32(texels);
        Texture { name: String::new(), width, height: 1, texels, wrap_u: wrap, wrap_v: wrap, filter: Filter::Linear }
    }

    fn grays(wrap: Wrap) -> Texture {
        row(wrap, vec![[0.0; 4], [1.0; 4], [4.0; 4], [9.0; 4]])
    }

    fn at(texture: &Texture, u: f32) -> f32 {
        texture.sample(Vec2::new(u, 0.5)).x
    }

    /// Centers give the texels themselves, the middle between two centers their mean, in every mode.
    #[test]
    fn bilinear_between_centers() {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let texture = grays(wrap);
            for (i, expected) in [0.0, 1.0, 4.0, 9.0].into_iter().enumerate() {
                assert_eq!(at(&texture, (i as f32 + 0.5) / 4.0), expected);
            }
            assert_eq!(at(&texture, 0.25), 0.5);
            assert_eq!(at(&texture, 0.75), 6.5);
        }
    }

    /// At the border, halfway between the last texel and what follows it.
    #[test]
    fn borders() {
        assert_eq!(at(&grays(Wrap::Repeat), 0.0), 4.5);
        assert_eq!(at(&grays(Wrap::Repeat), 1.0), 4.5);
        for wrap in [Wrap::Mirror, Wrap::Clamp] {
            assert_eq!(at(&grays(wrap), 0.0), 0.0);
            assert_eq!(at(&grays(wrap), 1.0), 9.0);
        }
    }

    /// Repeat has period 1, mirror is even with period 2, clamp is constant outside.
    #[test]
    fn wrap_modes_go_on_as_their_names_say() {
        for i in -64..64 {
            let u = i as f32 / 64.0;
            assert_eq!(at(&grays(Wrap::Repeat), u), at(&grays(Wrap::Repeat), u + 3.0));
            assert_eq!(at(&grays(Wrap::Mirror), u), at(&grays(Wrap::Mirror), -u));
            assert_eq!(at(&grays(Wrap::Mirror), u), at(&grays(Wrap::Mirror), u + 2.0));
            assert_eq!(at(&grays(Wrap::Clamp), u.abs() + 1.0), 9.0);
            assert_eq!(at(&grays(Wrap::Clamp), -u.abs()), 0.0);
        }
    }

    /// Rows run downwards, and each direction has its own mode.
    #[test]
    fn rows_run_down() {
        let texels = Texels::Linear8(vec![[0; 4], [255; 4]]);
        let texture = Texture {
            name: String::new(),
            width: 1,
            height: 2,
            texels,
            wrap_u: Wrap::Repeat,
            wrap_v: Wrap::Clamp,
            filter: Filter::Linear,
        };
        assert_eq!(texture.sample(Vec2::new(0.3, 0.0)), Vec4::ZERO);
        assert_eq!(texture.sample(Vec2::new(-7.3, 0.5)), Vec4::splat(0.5));
        assert_eq!(texture.sample(Vec2::new(0.3, 1.0)), Vec4::ONE);
    }

    /// sRGB holds for colors and not for alpha.
    #[test]
    fn colors_are_decoded_and_alpha_is_not() {
        let mut texture = grays(Wrap::Repeat);
        texture.width = 1;
        texture.texels = Texels::Srgb8(vec![[188, 0, 255, 51]]);
        let texel = texture.sample(Vec2::splat(0.5));
        assert!((texel - Vec4::new(0.502_886_5, 0.0, 1.0, 0.2)).abs().max_element() < 1e-6, "{texel}");
    }

    /// Broken coordinates and broken textures give something and no panic.
    #[test]
    fn nothing_panics() {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let texture = grays(wrap);
            let zero = texture.sample(Vec2::ZERO);
            for broken in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                assert_eq!(texture.sample(Vec2::splat(broken)), zero);
            }
            for huge in [f32::MAX, f32::MIN, 1e30, -1e30, f32::MIN_POSITIVE, -f32::MIN_POSITIVE] {
                assert!(texture.sample(Vec2::splat(huge)).is_finite());
            }
            assert_eq!(row(wrap, vec![]).sample(Vec2::splat(0.7)), Vec4::ONE);
        }
    }

    /// Without a filter a texel is one color up to its border.
    #[test]
    fn nearest_texels_do_not_mix() {
        let texels = Texels::Linear8(vec![[255; 4], [0; 4]]);
        let wrap = Wrap::Repeat;
        let texture = Texture {
            name: String::new(),
            width: 2,
            height: 1,
            texels,
            wrap_u: wrap,
            wrap_v: wrap,
            filter: Filter::Nearest,
        };
        for (u, expected) in [(0.01, 1.0), (0.49, 1.0), (0.51, 0.0), (0.99, 0.0), (1.01, 1.0)] {
            assert_eq!(texture.sample(Vec2::new(u, 0.5)).x, expected, "at {u}");
        }
    }
}
