//! How something is cited, as BibTeX and as CFF 1.2.0. Titles and names come from anybody: whatever is in them, the text stays
//! one entry with these fields.
#![forbid(unsafe_code)]

mod bibtex;
mod cff;
mod date;

pub use bibtex::bibtex;
pub use cff::cff;

/// What is cited.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Work {
    /// What it is.
    pub kind: Kind,
    /// What a text calls it: letters, digits and hyphens.
    pub key: String,
    /// Its title.
    pub title: String,
    /// Who made it.
    pub authors: Vec<String>,
    /// When, in microseconds since the Unix epoch.
    pub at_us: i64,
    /// Its stable link.
    pub url: String,
    /// Its version.
    pub version: Option<String>,
    /// Its licence, one SPDX identifier.
    pub license: Option<String>,
    /// Where its source is.
    pub source: Option<String>,
    /// A sentence or two.
    pub summary: String,
}

/// What is cited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Numbers.
    Dataset,
    /// A program.
    Software,
}

/// The names in a free text: `Ada Lovelace, Charles Babbage <cb@example.org>` or `Lovelace, Ada; Babbage, Charles`.
pub fn names(text: &str) -> Vec<String> {
    let ends: &[&str] = if text.contains(';') { &[";", " and "] } else { &[",", "&", " and "] };
    let mut parts = vec![text.to_owned()];
    for end in ends {
        parts = parts.iter().flat_map(|part| part.split(end).map(str::to_owned).collect::<Vec<_>>()).collect();
    }
    let name = |part: &String| part.split('<').next().unwrap_or_default().trim().to_owned();
    parts.iter().map(name).filter(|name| !name.is_empty()).collect()
}

/// One line of what can be printed; what is none of it becomes a space.
fn line(text: &str) -> String {
    let odd = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}');
    text.chars().map(|c| if odd(c) { ' ' } else { c }).collect::<String>().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_in_either_style() {
        assert_eq!(names("Ada Lovelace"), ["Ada Lovelace"]);
        assert_eq!(names("Ada Lovelace, Charles Babbage <cb@example.org>"), ["Ada Lovelace", "Charles Babbage"]);
        assert_eq!(names("Lovelace, Ada; Babbage, Charles"), ["Lovelace, Ada", "Babbage, Charles"]);
        assert_eq!(names("A and B & C"), ["A", "B", "C"]);
        assert!(names(" , <x@y>").is_empty());
    }
}
