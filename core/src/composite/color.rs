//! Colors with alpha, straight and premultiplied, as numbers of 32 bits or packed into 8 or 16 bits a channel.

use core::fmt::Debug;

use glam::{Vec3, Vec4};

use crate::math;
use crate::spectrum::{linear_to_srgb, srgb_to_linear};

/// How one of the four numbers of a color is stored: `f32`, or `u8` and `u16` as shares of 255 and 65535.
pub trait Channel: Copy + Debug + Default + PartialEq + PartialOrd + Send + Sync + 'static {
    /// 0
    const ZERO: Self;
    /// 1: all light is blocked.
    const ONE: Self;

    /// The nearest number that can be stored.
    fn from_f32(value: f32) -> Self;
    /// The stored number; alpha lies in `[0, 1]`.
    fn to_f32(self) -> f32;
    /// `1 - self`
    fn rest(self) -> Self;
    /// `self * a + other * b`, rounded once, at most 1 where packed.
    fn mix(self, a: Self, other: Self, b: Self) -> Self;
    /// A premultiplied color that keeps its promise: alpha in `[0, 1]`, and where packed no channel above alpha.
    fn sound(rgba: [Self; 4]) -> [Self; 4];
    /// `front + (1 - alpha of front) * back`, each channel rounded once.
    fn over(front: [Self; 4], back: [Self; 4]) -> [Self; 4];
}

impl Channel for f32 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;

    #[inline(always)]
    fn from_f32(value: f32) -> Self {
        value
    }
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self
    }
    #[inline(always)]
    fn rest(self) -> Self {
        1.0 - self
    }
    #[inline(always)]
    fn mix(self, a: Self, other: Self, b: Self) -> Self {
        self * a + other * b
    }
    #[inline(always)]
    fn sound([r, g, b, alpha]: [Self; 4]) -> [Self; 4] {
        // What is no number is not above 0 either.
        [r, g, b, if alpha > 0.0 { alpha.min(1.0) } else { 0.0 }]
    }
    #[inline(always)]
    fn over(front: [Self; 4], back: [Self; 4]) -> [Self; 4] {
        (Vec4::from_array(front) + (1.0 - front[3]) * Vec4::from_array(back)).to_array()
    }
}

impl Channel for u8 {
    const ZERO: Self = 0;
    const ONE: Self = 255;

    #[inline]
    fn from_f32(value: f32) -> Self {
        math::round(value * 255.0) as Self
    }
    #[inline]
    fn to_f32(self) -> f32 {
        f32::from(self) / 255.0
    }
    #[inline]
    fn rest(self) -> Self {
        255 - self
    }
    #[inline]
    fn mix(self, a: Self, other: Self, b: Self) -> Self {
        let sum = u32::from(self) * u32::from(a) + u32::from(other) * u32::from(b);
        ((sum + 127) / 255).min(255) as Self
    }
    #[inline]
    fn sound([r, g, b, alpha]: [Self; 4]) -> [Self; 4] {
        [r.min(alpha), g.min(alpha), b.min(alpha), alpha]
    }
    /// All four at once, two by two in the halves of a word: `x / 255` to the nearest is `(y + y / 256) / 256` with
    /// `y = x + 128`, exactly, for all products of two bytes (Blinn, "Three Wrongs Make a Right", 1995).
    #[inline(always)]
    fn over(front: [Self; 4], back: [Self; 4]) -> [Self; 4] {
        const EVEN: u32 = 0x00ff_00ff;
        let (front, back) = (u32::from_le_bytes(front), u32::from_le_bytes(back));
        let passing = 255 - (front >> 24);
        let [even, odd] = [back & EVEN, (back >> 8) & EVEN].map(|pair| {
            let product = pair * passing + 0x0080_0080;
            product + ((product >> 8) & EVEN)
        });
        front.wrapping_add(((even >> 8) & EVEN) | (odd & !EVEN)).to_le_bytes()
    }
}

impl Channel for u16 {
    const ZERO: Self = 0;
    const ONE: Self = 65535;

    #[inline]
    fn from_f32(value: f32) -> Self {
        math::round(value * 65535.0) as Self
    }
    #[inline]
    fn to_f32(self) -> f32 {
        f32::from(self) / 65535.0
    }
    #[inline]
    fn rest(self) -> Self {
        65535 - self
    }
    #[inline]
    fn mix(self, a: Self, other: Self, b: Self) -> Self {
        let sum = u64::from(self) * u64::from(a) + u64::from(other) * u64::from(b);
        ((sum + 32767) / 65535).min(65535) as Self
    }
    #[inline]
    fn sound([r, g, b, alpha]: [Self; 4]) -> [Self; 4] {
        [r.min(alpha), g.min(alpha), b.min(alpha), alpha]
    }
    /// As for bytes, in the halves of two words: `x / 65535` to the nearest.
    #[inline(always)]
    fn over(front: [Self; 4], back: [Self; 4]) -> [Self; 4] {
        const EVEN: u64 = 0x0000_ffff_0000_ffff;
        let word =
            |[a, b, c, d]: [Self; 4]| u64::from(a) | u64::from(b) << 16 | u64::from(c) << 32 | u64::from(d) << 48;
        let (front, back) = (word(front), word(back));
        let passing = 65535 - (front >> 48);
        let [even, odd] = [back & EVEN, (back >> 16) & EVEN].map(|pair| {
            let product = pair * passing + 0x0000_8000_0000_8000;
            product + ((product >> 16) & EVEN)
        });
        let sum = front.wrapping_add(((even >> 16) & EVEN) | (odd & !EVEN));
        [sum as Self, (sum >> 16) as Self, (sum >> 32) as Self, (sum >> 48) as Self]
    }
}

/// A color and, apart from it, the share of a pixel that it covers: what artists and files give.
///
/// Linear light; [`StraightRgba::from_srgb`] is the way in for stored pictures. Where alpha is 0 the color means nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StraightRgba<C = f32> {
    /// Linear red, green and blue.
    pub rgb: [C; 3],
    /// The share of light from behind that is blocked: 0 is air, 1 is a wall.
    pub alpha: C,
}

impl<C: Channel> StraightRgba<C> {
    /// Nothing at all: what is left of a color whose alpha is 0.
    pub const TRANSPARENT: Self = Self { rgb: [C::ZERO; 3], alpha: C::ZERO };

    /// A color that blocks everything.
    pub fn opaque(rgb: [C; 3]) -> Self {
        Self { rgb, alpha: C::ONE }
    }

    /// Each channel times alpha.
    #[inline]
    pub fn premultiplied(self) -> PremultipliedRgba<C> {
        let [r, g, b] = self.rgb.map(|channel| channel.mix(self.alpha, C::ZERO, C::ZERO));
        PremultipliedRgba::new([r, g, b, self.alpha])
    }

    /// The same color stored in another way, to the nearest.
    pub fn stored_as<D: Channel>(self) -> StraightRgba<D> {
        StraightRgba {
            rgb: self.rgb.map(|channel| D::from_f32(channel.to_f32())),
            alpha: D::from_f32(self.alpha.to_f32()),
        }
    }
}

impl StraightRgba {
    /// Red, green, blue and alpha of a stored picture. Alpha is a share and has no transfer curve.
    pub fn from_srgb([r, g, b, alpha]: [u8; 4]) -> Self {
        Self { rgb: [r, g, b].map(srgb_to_linear), alpha: alpha.to_f32() }
    }

    /// To be stored in a picture; what is outside `[0, 1]` is clamped.
    pub fn to_srgb(self) -> [u8; 4] {
        let [r, g, b] = self.rgb.map(linear_to_srgb);
        [r, g, b, u8::from_f32(self.alpha)]
    }
}

/// A color already multiplied by its alpha: the light that a layer adds, and the share of the light from behind that it
/// blocks.
///
/// Linear light. Alpha lies in `[0, 1]`. As `f32` the channels may exceed alpha: such a layer glows. Packed ones do not.
/// Eight bits of linear light are coarse in the dark: sums of many layers want 16 or `f32`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(transparent)]
pub struct PremultipliedRgba<C = f32>([C; 4]);

impl<C: Channel> PremultipliedRgba<C> {
    /// Adds nothing, blocks nothing.
    pub const TRANSPARENT: Self = Self([C::ZERO; 4]);

    /// Red, green and blue, multiplied by alpha, and alpha. Alpha is brought into `[0, 1]`, and where packed the channels
    /// down to alpha.
    #[inline]
    pub fn new(rgba: [C; 4]) -> Self {
        Self(C::sound(rgba))
    }

    /// Red, green, blue, alpha.
    #[inline]
    pub fn to_array(self) -> [C; 4] {
        self.0
    }

    /// The share of light from behind that is blocked.
    #[inline]
    pub fn alpha(self) -> C {
        self.0[3]
    }

    /// Each channel divided by alpha. Where alpha is 0 there is no color to be found:
    /// [`StraightRgba::TRANSPARENT`].
    pub fn straight(self) -> StraightRgba<C> {
        if self.0[3] == C::ZERO {
            return StraightRgba::TRANSPARENT;
        }
        let [r, g, b, alpha] = self.0.map(C::to_f32);
        StraightRgba { rgb: [r, g, b].map(|channel| C::from_f32(channel / alpha)), alpha: self.0[3] }
    }

    /// A layer that covers only this share of a pixel: the edge of a shape, drawn smoothly.
    #[inline]
    pub fn covering(self, share: C) -> Self {
        Self::new(self.0.map(|channel| channel.mix(share, C::ZERO, C::ZERO)))
    }

    /// The same color stored in another way, to the nearest.
    pub fn stored_as<D: Channel>(self) -> PremultipliedRgba<D> {
        PremultipliedRgba::new(self.0.map(|channel| D::from_f32(channel.to_f32())))
    }

    /// For operations that keep the promise of [`PremultipliedRgba::new`].
    #[inline(always)]
    pub(super) fn from_sound(rgba: [C; 4]) -> Self {
        Self(rgba)
    }
}

impl PremultipliedRgba {
    /// What adds `light` and blocks the share `alpha` of what comes from behind.
    pub fn adding(light: Vec3, alpha: f32) -> Self {
        let [r, g, b] = light.to_array();
        Self::new([r, g, b, alpha])
    }

    /// The light that is added.
    pub fn rgb(self) -> Vec3 {
        let [r, g, b, _] = self.0;
        Vec3::new(r, g, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_products_are_rounded_to_nearest() {
        for (front, back) in (0..=255_u8).flat_map(|front| (0..=255_u8).map(move |back| (front, back))) {
            let exact = f64::from(back) * f64::from(255 - front) / 255.0;
            let [.., alpha] = u8::over([0, 0, 0, front], [back; 4]);
            assert_eq!(alpha, front + exact.round() as u8, "{front} over {back}");
            assert_eq!(u8::over([0, 0, 0, front], [back; 4])[..3], [exact.round() as u8; 3]);
            assert_eq!(front.mix(back, 0, 0), (f64::from(front) * f64::from(back) / 255.0).round() as u8);
        }
        for (front, back) in
            (0..=255_u16).flat_map(|front| (0..=255_u16).map(move |back| (front * 257, back * 256 + 77)))
        {
            let exact = f64::from(back) * f64::from(65535 - front) / 65535.0;
            assert_eq!(u16::over([0, 0, 0, front], [back; 4]), {
                let [r, g, b] = [exact.round() as u16; 3];
                [r, g, b, front + r]
            });
        }
    }

    #[test]
    fn what_is_stored_survives() {
        for alpha in 0..=255_u8 {
            let color = StraightRgba::from_srgb([alpha, 255 - alpha, 77, alpha]);
            assert_eq!(color.to_srgb(), [alpha, 255 - alpha, 77, alpha]);
            let packed = PremultipliedRgba::new([alpha, alpha / 2, 0, alpha]);
            assert_eq!(packed.stored_as::<u16>().stored_as::<u8>(), packed);
            assert_eq!(packed.straight().premultiplied(), packed, "dividing by alpha loses nothing");
        }
    }

    #[test]
    fn alpha_zero_has_no_color() {
        let colorful = StraightRgba { rgb: [0.3, 0.5, 0.9], alpha: 0.0 };
        assert_eq!(colorful.premultiplied(), PremultipliedRgba::TRANSPARENT);
        assert_eq!(colorful.premultiplied().straight(), StraightRgba::TRANSPARENT);
        assert_eq!(PremultipliedRgba::<u8>::TRANSPARENT.straight(), StraightRgba::TRANSPARENT);
    }

    #[test]
    fn what_cannot_be_is_made_sound() {
        assert_eq!(PremultipliedRgba::new([200_u8, 10, 90, 80]).to_array(), [80, 10, 80, 80]);
        assert_eq!(PremultipliedRgba::new([9.0, 0.0, 0.0, 1.5]).to_array(), [9.0, 0.0, 0.0, 1.0]);
        assert_eq!(PremultipliedRgba::new([0.0, 0.0, 0.0, f32::NAN]).alpha(), 0.0);
    }
}
