//! What a drawing consists of: paths and words, written as SVG.

use crate::Point;

/// Colour of what explains.
pub const QUIET: &str = "#474e57";
const LETTERS: usize = 118;

/// SVG elements in the order of drawing, a line each.
#[derive(Default)]
pub struct Paper(String);

impl Paper {
    /// A path, with further attributes.
    pub fn path(&mut self, d: impl AsRef<str>, attributes: &str) {
        self.put(&format!("<path d=\"{}\" {attributes}/>", d.as_ref()));
    }

    /// A filled rectangle: left, top, width, height.
    pub fn rect(&mut self, [x, y, width, height]: [f64; 4], fill: &str) {
        self.put(&format!("<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{fill}\"/>"));
    }

    /// Words at a place, with further attributes; markup in them is kept.
    pub fn words(&mut self, [x, y]: [f64; 2], attributes: &str, words: impl AsRef<str>) {
        self.put(&format!("<text x=\"{x}\" y=\"{y}\" {attributes}>{}</text>", words.as_ref()));
    }

    /// Small, quiet words; `anchor` says which part of them stands at the place.
    pub fn label(&mut self, at: [f64; 2], anchor: &str, words: &str) {
        let attributes = format!("text-anchor=\"{anchor}\" font-size=\"11\" fill=\"{QUIET}\"");
        self.words(at, &attributes, escaped(words));
    }

    /// A line of SVG.
    pub fn put(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    /// Everything.
    pub fn into_text(self) -> String {
        self.0
    }
}

/// What is wrong with a point, in words, with their colours: red and amber.
pub fn faults(point: &Point) -> impl Iterator<Item = (String, &'static str)> {
    let both = [(point.missed, "#9c201c", "missed"), (point.false_alarms, "#7d4b00", "false alarms")];
    both.into_iter().filter(|(count, ..)| *count > 0).map(|(count, colour, what)| (format!(" {count} {what}"), colour))
}

/// The same as markup.
pub fn fault_spans(point: &Point) -> String {
    faults(point).map(|(words, colour)| format!("<tspan fill=\"{colour}\">{words}</tspan>")).collect()
}

/// In lines of a page's width.
pub fn wrapped(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < LETTERS => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// As SVG wants it.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
