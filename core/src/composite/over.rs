//! One layer over another, and many.
//!
//! Porter and Duff, "Compositing Digital Images", 1984: premultiplied, `over` is `front + (1 - alpha) back` in all four
//! channels. It is associative, so that layers can be merged before it is known what lies behind them.

use super::{Channel, PremultipliedRgba, StraightRgba};

impl<C: Channel> PremultipliedRgba<C> {
    /// This layer in front of another.
    ///
    /// ```
    /// use radiosity::composite::StraightRgba;
    ///
    /// let pane = StraightRgba { rgb: [0.0, 0.0, 1.0], alpha: 0.25 }.premultiplied();
    /// let wall = StraightRgba::opaque([1.0, 1.0, 1.0]).premultiplied();
    /// assert_eq!(pane.over(wall).to_array(), [0.75, 0.75, 1.0, 1.0]);
    /// ```
    #[inline(always)]
    pub fn over(self, back: Self) -> Self {
        Self::from_sound(C::over(self.to_array(), back.to_array()))
    }

    /// Whether nothing is seen through it.
    #[inline]
    pub fn is_opaque(self) -> bool {
        self.alpha() == C::ONE
    }
}

impl<C: Channel> StraightRgba<C> {
    /// The one layer that stands for this one in front of another:
    ///
    /// ```text
    /// alpha_new = alpha + (1 - alpha) alpha_back
    /// rgb_new = (alpha rgb + (1 - alpha) alpha_back rgb_back) / alpha_new
    /// ```
    ///
    /// Where both are transparent `alpha_new` is 0 and the quotient undefined. Any color will do there, since a layer of
    /// alpha 0 shows none: it is [`StraightRgba::TRANSPARENT`], so that equal layers compare equal.
    pub fn over(self, back: Self) -> Self {
        self.stored_as::<f32>().premultiplied().over(back.stored_as().premultiplied()).straight().stored_as()
    }
}

/// All layers from the nearest to the farthest. Ends as soon as nothing behind can be seen any more.
pub fn front_to_back<C: Channel>(layers: impl IntoIterator<Item = PremultipliedRgba<C>>) -> PremultipliedRgba<C> {
    front_to_back_until(C::ONE, layers)
}

/// All layers from the nearest to the farthest, ended as soon as alpha has reached `enough`. What is left out adds
/// at most `1 - enough` times the brightest color behind.
pub fn front_to_back_until<C: Channel>(
    enough: C,
    layers: impl IntoIterator<Item = PremultipliedRgba<C>>,
) -> PremultipliedRgba<C> {
    let mut merged = PremultipliedRgba::TRANSPARENT;
    let mut layers = layers.into_iter();
    while merged.alpha() < enough
        && let Some(layer) = layers.next()
    {
        merged = merged.over(layer);
    }
    merged
}

/// All layers from the farthest to the nearest.
pub fn back_to_front<C: Channel>(layers: impl IntoIterator<Item = PremultipliedRgba<C>>) -> PremultipliedRgba<C> {
    layers.into_iter().fold(PremultipliedRgba::TRANSPARENT, |merged, layer| layer.over(merged))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked out by hand.
    #[test]
    fn merged_layers_on_known_values() {
        let layer = |rgb, alpha| StraightRgba { rgb, alpha };
        let [red, green] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let cases = [
            (layer(red, 0.5), layer(green, 0.5), layer([2.0 / 3.0, 1.0 / 3.0, 0.0], 0.75)),
            (layer(red, 0.25), layer(green, 1.0), layer([0.25, 0.75, 0.0], 1.0)),
            (layer(red, 1.0), layer(green, 0.5), layer(red, 1.0)),
            (layer(red, 0.0), layer(green, 0.5), layer(green, 0.5)),
            (layer(red, 0.5), layer(green, 0.0), layer(red, 0.5)),
            (layer(red, 0.2), layer(red, 0.2), layer(red, 0.36)),
            (layer(red, 0.0), layer(green, 0.0), StraightRgba::TRANSPARENT),
        ];
        for (front, back, expected) in cases {
            let merged = front.over(back);
            assert!((merged.alpha - expected.alpha).abs() < 1e-7, "{merged:?} {expected:?}");
            (0..3).for_each(|k| assert!((merged.rgb[k] - expected.rgb[k]).abs() < 1e-6, "{merged:?} {expected:?}"));
        }
    }

    /// An iterator that fails when it is asked for what is behind a wall.
    #[test]
    fn nothing_behind_a_wall_is_asked_for() {
        let wall = StraightRgba::opaque([0.5_f32; 3]).premultiplied();
        let mut asked = 0;
        let layers = core::iter::repeat_with(|| {
            asked += 1;
            if asked == 3 { wall } else { PremultipliedRgba::new([0.1, 0.1, 0.1, 0.2]) }
        });
        assert!(front_to_back(layers).is_opaque());
        assert_eq!(asked, 3);
    }

    #[test]
    fn enough_is_within_its_bound() {
        let layers = [PremultipliedRgba::new([0.3, 0.2, 0.1, 0.5]); 20];
        let all = front_to_back(layers);
        let most = front_to_back_until(0.99, layers);
        assert!((all.rgb() - most.rgb()).abs().max_element() <= 0.01 && most != all);
    }
}
