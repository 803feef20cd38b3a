//! As BibTeX.

use crate::date::date;
use crate::{Work, line};

const MONTHS: [&str; 12] = ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];

/// One `@misc` entry.
pub fn bibtex(work: &Work) -> String {
    let (year, month, _) = date(work.at_us);
    let authors: Vec<String> = work.authors.iter().map(|name| author(name)).collect();
    let mut fields = vec![
        ("title", format!("{{{}}}", escaped(&work.title))),
        ("author", authors.join(" and ")),
        ("year", year.to_string()),
        ("url", line(&work.url)),
        ("note", escaped(&work.summary)),
    ];
    if let Some(version) = &work.version {
        fields.push(("version", escaped(version)));
    }
    let fields: String = fields.into_iter().map(|(name, value)| format!("  {name} = {{{value}}},\n")).collect();
    format!("@misc{{{},\n{fields}  month = {},\n}}\n", work.key, MONTHS[month - 1])
}

/// A person's name is left to the style; anything else stands as it is.
fn author(name: &str) -> String {
    let personal = |c: char| c.is_alphabetic() || " .-'’".contains(c);
    if name.chars().all(personal) { escaped(name) } else { format!("{{{}}}", escaped(name)) }
}

/// Text in braces. Braces of the text itself are written by name: BibTeX counts even those behind a backslash.
fn escaped(text: &str) -> String {
    let mut all = String::new();
    for c in line(text).chars() {
        match c {
            '\\' => all += "\\textbackslash{}",
            '{' => all += "\\textbraceleft{}",
            '}' => all += "\\textbraceright{}",
            '~' => all += "\\textasciitilde{}",
            '^' => all += "\\textasciicircum{}",
            '$' | '&' | '#' | '_' | '%' => all.extend(['\\', c]),
            c => all.push(c),
        }
    }
    all
}
