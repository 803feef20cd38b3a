//! XML of strangers, parsed within limits: COLLADA files, and descriptions of robots and scenes.
//!
//! Entities that a file declares (a DTD) are refused, so nothing is expanded and no other file is opened.

use roxmltree::{Document, ParsingOptions};

/// Most elements and pieces of text.
pub const MOST_NODES: u32 = 2_000_000;
/// Most attributes in all, most of one element and most declarations of namespaces: the parser compares those of an
/// element with each other, and an element with a declaration copies those around it.
pub const MOST_ATTRIBUTES: usize = 4_000_000;
/// See [`MOST_ATTRIBUTES`].
pub const MOST_OF_ONE: usize = 100;
/// See [`MOST_ATTRIBUTES`].
pub const MOST_NAMESPACES: usize = 1_000;

/// Why a text is no XML that is read. Lines are counted from 1.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum XmlError {
    /// More attributes than are read.
    #[error(
        "line {0}: more than {MOST_OF_ONE} attributes here, or {MOST_ATTRIBUTES} attributes or {MOST_NAMESPACES} namespaces in all"
    )]
    Attributes(usize),
    /// More elements than [`MOST_NODES`].
    #[error("it has more than {MOST_NODES} elements")]
    Nodes,
    /// It declares entities.
    #[error("it has a DTD, which is not read; remove its '<!DOCTYPE' part")]
    Dtd,
    /// The end is missing.
    #[error("line {0}: the file ends inside an element")]
    Cut(usize),
    /// Anything else, as the parser says it.
    #[error("line {line}: this is no XML ({reason})")]
    Syntax {
        /// Where.
        line: usize,
        /// Why.
        reason: String,
    },
}

/// Parses a text within the limits.
///
/// # Errors
/// The first fault, with its line.
pub fn parse(text: &str) -> Result<Document<'_>, XmlError> {
    let line_at = |at: usize| 1 + text.as_bytes()[..at].iter().filter(|&&b| b == b'\n').count();
    if let Some(at) = too_many_attributes(text.as_bytes()) {
        return Err(XmlError::Attributes(line_at(at)));
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|e| match e {
        roxmltree::Error::NodesLimitReached => XmlError::Nodes,
        roxmltree::Error::DtdDetected => XmlError::Dtd,
        // These have no position: the end is missing.
        roxmltree::Error::UnclosedRootNode | roxmltree::Error::UnexpectedEndOfStream | roxmltree::Error::NoRootNode => {
            XmlError::Cut(line_at(text.len()))
        }
        e => {
            let said = e.to_string();
            let reason = said.split(" at ").next().unwrap_or_default().chars().filter(|c| !c.is_control());
            XmlError::Syntax { line: e.pos().row as usize, reason: reason.take(120).collect() }
        }
    })
}

/// The byte at which there are too many attributes: found before parsing, since an attribute takes more room in memory
/// than in the file, and comparing those of one element takes the square of their number.
fn too_many_attributes(text: &[u8]) -> Option<usize> {
    let (mut all, mut here, mut namespaces, mut inside) = (0, 0, 0, false);
    for (at, &byte) in text.iter().enumerate() {
        match byte {
            // Neither a comment nor a declaration has attributes.
            b'<' => (inside, here) = (!matches!(text.get(at + 1), Some(b'!' | b'?')), 0),
            b'>' => inside = false,
            b'=' if inside => (all, here) = (all + 1, here + 1),
            b'x' if inside && text[at..].starts_with(b"xmlns") => namespaces += 1,
            _ => {}
        }
        if here > MOST_OF_ONE || all > MOST_ATTRIBUTES || namespaces > MOST_NAMESPACES {
            return Some(at);
        }
    }
    None
}
