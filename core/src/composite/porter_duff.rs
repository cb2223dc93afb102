//! The other ways in which two layers can share a pixel.

use super::{Channel, PremultipliedRgba};

/// An operator of Porter and Duff, "Compositing Digital Images", 1984: of the parts of a pixel that only the source
/// covers, only the destination, or both, which show what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PorterDuff {
    /// Nothing.
    Clear,
    /// The source alone.
    Source,
    /// The destination alone.
    Destination,
    /// The source, and the destination where the source leaves room.
    SourceOver,
    /// The destination, and the source where the destination leaves room.
    DestinationOver,
    /// The source where the destination is.
    SourceIn,
    /// The destination where the source is.
    DestinationIn,
    /// The source where the destination is not.
    SourceOut,
    /// The destination where the source is not.
    DestinationOut,
    /// The source where the destination is, and the rest of the destination.
    SourceAtop,
    /// The destination where the source is, and the rest of the source.
    DestinationAtop,
    /// Each where the other is not.
    Xor,
    /// Both, added.
    Plus,
}

impl PorterDuff {
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::Clear,
        Self::Source,
        Self::Destination,
        Self::SourceOver,
        Self::DestinationOver,
        Self::SourceIn,
        Self::DestinationIn,
        Self::SourceOut,
        Self::DestinationOut,
        Self::SourceAtop,
        Self::DestinationAtop,
        Self::Xor,
        Self::Plus,
    ];

    /// Both layers, each times its share.
    #[inline]
    pub fn compose<C: Channel>(
        self,
        source: PremultipliedRgba<C>,
        destination: PremultipliedRgba<C>,
    ) -> PremultipliedRgba<C> {
        let [a, b] = self.shares(source.alpha(), destination.alpha());
        let (source, destination) = (source.to_array(), destination.to_array());
        PremultipliedRgba::new(core::array::from_fn(|k| source[k].mix(a, destination[k], b)))
    }

    /// What is shown of the source and of the destination, given their alphas: the table of the paper.
    fn shares<C: Channel>(self, source: C, destination: C) -> [C; 2] {
        match self {
            Self::Clear => [C::ZERO, C::ZERO],
            Self::Source => [C::ONE, C::ZERO],
            Self::Destination => [C::ZERO, C::ONE],
            Self::SourceOver => [C::ONE, source.rest()],
            Self::DestinationOver => [destination.rest(), C::ONE],
            Self::SourceIn => [destination, C::ZERO],
            Self::DestinationIn => [C::ZERO, source],
            Self::SourceOut => [destination.rest(), C::ZERO],
            Self::DestinationOut => [C::ZERO, source.rest()],
            Self::SourceAtop => [destination, source.rest()],
            Self::DestinationAtop => [destination.rest(), source],
            Self::Xor => [destination.rest(), source.rest()],
            Self::Plus => [C::ONE, C::ONE],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Within a pixel the source covers the left, the destination the upper half: four quarters, each of which shows the
    /// source, the destination or nothing. That model of the paper is counted out here.
    #[test]
    fn quarters_of_a_pixel() {
        use PorterDuff::*;
        let source = PremultipliedRgba::new([0.5, 0.0, 0.0, 0.5]);
        let destination = PremultipliedRgba::new([0.0, 0.5, 0.0, 0.5]);
        // What is shown of the source and of the destination, in quarters.
        let quarters = [
            (Clear, [0, 0]),
            (Source, [2, 0]),
            (Destination, [0, 2]),
            (SourceOver, [2, 1]),
            (DestinationOver, [1, 2]),
            (SourceIn, [1, 0]),
            (DestinationIn, [0, 1]),
            (SourceOut, [1, 0]),
            (DestinationOut, [0, 1]),
            (SourceAtop, [1, 1]),
            (DestinationAtop, [1, 1]),
            (Xor, [1, 1]),
            (Plus, [2, 2]),
        ];
        for (operator, [a, b]) in quarters {
            let [a, b] = [a, b].map(|quarters| quarters as f32 / 4.0);
            assert_eq!(operator.compose(source, destination).to_array(), [a, b, 0.0, a + b], "{operator:?}");
        }
    }

    /// Packed results are those of `f32` to within a step, and keep the promise that no channel exceeds alpha.
    #[test]
    fn packed_ones_agree() {
        for k in 0..10_000_u32 {
            let bytes = (k.wrapping_mul(2_654_435_761) ^ (k << 7)).to_le_bytes();
            let [a, b] =
                [[bytes[0], 9, bytes[1], bytes[2]], [bytes[1], bytes[3], 200, bytes[0]]].map(PremultipliedRgba::new);
            for operator in PorterDuff::ALL {
                let packed = operator.compose(a, b);
                let exact = operator.compose(a.stored_as::<f32>(), b.stored_as()).stored_as::<u8>();
                let pairs = packed.to_array().into_iter().zip(exact.to_array());
                pairs.for_each(|(packed, exact)| assert!(packed.abs_diff(exact) <= 1, "{operator:?} {a:?} {b:?}"));
                assert_eq!(PremultipliedRgba::new(packed.to_array()), packed);
            }
            assert_eq!(PorterDuff::SourceOver.compose(a, b), a.over(b));
        }
    }
}
