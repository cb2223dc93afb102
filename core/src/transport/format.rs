//! A transport as bytes: everything is little-endian, lists have their length before them.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use glam::Vec3;

use super::{
    Cells, Codes, Contact, Fills, LampLight, Lighting, MaterialColors, Origin, Rows, Run, Sample, SeamPoint, Seams,
    StoredImage, Surfaces, Transport,
};

/// The first bytes of a file.
const MAGIC: [u8; 8] = *b"RADIOSTP";
/// What this version writes, and the only one that it reads.
const VERSION: u32 = 5;
/// Magic, version, a reserved zero, length and checksum of the rest.
const HEADER: usize = 32;
/// Images have at most so many texels in a row and so many rows.
const LARGEST_IMAGE: u32 = 1 << 14;

/// Why bytes are no transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransportError {
    /// They begin in another way.
    NotATransport,
    /// Another version wrote them.
    Version {
        /// The number of that version.
        found: u32,
    },
    /// There are too few or too many of them.
    Length {
        /// How many there should be.
        expected: u64,
        /// How many there are.
        found: u64,
    },
    /// They are not those that were written.
    Corrupt,
}

impl fmt::Display for TransportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotATransport => {
                write!(f, "this is no stored transport; bake the scene again and keep its transport")
            }
            Self::Version { found } => write!(
                f,
                "the transport has version {found} and version {VERSION} is read here; bake the scene again with this program"
            ),
            Self::Length { expected, found } => {
                write!(f, "the transport should have {expected} bytes and has {found}; copy it again, or bake again")
            }
            Self::Corrupt => write!(f, "the transport is corrupt; copy it again, or bake the scene again"),
        }
    }
}

impl core::error::Error for TransportError {}

impl Transport {
    /// The transport as bytes for a file.
    pub fn write(&self) -> Vec<u8> {
        let mut bytes = alloc::vec![0; HEADER];
        self.put(&mut bytes);
        let header =
            [MAGIC, word(u64::from(VERSION)), word((bytes.len() - HEADER) as u64), word(checksum(&bytes[HEADER..]))];
        bytes[..HEADER].copy_from_slice(header.as_flattened());
        bytes
    }

    /// The transport that was written as these bytes.
    ///
    /// # Errors
    ///
    /// See [`TransportError`]. Whatever the bytes are, no more memory is taken than they need.
    pub fn read(bytes: &[u8]) -> Result<Self, TransportError> {
        let (header, rest) = bytes.split_at_checked(HEADER).ok_or(TransportError::NotATransport)?;
        let field = |index: usize| {
            let mut field = [0; 8];
            field.copy_from_slice(&header[8 * index..8 * index + 8]);
            field
        };
        if field(0) != MAGIC {
            return Err(TransportError::NotATransport);
        }
        let [version, length, sum] = [1, 2, 3].map(|index| u64::from_le_bytes(field(index)));
        match (version as u32, version >> 32) {
            (VERSION, 0) => {}
            (VERSION, _) => return Err(TransportError::Corrupt),
            (found, _) => return Err(TransportError::Version { found }),
        }
        if length != rest.len() as u64 {
            let expected = length.saturating_add(HEADER as u64);
            return Err(TransportError::Length { expected, found: bytes.len() as u64 });
        }
        if sum != checksum(rest) {
            return Err(TransportError::Corrupt);
        }
        let mut rest = rest;
        let transport = Self::take(&mut rest).filter(|transport| rest.is_empty() && transport.is_sound());
        transport.ok_or(TransportError::Corrupt)
    }

    /// Whether all lists fit together, so that nothing that is named is missing.
    fn is_sound(&self) -> bool {
        let Self {
            surfaces,
            lamps,
            patches,
            nodes,
            contacts,
            texels,
            images,
            seams,
            lighting,
            lamp_names,
            material_names,
        } = self;
        let (receivers, all) = (surfaces.receivers(), surfaces.patch_of.len());
        let of_image = |image: &StoredImage| {
            let within = image.width.max(image.height) <= LARGEST_IMAGE;
            let count = if within { image.width * image.height } else { 0 };
            let is_place = |&place: &u32| place < count || place == StoredImage::NOWHERE;
            within && image.places.iter().all(is_place) && image.fills.is_sound(image.width, image.height)
        };
        lighting.check(lamp_names.len(), material_names.len()).is_ok()
            && surfaces.is_sound(lighting.materials.len())
            && lamps.iter().all(|lamp| lamp.is_sound(receivers, lighting))
            && (patches.len() == surfaces.areas.len() + surfaces.outside() && patches.is_sound(patches.len()))
            && nodes.is_sound(surfaces.columns())
            && contacts.iter().all(|contact| (contact.texel as usize) < all && (contact.node as usize) < nodes.len())
            && (texels.len() == all && texels.is_sound(nodes.len()))
            && images.iter().map(|image| image.places.len()).sum::<usize>() == all
            && images.iter().all(of_image)
            && seams.is_sound(images.iter().map(|image| image.width as usize * image.height as usize))
    }
}

fn word(number: u64) -> [u8; 8] {
    number.to_le_bytes()
}

/// Changes with every change of up to eight bytes in a row, and with nearly every other.
fn checksum(bytes: &[u8]) -> u64 {
    let mix = |sum: u64, word: u64| (sum.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let (words, rest) = bytes.as_chunks::<8>();
    let sum = words.iter().fold(0, |sum, word| mix(sum, u64::from_le_bytes(*word)));
    rest.iter().fold(sum, |sum, &byte| mix(sum, u64::from(byte)))
}

/// What can be put into bytes and taken out again.
trait Stored: Sized {
    fn put(&self, bytes: &mut Vec<u8>);

    /// Takes itself off the front, if it is there.
    fn take(bytes: &mut &[u8]) -> Option<Self>;

    fn take_list(bytes: &mut &[u8], count: usize) -> Option<Vec<Self>> {
        let mut list = Vec::with_capacity(count.min(bytes.len() / size_of::<Self>().max(1)));
        for _ in 0..count {
            list.push(Self::take(bytes)?);
        }
        Some(list)
    }
}

macro_rules! numbers {
    ($($number:ident),*) => { $(
        impl Stored for $number {
            fn put(&self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                let (first, rest) = bytes.split_first_chunk()?;
                *bytes = rest;
                Some(Self::from_le_bytes(*first))
            }

            fn take_list(bytes: &mut &[u8], count: usize) -> Option<Vec<Self>> {
                let (all, rest) = bytes.split_at_checked(count.checked_mul(size_of::<Self>())?)?;
                *bytes = rest;
                Some(all.as_chunks().0.iter().map(|number| Self::from_le_bytes(*number)).collect())
            }
        }
    )* };
}

numbers!(u8, u16, u32, u64, f32);

impl<T: Stored> Stored for Vec<T> {
    fn put(&self, bytes: &mut Vec<u8>) {
        (self.len() as u64).put(bytes);
        self.iter().for_each(|each| each.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        let count = usize::try_from(u64::take(bytes)?).ok()?;
        T::take_list(bytes, count)
    }
}

macro_rules! fields {
    ($($name:ident { $($field:ident),* })*) => { $(
        impl Stored for $name {
            fn put(&self, bytes: &mut Vec<u8>) {
                $(self.$field.put(bytes);)*
            }

            fn take(bytes: &mut &[u8]) -> Option<Self> {
                Some(Self { $($field: Stored::take(bytes)?),* })
            }
        }
    )* };
}

fields! {
    Transport { surfaces, lamps, patches, nodes, contacts, texels, images, seams, lighting, lamp_names, material_names }
    Surfaces { areas, presence, materials, bare, patch_of, texel_areas, reflectance, emission, cells, around, sky }
    Contact { texel, node }
    Cells { of_texel, count }
    Codes { largest, codes }
    Rows { ends, entries, totals, columns }
    LampLight { origin, color, runs, light }
    Run { start, first }
    StoredImage { width, height, places, fills }
    Fills { width, rings, texels, from }
    Seams { texels, holds, points, rows, links }
    SeamPoint { sides, weight }
    Sample { upper, lower, right, down }
    Lighting { lamps, materials, sky }
    MaterialColors { base_color, emissive }
    Vec3 { x, y, z }
}

impl Stored for String {
    fn put(&self, bytes: &mut Vec<u8>) {
        (self.len() as u64).put(bytes);
        bytes.extend(self.as_bytes());
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        Self::from_utf8(Vec::take(bytes)?).ok()
    }
}

impl<T: Stored, const N: usize> Stored for [T; N] {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.iter().for_each(|each| each.put(bytes));
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        T::take_list(bytes, N)?.try_into().ok()
    }
}

impl Stored for Origin {
    fn put(&self, bytes: &mut Vec<u8>) {
        let (kind, index) = match *self {
            Self::Lamp(index) => (0_u8, index),
            Self::Material(index) => (1, index),
            Self::Sky => (2, 0),
        };
        kind.put(bytes);
        index.put(bytes);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        match (u8::take(bytes)?, u32::take(bytes)?) {
            (0, index) => Some(Self::Lamp(index)),
            (1, index) => Some(Self::Material(index)),
            (2, 0) => Some(Self::Sky),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bake::{BakeSettings, Keep, Quality, bake};
    use crate::geometry::hash;
    use crate::lightmap::{LayoutSettings, Resolution};
    use crate::progress::Progress;
    use crate::scene::cornell_box;
    use crate::transport::Relighter;

    /// Bytes that were forged, checksum and all, are refused or light something, and never more than that.
    #[test]
    fn forged_bytes_do_no_harm() {
        let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(12.0), ..LayoutSettings::default() };
        let settings = BakeSettings { layout, quality: Quality::Draft, keep: Keep::Transport, ..Default::default() };
        let progress = Progress::with_clock(|| 0.0);
        let bytes = bake(&cornell_box(), &settings, &progress).unwrap().transport.unwrap().write();
        let (mut refused, mut lit) = (0, 0);
        for round in 0..2000 {
            let mut forged = bytes.clone();
            let at = HEADER + hash(round, 0) as usize % (bytes.len() - HEADER);
            forged[at] ^= 1 << (hash(round, 1) % 8);
            let sum = checksum(&forged[HEADER..]);
            forged[24..HEADER].copy_from_slice(&word(sum));
            match Transport::read(&forged) {
                Err(error) => {
                    assert_eq!(error, TransportError::Corrupt);
                    refused += 1;
                }
                Ok(transport) if round % 20 == 0 => {
                    assert!(Relighter::new(&transport, 1).relight(&transport.lighting, &progress).is_ok());
                    lit += 1;
                }
                Ok(_) => {}
            }
        }
        assert!(refused > 100 && lit > 10, "{refused} {lit}");
    }
}
