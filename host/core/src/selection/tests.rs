use std::borrow::Cow;

use serde_json::Value;

use super::*;

fn cases() -> Value {
    serde_json::from_str(include_str!("cases.json")).unwrap()
}

/// The columns of the examples.
struct Examples(Value);

impl Examples {
    fn get(&self, name: &str) -> Result<Vec<f64>, String> {
        let column = self.0["columns"][name].as_array().ok_or_else(|| format!("no {name}"))?;
        Ok(column.iter().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect())
    }
}

impl Columns for Examples {
    type Error = String;

    fn column(&self, column: Column, of: Option<&str>) -> Result<Cow<'_, [f64]>, String> {
        let of = of.map_or_else(String::new, |of| format!(" of {of}"));
        self.get(&format!("{}{of}", column.name())).map(Cow::Owned)
    }

    fn distance_from(&self, body: Body, vertex: u32) -> Result<Vec<f64>, String> {
        self.get(&format!("near {} {vertex}", format!("{body:?}").to_lowercase()))
    }
}

#[test]
fn the_examples_read_write_and_select_as_they_say() {
    let examples = Examples(cases());
    for case in examples.0["good"].as_array().unwrap() {
        let [text, canonical, chosen] = [0, 1, 2].map(|i| &case[i]);
        let selection: Selection = text.as_str().unwrap().parse().unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(selection.to_string(), canonical.as_str().unwrap());
        assert_eq!(selection.to_string().parse::<Selection>().unwrap(), selection);
        let members = selection.apply(&examples).unwrap_or_else(|e| panic!("{text}: {e}"));
        let chosen: Vec<usize> = chosen.as_array().unwrap().iter().map(|i| i.as_u64().unwrap() as usize).collect();
        let got: Vec<usize> = members.iter().enumerate().filter(|(_, is)| **is).map(|(i, _)| i).collect();
        assert_eq!(got, chosen, "{text}");
    }
}

/// What must be said of every column.
#[test]
fn every_column_has_an_example_and_stands_in_the_help_and_in_the_readme() {
    let readme = include_str!("../../../README.md");
    let (_, readme) = readme.split_once("\n## Selections\n").unwrap();
    let (readme, _) = readme.split_once("\n## ").unwrap();
    let cases = cases();
    let examples: Vec<&str> = cases["good"].as_array().unwrap().iter().map(|case| case[0].as_str().unwrap()).collect();
    assert!(!Column::ALL.is_empty());
    for name in Column::ALL.iter().map(|column| column.name()) {
        assert!(readme.contains(&format!("`{name}`")), "host/README.md does not name {name}");
        assert!(help().contains(name), "{name}");
        assert!(examples.iter().any(|text| text.contains(name)), "cases.json has no example of {name}");
    }
}

#[test]
fn what_is_no_selection_is_told_with_its_place() {
    for case in cases()["bad"].as_array().unwrap() {
        let text = case[0].as_str().unwrap();
        let error = text.parse::<Selection>().unwrap_err();
        assert_eq!(error.at as u64, case[1].as_u64().unwrap(), "{text}: {error}");
        assert!(error.what.contains(case[2].as_str().unwrap()), "{text}: {error}");
    }
    let deep = format!("{}wrong", "!".repeat(50));
    assert!(deep.parse::<Selection>().unwrap_err().what.contains("deeper"));
    let long = "wrong & ".repeat(500) + "wrong";
    assert!(long.parse::<Selection>().unwrap_err().what.contains("longer"));
}

#[test]
fn it_tells_what_it_needs_and_passes_on_why_a_column_is_missing() {
    let selection: Selection = "time of b in [0, 1] & !(wrong of a | disputed) | bv in [1, 2]".parse().unwrap();
    assert_eq!(selection.algorithms(), ["a", "b"]);
    assert!(selection.uses(Column::Disputed) && !selection.uses(Column::Flipped));
    assert_eq!(selection.apply(&Examples(cases())), Err("no time of b".to_owned()));
}

#[test]
fn distances_are_in_units_of_the_length() {
    let points = [Point3::new(1.0, 2.0, 3.0), Point3::new(1.0, 2.0, 7.0)];
    assert_eq!(distances(&points, &points[0], 8.0), [0.0, 0.5]);
}
