//! A pixel with one layer, its depth and its alpha: a depth buffer that knows transparency, to a degree.

use super::{Layer, Pixel, PremultipliedRgba, StraightRgba};

/// All that a pixel remembers: one color, one depth, one alpha.
///
/// A new layer is compared with the depth that is stored. The nearer of the two goes over the other, and the pixel keeps
/// the merged layer with the depth of the nearer one:
///
/// ```text
/// front, back = (new, pixel) where z_new > z, else (pixel, new)        larger is nearer
/// alpha' = alpha_front + (1 - alpha_front) alpha_back
/// rgb' = (alpha_front rgb_front + (1 - alpha_front) alpha_back rgb_back) / alpha'
/// z' = z_front
/// ```
///
/// It is right for any number of layers that arrive from back to front or from front to back, and for any two.
///
/// **What it cannot do:** a third layer between two that are merged already. Only the depth of the nearer one is left, so
/// the third goes behind both. A red pane, a blue one behind it and a green one that arrives last but stands between
/// them:
///
/// ```
/// use radiosity::composite::{DepthPixel, Layer, Pixel, StraightRgba};
///
/// let pane = |rgb, depth| Layer { color: StraightRgba { rgb, alpha: 0.5 }.premultiplied(), depth };
/// let [red, green, blue] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let mut pixel = DepthPixel::EMPTY;
/// [pane(red, 3.0), pane(blue, 1.0), pane(green, 2.0)].map(|layer| pixel.add(layer));
/// assert_eq!(pixel.color().to_array(), [0.5, 0.125, 0.25, 0.875], "blue shines through more than green: wrong");
/// ```
///
/// Alpha is right in any order; colors are not. Nor can it take a layer out again, or show panes that touch in a stable
/// order: at the same depth what came first stays in front. [`Layers`](super::Layers) cures the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthPixel {
    /// Straight linear red, green and blue of all layers so far.
    pub rgb: [f32; 3],
    /// Depth of the nearest layer so far; larger is nearer.
    pub z: f32,
    /// The share of light from behind that all layers so far block, in `[0, 1]`.
    pub alpha: f32,
}

impl Pixel for DepthPixel {
    const EMPTY: Self = Self { rgb: [0.0; 3], z: f32::NEG_INFINITY, alpha: 0.0 };

    /// A layer without alpha changes nothing; glow without alpha cannot be kept in straight colors.
    fn add(&mut self, layer: Layer) {
        let (new, old) = (layer.color.straight(), StraightRgba { rgb: self.rgb, alpha: self.alpha });
        if new.alpha == 0.0 {
            return;
        }
        let StraightRgba { rgb, alpha } = if layer.depth > self.z { new.over(old) } else { old.over(new) };
        *self = Self { rgb, alpha, z: self.z.max(layer.depth) };
    }

    fn color(&self) -> PremultipliedRgba {
        StraightRgba { rgb: self.rgb, alpha: self.alpha }.premultiplied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels after each of several layers `(rgb, alpha, z)`, worked out by hand with the formulas above.
    #[test]
    fn the_rule_on_tabulated_values() {
        let table = [
            (([1.0, 0.0, 0.0], 0.5, 0.2), ([1.0, 0.0, 0.0], 0.2, 0.5)),
            (([0.0, 1.0, 0.0], 0.5, 0.4), ([1.0 / 3.0, 2.0 / 3.0, 0.0], 0.4, 0.75)),
            (([0.0, 0.0, 1.0], 0.6, 0.3), ([0.25 / 0.9, 0.5 / 0.9, 0.15 / 0.9], 0.4, 0.9)),
            (([1.0, 1.0, 1.0], 0.0, 0.9), ([0.25 / 0.9, 0.5 / 0.9, 0.15 / 0.9], 0.4, 0.9)),
            (([1.0, 1.0, 0.0], 1.0, 0.1), ([0.35, 0.6, 0.15], 0.4, 1.0)),
            (([0.2, 0.4, 0.6], 1.0, 0.7), ([0.2, 0.4, 0.6], 0.7, 1.0)),
        ];
        let mut pixel = DepthPixel::EMPTY;
        for ((rgb, alpha, depth), (expected, z, covered)) in table {
            pixel.add(Layer { color: StraightRgba { rgb, alpha }.premultiplied(), depth });
            assert_eq!(pixel.z, z);
            assert!((pixel.alpha - covered).abs() < 1e-6, "{pixel:?}");
            (0..3).for_each(|k| assert!((pixel.rgb[k] - expected[k]).abs() < 1e-6, "{pixel:?} {expected:?}"));
        }
    }
}
