//! Small files, cut off at every byte and changed at every byte: an answer or a sentence, never a panic.

use ocb_core::mesh::{FileFormat, read};

use crate::write::{DIALECTS, cube};

/// One line, not long, and nothing of the inside.
fn check_sentence(sentence: &str) {
    assert!(!sentence.is_empty() && sentence.len() < 300 && !sentence.contains(['\n', '\0', '\u{1b}']), "{sentence:?}");
}

#[test]
fn a_file_cut_off_anywhere_is_refused_or_lacks_nothing() {
    let mesh = cube();
    for dialect in DIALECTS {
        let file = dialect.write(&mesh);
        let whole = read(&file).expect("a valid file").mesh;
        for length in 0..file.len() {
            match read(&file[..length]) {
                Err(e) => check_sentence(&e.to_string()),
                // The end may lack white space or a name, and OBJ says nowhere how many faces it has.
                Ok(cut) => {
                    let whole_count = whole.triangles().len();
                    let complete = cut.mesh.triangles().len() == whole_count && length + 6 >= file.len();
                    assert!(complete || dialect.format() == FileFormat::Obj, "{dialect:?} cut to {length} bytes");
                }
            }
        }
    }
}

#[test]
fn a_file_with_any_byte_changed_gives_a_mesh_or_a_sentence() {
    let mesh = cube();
    for dialect in DIALECTS {
        let mut file = dialect.write(&mesh);
        for at in 0..file.len() {
            let byte = file[at];
            for other in [0, 0xff, byte ^ 1, byte ^ 0x80, b'9', b'-', b'\n'] {
                file[at] = other;
                if let Err(e) = read(&file) {
                    check_sentence(&e.to_string());
                }
            }
            file[at] = byte;
        }
    }
}
