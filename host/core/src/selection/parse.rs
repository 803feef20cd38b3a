//! Reading the language of selections, by recursive descent over characters.

use super::{Body, Column, Kind, Selection, SelectionError};

/// Longest text; a selection is something that a person wrote or a chart was asked for.
const LONGEST: usize = 2_000;
/// Deepest nesting of brackets and negations.
const DEEPEST: usize = 40;

type Result<T> = std::result::Result<T, SelectionError>;

/// Reads the whole text.
pub fn selection(text: &str) -> Result<Selection> {
    let mut reader = Reader { text: text.chars().collect(), at: 0, depth: 0 };
    if reader.text.len() > LONGEST {
        return Err(reader.wrong(&format!("it is longer than {LONGEST} characters")));
    }
    let all = reader.any()?;
    reader.space();
    if reader.at < reader.text.len() {
        return Err(reader.wrong("\"&\", \"|\" or the end is expected"));
    }
    Ok(all)
}

struct Reader {
    text: Vec<char>,
    at: usize,
    depth: usize,
}

impl Reader {
    fn any(&mut self) -> Result<Selection> {
        let mut all = vec![self.all()?];
        while self.take('|') {
            all.push(self.all()?);
        }
        Ok(single(all, Selection::Any))
    }

    fn all(&mut self) -> Result<Selection> {
        let mut all = vec![self.one()?];
        while self.take('&') {
            all.push(self.one()?);
        }
        Ok(single(all, Selection::All))
    }

    fn one(&mut self) -> Result<Selection> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.wrong(&format!("brackets and negations nest deeper than {DEEPEST}")));
        }
        let found = if self.take('!') {
            Selection::Not(Box::new(self.one()?))
        } else if self.take('(') {
            let inner = self.any()?;
            self.expect(')')?;
            inner
        } else {
            self.test()?
        };
        self.depth -= 1;
        Ok(found)
    }

    fn test(&mut self) -> Result<Selection> {
        self.space();
        let begin = self.at;
        let word = self.word(|c| c.is_ascii_alphabetic() || c == '_');
        if word == "near" {
            return self.near();
        }
        let Some(&column) = Column::ALL.iter().find(|column| column.name() == word) else {
            self.at = begin;
            let names: Vec<&str> = Column::ALL.iter().map(|column| column.name()).collect();
            return Err(self.wrong(&format!("one of {}, near(...), \"!\" or \"(\" is expected", names.join(", "))));
        };
        let of = self.of()?;
        if column.kind() == Kind::Flag {
            return Ok(Selection::Flag { column, of });
        }
        self.keyword("in")?;
        self.expect('[')?;
        let lo = self.amount(column)?;
        self.expect(',')?;
        let hi = self.amount(column)?;
        if lo > hi {
            return Err(self.wrong("the first end of the range is above the second"));
        }
        self.expect(']')?;
        Ok(Selection::Range { column, of, lo, hi })
    }

    fn near(&mut self) -> Result<Selection> {
        self.expect('(')?;
        self.space();
        let begin = self.at;
        let body = match self.word(|c| c.is_ascii_alphabetic()).as_str() {
            "a" => Body::A,
            "b" => Body::B,
            _ => {
                self.at = begin;
                Body::A
            }
        };
        self.keyword("vertex")?;
        self.space();
        let digits = self.word(|c| c.is_ascii_digit());
        let vertex = digits.parse().map_err(|_| self.wrong("the number of a vertex, counted from 0, is expected"))?;
        self.expect(',')?;
        let radius = self.number()?;
        if radius < 0.0 {
            return Err(self.wrong("a radius cannot be negative"));
        }
        self.expect(')')?;
        Ok(Selection::Near { body, vertex, radius })
    }

    /// Whose column, when the text says so.
    fn of(&mut self) -> Result<Option<String>> {
        let begin = self.at;
        self.space();
        if self.word(|c| c.is_ascii_alphabetic()) != "of" {
            self.at = begin;
            return Ok(None);
        }
        self.space();
        let name = self.word(|c| c.is_ascii_alphanumeric() || "-_.:=+".contains(c));
        if name.is_empty() { Err(self.wrong("the id of an algorithm is expected")) } else { Ok(Some(name)) }
    }

    /// An end of a range, in the column's own unit.
    fn amount(&mut self, column: Column) -> Result<f64> {
        let number = self.number()?;
        let begin = self.at;
        let is_time = matches!(column.kind(), Kind::Range { unit: "ns", .. });
        let factor = match self.word(|c| c.is_ascii_alphabetic()).as_str() {
            "" => 1.0,
            "ns" if is_time => 1.0,
            "us" if is_time => 1e3,
            "ms" if is_time => 1e6,
            "s" if is_time => 1e9,
            _ => {
                self.at = begin;
                let units = if is_time { "ns, us, ms or s" } else { "no unit" };
                return Err(self.wrong(&format!("{} takes {units}", column.name())));
            }
        };
        Ok(number * factor)
    }

    fn number(&mut self) -> Result<f64> {
        self.space();
        let begin = self.at;
        let mut end = self.at;
        while let Some(&c) = self.text.get(end) {
            let exponent = matches!(c, 'e' | 'E')
                && self.text.get(end + 1).is_some_and(|c| c.is_ascii_digit() || matches!(c, '+' | '-'));
            let sign = matches!(c, '+' | '-') && (end == begin || matches!(self.text[end - 1], 'e' | 'E'));
            if !(c.is_ascii_digit() || c == '.' || exponent || sign) {
                break;
            }
            end += 1;
        }
        let text: String = self.text[begin..end].iter().collect();
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => {
                self.at = end;
                Ok(number)
            }
            _ => Err(self.wrong("a number is expected")),
        }
    }

    fn keyword(&mut self, wanted: &str) -> Result<()> {
        self.space();
        let begin = self.at;
        if self.word(|c| c.is_ascii_alphabetic()) == wanted {
            return Ok(());
        }
        self.at = begin;
        Err(self.wrong(&format!("{wanted:?} is expected")))
    }

    fn expect(&mut self, sign: char) -> Result<()> {
        if self.take(sign) { Ok(()) } else { Err(self.wrong(&format!("\"{sign}\" is expected"))) }
    }

    fn take(&mut self, sign: char) -> bool {
        self.space();
        let there = self.text.get(self.at) == Some(&sign);
        self.at += usize::from(there);
        there
    }

    fn word(&mut self, belongs: impl Fn(char) -> bool) -> String {
        let word: String = self.text[self.at..].iter().take_while(|c| belongs(**c)).collect();
        self.at += word.chars().count();
        word
    }

    fn space(&mut self) {
        while self.text.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
    }

    fn wrong(&self, what: &str) -> SelectionError {
        SelectionError { at: self.at + 1, what: what.to_owned() }
    }
}

fn single(mut all: Vec<Selection>, many: fn(Vec<Selection>) -> Selection) -> Selection {
    match all.pop() {
        Some(only) if all.is_empty() => only,
        Some(last) => {
            all.push(last);
            many(all)
        }
        None => many(all),
    }
}
