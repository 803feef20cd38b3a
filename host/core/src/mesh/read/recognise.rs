//! Which format the bytes are in.

use super::{FileFormat, without_mark};
use crate::mesh::{off, stl};

/// The format, from what its files begin with; OBJ has no such mark and is known by its first `v` or `f` line.
pub fn format(bytes: &[u8]) -> Option<FileFormat> {
    if bytes.starts_with(b"glTF") {
        return Some(FileFormat::Glb);
    }
    if let [b'p', b'l', b'y', b'\n' | b'\r', ..] = bytes {
        return Some(FileFormat::Ply);
    }
    if stl::is_binary(bytes) {
        return Some(FileFormat::Stl);
    }
    let text = without_mark(bytes).trim_ascii_start();
    match text.first() {
        Some(b'{') => return Some(FileFormat::Gltf),
        Some(b'<') => return is_collada(text).then_some(FileFormat::Collada),
        _ => {}
    }
    if off::is_off(text) {
        return Some(FileFormat::Off);
    }
    if stl::is_text(text) || stl::is_cut_short(bytes) {
        return Some(FileFormat::Stl);
    }
    is_obj(text).then_some(FileFormat::Obj)
}

/// Is the root element of this XML text `COLLADA`, perhaps with a prefix?
fn is_collada(text: &[u8]) -> bool {
    let mut rest = text;
    while let Some(at) = rest.iter().position(|&b| b == b'<') {
        let tag = &rest[at + 1..];
        let skipped: &[u8] = match tag {
            [b'!', b'-', b'-', ..] => b"-->",
            [b'!' | b'?', ..] => b">",
            _ => {
                let name =
                    tag.split(|b| b.is_ascii_whitespace() || *b == b'>' || *b == b'/').next().unwrap_or_default();
                return name.rsplit(|&b| b == b':').next() == Some(b"COLLADA");
            }
        };
        let Some(end) = tag.windows(skipped.len()).position(|w| w == skipped) else { return false };
        rest = &tag[end..];
    }
    false
}

/// Does a line begin with the word `v`, `f` or `fo`, and is everything above it text?
fn is_obj(text: &[u8]) -> bool {
    text.split(|&b| b == b'\n' || b == b'\r')
        .take_while(|line| !line.contains(&0))
        .any(|line| matches!(line.split(u8::is_ascii_whitespace).find(|w| !w.is_empty()), Some(b"v" | b"f" | b"fo")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_format_is_known_by_its_content() {
        let binary_stl = [&[b' '; 80][..], &1u32.to_le_bytes(), &[0; 50]].concat();
        let cases: [(&[u8], Option<FileFormat>); 21] = [
            (b"glTF\x02\0\0\0", Some(FileFormat::Glb)),
            (b"ply\nformat", Some(FileFormat::Ply)),
            (b"ply\r\nformat", Some(FileFormat::Ply)),
            (b"plywood", None),
            (b"\xef\xbb\xbf {\"asset\": {}}", Some(FileFormat::Gltf)),
            (b"<?xml version=\"1.0\"?>\n<!-- <a> -->\n<COLLADA xmlns=\"x\">", Some(FileFormat::Collada)),
            (b"<c:COLLADA>", Some(FileFormat::Collada)),
            (b"<X3D>", None),
            (b"<?xml", None),
            (b"# a cube\nOFF\n8 6 12", Some(FileFormat::Off)),
            (b"COFF 8 6 12", Some(FileFormat::Off)),
            (b"OFF8 6 12", Some(FileFormat::Off)),
            (b"OFFER", None),
            (b"solid cube\nfacet", Some(FileFormat::Stl)),
            (b"SOLID\n", Some(FileFormat::Stl)),
            (b"solidity", None),
            (&binary_stl, Some(FileFormat::Stl)),
            (b"# made by hand\no cube\nv 1 2 3", Some(FileFormat::Obj)),
            (b"  f 1 2 3", Some(FileFormat::Obj)),
            (b"vt 0 0\nvn 0 0 1", None),
            (b"junk\0junk\nv 1 2 3", None),
        ];
        for (bytes, expected) in cases {
            assert_eq!(format(bytes), expected, "{}", String::from_utf8_lossy(bytes));
        }
    }
}
