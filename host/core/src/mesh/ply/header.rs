//! The head of a PLY file: always text, up to `end_header`.

use crate::mesh::read::limits::MAX_LINE_BYTES;
use crate::mesh::read::words::shown;
use crate::mesh::read::{Fault, Place, ReadError};

/// Most elements and properties together; files have about ten.
const MOST_ENTRIES: usize = 1_000;

/// What the head says of the body.
pub struct Header {
    pub encoding: Encoding,
    /// In the order of the body.
    pub elements: Vec<Element>,
    /// The first byte of the body.
    pub body: usize,
    /// Lines above the body.
    pub lines: usize,
}

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// Entries of one kind.
pub struct Element {
    pub name: String,
    /// As promised; nothing is allocated for it.
    pub count: u64,
    pub properties: Vec<Property>,
    /// Where it is declared.
    pub line: usize,
}

/// A number of each entry, or a list of numbers.
pub struct Property {
    pub name: String,
    pub kind: Kind,
    /// Type of the length, where it is a list.
    pub length: Option<Kind>,
}

/// A type of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn named(word: &str) -> Result<Self, Fault> {
        Ok(match word {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => {
                return Err(
                    format!("'{}' is no type of PLY; use one like 'float', 'int' or 'uchar'", shown(word)).into()
                );
            }
        })
    }

    /// Bytes of a number in a binary body.
    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Header {
    /// The index of the element with this name.
    pub fn element(&self, name: &str) -> Option<usize> {
        self.elements.iter().position(|e| e.name == name)
    }

    pub fn read(bytes: &[u8]) -> Result<Self, ReadError> {
        // The first line shows how lines end; a body in bytes may begin with anything.
        let end = if bytes.get(3) == Some(&b'\r') && bytes.get(4) != Some(&b'\n') { b'\r' } else { b'\n' };
        let (mut at, mut lines, mut entries) = (0, 0, 0);
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        loop {
            let place = Place::Line(lines + 1);
            let rest = bytes.get(at..).unwrap_or_default();
            let length = rest.iter().take(MAX_LINE_BYTES).position(|&b| b == end);
            let length = length
                .ok_or_else(|| place.clone().has("the header has no line 'end_header'; export the object again"))?;
            (at, lines) = (at + length + 1, lines + 1);
            let line = String::from_utf8_lossy(&rest[..length]);
            let words: Vec<&str> = line.split_whitespace().collect();
            let said = match words[..] {
                ["end_header"] => break,
                [] | ["ply" | "comment" | "obj_info", ..] => Ok(()),
                ["format", name, ..] => encoding_named(name).map(|known| encoding = Some(known)),
                ["element", name, count] => element(name, count, lines, &mut elements),
                ["element", ..] => Err("an element has a name and a count; write it like 'element vertex 8'".into()),
                ["property", ref rest @ ..] => property(rest, &mut elements),
                [word, ..] => {
                    Err(Fault::from(format!("'{}' is no word of a PLY header; export the object again", shown(word))))
                }
            };
            said.map_err(|fault| place.clone().has(fault))?;
            entries += usize::from(matches!(words[..], ["element" | "property", ..]));
            if entries > MOST_ENTRIES {
                return Err(place
                    .has(format!("more than {MOST_ENTRIES} elements and properties; export only vertices and faces")));
            }
        }
        let encoding = encoding.ok_or_else(|| {
            Place::Line(2).has("the header has no line like 'format ascii 1.0'; export the object again")
        })?;
        Ok(Self { encoding, elements, body: at, lines })
    }
}

fn encoding_named(word: &str) -> Result<Encoding, Fault> {
    match word {
        "ascii" => Ok(Encoding::Text),
        "binary_little_endian" => Ok(Encoding::LittleEndian),
        "binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(format!("'{}' is no format of PLY; use 'ascii' or 'binary_little_endian'", shown(word)).into()),
    }
}

fn element(name: &str, count: &str, line: usize, elements: &mut Vec<Element>) -> Result<(), Fault> {
    if elements.iter().any(|e| e.name == name) {
        return Err(format!("a second element '{}'; export the object again", shown(name)).into());
    }
    let count = count
        .parse()
        .map_err(|_| Fault::from(format!("'{}' is not a count; write one like 'element vertex 8'", shown(count))))?;
    elements.push(Element { name: name.to_owned(), count, properties: Vec::new(), line });
    Ok(())
}

fn property(words: &[&str], elements: &mut [Element]) -> Result<(), Fault> {
    let (kind, length, name) = match *words {
        ["list", length, kind, name] => (Kind::named(kind)?, Some(Kind::named(length)?), name),
        [kind, name] => (Kind::named(kind)?, None, name),
        _ => return Err("a property has a type and a name; write it like 'property float x'".into()),
    };
    if matches!(length, Some(Kind::F32 | Kind::F64)) {
        return Err("the length of a list must be a whole number; use a type like 'uchar'".into());
    }
    let element = elements.last_mut().ok_or("a property belongs below its element; export the object again")?;
    element.properties.push(Property { name: name.to_owned(), kind, length });
    Ok(())
}
