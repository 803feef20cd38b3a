//! The lines of a text, numbered, whatever system wrote it.

use super::fault::Fault;
use super::limits::MAX_LINE_BYTES;

/// Physical lines without their ends, numbered from 1. A line that is too long or holds a NUL byte is a fault.
pub struct Lines<'a> {
    rest: Option<&'a [u8]>,
    end: u8,
    number: usize,
}

impl<'a> Lines<'a> {
    /// Lines of `text` that end by LF, by CR LF, or, where the text has no LF, by CR alone as old Macintosh programs wrote.
    pub fn new(text: &'a [u8]) -> Self {
        Self { rest: Some(text), end: if text.contains(&b'\n') { b'\n' } else { b'\r' }, number: 0 }
    }

    /// The text behind a head whose lines have been read: `above` of them.
    pub fn below(text: &'a [u8], above: usize) -> Self {
        Self { number: above, ..Self::new(text) }
    }

    /// Number of the line that was read last.
    pub fn number(&self) -> usize {
        self.number
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Result<&'a [u8], Fault>);

    fn next(&mut self) -> Option<Self::Item> {
        let rest = self.rest?;
        let line = match rest.iter().position(|&b| b == self.end) {
            Some(at) => {
                self.rest = Some(&rest[at + 1..]);
                &rest[..at]
            }
            None => {
                self.rest = None;
                rest
            }
        };
        self.number += 1;
        let checked = if line.len() > MAX_LINE_BYTES {
            Err(Fault::LineTooLong)
        } else if line.contains(&0) {
            Err(Fault::Binary)
        } else {
            Ok(line.strip_suffix(b"\r").unwrap_or(line))
        };
        Some((self.number, checked))
    }
}
