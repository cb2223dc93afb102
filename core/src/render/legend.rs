//! Colors for numbers, and the scale that tells what they mean.

/// From few to many, in sRGB.
const COLORS: [[f32; 3]; 5] =
    [[35.0, 60.0, 200.0], [30.0, 170.0, 220.0], [60.0, 190.0, 80.0], [240.0, 210.0, 50.0], [220.0, 30.0, 30.0]];

/// The side of a point of a letter, in pixels.
const POINT: usize = 2;
/// Letters are five points high and four apart.
const ADVANCE: usize = 4 * POINT;
/// Of the bar, in pixels.
const BAR: [usize; 2] = [160, 14];
const WHITE: [u8; 3] = [255; 3];

/// A color in sRGB for a share of a scale: blue for 0, less, and what is no number, green in the middle, red for 1 and more.
pub fn heat(share: f32) -> [u8; 3] {
    let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
    let place = share * (COLORS.len() - 1) as f32;
    let lower = (place as usize).min(COLORS.len() - 2);
    let upper_share = place - lower as f32;
    core::array::from_fn(|k| {
        let (lower, upper) = (COLORS[lower][k], COLORS[lower + 1][k]);
        (lower + (upper - lower) * upper_share + 0.5) as u8
    })
}

/// Draws a bar of all colors with the numbers of its ends into the lower left corner of a picture, where there is room.
pub fn draw_scale(rgb: &mut [[u8; 3]], width: usize, [low, high]: [f32; 2], unit: &str) {
    let height = rgb.len() / width.max(1);
    let room = [BAR[0] + 30 * ADVANCE, BAR[1] + 20];
    if width < room[0] || height < room[1] {
        return;
    }
    let top = height - BAR[1] - 8;
    let first = 8 + draw_number(rgb, width, [8, top + 2], low, unit) + ADVANCE;
    for (x, y) in (0..BAR[0]).flat_map(|x| (0..BAR[1]).map(move |y| (x, y))) {
        rgb[(top + y) * width + first + x] = heat(x as f32 / (BAR[0] - 1) as f32);
    }
    draw_number(rgb, width, [first + BAR[0] + ADVANCE, top + 2], high, unit);
}

/// Draws a number with one digit after the point, and a unit; returns how wide it is.
fn draw_number(rgb: &mut [[u8; 3]], width: usize, [left, top]: [usize; 2], number: f32, unit: &str) -> usize {
    let text = alloc::format!("{number:.1}{unit}");
    for (index, letter) in text.chars().enumerate() {
        for (x, y) in (0..3 * POINT).flat_map(|x| (0..5 * POINT).map(move |y| (x, y))) {
            let bit = 14 - (3 * (y / POINT) + x / POINT);
            if glyph(letter) >> bit & 1 == 1 {
                rgb[(top + y) * width + left + index * ADVANCE + x] = WHITE;
            }
        }
    }
    text.chars().count() * ADVANCE
}

/// Five rows of three points, from the top.
fn glyph(letter: char) -> u16 {
    match letter {
        '0' => 0b111_101_101_101_111,
        '1' => 0b010_110_010_010_111,
        '2' => 0b111_001_111_100_111,
        '3' => 0b111_001_111_001_111,
        '4' => 0b101_101_111_001_001,
        '5' => 0b111_100_111_001_111,
        '6' => 0b111_100_111_101_111,
        '7' => 0b111_001_010_010_010,
        '8' => 0b111_101_111_101_111,
        '9' => 0b111_101_111_001_111,
        '-' => 0b000_000_111_000_000,
        '.' => 0b000_000_000_000_010,
        '/' => 0b001_001_010_100_100,
        '%' => 0b101_001_010_100_101,
        'M' => 0b101_111_111_101_101,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn colors_go_from_blue_over_green_to_red() {
        let [low, middle, high] = [0.0, 0.5, 1.0].map(heat);
        assert!(low[2] > low[0] && middle[1] > middle[0].max(middle[2]) && high[0] > high[1].max(high[2]));
        assert_eq!((heat(-1.0), heat(7.0), heat(f32::NAN)), (low, high, heat(0.0)));
    }

    /// The bar has all colors; a picture without room stays as it is.
    #[test]
    fn the_scale_is_drawn_where_there_is_room() {
        let mut picture = vec![[0; 3]; 640 * 60];
        draw_scale(&mut picture, 640, [0.0, 10.0], "%");
        for share in [0.0, 1.0] {
            assert!(picture.contains(&heat(share)));
        }
        assert!(picture.contains(&WHITE));
        let mut small = vec![[0; 3]; 16];
        draw_scale(&mut small, 4, [0.0, 10.0], "%");
        assert_eq!(small, vec![[0; 3]; 16]);
    }
}
