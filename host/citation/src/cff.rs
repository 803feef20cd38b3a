//! As a CITATION.cff, version 1.2.0 of the format. It is YAML, in which every string of JSON is a string.

use crate::date::date;
use crate::{Kind, Work, line};

/// The whole file.
pub fn cff(work: &Work) -> String {
    let (year, month, day) = date(work.at_us);
    let kind = match work.kind {
        Kind::Dataset => "dataset",
        Kind::Software => "software",
    };
    let mut text = format!(
        "cff-version: 1.2.0\nmessage: {}\ntype: {kind}\ntitle: {}\nauthors:\n",
        quoted("If you use it, please cite it as below."),
        quoted(&work.title)
    );
    for name in &work.authors {
        text += &format!("  - name: {}\n", quoted(name));
    }
    text += &format!("date-released: \"{year:04}-{month:02}-{day:02}\"\nurl: {}\n", quoted(&work.url));
    for (field, value) in [("version", &work.version), ("license", &work.license), ("repository-code", &work.source)] {
        if let Some(value) = value {
            text += &format!("{field}: {}\n", quoted(value));
        }
    }
    text + &format!("abstract: {}\n", quoted(&work.summary))
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(line(text)).to_string()
}
