//! Numbers and words of a file, and how messages show them.

use super::fault::Fault;
use crate::mesh::MAX_COORDINATE;

/// A word of the file, fit for a message: short, no control characters.
pub fn shown(word: &str) -> String {
    let mut short: String = word.chars().take(24).flat_map(char::escape_debug).collect();
    if word.chars().nth(24).is_some() {
        short.push_str("...");
    }
    short
}

/// A count with a comma after each group of three digits.
pub fn grouped(count: usize) -> String {
    let digits = count.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A coordinate written in decimal: the nearest f64, finite and at most [`MAX_COORDINATE`] in magnitude.
pub fn coordinate(word: &str) -> Result<f64, Fault> {
    let number = word.parse().map_err(|_| Fault::NotANumber(shown(word)))?;
    bounded(number, || shown(word))
}

/// A coordinate that computing is possible with; `show` writes it for the message.
pub fn bounded(number: f64, show: impl FnOnce() -> String) -> Result<f64, Fault> {
    if !number.is_finite() {
        return Err(Fault::NotFinite(show()));
    }
    if number.abs() > MAX_COORDINATE {
        return Err(Fault::TooFar(show()));
    }
    Ok(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_grouped_by_three_digits() {
        let texts = [0, 12, 999, 1_000, 12_345, 1_234_567].map(grouped);
        assert_eq!(texts, ["0", "12", "999", "1,000", "12,345", "1,234,567"]);
    }
}
