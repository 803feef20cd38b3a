//! From all results to those that may be compared: one filter after the other, each saying what it took away.

use super::{Measured, Named, Needed, family, keys};
use crate::model::{BoardFilter, BoardOption, BoardRequest, BoardRow, ContractClass};

/// Takes every value of a filter that allows it.
pub const ALL: &str = "all";
/// Instead of a suite: the runs of people.
pub const NO_SUITE: &str = "none";

/// Applies all filters on what was measured.
pub fn narrowed(mut left: Vec<Measured>, request: &BoardRequest) -> (Vec<Measured>, Vec<BoardFilter>) {
    type Key = fn(&Measured) -> Option<Named>;
    let filters: [(&str, &Option<String>, bool, Key); 6] = [
        ("suite", &request.suite, false, |m| Some(suite(m))),
        ("question", &request.question, false, |m| Some(m.question.clone())),
        ("class", &request.class, false, class),
        ("hardware", &request.hardware, false, |m| Some(m.hardware.clone())),
        ("scene", &request.scene, true, |m| Some(m.scene.clone())),
        ("distance", &request.distance, true, |m| Some(m.distance.clone())),
    ];
    let mut applied: Vec<BoardFilter> = Vec::new();
    for (name, asked, all, key) in filters {
        let options = options(&left, key);
        let of_suite = applied.first().is_some_and(|suite| suite.chosen != NO_SUITE);
        let proposed = match name {
            "suite" => newest(&options),
            // A suite is a whole.
            _ if all && of_suite => Some(ALL.to_owned()),
            _ => most(&options),
        };
        let chosen = asked.clone().or(proposed).unwrap_or_default();
        let before = left.len();
        if !(all && chosen == ALL) {
            left.retain(|m| key(m).is_none_or(|named| named.value == chosen));
        }
        applied.push(BoardFilter { name: name.into(), chosen, options, removed: (before - left.len()) as u32 });
    }
    (left, applied)
}

/// Takes away what is not as right as it has to be; what failed stays, to say so.
pub fn precise(rows: &mut Vec<BoardRow>, needed: &Needed, asked: Option<&str>) -> BoardFilter {
    let enough = |row: &BoardRow| match needed {
        _ if row.n == 0 => true,
        Needed::Any => true,
        Needed::NoneSeen => row.wrong == 0,
        Needed::Eps(most) => row.eps.is_some_and(|eps| eps <= *most),
    };
    let count = |of: &dyn Fn(&BoardRow) -> bool| rows.iter().filter(|row| of(row)).count() as u32;
    let finer = |eps: f64| count(&|row| row.eps.is_some_and(|own| own <= eps));
    let mut options = vec![
        BoardOption { value: "any".into(), words: "any".into(), algorithms: rows.len() as u32 },
        BoardOption {
            value: "none_seen".into(),
            words: "no wrong answer seen".into(),
            algorithms: count(&|r| r.n > 0 && r.wrong == 0),
        },
    ];
    options.extend(["1e-4", "1e-6", "1e-8", "1e-12"].map(|text| BoardOption {
        value: text.into(),
        words: format!("{text} of the scene's size"),
        algorithms: text.parse().map_or(0, finer),
    }));
    let before = rows.len();
    rows.retain(enough);
    let removed = (before - rows.len()) as u32;
    BoardFilter { name: "precision".into(), chosen: asked.unwrap_or("any").into(), options, removed }
}

/// The classes that occur, in the order in which they first do.
pub fn classes(measured: &[Measured]) -> Vec<Option<ContractClass>> {
    let mut classes = Vec::new();
    for m in measured {
        if !classes.contains(&m.result.class) {
            classes.push(m.result.class);
        }
    }
    classes
}

fn suite(m: &Measured) -> Named {
    m.suite.clone().unwrap_or_else(|| Named { value: NO_SUITE.into(), words: "user runs".into() })
}

/// The suite of the highest version; without any, the runs of people.
fn newest(options: &[BoardOption]) -> Option<String> {
    let version = |option: &&BoardOption| option.value.parse::<u32>().ok();
    let newest = options.iter().filter(|option| version(option).is_some()).max_by_key(version);
    Some(newest.map_or_else(|| NO_SUITE.to_owned(), |option| option.value.clone()))
}

/// What failed before its first answer has shown no class: it stands in each.
fn class(m: &Measured) -> Option<Named> {
    let known = m.result.class.filter(|_| m.result.n > 0);
    let old = Named { value: "unknown".into(), words: "not recorded (older version)".into() };
    match known {
        Some(class) => Some(keys::class(&class)),
        None => (m.result.n > 0).then_some(old),
    }
}

/// The values that occur, with the algorithms behind each, in the order in which they first occur: the newest first.
fn options(left: &[Measured], key: fn(&Measured) -> Option<Named>) -> Vec<BoardOption> {
    let mut found: Vec<(Named, Vec<&str>)> = Vec::new();
    for m in left {
        let Some(named) = key(m) else { continue };
        let place = found.iter().position(|(known, _)| known.value == named.value).unwrap_or_else(|| {
            found.push((named, Vec::new()));
            found.len() - 1
        });
        let members = &mut found[place].1;
        if m.result.n > 0 && !members.contains(&m.result.algorithm.as_str()) {
            members.push(&m.result.algorithm);
        }
    }
    let option = |(named, members): (Named, Vec<&str>)| {
        let Named { value, words } = named;
        BoardOption { value, words, algorithms: members.len() as u32 }
    };
    found.into_iter().map(option).collect()
}

/// The value with the most algorithms; the newest of several.
fn most(options: &[BoardOption]) -> Option<String> {
    let most = options.iter().map(|option| option.algorithms).max()?;
    options.iter().find(|option| option.algorithms == most).map(|option| option.value.clone())
}

/// In a fixed order: by family, then by id, so that the settings of one algorithm follow one another.
pub fn in_order(rows: &mut [BoardRow]) {
    rows.sort_by(|a, b| {
        let key = |row: &BoardRow| (row.rank.is_none(), row.rank);
        key(a)
            .cmp(&key(b))
            .then_with(|| rate(b).total_cmp(&rate(a)))
            .then_with(|| family::base(&a.algorithm).cmp(family::base(&b.algorithm)))
    });
}

fn rate(row: &BoardRow) -> f64 {
    row.rate.map_or(0.0, |rate| rate.value)
}
