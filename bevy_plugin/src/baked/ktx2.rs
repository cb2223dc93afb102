//! Writes a lightmap as KTX2 with a shared exponent, four bytes a texel, which every GPU can filter.

use radiosity::lightmap::LightmapImage;

/// `VK_FORMAT_E5B9G9R9_UFLOAT_PACK32`, which Bevy calls `Rgb9e5Ufloat`.
const VK_FORMAT: u32 = 123;
const IDENTIFIER: [u8; 12] = [0xAB, b'K', b'T', b'X', b' ', b'2', b'0', 0xBB, b'\r', b'\n', 0x1A, b'\n'];
const HEADER_BYTES: u32 = 80;
const LEVEL_INDEX_BYTES: u32 = 24;
/// The total size, the header of the block, and six samples.
const DESCRIPTOR_BYTES: u32 = 4 + 24 + 6 * 16;

const MANTISSA_BITS: i32 = 9;
const EXPONENT_BIAS: i32 = 15;
/// The largest value that fits: mantissa 511, exponent 31.
const MAX: f32 = 65408.0;

/// The bytes of a KTX2 file without mip levels or compression.
pub fn encode(image: &LightmapImage) -> Vec<u8> {
    let data_bytes = image.texels.len() as u64 * 4;
    let data_offset = u64::from(HEADER_BYTES + LEVEL_INDEX_BYTES + DESCRIPTOR_BYTES);
    let mut file = Vec::with_capacity((data_offset + data_bytes) as usize);
    file.extend(IDENTIFIER);
    // Format, size of its units, width, height, depth, layers, faces, levels, no supercompression.
    push_words(&mut file, &[VK_FORMAT, 4, image.width, image.height, 0, 0, 1, 1, 0]);
    // Where the descriptor is; no key-value data and no global data of a supercompression.
    push_words(&mut file, &[HEADER_BYTES + LEVEL_INDEX_BYTES, DESCRIPTOR_BYTES, 0, 0, 0, 0, 0, 0]);
    for level in [data_offset, data_bytes, data_bytes] {
        file.extend(level.to_le_bytes());
    }
    push_descriptor(&mut file);
    for texel in &image.texels {
        file.extend(shared_exponent(texel.to_array()).to_le_bytes());
    }
    file
}

/// Three values in one word: 9 bits of mantissa each and a common exponent, rounded to the nearest.
///
/// Negative values and NaN become 0, values above 65408 become that. As in `EXT_texture_shared_exponent`.
pub fn shared_exponent(rgb: [f32; 3]) -> u32 {
    // NaN is not greater than zero.
    let rgb = rgb.map(|channel| if channel > 0.0 { channel.min(MAX) } else { 0.0 });
    let largest = rgb[0].max(rgb[1]).max(rgb[2]);
    let mut exponent = floor_log2(largest).max(-EXPONENT_BIAS - 1) + 1 + EXPONENT_BIAS;
    if mantissa(largest, exponent) == 1 << MANTISSA_BITS {
        exponent += 1;
    }
    let [red, green, blue] = rgb.map(|channel| mantissa(channel, exponent));
    red | green << 9 | blue << 18 | (exponent as u32) << 27
}

/// `channel` in units of the last place that a shared `exponent` leaves.
fn mantissa(channel: f32, exponent: i32) -> u32 {
    let unit = f64::powi(2.0, exponent - EXPONENT_BIAS - MANTISSA_BITS);
    (f64::from(channel) / unit + 0.5) as u32
}

/// The exponent of a finite number that is not negative; that of zero and of subnormal numbers is -127.
fn floor_log2(number: f32) -> i32 {
    (number.to_bits() >> 23) as i32 - 127
}

/// Tells readers that do not know the format how the bits are laid out: a basic Khronos data format descriptor.
fn push_descriptor(file: &mut Vec<u8>) {
    const RGBSDA: u32 = 1;
    const BT709: u32 = 1;
    const LINEAR: u32 = 1;
    const EXPONENT: u32 = 1 << 5;
    push_words(file, &[DESCRIPTOR_BYTES, 0, 2 | (DESCRIPTOR_BYTES - 4) << 16]);
    // One texel of four bytes a block.
    push_words(file, &[RGBSDA | BT709 << 8 | LINEAR << 16, 0, 4, 0]);
    for channel in 0..3 {
        let bits = |offset: u32, length: u32| offset | (length - 1) << 16;
        push_words(file, &[bits(9 * channel, 9) | channel << 24, 0, 0, 8448]);
        push_words(file, &[bits(27, 5) | (channel | EXPONENT) << 24, 0, EXPONENT_BIAS as u32, 31]);
    }
}

fn push_words(file: &mut Vec<u8>, words: &[u32]) {
    file.extend(words.iter().flat_map(|word| word.to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use bevy::image::{CompressedImageFormats, Image, ImageSampler, ImageType};
    use wgpu_types::TextureFormat;

    use super::*;

    /// The inverse, as the specification of the format has it.
    fn decode(word: u32) -> [f64; 3] {
        let unit = f64::powi(2.0, (word >> 27) as i32 - 15 - 9);
        [0, 9, 18].map(|shift| f64::from(word >> shift & 511) * unit)
    }

    /// The largest channel keeps nine bits, so that it is wrong by at most half of 1/256; the others are no worse.
    #[test]
    fn rounds_to_the_nearest() {
        let mut seed = 1_u32;
        for _ in 0..20_000 {
            let rgb = [0; 3].map(|_| {
                seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f32::exp2((seed >> 8) as f32 / (1 << 24) as f32 * 30.0 - 14.0)
            });
            let largest = f64::from(rgb[0].max(rgb[1]).max(rgb[2]).min(MAX));
            for (channel, decoded) in rgb.into_iter().zip(decode(shared_exponent(rgb))) {
                let error = (f64::from(channel.min(MAX)) - decoded).abs();
                assert!(error <= largest / 512.0, "{channel} of {rgb:?} became {decoded}");
            }
        }
    }

    #[test]
    fn extremes_stay_in_range() {
        assert_eq!(shared_exponent([0.0; 3]), 0);
        assert_eq!(shared_exponent([-1.0, f32::NAN, 0.0]), 0);
        assert_eq!(decode(shared_exponent([f32::INFINITY, 1e9, 0.0])), [65408.0, 65408.0, 0.0]);
        assert_eq!(decode(shared_exponent([1.0, 0.5, 0.25])), [1.0, 0.5, 0.25]);
        // Half a unit below a power of two rounds up into the next exponent.
        assert_eq!(decode(shared_exponent([1.9999, 0.0, 0.0])), [2.0, 0.0, 0.0]);
        // The smallest step is 2^-24.
        assert_eq!(decode(shared_exponent([f32::exp2(-24.0), 0.0, 0.0]))[0], f64::powi(2.0, -24));
    }

    /// An independent reader finds the format, the size, the descriptor and the texels.
    #[test]
    fn reads_back() {
        let texels = [[1.0, 2.0, 3.0], [0.0, 0.5, 100.0], [7.0, 7.0, 7.0], [0.0, 0.0, 0.0]];
        let image =
            LightmapImage { width: 2, height: 2, texels: texels.map(Into::into).to_vec(), ..Default::default() };
        let file = encode(&image);
        let reader = ktx2::Reader::new(&file).unwrap();
        let header = reader.header();
        assert_eq!(header.format, Some(ktx2::Format::E5B9G9R9_UFLOAT_PACK32));
        assert_eq!((header.pixel_width, header.pixel_height, header.level_count), (2, 2, 1));
        let level = reader.levels().next().unwrap();
        for (bytes, texel) in level.data.chunks_exact(4).zip(texels) {
            assert_eq!(u32::from_le_bytes(bytes.try_into().unwrap()), shared_exponent(texel));
        }
        let (expected, _) = ktx2::dfd::Basic::from_format(ktx2::Format::E5B9G9R9_UFLOAT_PACK32).unwrap();
        assert!(matches!(reader.dfd_blocks(), [ktx2::dfd::Block::Basic(basic)] if *basic == expected));
    }
    /// Bevy's own loader finds the same texels in the same format.
    #[test]
    fn bevy_reads_it() {
        let texels = [[1.0, 2.0, 3.0]; 16].map(Into::into).to_vec();
        let file = encode(&LightmapImage { width: 8, height: 2, texels, ..Default::default() });
        let image = Image::from_buffer(
            &file,
            ImageType::Extension("ktx2"),
            CompressedImageFormats::NONE,
            false,
            ImageSampler::Default,
            Default::default(),
        );
        let image = image.unwrap();
        assert_eq!(image.texture_descriptor.format, TextureFormat::Rgb9e5Ufloat);
        assert_eq!((image.width(), image.height()), (8, 2));
        assert_eq!(image.data.unwrap(), shared_exponent([1.0, 2.0, 3.0]).to_le_bytes().repeat(16));
    }
}
