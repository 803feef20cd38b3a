//! A GLB file: 12 bytes of header, then chunks of a length, a kind and data. The first is JSON, the second the buffer.

use crate::mesh::read::words::shown;
use crate::mesh::read::{Place, ReadError, without_mark};

/// The parts of a file.
pub struct Parts<'a> {
    pub json: &'a [u8],
    /// Where the JSON begins, if the file is binary.
    pub json_at: Option<usize>,
    /// The data of the first buffer.
    pub binary: Option<&'a [u8]>,
    pub warnings: Vec<String>,
}

/// Takes a file apart; one that is not binary is all JSON.
pub fn open(bytes: &[u8]) -> Result<Parts<'_>, ReadError> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Parts { json: without_mark(bytes), json_at: None, binary: None, warnings: Vec::new() });
    }
    let version = word(bytes, 4)?;
    if version != 2 {
        return Err(Place::Byte(4).has(format!("version {version} of GLB is not read; export the object as glTF 2.0")));
    }
    let length = word(bytes, 8)? as usize;
    let mut warnings = Vec::new();
    let Some(file) = bytes.get(..length) else {
        return Err(Place::Byte(8).has(format!(
            "the header promises {length} bytes, but the file has {}; export or download it again",
            bytes.len()
        )));
    };
    if length < bytes.len() {
        warnings.push(format!("Skipped {} bytes behind the end of the GLB file.", bytes.len() - length));
    }
    let (json, behind) = chunk(file, 12, b"JSON")?;
    let binary = if behind < file.len() { Some(chunk(file, behind, b"BIN\0")?.0) } else { None };
    Ok(Parts { json, json_at: Some(20), binary, warnings })
}

/// The data of a chunk, and where the next one begins.
fn chunk<'a>(file: &'a [u8], at: usize, kind: &[u8; 4]) -> Result<(&'a [u8], usize), ReadError> {
    let length = word(file, at)? as usize;
    let found = file.get(at + 4..at + 8).ok_or_else(|| ends(file))?;
    if found != kind {
        let [found, kind] = [found, &kind[..]].map(|k| shown(&String::from_utf8_lossy(k)));
        return Err(
            Place::Byte(at + 4).has(format!("a chunk '{found}', but '{kind}' belongs here; export the object again"))
        );
    }
    let data = (at + 8).checked_add(length).and_then(|end| file.get(at + 8..end));
    let data = data.ok_or_else(|| {
        Place::Byte(at).has(format!("a chunk of {length} bytes ends behind the file; export or download it again"))
    })?;
    Ok((data, at + 8 + length))
}

fn word(bytes: &[u8], at: usize) -> Result<u32, ReadError> {
    let word = bytes.get(at..).and_then(|rest| rest.first_chunk::<4>());
    word.map(|&word| u32::from_le_bytes(word)).ok_or_else(|| ends(bytes))
}

fn ends(bytes: &[u8]) -> ReadError {
    Place::Byte(bytes.len()).has("the file ends inside a header; export or download it again")
}
