//! The transfer curve of sRGB, IEC 61966-2-1, the same bits on every machine.

/// Linear intensity in `[0, 1]` of a stored sRGB value.
pub fn srgb_to_linear(stored: u8) -> f32 {
    DECODED[stored as usize]
}

/// The stored sRGB value nearest on its own scale to a linear intensity; below 0 and NaN give 0, above 1 gives 255.
pub fn linear_to_srgb(linear: f32) -> u8 {
    THRESHOLDS.partition_point(|&threshold| threshold <= linear) as u8
}

/// Linear intensity of each stored value.
const DECODED: [f32; 256] = {
    let mut decoded = [0.0; 256];
    let mut i = 0;
    while i < 256 {
        decoded[i] = decode(i as f64 / 255.0) as f32;
        i += 1;
    }
    decoded
};

/// Linear intensities from which on the next stored value is nearer.
const THRESHOLDS: [f32; 255] = {
    let mut thresholds = [0.0; 255];
    let mut i = 0;
    while i < 255 {
        thresholds[i] = decode((i as f64 + 0.5) / 255.0) as f32;
        i += 1;
    }
    thresholds
};

/// The piecewise curve: linear near black, then `((s + 0.055) / 1.055)^2.4`.
const fn decode(stored: f64) -> f64 {
    if stored <= 0.04045 {
        return stored / 12.92;
    }
    let base = (stored + 0.055) / 1.055;
    base * base * fifth_root(base * base)
}

/// By Newton's iteration; `x` in `(0, 1]`.
const fn fifth_root(x: f64) -> f64 {
    let mut root = 1.0;
    let mut i = 0;
    while i < 64 {
        let fourth = root * root * root * root;
        root -= (root * fourth - x) / (5.0 * fourth);
        i += 1;
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the standard's formula, computed to ten digits elsewhere.
    #[test]
    fn known_values() {
        let known = [(0, 0.0), (1, 0.000_303_527), (10, 0.003_035_27), (11, 0.003_346_535_8), (64, 0.051_269_458)];
        for (stored, linear) in known.into_iter().chain([(128, 0.215_860_5), (188, 0.502_886_5), (255, 1.0)]) {
            let decoded = srgb_to_linear(stored);
            assert!((decoded - linear).abs() <= 2e-7 * linear, "{stored}: {decoded} instead of {linear}");
        }
    }

    #[test]
    fn every_value_survives_the_way_there_and_back() {
        for stored in 0..=255 {
            assert_eq!(linear_to_srgb(srgb_to_linear(stored)), stored);
        }
    }

    #[test]
    fn what_cannot_be_stored_is_clamped() {
        assert_eq!(linear_to_srgb(-1.0), 0);
        assert_eq!(linear_to_srgb(f32::NAN), 0);
        assert_eq!(linear_to_srgb(2.0), 255);
        assert_eq!(linear_to_srgb(f32::INFINITY), 255);
    }
}
