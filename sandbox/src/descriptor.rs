//! What a plugin says of one of its algorithms.

use ocb_core::query::Query;
use serde::{Deserialize, Serialize};

use crate::text::{is_label, one_line};

/// What a plugin says of one of its algorithms. Text is bounded, plain (`text.rs`) and unverified.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Descriptor {
    /// Unique id, e.g. `box-tree`.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Version as the plugin says it.
    pub version: String,
    /// Authors.
    pub authors: String,
    /// SPDX licence expression.
    pub license: String,
    /// Home page or source.
    pub url: String,
    /// The paper the method comes from.
    pub paper: String,
    /// The questions it answers.
    pub queries: Vec<Query>,
    /// It reports BV and primitive tests.
    pub counters: bool,
    /// It has distances with witness points; whether an answer carries them, the answer says.
    pub witness_points: bool,
    /// Computes in f32: its answers are judged in the wider band.
    pub single_precision: bool,
    /// It also answers for solid bodies.
    pub solid: bool,
    /// Earlier queries speed up later ones: the order of queries matters.
    pub coherent: bool,
    /// Can use several CPUs: it may enter the multi-threaded track.
    pub threads: bool,
    /// It loads scenes of many objects.
    pub scene: bool,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
}

/// A knob of an algorithm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// What it does.
    pub description: String,
    /// Smallest value.
    pub minimum: f64,
    /// Largest value.
    pub maximum: f64,
    /// Value when nothing is said.
    pub default: f64,
    /// Only whole numbers.
    pub integer: bool,
}

/// Longest text in a descriptor, bytes; also said in plugin.h.
const TEXT_BYTES: usize = 4096;
/// Longest id and name of a parameter.
const ID_BYTES: usize = 64;
/// Most parameters of one algorithm.
const PARAMETERS: usize = 64;

impl Descriptor {
    /// Cuts the text, strips what cannot be seen, refuses what breaks the interface's rules. The runner writes none of that,
    /// but a plugin may write where the runner has written.
    pub(crate) fn bounded(mut self) -> Result<Self, String> {
        if !is_id(&self.id, "-._") {
            let id = one_line(&self.id, ID_BYTES);
            return Err(format!("the algorithm id '{id}' breaks the rules of plugin.h: 1 to 64 of a-z 0-9 - . _"));
        }
        let id = &self.id;
        for text in
            [&mut self.name, &mut self.version, &mut self.authors, &mut self.license, &mut self.url, &mut self.paper]
        {
            *text = one_line(text, TEXT_BYTES);
        }
        for (field, text) in [
            ("name", &self.name),
            ("version", &self.version),
            ("authors", &self.authors),
            ("licence", &self.license),
            ("URL", &self.url),
        ] {
            if !is_label(text) {
                return Err(format!("the {field} of '{id}' holds '<' or '>'; write plain text"));
            }
        }
        for (i, query) in self.queries.iter().enumerate() {
            if self.queries[..i].contains(query) {
                return Err(format!("'{id}' lists the query {query:?} twice"));
            }
        }
        if self.parameters.len() > PARAMETERS {
            return Err(format!("'{id}' has {} parameters; at most {PARAMETERS} are allowed", self.parameters.len()));
        }
        for i in 0..self.parameters.len() {
            let (before, rest) = self.parameters.split_at_mut(i);
            rest[0].bounded(id, before)?;
        }
        Ok(self)
    }
}

impl Parameter {
    /// One of the algorithm `id`, behind these.
    fn bounded(&mut self, id: &str, before: &[Parameter]) -> Result<(), String> {
        self.description = one_line(&self.description, TEXT_BYTES);
        let Parameter { name, minimum, maximum, default, .. } = self;
        if !is_id(name, "_") {
            let name = one_line(name, ID_BYTES);
            return Err(format!(
                "the parameter name '{name}' of '{id}' breaks the rules of parameters.h: 1 to 64 of a-z 0-9 _"
            ));
        }
        if before.iter().any(|other| other.name == *name) {
            return Err(format!("'{id}' has the parameter '{name}' twice"));
        }
        let ordered = minimum <= default && default <= maximum;
        if !ordered || !minimum.is_finite() || !maximum.is_finite() {
            return Err(format!("parameter '{name}' of '{id}' has an invalid range"));
        }
        Ok(())
    }
}

/// A small letter, then small letters, digits and these.
fn is_id(text: &str, more: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || more.contains(c);
    text.starts_with(|c: char| c.is_ascii_lowercase()) && text.len() <= ID_BYTES && text.chars().all(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn good() -> Descriptor {
        let knob = Parameter {
            name: "leaf_size".into(),
            description: "Triangles, 0 < n.".into(),
            minimum: 1.0,
            maximum: 8.0,
            default: 4.0,
            integer: true,
        };
        Descriptor {
            id: "box-tree".into(),
            name: "Box tree".into(),
            version: "1.0".into(),
            authors: "Zoë".into(),
            license: "MIT".into(),
            url: "https://example.org".into(),
            paper: String::new(),
            queries: vec![Query::CollisionFirst, Query::Proximity],
            counters: false,
            witness_points: false,
            single_precision: false,
            solid: false,
            coherent: false,
            threads: false,
            scene: false,
            parameters: vec![knob],
        }
    }

    fn check_refused(change: impl Fn(&mut Descriptor), words: &str) {
        let mut descriptor = good();
        change(&mut descriptor);
        let reason = descriptor.bounded().unwrap_err();
        assert!(reason.contains(words), "{reason}");
    }

    #[test]
    fn a_good_one_stays_as_it_is() {
        assert_eq!(good().bounded(), Ok(good()));
    }

    #[test]
    fn a_list_holds_each_thing_once() {
        check_refused(|d| d.queries = vec![Query::Proximity; 12_000], "lists the query Proximity twice");
        check_refused(|d| d.parameters.push(d.parameters[0].clone()), "has the parameter 'leaf_size' twice");
        let many = |i: usize| Parameter { name: format!("p{i}"), ..good().parameters[0].clone() };
        check_refused(|d| d.parameters = (0..65).map(many).collect(), "65 parameters");
    }

    #[test]
    fn ids_are_plain_and_labels_hold_no_markup() {
        for id in ["", "Box", "box tree", "b\u{202e}ox", "1box", &"b".repeat(65)] {
            check_refused(|d| d.id = id.to_owned(), "plugin.h");
        }
        for name in ["", "Leaf", "leaf-size", "leaf\u{200b}", "<b>", &"b".repeat(65)] {
            check_refused(|d| d.parameters[0].name = name.to_owned(), "parameters.h");
        }
        check_refused(|d| d.name = "<img src=x>".into(), "the name of 'box-tree' holds '<' or '>'");
        check_refused(|d| d.authors = "A <a@example.org>".into(), "the authors of");
        check_refused(|d| d.license = "MIT>".into(), "the licence of");
    }

    #[test]
    fn what_cannot_be_seen_is_stripped() {
        let odd = Descriptor { name: "Box\u{202e} \u{200b}tree\n".into(), ..good() };
        assert_eq!(odd.bounded(), Ok(good()));
    }
}
