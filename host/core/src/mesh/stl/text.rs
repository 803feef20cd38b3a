//! Text STL: `facet normal`, `outer loop`, three `vertex` lines, `endloop`, `endfacet`; words in any case.

use super::Soup;
use crate::mesh::read::lines::Lines;
use crate::mesh::read::words::{coordinate, shown};
use crate::mesh::read::{Fault, Place, ReadError, without_mark};

/// Does the first word read `solid`?
pub fn is_text(bytes: &[u8]) -> bool {
    let text = without_mark(bytes).trim_ascii_start();
    text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
        && text.get(5).is_none_or(u8::is_ascii_whitespace)
}

/// Reads one or several solids. Numbers are read in double precision, since text may carry it.
pub fn read(bytes: &[u8], soup: &mut Soup) -> Result<(), ReadError> {
    let mut reader = Reader { soup, corners: Vec::new(), inside: Inside::Nothing };
    let mut lines = Lines::new(without_mark(bytes));
    for (number, line) in &mut lines {
        let line = line.map_err(|fault| Place::Line(number).has(fault))?;
        reader.line(&String::from_utf8_lossy(line)).map_err(|fault| Place::Line(number).has(fault))?;
    }
    match reader.inside {
        Inside::Nothing => Ok(()),
        _ => Err(Place::Line(lines.number())
            .has("the file ends before 'endsolid', so part of it is missing; export or download it again")),
    }
}

/// What the current line is inside of.
#[derive(Clone, Copy, PartialEq)]
enum Inside {
    Nothing,
    Solid,
    Facet,
}

struct Reader<'a> {
    soup: &'a mut Soup,
    corners: Vec<[f64; 3]>,
    inside: Inside,
}

impl Reader<'_> {
    fn line(&mut self, line: &str) -> Result<(), Fault> {
        let mut words = line.split_whitespace();
        let Some(word) = words.next() else { return Ok(()) };
        let lower = word.to_ascii_lowercase();
        match (lower.as_str(), self.inside) {
            ("solid", Inside::Nothing) => self.inside = Inside::Solid,
            ("facet", Inside::Solid) => self.inside = Inside::Facet,
            ("outer" | "endloop", Inside::Facet) => {}
            ("vertex", Inside::Facet) => self.vertex(words)?,
            ("endfacet", Inside::Facet) => {
                let [a, b, c] = self.corners[..] else {
                    let count = self.corners.len();
                    return Err(format!("a facet has 3 vertices, but this one has {count}; repair that facet").into());
                };
                self.soup.facet([a, b, c])?;
                self.corners.clear();
                self.inside = Inside::Solid;
            }
            ("endsolid", Inside::Solid) => self.inside = Inside::Nothing,
            ("solid" | "facet" | "outer" | "vertex" | "endloop" | "endfacet" | "endsolid", _) => {
                return Err(
                    format!("'{lower}' is out of place here; a line above is missing, so export it again").into()
                );
            }
            _ => {
                return Err(format!("'{}' is no word of an STL file; export the object again", shown(word)).into());
            }
        }
        Ok(())
    }

    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), Fault> {
        if self.corners.len() == 3 {
            return Err("a facet has 3 vertices, but this is another; cut the facet into triangles".into());
        }
        let numbers = words.take(4).map(coordinate).collect::<Result<Vec<_>, _>>()?;
        let [x, y, z] = numbers[..] else {
            return Err("a vertex needs 3 coordinates; write it like 'vertex 1 0 -2.5'".into());
        };
        self.corners.push([x, y, z]);
        Ok(())
    }
}
