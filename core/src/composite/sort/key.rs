//! Layer, priority and depth in one number.

/// The place of a thing in the order of drawing: lower layers first, then lower priorities, then from far to near.
///
/// ```
/// use radiosity::composite::DrawKey;
///
/// let [far, near] = [-8.0, -2.0].map(|depth| DrawKey::new(0, 0, depth));
/// assert!(far < near, "what is far is drawn first");
/// assert!(near < DrawKey::new(0, 1, -8.0), "then what has a higher priority");
/// assert!(DrawKey::new(-1, 5, -1.0) < far, "and before all, the layer below");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DrawKey(u64);

impl DrawKey {
    /// Layers are drawn one after the other, and within a layer priorities; in each from the least depth to the largest.
    ///
    /// Depths have a total order: both zeros are the same, infinities are the first and the last, and what is no number is
    /// as far as can be.
    #[inline]
    pub fn new(layer: i16, priority: i16, depth: f32) -> Self {
        let [layer, priority] = [layer, priority].map(|number| u64::from(number.cast_unsigned() ^ 0x8000));
        Self(layer << 48 | priority << 32 | u64::from(ordered(depth)))
    }

    /// The depth it was made of.
    #[inline]
    pub fn depth(self) -> f32 {
        let bits = self.0 as u32;
        f32::from_bits(if bits >> 31 == 1 { bits ^ 0x8000_0000 } else { !bits })
    }

    /// The same layer and priority at another depth.
    #[inline]
    pub fn at(self, depth: f32) -> Self {
        Self(self.group() << 32 | u64::from(ordered(depth)))
    }

    /// Layer and priority in one number: only within the same the depth counts.
    #[inline]
    pub fn group(self) -> u64 {
        self.0 >> 32
    }

    #[inline]
    pub(super) fn bits(self) -> u64 {
        self.0
    }
}

/// The bits of a float such that they compare as unsigned numbers: those of negative ones turned round, the sign of the
/// others set.
#[inline]
fn ordered(depth: f32) -> u32 {
    let depth = if depth.is_nan() { f32::NEG_INFINITY } else { depth + 0.0 };
    let bits = depth.to_bits();
    bits ^ ((bits.cast_signed() >> 31).cast_unsigned() | 0x8000_0000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_have_a_total_order() {
        let depths =
            [f32::NEG_INFINITY, -1e30, -2.0, -1.0, -1e-40, 0.0, f32::MIN_POSITIVE, 0.5, 1.0, f32::MAX, f32::INFINITY];
        for pair in depths.windows(2) {
            assert!(DrawKey::new(3, -4, pair[0]) < DrawKey::new(3, -4, pair[1]), "{pair:?}");
        }
        depths.iter().for_each(|&depth| assert_eq!(DrawKey::new(-7, 9, depth).depth(), depth));
        assert_eq!(DrawKey::new(0, 0, -0.0), DrawKey::new(0, 0, 0.0));
        assert_eq!(DrawKey::new(3, -4, 7.0).at(-2.5), DrawKey::new(3, -4, -2.5));
        assert_eq!(DrawKey::new(0, 0, f32::NAN), DrawKey::new(0, 0, f32::NEG_INFINITY));
        assert_eq!(DrawKey::new(0, 0, -f32::NAN), DrawKey::new(0, 0, f32::NEG_INFINITY));
    }

    #[test]
    fn layers_before_priorities_before_depths() {
        let numbers = [i16::MIN, -1, 0, 1, i16::MAX];
        let all = || numbers.iter().flat_map(|&a| numbers.iter().flat_map(move |&b| [-3.0, 4.0].map(|c| (a, b, c))));
        for (a, b) in all().flat_map(|a| all().map(move |b| (a, b))) {
            let [key_a, key_b] = [a, b].map(|(layer, priority, depth)| DrawKey::new(layer, priority, depth));
            assert_eq!(key_a < key_b, a < b, "{a:?} {b:?}");
        }
    }
}
