//! Lightmap coordinates of a mesh in a file beside the manifest, for meshes that brought none along.
//!
//! All numbers have 4 bytes, the lowest first: `RUV1`, the count of vertices, the count of triangles; then for each
//! vertex the one that it repeats, for each vertex `u` and `v`, for each triangle its three vertices.

use std::fmt;

use radiosity::lightmap::{LightmapUv, UvOrigin};

const MAGIC: [u8; 4] = *b"RUV1";

/// A file that does not hold lightmap coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BrokenUvFile;

impl fmt::Display for BrokenUvFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the file of lightmap coordinates is broken; save the bake again")
    }
}

impl std::error::Error for BrokenUvFile {}

/// The bytes of the file.
pub fn encode(uv: &LightmapUv) -> Vec<u8> {
    let counts = [uv.sources.len() as u32, uv.triangles.len() as u32];
    let coordinates = uv.uv_1.iter().flat_map(|uv| uv.to_array()).map(f32::to_bits);
    let words = counts.into_iter().chain(uv.sources.iter().copied()).chain(coordinates);
    let words = words.chain(uv.triangles.iter().flatten().copied());
    MAGIC.into_iter().chain(words.flat_map(u32::to_le_bytes)).collect()
}

/// The inverse of [`encode`].
///
/// # Errors
///
/// Where the file is too short or too long, or a triangle has a vertex that does not exist.
pub fn decode(bytes: &[u8]) -> Result<LightmapUv, BrokenUvFile> {
    let words = bytes.strip_prefix(&MAGIC).ok_or(BrokenUvFile)?;
    let (words, rest) = words.as_chunks::<4>();
    let words: Vec<u32> = words.iter().map(|&word| u32::from_le_bytes(word)).collect();
    let [vertices, triangles, ref data @ ..] = words[..] else { return Err(BrokenUvFile) };
    let (vertex_count, triangle_count) = (vertices as usize, triangles as usize);
    if !rest.is_empty() || data.len() != 3 * (vertex_count + triangle_count) {
        return Err(BrokenUvFile);
    }
    let (sources, data) = data.split_at(vertex_count);
    let (coordinates, triangles) = data.split_at(2 * vertex_count);
    if triangles.iter().any(|&vertex| vertex >= vertices) {
        return Err(BrokenUvFile);
    }
    let uv_1 = coordinates.as_chunks::<2>().0.iter().map(|uv| uv.map(f32::from_bits).into());
    Ok(LightmapUv {
        origin: UvOrigin::Unwrapped,
        sources: sources.to_vec(),
        uv_1: uv_1.collect(),
        triangles: triangles.as_chunks::<3>().0.to_vec(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad() -> LightmapUv {
        LightmapUv {
            origin: UvOrigin::Unwrapped,
            sources: vec![0, 1, 2, 2, 1, 3],
            uv_1: [[0.0, 0.0], [0.4, 0.0], [0.0, 1.0], [0.6, 1.0], [1.0, 0.0], [1.0, 1.0]].map(Into::into).to_vec(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
        }
    }

    #[test]
    fn reads_what_it_writes() {
        assert_eq!(decode(&encode(&quad())), Ok(quad()));
    }

    /// No file makes the reader panic, and none that is cut off passes.
    #[test]
    fn finds_broken_files() {
        let file = encode(&quad());
        for length in 0..file.len() {
            assert_eq!(decode(&file[..length]), Err(BrokenUvFile));
        }
        let vertex_of_last_triangle = file.len() - 4;
        let mut broken = file.clone();
        broken[vertex_of_last_triangle] = 6;
        assert_eq!(decode(&broken), Err(BrokenUvFile));
    }
}
