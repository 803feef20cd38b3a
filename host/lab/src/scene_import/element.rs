//! XML as a tree that outlives its text: elements with their lines, and their attributes as numbers.

use std::sync::Arc;

use ocb_core::mesh::MAX_COORDINATE;
use ocb_core::xml;
use roxmltree::{Document, Node};

use super::{Found, shown};

/// Deepest nesting: the tree is walked by functions that call themselves.
pub const MOST_DEPTH: usize = 256;

/// An element with its content.
#[derive(Clone, Debug)]
pub struct Element {
    /// Its name, without its namespace.
    pub name: String,
    /// The elements in it, in the order of the file.
    pub children: Vec<Element>,
    /// The text directly in it, without white space around it.
    pub text: String,
    attributes: Vec<(String, String)>,
    line: usize,
    /// Where it was included from; absent in the file that is imported.
    file: Option<Arc<str>>,
}

impl Element {
    /// The root of a file; `file` names it in messages, where it is not the one that is imported.
    pub fn root(bytes: &[u8], file: Option<&str>) -> Found<Self> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        // Names may be in Latin-1; what is not ASCII in a number is refused there.
        let text = String::from_utf8_lossy(bytes);
        let inside = |why: String| file.map_or_else(|| why.clone(), |file| format!("{}: {why}", shown(file)));
        let document = xml::parse(&text).map_err(|why| inside(why.to_string()))?;
        let mut reading = Reading { document: &document, at: 0, line: 1, file: file.map(Arc::from) };
        reading.element(document.root_element(), 0).map_err(inside)
    }

    /// An attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// All attributes.
    pub fn attributes(&self) -> &[(String, String)] {
        &self.attributes
    }

    /// Sets an attribute that it does not have.
    pub fn set(&mut self, name: &str, value: &str) {
        self.attributes.push((name.to_owned(), value.to_owned()));
    }

    /// An attribute that must be there and not be empty.
    pub fn required(&self, name: &str) -> Found<&str> {
        let value = self.attribute(name).map(str::trim).filter(|value| !value.is_empty());
        value.ok_or_else(|| self.fault(&format!("<{}> has no {name}", self.name)))
    }

    /// The first element of this name directly in it.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|child| child.name == name)
    }

    /// The elements of this name directly in it.
    pub fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |child| child.name == name)
    }

    /// So many numbers in an attribute, if it is there.
    pub fn numbers<const N: usize>(&self, name: &str) -> Found<Option<[f64; N]>> {
        let Some(text) = self.attribute(name) else { return Ok(None) };
        let numbers = self.parse(name, text)?;
        numbers.try_into().map(Some).map_err(|found: Vec<f64>| self.count(name, N, found.len()))
    }

    /// As many numbers as there are in an attribute, if it is there.
    pub fn list(&self, name: &str) -> Found<Option<Vec<f64>>> {
        self.attribute(name).map(|text| self.parse(name, text)).transpose()
    }

    /// A number in an attribute, if it is there.
    pub fn number(&self, name: &str) -> Found<Option<f64>> {
        Ok(self.numbers::<1>(name)?.map(|[x]| x))
    }

    /// A number in an attribute that must be there.
    pub fn required_number(&self, name: &str) -> Found<f64> {
        self.required(name)?;
        Ok(self.number(name)?.unwrap_or_default())
    }

    /// So many numbers in its text.
    pub fn text_numbers<const N: usize>(&self) -> Found<[f64; N]> {
        let numbers = self.parse(&self.name, &self.text)?;
        numbers.try_into().map_err(|found: Vec<f64>| self.count(&self.name, N, found.len()))
    }

    /// A sentence about this place.
    pub fn fault(&self, why: &str) -> String {
        match &self.file {
            None => format!("line {}: {why}", self.line),
            Some(file) => format!("line {} of {}: {why}", self.line, shown(file)),
        }
    }

    fn count(&self, name: &str, wanted: usize, found: usize) -> String {
        self.fault(&format!("{name} needs {wanted} number(s) and has {found}"))
    }

    fn parse(&self, name: &str, text: &str) -> Found<Vec<f64>> {
        let number = |word: &str| {
            let number: Option<f64> = word.parse().ok().filter(|x: &f64| x.abs() <= MAX_COORDINATE);
            number.ok_or_else(|| {
                self.fault(&format!("{} in {name} is not a number up to {MAX_COORDINATE:e}", shown(word)))
            })
        };
        text.split_ascii_whitespace().map(number).collect()
    }
}

/// Elements are read in the order of the file, so that its lines are counted once.
struct Reading<'a> {
    document: &'a Document<'a>,
    at: usize,
    line: usize,
    file: Option<Arc<str>>,
}

impl Reading<'_> {
    fn element(&mut self, node: Node<'_, '_>, depth: usize) -> Found<Element> {
        let start = node.range().start;
        let between = &self.document.input_text().as_bytes()[self.at..start];
        self.line += between.iter().filter(|&&byte| byte == b'\n').count();
        self.at = start;
        if depth > MOST_DEPTH {
            return Err(format!("line {}: elements are nested more than {MOST_DEPTH} deep", self.line));
        }
        let attributes = node.attributes().map(|it| (it.name().to_owned(), it.value().to_owned())).collect();
        let mut element = Element {
            name: node.tag_name().name().to_owned(),
            children: Vec::new(),
            text: node.text().unwrap_or_default().trim().to_owned(),
            attributes,
            line: self.line,
            file: self.file.clone(),
        };
        for child in node.children().filter(Node::is_element) {
            element.children.push(self.element(child, depth + 1)?);
        }
        Ok(element)
    }
}
