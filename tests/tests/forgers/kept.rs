//! Results of a long campaign in a file, so that it goes on where it ended.

use std::fs::File;
use std::io::Write;

use serde_json::Value;

/// A line for each run, in the plan's order.
pub struct Kept {
    /// Of earlier times.
    lines: std::vec::IntoIter<String>,
    file: Option<File>,
}

impl Kept {
    /// What `OCB_FORGERS_KEPT` names, or nothing.
    pub fn open() -> Self {
        let Some(path) = std::env::var_os("OCB_FORGERS_KEPT") else {
            return Self { lines: Vec::new().into_iter(), file: None };
        };
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        // A line that has no end was being written.
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        let lines: Vec<String> = whole.lines().map(str::to_owned).collect();
        std::fs::write(&path, whole).expect("the file for results can be written");
        let file = File::options().append(true).open(&path).expect("it can be opened");
        Self { lines: lines.into_iter(), file: Some(file) }
    }

    /// The results of the next run, which is made unless they are kept.
    pub fn next(&mut self, make: impl FnOnce() -> Value) -> Value {
        if let Some(line) = self.lines.next() {
            return serde_json::from_str(&line).expect("a line of results");
        }
        let results = make();
        if let Some(file) = &mut self.file {
            file.write_all(format!("{results}\n").as_bytes()).expect("the file takes a line");
        }
        results
    }
}
