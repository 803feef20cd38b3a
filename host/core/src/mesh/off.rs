//! OFF, as text: counts, then one line per vertex and one per face. Vertices are numbered from 0. Normals, colours and
//! texture coordinates are ignored, and so is all that follows the corners of a face. The number of edges is not used.

#[cfg(test)]
mod tests;

use std::borrow::Cow;

use nalgebra::Point3;

use super::read::limits::{MAX_CORNERS, MAX_TRIANGLES, MAX_VERTICES};
use super::read::lines::Lines;
use super::read::surface::Surface;
use super::read::words::{coordinate, shown};
use super::read::{Contents, Fault, Place, ReadError, without_mark};

/// What may stand before `OFF`: texture coordinates, colours and normals with each vertex, in this order. (`4` and `n` would
/// be other dimensions.)
const PREFIXES: [&str; 8] = ["", "ST", "C", "N", "CN", "STC", "STN", "STCN"];

/// Does the first word outside of comments end with `OFF`, or with `OFF` and a number? (Files of ModelNet lack the line
/// end in between.)
pub fn is_off(text: &[u8]) -> bool {
    let mut lines = text.split(|&b| b == b'\n' || b == b'\r').map(<[u8]>::trim_ascii);
    let Some(line) = lines.find(|line| !line.is_empty() && !line.starts_with(b"#")) else { return false };
    let word = line.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    let word = word.trim_ascii_end();
    let Some(at) = word.windows(3).position(|w| w == b"OFF") else { return false };
    let (before, after) = (&word[..at], &word[at + 3..]);
    before.iter().all(|b| b"STCN4n".contains(b)) && after.iter().all(u8::is_ascii_digit)
}

/// Reads coordinates in double precision.
pub fn read(bytes: &[u8]) -> Result<Contents, ReadError> {
    let mut rows = Rows { lines: Lines::new(without_mark(bytes)) };
    let (number, head) = rows.next(|| "its first line".to_owned())?;
    let at = Place::Line(number);
    let (kind, rest) = head.split_at(head.find("OFF").map_or(head.len(), |at| at + 3));
    if !PREFIXES.contains(&kind.strip_suffix("OFF").unwrap_or("?")) {
        return Err(at.has(format!(
            "'{}' has vertices that are not in three dimensions; export the object as a plain OFF file",
            shown(kind)
        )));
    }
    if rest.trim_start().to_ascii_uppercase().starts_with("BINARY") {
        return Err(at.has("binary OFF files are not read; export the object as text"));
    }
    let (at, counts) = if rest.trim().is_empty() {
        let (number, counts) = rows.next(|| "the counts of vertices and faces".to_owned())?;
        (Place::Line(number), counts)
    } else {
        (at, Cow::Owned(rest.to_owned()))
    };
    let counts: Vec<&str> = counts.split_whitespace().collect();
    let count = |word: &&str| {
        word.parse::<usize>()
            .map_err(|_| at.clone().has(format!("'{}' is not a count; write 'VERTICES FACES EDGES'", shown(word))))
    };
    let [vertices, faces, ..] = counts[..] else {
        return Err(at.has("the counts of vertices and faces belong here; write them like '8 6 12'"));
    };
    let (vertices, faces) = (count(&vertices)?, count(&faces)?);
    if vertices > MAX_VERTICES {
        return Err(at.has(Fault::TooManyVertices));
    }
    if faces > MAX_TRIANGLES {
        return Err(at.has(Fault::TooManyTriangles));
    }
    if faces == 0 {
        return Err(at.has("the file has no faces; export a surface, not points"));
    }
    let mut surface = Surface::default();
    for i in 0..vertices {
        let (number, line) = rows.next_of("vertices", i, vertices)?;
        vertex(&line, &mut surface).map_err(|fault| Place::Line(number).has(fault))?;
    }
    let mut corners = Vec::new();
    for i in 0..faces {
        let (number, line) = rows.next_of("faces", i, faces)?;
        face(&line, &mut corners, &mut surface).map_err(|fault| Place::Line(number).has(fault))?;
    }
    let mut warnings = Vec::new();
    Ok((surface.finish(&mut warnings)?, warnings))
}

fn vertex(line: &str, surface: &mut Surface) -> Result<(), Fault> {
    let numbers = line.split_whitespace().take(3).map(coordinate).collect::<Result<Vec<_>, _>>()?;
    let [x, y, z] = numbers[..] else {
        return Err(format!("a vertex needs 3 coordinates, but here are {} numbers", numbers.len()).into());
    };
    surface.vertex(Point3::new(x, y, z))
}

fn face(line: &str, corners: &mut Vec<u32>, surface: &mut Surface) -> Result<(), Fault> {
    let mut words = line.split_whitespace();
    let word = words.next().unwrap_or_default();
    let count: usize = word.parse().map_err(|_| {
        Fault::from(format!("'{}' is not a number of corners; write faces like '3 0 1 2'", shown(word)))
    })?;
    if count > MAX_CORNERS {
        return Err(Fault::TooManyCorners(count));
    }
    corners.clear();
    for word in words.take(count) {
        let index: i64 = word.parse().map_err(|_| {
            Fault::from(format!("'{}' is not a vertex number; write faces like '3 0 1 2'", shown(word)))
        })?;
        corners.push(u32::try_from(index).map_err(|_| Fault::NoSuchVertex { index, vertices: surface.vertices() })?);
    }
    if corners.len() < count {
        return Err(format!("a face of {count} corners, but here are {} vertex numbers", corners.len()).into());
    }
    surface.face(corners)
}

/// Lines that hold something: comments and empty lines left out.
struct Rows<'a> {
    lines: Lines<'a>,
}

impl<'a> Rows<'a> {
    fn next(&mut self, expected: impl FnOnce() -> String) -> Result<(usize, Cow<'a, str>), ReadError> {
        for (number, line) in &mut self.lines {
            let line = line.map_err(|fault| Place::Line(number).has(fault))?;
            let text = line.split(|&b| b == b'#').next().unwrap_or_default().trim_ascii();
            if !text.is_empty() {
                return Ok((number, String::from_utf8_lossy(text)));
            }
        }
        Err(Place::Line(self.lines.number())
            .has(format!("the file ends before {}; export or download it again", expected())))
    }

    fn next_of(&mut self, what: &str, read: usize, promised: usize) -> Result<(usize, Cow<'a, str>), ReadError> {
        self.next(|| format!("the last of its {promised} {what} ({read} are there)"))
    }
}
