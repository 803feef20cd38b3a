//! The body of a PLY file: numbers one after the other, as words or as bytes.

use std::borrow::Cow;

use super::header::{Element, Encoding, Header, Kind, Property};
use crate::mesh::read::lines::Lines;
use crate::mesh::read::words::{coordinate, shown};
use crate::mesh::read::{Fault, Place, ReadError};

/// Where reading has come to. Each entry of an element is a line of a text.
pub enum Body<'a> {
    Text { lines: Lines<'a>, line: Cow<'a, str>, at: usize },
    Bytes { bytes: &'a [u8], at: usize, big_endian: bool },
}

impl<'a> Body<'a> {
    pub fn new(bytes: &'a [u8], header: &Header) -> Self {
        match header.encoding {
            Encoding::Text => {
                let lines = Lines::below(&bytes[header.body..], header.lines);
                Self::Text { lines, line: Cow::Borrowed(""), at: 0 }
            }
            Encoding::LittleEndian => Self::Bytes { bytes, at: header.body, big_endian: false },
            Encoding::BigEndian => Self::Bytes { bytes, at: header.body, big_endian: true },
        }
    }

    /// The line, or the byte that is read next.
    pub fn place(&self) -> Place {
        match self {
            Self::Text { lines, .. } => Place::Line(lines.number()),
            Self::Bytes { at, .. } => Place::Byte(*at),
        }
    }

    /// Goes to the next entry of an element, number `i` from 0.
    pub fn begin(&mut self, element: &Element, i: u64) -> Result<(), ReadError> {
        let ends = |place: Place| {
            let (name, count) = (shown(&element.name), element.count);
            place.has(format!(
                "the file ends after {i} of {count} entries of the element '{name}'; export or download it again"
            ))
        };
        match self {
            Self::Text { lines, line, at } => loop {
                let Some((number, text)) = lines.next() else { return Err(ends(Place::Line(lines.number()))) };
                let text = text.map_err(|fault| Place::Line(number).has(fault))?;
                if !text.trim_ascii().is_empty() {
                    (*line, *at) = (String::from_utf8_lossy(text), 0);
                    return Ok(());
                }
            },
            Self::Bytes { bytes, at, .. } if *at == bytes.len() && !element.properties.is_empty() => {
                Err(ends(Place::Byte(*at)))
            }
            Self::Bytes { .. } => Ok(()),
        }
    }

    /// Ends an entry: its line must hold nothing more.
    pub fn end(&mut self) -> Result<(), ReadError> {
        let Self::Text { line, at, .. } = self else { return Ok(()) };
        if line[*at..].trim().is_empty() {
            return Ok(());
        }
        Err(self.place().has("the line has more numbers than the header declares; correct the header or the line"))
    }

    /// A number that may have a fraction.
    pub fn number(&mut self, kind: Kind) -> Result<f64, ReadError> {
        let place = self.place();
        match self {
            Self::Text { .. } => {
                let word = self.word()?;
                let exact = coordinate(word).map_err(|fault| place.has(fault))?;
                // Rounded once, from the decimal number.
                Ok(if kind == Kind::F32 { f64::from(word.parse::<f32>().unwrap_or(exact as f32)) } else { exact })
            }
            Self::Bytes { big_endian, .. } => {
                let big_endian = *big_endian;
                let bytes = self.take(kind.bytes())?;
                Ok(match kind {
                    Kind::F32 => f64::from(f32::from_le_bytes(ordered(bytes, big_endian))),
                    Kind::F64 => f64::from_le_bytes(ordered(bytes, big_endian)),
                    _ => whole(kind, bytes, big_endian) as f64,
                })
            }
        }
    }

    /// A whole number.
    pub fn whole(&mut self, kind: Kind) -> Result<i64, ReadError> {
        let place = self.place();
        match self {
            Self::Text { .. } => {
                let word = self.word()?;
                let fault = || format!("'{}' is not a whole number; write lists like '3 0 1 2'", shown(word));
                word.parse().map_err(|_| place.has(fault()))
            }
            Self::Bytes { big_endian, .. } => {
                let big_endian = *big_endian;
                Ok(whole(kind, self.take(kind.bytes())?, big_endian))
            }
        }
    }

    /// The length of a list.
    pub fn length(&mut self, kind: Kind) -> Result<u64, ReadError> {
        let place = self.place();
        let length = self.whole(kind)?;
        u64::try_from(length).map_err(|_| place.has(format!("a list of length {length}; export the object again")))
    }

    /// Passes over a property.
    pub fn skip_property(&mut self, property: &Property) -> Result<(), ReadError> {
        let count = property.length.map_or(Ok(1), |kind| self.length(kind))?;
        match self {
            Self::Text { .. } => (0..count).try_for_each(|_| self.word().map(|_| ())),
            Self::Bytes { .. } => {
                let bytes = count.saturating_mul(property.kind.bytes() as u64);
                self.take(bytes.try_into().unwrap_or(usize::MAX)).map(|_| ())
            }
        }
    }

    /// Passes over all entries of an element.
    pub fn skip(&mut self, element: &Element) -> Result<(), ReadError> {
        // In bytes, an entry without properties takes no room: its number must not cost time.
        if matches!(self, Self::Bytes { .. }) && element.properties.is_empty() {
            return Ok(());
        }
        for i in 0..element.count {
            self.begin(element, i)?;
            element.properties.iter().try_for_each(|property| self.skip_property(property))?;
        }
        Ok(())
    }

    fn word(&mut self) -> Result<&str, ReadError> {
        let place = self.place();
        let Self::Text { line, at, .. } = self else { return Ok("") };
        let rest = &line[*at..];
        let start = *at + (rest.len() - rest.trim_start().len());
        let word = line[start..].split_whitespace().next();
        let word = word.ok_or_else(|| {
            place.has("the line has fewer numbers than the header declares; correct the header or the line")
        })?;
        *at = start + word.len();
        Ok(word)
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], ReadError> {
        let Self::Bytes { bytes, at, .. } = self else { return Ok(&[]) };
        let end = at.checked_add(count).filter(|&end| end <= bytes.len());
        let end = end.ok_or_else(|| {
            Place::Byte(*at).has(Fault::from("the file ends inside an entry; export or download it again"))
        })?;
        let taken = &bytes[*at..end];
        *at = end;
        Ok(taken)
    }
}

/// The bytes of a number, lowest first.
fn ordered<const N: usize>(bytes: &[u8], big_endian: bool) -> [u8; N] {
    let mut array = [0; N];
    array.copy_from_slice(bytes);
    if big_endian {
        array.reverse();
    }
    array
}

fn whole(kind: Kind, bytes: &[u8], big_endian: bool) -> i64 {
    match kind {
        Kind::I8 => i64::from(i8::from_le_bytes(ordered(bytes, big_endian))),
        Kind::U8 => i64::from(u8::from_le_bytes(ordered(bytes, big_endian))),
        Kind::I16 => i64::from(i16::from_le_bytes(ordered(bytes, big_endian))),
        Kind::U16 => i64::from(u16::from_le_bytes(ordered(bytes, big_endian))),
        Kind::I32 => i64::from(i32::from_le_bytes(ordered(bytes, big_endian))),
        Kind::U32 => i64::from(u32::from_le_bytes(ordered(bytes, big_endian))),
        // The header was refused: neither lengths nor vertex numbers are floats.
        Kind::F32 | Kind::F64 => 0,
    }
}
