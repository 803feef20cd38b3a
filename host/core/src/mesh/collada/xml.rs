//! The XML under a COLLADA file.

use std::cell::Cell;
use std::collections::HashMap;

use roxmltree::{Document, Node};

use crate::mesh::read::words::shown;
use crate::mesh::read::{Place, ReadError};
use crate::xml::{self, MOST_ATTRIBUTES, MOST_NAMESPACES, MOST_NODES, MOST_OF_ONE, XmlError};

/// Most elements and numbers that are looked at, counted each time: what a file refers to again is read again.
const MOST_STEPS: usize = 100_000_000;

/// Parses the text; entities of its own (a DTD) are refused.
pub fn parse(text: &str) -> Result<Document<'_>, ReadError> {
    xml::parse(text).map_err(|e| match e {
        XmlError::Attributes(line) => Place::Line(line).has(format!(
            "more than {MOST_OF_ONE} attributes here, or {MOST_ATTRIBUTES} attributes or {MOST_NAMESPACES} namespaces \
             in all; export the object again"
        )),
        XmlError::Nodes => {
            ReadError::Whole(format!("the COLLADA file has more than {MOST_NODES} elements; join its meshes").into())
        }
        XmlError::Dtd => {
            ReadError::Whole("the COLLADA file has a DTD, which is not read; remove its '<!DOCTYPE' part".into())
        }
        XmlError::Cut(line) => Place::Line(line).has("the file ends inside an element; export or download it again"),
        XmlError::Syntax { line, reason } => {
            Place::Line(line).has(format!("this is no XML ({reason}); export the object again"))
        }
    })
}

/// A parsed file, and its elements by their ids.
pub struct File<'a> {
    document: &'a Document<'a>,
    by_id: HashMap<&'a str, Node<'a, 'a>>,
    steps: Cell<usize>,
}

impl<'a> File<'a> {
    pub fn new(document: &'a Document<'a>) -> Self {
        let mut by_id = HashMap::new();
        for node in document.descendants().filter(Node::is_element) {
            if let Some(id) = node.attribute("id") {
                by_id.entry(id).or_insert(node);
            }
        }
        Self { document, by_id, steps: Cell::new(0) }
    }

    pub fn root(&self) -> Node<'a, 'a> {
        self.document.root_element()
    }

    /// Counts an element or a number that is looked at.
    pub fn step(&self) -> Result<(), ReadError> {
        self.steps.set(self.steps.get() + 1);
        if self.steps.get() <= MOST_STEPS {
            return Ok(());
        }
        Err(ReadError::Whole("the COLLADA file refers to the same elements too often; export the object again".into()))
    }

    /// The elements directly below a node.
    pub fn elements(&self, node: Node<'a, 'a>) -> Result<Vec<Node<'a, 'a>>, ReadError> {
        let mut found = Vec::new();
        for below in node.children() {
            self.step()?;
            if below.is_element() {
                found.push(below);
            }
        }
        Ok(found)
    }

    /// The elements of one name directly below a node.
    pub fn named(&self, node: Node<'a, 'a>, name: &str) -> Result<Vec<Node<'a, 'a>>, ReadError> {
        let mut found = self.elements(node)?;
        found.retain(|n| is(*n, name));
        Ok(found)
    }

    /// The first element of one name directly below a node.
    pub fn child(&self, node: Node<'a, 'a>, name: &str) -> Result<Option<Node<'a, 'a>>, ReadError> {
        Ok(self.named(node, name)?.first().copied())
    }

    /// The line of an element, or of a piece of text. It is counted from the beginning of the file: for messages only.
    pub fn line(&self, node: Node<'_, '_>) -> usize {
        self.document.text_pos_at(node.range().start).row as usize
    }

    /// The line of a word in a piece of text.
    pub fn line_of_word(&self, text: Node<'_, '_>, word: &str) -> usize {
        let all = text.text().unwrap_or_default();
        let before = (word.as_ptr() as usize).saturating_sub(all.as_ptr() as usize).min(all.len());
        self.line(text) + all.as_bytes()[..before].iter().filter(|&&b| b == b'\n').count()
    }

    /// The element that an attribute refers to: `#id`, in this file.
    pub fn referred(&self, from: Node<'a, 'a>, attribute: &str) -> Result<Node<'a, 'a>, ReadError> {
        let at = || Place::Line(self.line(from));
        let Some(address) = from.attribute(attribute) else {
            return Err(at().has(format!("'{}' has no '{attribute}'; export the object again", from.tag_name().name())));
        };
        let Some(id) = address.strip_prefix('#') else {
            return Err(at().has(format!(
                "'{}' is in another file, which is not opened; export everything into one file",
                shown(address)
            )));
        };
        self.by_id.get(id).copied().ok_or_else(|| {
            at().has(format!("it refers to '{}', which is not there; export the object again", shown(address)))
        })
    }

    /// A whole number in an attribute.
    pub fn whole(&self, node: Node<'_, '_>, attribute: &str, default: u64) -> Result<u64, ReadError> {
        let Some(word) = node.attribute(attribute) else { return Ok(default) };
        word.trim().parse().map_err(|_| {
            Place::Line(self.line(node))
                .has(format!("{attribute} '{}' is not a whole number; export the object again", shown(word)))
        })
    }
}

/// Is it an element of this name, in whatever namespace?
pub fn is(node: Node<'_, '_>, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

/// The words of an element's text, each with the piece of text that it stands in.
pub fn words<'a>(node: Node<'a, 'a>) -> impl Iterator<Item = (Node<'a, 'a>, &'a str)> {
    let pieces = node.children().filter(Node::is_text);
    pieces.flat_map(|piece| piece.text().unwrap_or_default().split_ascii_whitespace().map(move |word| (piece, word)))
}
