//! Long lists, part by part.

use std::fmt;

use serde::Deserialize;
use utoipa::IntoParams;

/// Entries of one part at most.
const MOST: u32 = 200;

/// Why there is no such part, as a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadPage(pub String);

/// Which part of a list. Lists go from the newest to the oldest entry, so that what is added meanwhile shifts nothing.
#[derive(Clone, Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub struct Page {
    /// Entries at most, from 1 to 200.
    #[serde(default = "most")]
    #[param(minimum = 1, maximum = 200, default = 200)]
    pub limit: u32,
    /// Start of the page, from the `Link` header of the previous page; absent for the first page.
    pub cursor: Option<String>,
}

fn most() -> u32 {
    MOST
}

impl Default for Page {
    fn default() -> Self {
        Self { limit: MOST, cursor: None }
    }
}

impl Page {
    /// Behind which entry the part begins, and how many it holds at most.
    pub fn start(&self) -> Result<(Cursor, usize), BadPage> {
        if !(1..=MOST).contains(&self.limit) {
            return Err(BadPage(format!("A page of a list has 1 to {MOST} entries, not {}.", self.limit)));
        }
        let start = self.cursor.as_deref().map_or(Ok(Cursor::start()), Cursor::parse)?;
        Ok((start, self.limit as usize))
    }

    /// The part behind this one, as long.
    pub fn behind(&self, next: &Cursor) -> Self {
        Self { limit: self.limit, cursor: Some(next.to_string()) }
    }
}

/// The place behind an entry, in a list from the newest to the oldest: smaller is further on.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cursor {
    /// When the entry was made.
    pub created_us: i64,
    /// Its id, where several were made at once.
    pub id: String,
}

impl Cursor {
    /// Before the first entry.
    pub fn start() -> Self {
        Self { created_us: i64::MAX, id: String::new() }
    }

    /// The place behind this entry.
    pub fn behind(created_us: i64, id: &str) -> Self {
        Self { created_us, id: id.to_owned() }
    }

    fn parse(text: &str) -> Result<Self, BadPage> {
        let bad = || {
            let mend = "take it from the Link header of the previous page";
            BadPage(format!("The cursor {text:?} is not valid; {mend}."))
        };
        let (created_us, id) = text.split_once('~').ok_or_else(bad)?;
        Ok(Self { created_us: created_us.parse().map_err(|_| bad())?, id: id.to_owned() })
    }
}

impl fmt::Display for Cursor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}~{}", self.created_us, self.id)
    }
}

/// A part of a list.
#[derive(Clone, Debug)]
pub struct Part<T> {
    /// Its entries.
    pub entries: Vec<T>,
    /// Where the list goes on, unless this is its end.
    pub next: Option<Cursor>,
}

impl<T> Part<T> {
    /// From the entries behind the start of a part, one more than it holds if there are so many.
    pub fn of(mut entries: Vec<T>, limit: usize, place: impl Fn(&T) -> Cursor) -> Self {
        let more = entries.len() > limit;
        entries.truncate(limit);
        Self { next: entries.last().filter(|_| more).map(place), entries }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_put_together_are_the_list() {
        let all: Vec<(i64, &str)> = vec![(9, "a"), (7, "c"), (7, "b"), (7, "a"), (-1, "z")];
        for limit in 1..=6 {
            let (mut page, mut got) = (Page { limit, cursor: None }, Vec::new());
            loop {
                let (start, most) = page.start().unwrap();
                let place = |(us, id): &(i64, &str)| Cursor::behind(*us, id);
                let left = all.iter().copied().filter(|entry| place(entry) < start).take(most + 1).collect();
                let part = Part::of(left, most, place);
                got.extend(part.entries);
                let Some(next) = part.next else { break };
                page = page.behind(&next);
            }
            assert_eq!(got, all, "{limit} at a time");
        }
        for (limit, cursor) in [(0, None), (201, None), (1, Some("x")), (1, Some("x~y")), (1, Some(""))] {
            let page = Page { limit, cursor: cursor.map(str::to_owned) };
            assert!(page.start().is_err(), "{page:?}");
        }
    }
}
