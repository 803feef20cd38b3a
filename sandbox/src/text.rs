//! Text of strangers for people: what a plugin says, what its file holds, what its author writes. One rule for every door.
//!
//! Letters, marks, digits, punctuation, symbols and spaces may stand there. What cannot be seen may not: control and format
//! characters (among them those that turn the direction of reading), separators of lines and paragraphs, private use, and
//! numbers to which Unicode has given no character yet. The categories are those of the crate `unicode-properties`, which is
//! in the tree anyhow and follows the Unicode Character Database; a table of our own would be forgotten.

use unicode_properties::{GeneralCategory, UnicodeGeneralCategory};

/// Letters and marks by their category that nevertheless show nothing: the rest of Default_Ignorable_Code_Point of
/// DerivedCoreProperties.txt, Unicode 16.
const UNSEEN: [(char, char); 8] = [
    ('\u{34f}', '\u{34f}'),
    ('\u{115f}', '\u{1160}'),
    ('\u{17b4}', '\u{17b5}'),
    ('\u{180b}', '\u{180f}'),
    ('\u{3164}', '\u{3164}'),
    ('\u{fe00}', '\u{fe0f}'),
    ('\u{ffa0}', '\u{ffa0}'),
    ('\u{e0100}', '\u{e01ef}'),
];

/// May this character stand in text for people?
pub fn is_plain(c: char) -> bool {
    use GeneralCategory::{Control, Format, LineSeparator, ParagraphSeparator, PrivateUse, Surrogate, Unassigned};
    if c.is_ascii() {
        return !c.is_ascii_control();
    }
    let unfit = matches!(
        c.general_category(),
        Control | Format | LineSeparator | ParagraphSeparator | PrivateUse | Surrogate | Unassigned
    );
    !unfit && !UNSEEN.iter().any(|(first, last)| (*first..=*last).contains(&c))
}

/// One line of at most so many bytes, without what may not stand there.
pub fn one_line(text: &str, most: usize) -> String {
    let mut line: String = text.chars().filter(|c| is_plain(*c)).collect();
    line.truncate(line.floor_char_boundary(most));
    line
}

/// Several lines, from bytes: UTF-8, with line feeds and tabs.
pub fn lines(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).chars().filter(|c| is_plain(*c) || matches!(c, '\n' | '\t')).collect()
}

/// Is it a line without markup? Names, authors and licences stand in tables, mails and files made for other programs, and not
/// each of those knows that `<` may begin something.
pub fn is_label(text: &str) -> bool {
    text.chars().all(|c| is_plain(c) && !matches!(c, '<' | '>'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_stays() {
        let text = "Zoë Ångström, 山田太郎, Ελένη, עברית, e\u{301}: 3 ≤ x — \u{1f600}";
        assert_eq!(one_line(text, 200), text);
        assert!(is_label(text));
        assert_eq!(lines("a\n\tb".as_bytes()), "a\n\tb");
    }

    #[test]
    fn what_cannot_be_seen_goes() {
        let unseen = [
            0x0, 0x1b, 0x7f, 0x85, 0xad, 0x34f, 0x61c, 0x115f, 0x180e, 0x200b, 0x200c, 0x200d, 0x200e, 0x200f, 0x2028,
            0x2029, 0x202a, 0x202e, 0x2060, 0x2066, 0x2069, 0x3164, 0xe000, 0xfe0f, 0xfeff, 0xfff9, 0xfffe, 0x1fffe,
            0xe0001, 0xe0041, 0xe0100, 0xf0000, 0x10_ffff, 0x378,
        ];
        for code in unseen {
            let c = char::from_u32(code).unwrap();
            assert!(!is_plain(c) && !is_label(&c.to_string()), "{code:#x}");
            assert_eq!(one_line(&format!("a{c}b"), 9), "ab", "{code:#x}");
            assert_eq!(lines(format!("a{c}b").as_bytes()), "ab", "{code:#x}");
        }
        assert_eq!(one_line("a\nb\tc", 9), "abc");
        assert!(!is_label("<b>") && !is_label("a>b"));
    }

    #[test]
    fn a_line_is_cut_between_characters() {
        assert_eq!(one_line("aé", 2), "a");
        assert_eq!(one_line("aé", 3), "aé");
    }
}
