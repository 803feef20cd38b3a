//! Mutated files for what reads users' objects.
//!
//! A slice runs in every test; `OCB_FUZZ=1000000` (as `make soak` does) says how many files are read in all.

#[path = "formats/write.rs"]
mod write;

use ocb_core::mesh::read;
use ocb_core::numbers::Numbers;
use ocb_core::stock;
use write::{DIALECTS, cube};

/// How many files in every test.
const SLICE: u64 = 20_000;
/// Longest sentence of a refusal, in bytes.
const LONGEST: usize = 400;

fn inputs() -> u64 {
    let asked = std::env::var("OCB_FUZZ").ok().and_then(|n| n.parse::<f64>().ok());
    asked.map_or(SLICE, |n| n.ceil() as u64)
}

/// Words and bytes on which readers stumble.
const NASTY: [&[u8]; 20] = [
    b"0",
    b"-1",
    b"4294967295",
    b"18446744073709551616",
    b"1e999",
    b"nan",
    b"1e18",
    b"\xff\xff\xff\xff",
    b"\0\0\0\0",
    b"\x00\x00\x80\x7f",
    b"\xff\xff\xff\x7f",
    b"\n",
    b"\r",
    b" ",
    b"\"",
    b"<",
    b"</p>",
    b"}",
    b"#",
    b"\xef\xbb\xbf",
];

/// A few places of the file changed: bits flipped, nasty words put in, parts cut out, doubled or taken from elsewhere.
fn mutate(file: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=numbers.below(4) {
        let at = numbers.below(bytes.len() + 1);
        let length = numbers.below(24).min(bytes.len() - at);
        match numbers.below(6) {
            0 if at < bytes.len() => bytes[at] ^= 1 << numbers.below(8),
            1 => {
                let nasty = NASTY[numbers.below(NASTY.len())];
                let end = (at + nasty.len()).min(bytes.len());
                bytes.splice(at..end, nasty.iter().copied());
            }
            2 => {
                let nasty = NASTY[numbers.below(NASTY.len())];
                // A whole word of a text.
                let end = bytes[at..].iter().position(|b| b" \n\",<".contains(b)).map_or(bytes.len(), |n| at + n);
                bytes.splice(at..end, nasty.iter().copied());
            }
            3 => drop(bytes.drain(at..at + length)),
            4 => {
                let part = bytes[at..at + length].to_vec();
                let to = numbers.below(bytes.len() + 1);
                bytes.splice(to..to, part);
            }
            _ => bytes.truncate(at.max(bytes.len() / 2)),
        }
    }
    bytes
}

#[test]
fn mutated_files_give_a_mesh_or_a_sentence() {
    let knot = stock::generate("torus-knot", 600).and_then(|mesh| mesh.to_f32_representable().ok());
    let meshes = [cube(), knot.expect("a knot")];
    let files: Vec<Vec<u8>> = meshes.iter().flat_map(|mesh| DIALECTS.map(|dialect| dialect.write(mesh))).collect();
    let mut numbers = Numbers::new(7);
    let (mut read_well, mut refused) = (0, 0);
    for _ in 0..inputs() {
        let file = mutate(&files[numbers.below(files.len())], &mut numbers);
        match read(&file) {
            Ok(_) => read_well += 1,
            Err(e) => {
                let sentence = e.to_string();
                assert!(sentence.len() < LONGEST && !sentence.contains('\n'), "{sentence}");
                refused += 1;
            }
        }
    }
    println!("fuzz: {read_well} of {} mutated files were still objects", read_well + refused);
    assert!(read_well > 0 && refused > 0, "the mutations must reach both ends");
}
