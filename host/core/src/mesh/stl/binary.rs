//! Binary STL: 80 bytes of header, the number of triangles (u32), then 50 bytes for each: normal and corners (12 f32), and
//! two bytes of attributes; little-endian.

use super::Soup;
use crate::mesh::read::words::{bounded, grouped};
use crate::mesh::read::{Place, ReadError};

const HEAD: usize = 84;
const FACET: usize = 50;

/// Facets that the header promises, and those that are there with all their bytes.
fn counts(bytes: &[u8]) -> Option<(usize, usize)> {
    let promised = bytes.get(HEAD - 4..HEAD)?;
    let promised = u32::from_le_bytes(promised.try_into().ok()?) as usize;
    Some((promised, (bytes.len() - HEAD) / FACET))
}

/// Is the file exactly as long as its number of triangles says? A text never is: as a number, four letters stand for more
/// triangles than a file can hold. Headers that begin with `solid` are common, so the length decides.
pub fn is_binary(bytes: &[u8]) -> bool {
    counts(bytes).is_some_and(|(promised, _)| promised > 0 && bytes.len() as u64 == (HEAD + FACET * promised) as u64)
}

/// Does it look like a binary STL file of the wrong length? Then it is refused as such: the first facets have coordinates
/// of objects, which other data hardly has, and NUL bytes, which text has not.
pub fn is_cut_short(bytes: &[u8]) -> bool {
    const LOOKED_AT: usize = 8;
    let Some((promised, there)) = counts(bytes) else { return false };
    let plausible = |x: f32| x == 0.0 || (1e-9..1e9).contains(&x.abs());
    promised > 0
        && there > 0
        && facets(bytes).take(LOOKED_AT).flatten().any(|&b| b == 0)
        && facets(bytes).take(LOOKED_AT).all(|facet| numbers(facet).iter().all(|&x| plausible(x)))
        && facets(bytes).take(LOOKED_AT).any(|facet| numbers(facet)[3..].iter().any(|&x| x != 0.0))
}

pub fn read(bytes: &[u8], soup: &mut Soup) -> Result<(), ReadError> {
    let at_count = Place::Byte(HEAD - 4);
    let Some((promised, _)) = counts(bytes) else {
        return Err(Place::Byte(bytes.len()).has("the file ends inside the header; export or download it again"));
    };
    let expected = HEAD as u64 + FACET as u64 * promised as u64;
    if bytes.len() as u64 != expected {
        return Err(at_count.has(format!(
            "the header promises {} triangles in {} bytes, but the file has {}; export or download it again",
            grouped(promised),
            expected,
            bytes.len()
        )));
    }
    for (i, facet) in facets(bytes).enumerate() {
        let mut corners = [0.0; 9];
        for (k, (corner, x)) in corners.iter_mut().zip(&numbers(facet)[3..]).enumerate() {
            let at = Place::Byte(HEAD + FACET * i + 12 + 4 * k);
            *corner = bounded(f64::from(*x), || format!("{x:e}")).map_err(|fault| at.has(fault))?;
        }
        let [a, b, c, d, e, f, g, h, j] = corners;
        soup.facet([[a, b, c], [d, e, f], [g, h, j]]).map_err(|fault| Place::Byte(HEAD + FACET * i).has(fault))?;
    }
    Ok(())
}

/// The facets that are there with all their bytes.
fn facets(bytes: &[u8]) -> impl Iterator<Item = &[u8; FACET]> {
    bytes.get(HEAD..).unwrap_or_default().as_chunks::<FACET>().0.iter()
}

/// Normal and corners.
fn numbers(facet: &[u8; FACET]) -> [f32; 12] {
    std::array::from_fn(|k| f32::from_le_bytes([facet[4 * k], facet[4 * k + 1], facet[4 * k + 2], facet[4 * k + 3]]))
}
