//! The measured spectra of the Cornell box.
//!
//! They are those of the "Cornell Box Data" that Cornell University publishes: 76 bands from 400 to 700 nm in steps of
//! 4 nm. The lamp reflects 0.78 at all of them.

use super::Bands;

/// Reflectance of the floor, the ceiling, the back wall and the blocks.
pub const CORNELL_WHITE: Bands<76> = thousandths([
    343, 445, 551, 624, 665, 687, 708, 723, 715, 710, 745, 758, 739, 767, 777, 765, 751, 745, 748, 729, 745, 757, 753,
    750, 746, 747, 735, 732, 739, 734, 725, 721, 733, 725, 732, 743, 744, 748, 728, 716, 733, 726, 713, 740, 754, 764,
    752, 736, 734, 741, 740, 732, 745, 755, 751, 744, 731, 733, 744, 731, 712, 708, 729, 730, 727, 707, 703, 729, 750,
    760, 751, 739, 724, 730, 740, 737,
]);

/// Reflectance of the wall to the left.
pub const CORNELL_RED: Bands<76> = thousandths([
    40, 46, 48, 53, 49, 50, 53, 55, 57, 56, 59, 57, 61, 61, 60, 62, 62, 62, 61, 62, 60, 59, 57, 58, 58, 58, 56, 55, 56,
    59, 57, 55, 59, 59, 58, 59, 61, 61, 63, 63, 67, 68, 72, 80, 90, 99, 124, 154, 192, 255, 287, 349, 402, 443, 487,
    513, 558, 584, 620, 606, 609, 651, 612, 610, 650, 638, 627, 620, 630, 628, 642, 639, 657, 639, 635, 642,
]);

/// Reflectance of the wall to the right.
pub const CORNELL_GREEN: Bands<76> = thousandths([
    92, 96, 98, 97, 98, 95, 95, 97, 95, 94, 97, 98, 96, 101, 103, 104, 107, 109, 112, 115, 125, 140, 160, 187, 229,
    285, 343, 390, 435, 464, 472, 476, 481, 462, 447, 441, 426, 406, 373, 347, 337, 314, 285, 277, 266, 250, 230, 207,
    186, 171, 160, 148, 141, 136, 130, 126, 123, 121, 122, 119, 114, 115, 117, 117, 118, 120, 122, 128, 132, 139, 144,
    146, 150, 152, 157, 159,
]);

/// Emission of the lamp at 400, 500, 600 and 700 nm, in no particular unit.
const LAMP: [f32; 4] = [0.0, 8.0, 15.6, 18.4];

/// The band that holds a wavelength in nanometers; the first or the last outside of 400..700.
pub fn cornell_band(wavelength: f32) -> usize {
    (((wavelength - 400.0) / 4.0 + 0.5) as usize).min(75)
}

/// Emission of the lamp, in no particular unit, linear between the four wavelengths at which it was measured.
pub fn cornell_lamp() -> Bands<76> {
    Bands(core::array::from_fn(|band| {
        let (interval, along) = (band / 25, (band % 25) as f32 / 25.0);
        let next = LAMP[(interval + 1).min(3)];
        LAMP[interval] + (next - LAMP[interval]) * along
    }))
}

const fn thousandths(values: [u16; 76]) -> Bands<76> {
    let mut bands = [0.0; 76];
    let mut band = 0;
    while band < 76 {
        bands[band] = values[band] as f32 / 1000.0;
        band += 1;
    }
    Bands(bands)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Red paint is red, green paint is green, and the lamp is as it was measured.
    #[test]
    fn paints_have_their_colors() {
        let [blue, green, red] = [452.0, 548.0, 620.0].map(cornell_band);
        assert_eq!([blue, green, red], [13, 37, 55]);
        assert_eq!([CORNELL_WHITE.0[blue], CORNELL_WHITE.0[green], CORNELL_WHITE.0[red]], [0.767, 0.748, 0.744]);
        assert!(CORNELL_RED.0[red] > 8.0 * CORNELL_RED.0[blue] && CORNELL_GREEN.0[green] > 3.0 * CORNELL_GREEN.0[red]);
        let lamp = cornell_lamp();
        assert_eq!([0, 25, 50, 75].map(|band| lamp.0[band]), LAMP);
        assert!((lamp.0[cornell_band(548.0)] - 11.648).abs() < 1e-5);
        assert_eq!([cornell_band(0.0), cornell_band(f32::NAN), cornell_band(9e9)], [0, 0, 75]);
    }
}
