//! The pre-pass over an OBJ file: everything that can be wrong in a line is found here, with its number, and only plain
//! `v x y z [w]` and `f i j k ...` lines with positive numbers reach the parser.

use std::borrow::Cow;
use std::fmt::Write;

use super::{LineFault, ObjError};
use crate::mesh::read::limits::{MAX_BYTES, MAX_CORNERS, MAX_LINE_BYTES, MAX_TRIANGLES, MAX_VERTICES};
use crate::mesh::read::words::{bounded, shown};
use crate::mesh::read::{Fault, lines};

/// What is left of a file for the parser.
#[derive(Default)]
pub struct Clean {
    /// `v` lines.
    pub vertices: String,
    /// `f` lines: vertex numbers from 1, at least three each.
    pub faces: String,
    /// Number of `v` lines.
    pub vertex_count: usize,
    /// Triangles that the faces will give.
    pub triangle_count: usize,
    /// One sentence each.
    pub warnings: Vec<String>,
}

/// Words that say nothing about the surface: dropped without a warning. `mtllib` names another file, which is never
/// opened.
const SILENT: [&str; 10] = ["vt", "vn", "o", "g", "s", "mg", "mtllib", "usemtl", "usemap", "maplib"];

/// So many different skipped words are named in warnings.
const MAX_NAMED_WORDS: usize = 8;

pub fn run(bytes: &[u8]) -> Result<Clean, ObjError> {
    if bytes.len() > MAX_BYTES {
        return Err(ObjError::TooLong(bytes.len()));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(ObjError::Empty);
    }
    let mut pass = Pass::default();
    for line in Lines::new(bytes) {
        let (number, text) = line?;
        pass.line(number, &text).map_err(|fault| ObjError::Line { line: number, fault })?;
    }
    pass.finish()
}

/// The logical lines of a file: numbered from 1 by their first physical line, continuation lines joined, comments and
/// line ends cut off.
struct Lines<'a> {
    physical: lines::Lines<'a>,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self { physical: lines::Lines::new(bytes) }
    }

    fn next_physical(&mut self) -> Option<(usize, Result<&'a [u8], LineFault>)> {
        let (number, line) = self.physical.next()?;
        let line = line.map_err(|fault| match fault {
            Fault::Binary => LineFault::Binary,
            fault => LineFault::Shared(fault),
        });
        Some((number, line))
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Result<(usize, Cow<'a, str>), ObjError>;

    fn next(&mut self) -> Option<Self::Item> {
        let at = |line: usize| move |fault| ObjError::Line { line, fault };
        let (number, first) = self.next_physical()?;
        let mut line = match first.map_err(at(number)) {
            // Latin-1 in names and comments must not cost the file; in a number the replacement character is an error.
            Ok(bytes) => without_comment(String::from_utf8_lossy(bytes)),
            Err(e) => return Some(Err(e)),
        };
        while line.ends_with('\\') {
            let mut joined = line.into_owned();
            joined.pop();
            joined.push(' ');
            if let Some((next, bytes)) = self.next_physical() {
                match bytes.map_err(at(next)) {
                    Ok(bytes) => joined.push_str(&without_comment(String::from_utf8_lossy(bytes))),
                    Err(e) => return Some(Err(e)),
                }
            }
            if joined.len() > MAX_LINE_BYTES {
                return Some(Err(at(number)(Fault::LineTooLong.into())));
            }
            line = Cow::Owned(joined);
        }
        Some(Ok((number, line)))
    }
}

fn without_comment(line: Cow<'_, str>) -> Cow<'_, str> {
    match line.find('#') {
        None => line,
        Some(at) => match line {
            Cow::Borrowed(s) => Cow::Borrowed(&s[..at]),
            Cow::Owned(s) => Cow::Owned(s[..at].to_owned()),
        },
    }
}

#[derive(Default)]
struct Pass {
    clean: Clean,
    /// The largest index that named a vertex below it, with its line: allowed if the vertex comes.
    forward: Option<(i64, usize)>,
    /// Skipped words with their count and first line.
    skipped: Vec<(String, usize, usize)>,
    skipped_more: usize,
    /// Faces of one or two corners: count, first line.
    flat: (usize, usize),
    corners: Vec<usize>,
}

impl Pass {
    fn line(&mut self, number: usize, text: &str) -> Result<(), LineFault> {
        let mut words = text.split_whitespace();
        match words.next() {
            None => Ok(()),
            Some("v") => self.vertex(words),
            // `fo` is the old name of `f`.
            Some("f" | "fo") => self.face(number, words),
            Some(word) if SILENT.contains(&word) => Ok(()),
            Some(word) => {
                self.skip(number, word);
                Ok(())
            }
        }
    }

    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a str> + Clone) -> Result<(), LineFault> {
        if self.clean.vertex_count == MAX_VERTICES {
            return Err(Fault::TooManyVertices.into());
        }
        let count = words.clone().count();
        // 4 is x y z w; 6 and 7 are x y z and a colour, which is no geometry and is not looked at.
        if !matches!(count, 3 | 4 | 6 | 7) {
            return Err(LineFault::CoordinateCount(count));
        }
        let mut numbers = [1.0; 4];
        let taken = if count == 4 { 4 } else { 3 };
        self.clean.vertices.push('v');
        for (number, word) in numbers.iter_mut().zip(words.clone().take(taken)) {
            *number = word.parse::<f64>().map_err(|_| Fault::NotANumber(shown(word)))?;
            if !number.is_finite() {
                return Err(Fault::NotFinite(shown(word)).into());
            }
            let _ = write!(self.clean.vertices, " {word}");
        }
        self.clean.vertices.push('\n');
        let [x, y, z, w] = numbers;
        for (coordinate, word) in [x, y, z].into_iter().zip(words.clone()) {
            if !(coordinate / w).is_finite() {
                return Err(LineFault::Weight(words.clone().nth(3).map(shown).unwrap_or_default()));
            }
            bounded(coordinate / w, || shown(word))?;
        }
        self.clean.vertex_count += 1;
        Ok(())
    }

    fn face<'a>(&mut self, line: usize, words: impl Iterator<Item = &'a str>) -> Result<(), LineFault> {
        let above = self.clean.vertex_count;
        self.corners.clear();
        for word in words {
            let first = word.split('/').next().unwrap_or_default();
            let index: i64 = first.parse().map_err(|_| LineFault::NotAnIndex(shown(word)))?;
            let resolved = match index {
                0 => return Err(LineFault::IndexZero),
                1.. => {
                    if index as u64 > above as u64 && self.forward.is_none_or(|(most, _)| index > most) {
                        self.forward = Some((index, line));
                    }
                    index as usize
                }
                _ => {
                    (above as i64)
                        .checked_add(index)
                        .filter(|&i| i >= 0)
                        .ok_or(LineFault::IndexTooSmall { index, vertices: above })? as usize
                        + 1
                }
            };
            self.corners.push(resolved);
        }
        let n = self.corners.len();
        if n > MAX_CORNERS {
            return Err(Fault::TooManyCorners(n).into());
        }
        if n < 3 {
            self.flat = (self.flat.0 + 1, if self.flat.0 == 0 { line } else { self.flat.1 });
            return Ok(());
        }
        self.clean.triangle_count += n - 2;
        if self.clean.triangle_count > MAX_TRIANGLES {
            return Err(Fault::TooManyTriangles.into());
        }
        self.clean.faces.push('f');
        for i in &self.corners {
            let _ = write!(self.clean.faces, " {i}");
        }
        self.clean.faces.push('\n');
        Ok(())
    }

    fn skip(&mut self, line: usize, word: &str) {
        let word = shown(word);
        if let Some(known) = self.skipped.iter_mut().find(|(w, ..)| *w == word) {
            known.1 += 1;
        } else if self.skipped.len() < MAX_NAMED_WORDS {
            self.skipped.push((word, 1, line));
        } else {
            self.skipped_more += 1;
        }
    }

    fn finish(mut self) -> Result<Clean, ObjError> {
        let vertices = self.clean.vertex_count;
        if let Some((index, line)) = self.forward.filter(|&(index, _)| index as u64 > vertices as u64) {
            return Err(ObjError::Line { line, fault: LineFault::IndexTooLarge { index, vertices } });
        }
        let warnings = &mut self.clean.warnings;
        for (word, count, line) in &self.skipped {
            let meaning = match word.as_str() {
                "l" | "p" => "lines and points are not surfaces",
                "vp" | "cstype" | "deg" | "bmat" | "step" | "curv" | "curv2" | "surf" | "parm" | "trim" | "hole"
                | "scrv" | "sp" | "end" | "con" => "free-form curves and surfaces are not read",
                _ => "only vertices and faces are read",
            };
            warnings
                .push(format!("Skipped {count} line(s) starting with '{word}', the first in line {line}: {meaning}."));
        }
        if self.skipped_more > 0 {
            warnings.push(format!("Skipped {} more lines starting with other words.", self.skipped_more));
        }
        if self.flat.0 > 0 {
            let (count, line) = self.flat;
            warnings.push(format!("Skipped {count} face(s) with fewer than 3 corners, the first in line {line}."));
        }
        if self.clean.triangle_count == 0 {
            return Err(ObjError::NoFaces);
        }
        Ok(self.clean)
    }
}
