//! How an algorithm is asked for: `box-tree`, or with settings of its own, `box-tree:leaf_size=4`.
//!
//! Each setting of an algorithm is measured as one of its own, under its whole name. So tables, files, links and commands
//! need no notion of parameters. `threads=2` enters the multi-threaded track with so many CPUs; a plugin that declares a
//! parameter of that name is told as well.

use super::Algorithm;
use crate::model::ParameterInfo;
use crate::{LabError, Result};

/// The word for the multi-threaded track.
const THREADS: &str = "threads";

/// The algorithm with the settings that follow its id; without those that change nothing, in the declared order.
pub(super) fn with_settings(plain: &Algorithm, settings: &str) -> Result<Algorithm> {
    let mut chosen = plain.clone();
    let mut said: Vec<&str> = Vec::new();
    for setting in settings.split(':') {
        let (name, value) = setting
            .split_once('=')
            .ok_or_else(|| invalid(plain, &format!("{setting:?} is not a setting; write it as name=value")))?;
        if said.contains(&name) {
            return Err(invalid(plain, &format!("{name:?} is set twice; leave one out")));
        }
        said.push(name);
        let number: f64 =
            value.parse().map_err(|_| invalid(plain, &format!("{name:?} must be a number, not {value:?}")))?;
        let declared = plain.info.parameters.iter().find(|p| p.name == name);
        if name == THREADS && plain.info.threads {
            chosen.threads = threads(plain, number)?;
        } else if declared.is_none() {
            return Err(invalid(plain, &format!("it has no parameter {name:?}; {}", there_are(plain))));
        }
        if let Some(parameter) = declared {
            check(plain, parameter, number)?;
            chosen.settings.push((name.to_owned(), number));
        }
    }
    let declared = |name: &str| plain.info.parameters.iter().position(|p| p.name == name);
    chosen
        .settings
        .retain(|(name, value)| plain.info.parameters.iter().any(|p| p.name == *name && p.default != *value));
    chosen.settings.sort_by_key(|(name, _)| declared(name));
    rename(&mut chosen);
    Ok(chosen)
}

/// Its whole name, for programs and for people.
fn rename(chosen: &mut Algorithm) {
    let told = chosen.settings.iter().map(|(name, value)| (name.as_str(), *value));
    let track = (chosen.threads > 1).then_some((THREADS, chosen.threads as f64));
    let parts: Vec<(&str, f64)> = told.filter(|(name, _)| track.is_none() || *name != THREADS).chain(track).collect();
    for (name, value) in &parts {
        chosen.info.id += &format!(":{name}={value}");
    }
    if !parts.is_empty() {
        let words: Vec<String> = parts.iter().map(|(name, value)| format!("{name} {value}")).collect();
        chosen.info.name = format!("{} ({})", chosen.info.name, words.join(", "));
    }
}

fn threads(plain: &Algorithm, number: f64) -> Result<usize> {
    let most = std::thread::available_parallelism().map_or(1, usize::from);
    if number.fract() != 0.0 || !(1.0..=most as f64).contains(&number) {
        return Err(invalid(plain, &format!("threads must be a whole number from 1 to {most}, the number of CPUs")));
    }
    Ok(number as usize)
}

fn check(plain: &Algorithm, parameter: &ParameterInfo, number: f64) -> Result<()> {
    let ParameterInfo { name, minimum, maximum, integer, .. } = parameter;
    let whole = if *integer { "a whole number" } else { "a number" };
    if !(*minimum..=*maximum).contains(&number) || (*integer && number.fract() != 0.0) {
        return Err(invalid(plain, &format!("{name:?} must be {whole} from {minimum} to {maximum}, not {number}")));
    }
    Ok(())
}

fn there_are(plain: &Algorithm) -> String {
    let mut names: Vec<&str> = plain.info.parameters.iter().map(|p| p.name.as_str()).collect();
    if plain.info.threads && !names.contains(&THREADS) {
        names.push(THREADS);
    }
    if names.is_empty() { "it has no parameters".to_owned() } else { format!("available: {}", names.join(", ")) }
}

fn invalid(plain: &Algorithm, why: &str) -> LabError {
    LabError::Invalid(format!("These settings of the algorithm {:?} are not possible: {why}.", plain.info.id))
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;
    use crate::model::AlgorithmInfo;

    fn plain(threads: bool) -> Algorithm {
        let parameter = |name: &str, maximum: f64, integer: bool| ParameterInfo {
            name: name.into(),
            description: String::new(),
            minimum: 0.0,
            maximum,
            default: 1.0,
            integer,
        };
        let info = serde_json::json!({
            "id": "x", "name": "X", "version": "1", "authors": "", "license": "", "url": "", "paper": "", "queries": [],
            "counters": false, "witness_points": false, "single_precision": false, "solid": false, "coherent": false,
            "threads": threads, "usual": false, "parameters": [], "plugin_sha256": "", "builds": []
        });
        let mut info: AlgorithmInfo = serde_json::from_value(info).expect("an algorithm");
        info.parameters = vec![parameter("size", 8.0, true), parameter("slack", 2.0, false)];
        Algorithm::plain(info, PathBuf::new(), true)
    }

    #[test]
    fn settings_have_one_spelling() {
        let chosen = with_settings(&plain(false), "slack=0.50:size=4").unwrap();
        assert_eq!(chosen.info.id, "x:size=4:slack=0.5");
        assert_eq!(chosen.info.name, "X (size 4, slack 0.5)");
        assert_eq!(chosen.settings, [("size".to_owned(), 4.0), ("slack".to_owned(), 0.5)]);
        assert_eq!((chosen.id_in_plugin.as_str(), chosen.threads), ("x", 1));
        // What changes nothing is not said.
        assert_eq!(with_settings(&plain(false), "size=1:slack=2").unwrap().info.id, "x:slack=2");
        assert_eq!(with_settings(&plain(false), "size=1").unwrap().info.id, "x");
    }

    #[test]
    fn several_threads_are_a_track_of_their_own() {
        let most = std::thread::available_parallelism().map_or(1, usize::from);
        let chosen = with_settings(&plain(true), &format!("threads={most}:size=2")).unwrap();
        assert_eq!(chosen.threads, most);
        assert_eq!(chosen.settings, [("size".to_owned(), 2.0)]);
        let expected = if most > 1 { format!("x:size=2:threads={most}") } else { "x:size=2".to_owned() };
        assert_eq!(chosen.info.id, expected);
        assert!(with_settings(&plain(true), &format!("threads={}", most + 1)).is_err());
        assert!(with_settings(&plain(false), "threads=1").is_err());
    }

    #[test]
    fn what_cannot_be_set_is_said() {
        let cases = [
            ("", "is not a setting; write it as name=value"),
            ("size", "is not a setting; write it as name=value"),
            ("size=", "must be a number"),
            ("size=four", "must be a number"),
            ("size=9", "must be a whole number from 0 to 8, not 9"),
            ("size=1.5", "must be a whole number from 0 to 8, not 1.5"),
            ("slack=NaN", "must be a number from 0 to 2, not NaN"),
            ("slack=0.5:slack=0.6", "is set twice"),
            ("speed=1", "it has no parameter \"speed\"; available: size, slack"),
        ];
        for (settings, expected) in cases {
            let Err(LabError::Invalid(said)) = with_settings(&plain(false), settings) else {
                panic!("{settings:?} was accepted");
            };
            assert!(said.contains(expected) && said.contains("\"x\""), "{settings:?}: {said}");
        }
    }
}
