//! Files of pairs: a case a line, with or without its truth.
//!
//! `NAME FAMILY nA nB`, then nine coordinates for each of the nA + nB triangles, then perhaps `|` and the truth: hit (1 or
//! 0), distance, margin, size. Or 18 coordinates of two triangles, 9 entries of a rotation by rows and 3 of a translation
//! that place the second, then perhaps hit and distance. Empty lines, and lines that begin with `#`, are skipped.

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::configuration::{Configuration, Truth};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_service::model::TruthRow;

use super::number::number;

/// The most triangles of one object in a line.
const MAX_TRIANGLES: usize = 1_000_000;
/// How much a margin may be below the listed one, as a share of the size: listed margins are computed in f64.
const MARGIN_TOLERANCE: f64 = 1e-9;

/// One line.
pub struct Case {
    line: u64,
    name: Option<String>,
    family: Option<String>,
    a: Vec<[Point3<f64>; 3]>,
    b: Vec<[Point3<f64>; 3]>,
    pose_b: Pose,
    listed: Listed,
}

/// The truth that the file gives, as far as it does.
#[derive(Default)]
struct Listed {
    hit: Option<bool>,
    distance: Option<f64>,
    margin: Option<f64>,
    size: Option<f64>,
}

/// All cases, or what is wrong in which line.
pub fn read(text: &str) -> Result<Vec<Case>, String> {
    let mut cases = Vec::new();
    for (line, words) in (1..).zip(text.lines()) {
        let words = words.trim();
        if words.is_empty() || words.starts_with('#') {
            continue;
        }
        let case = if is_transformed(words) { transformed(words) } else { named(words) };
        let case = case.map_err(|reason| format!("line {line}: {reason}"))?;
        cases.push(Case { line, ..case });
    }
    if cases.is_empty() { Err("it has no cases".to_owned()) } else { Ok(cases) }
}

/// A line of numbers alone. One with a name never has so many words: they are 4, and 9 for each triangle.
fn is_transformed(line: &str) -> bool {
    !line.contains('|') && matches!(line.split_whitespace().count(), 30 | 32)
}

fn transformed(line: &str) -> Result<Case, String> {
    let n = numbers(&line.split_whitespace().collect::<Vec<_>>(), 1)?;
    let pose_b = Pose { linear: Matrix3::from_row_slice(&n[18..27]), translation: Vector3::from_row_slice(&n[27..30]) };
    let hit = n.get(30).map(|&x| truth_value(x)).transpose()?;
    let listed = Listed { hit, distance: n.get(31).copied(), ..Listed::default() };
    let (a, b) = (triangles(&n[..9]), triangles(&n[9..18]));
    Ok(Case { line: 0, name: None, family: None, a, b, pose_b, listed })
}

fn named(line: &str) -> Result<Case, String> {
    let (left, right) = line.split_once('|').unwrap_or((line, ""));
    let words: Vec<&str> = left.split_whitespace().collect();
    let [name, family, a, b, coordinates @ ..] = words.as_slice() else {
        return Err("it must begin with NAME FAMILY nA nB".to_owned());
    };
    let count = |word: &str| match word.parse::<usize>() {
        Ok(n) if (1..=MAX_TRIANGLES).contains(&n) => Ok(n),
        _ => Err(format!("{word:?} is not a number of triangles from 1 to {MAX_TRIANGLES}")),
    };
    let (a, b) = (count(a)?, count(b)?);
    let expected = 9 * (a + b);
    if coordinates.len() != expected {
        return Err(format!("{a} + {b} triangles need {expected} coordinates, not {}", coordinates.len()));
    }
    let coordinates = numbers(coordinates, 5)?;
    let truth = numbers(&right.split_whitespace().collect::<Vec<_>>(), words.len() + 2)?;
    if truth.len() > 4 {
        return Err(format!("at most hit, distance, margin and size may follow the bar, not {} numbers", truth.len()));
    }
    let (a, b) = coordinates.split_at(9 * a);
    let listed = Listed {
        hit: truth.first().map(|&x| truth_value(x)).transpose()?,
        distance: truth.get(1).copied(),
        margin: truth.get(2).copied(),
        size: truth.get(3).copied(),
    };
    let (name, family) = (Some((*name).to_owned()), Some((*family).to_owned()));
    Ok(Case { line: 0, name, family, a: triangles(a), b: triangles(b), pose_b: Pose::identity(), listed })
}

/// `first` is the position of the first word in its line.
fn numbers(words: &[&str], first: usize) -> Result<Vec<f64>, String> {
    let read = |(i, word): (usize, &&str)| {
        number(word).map_err(|e| format!("word {}: {e}; write decimal or C99 hexadecimal numbers", first + i))
    };
    words.iter().enumerate().map(read).collect()
}

fn truth_value(x: f64) -> Result<bool, String> {
    match x {
        0.0 => Ok(false),
        1.0 => Ok(true),
        _ => Err(format!("hit must be 0 or 1, not {x}")),
    }
}

fn triangles(numbers: &[f64]) -> Vec<[Point3<f64>; 3]> {
    numbers.as_chunks::<9>().0.iter().map(|t| [0, 3, 6].map(|k| Point3::new(t[k], t[k + 1], t[k + 2]))).collect()
}

impl Case {
    /// The tightest certified answer, compared with the listed one.
    pub fn answer(&self) -> TruthRow {
        let (a, b) = (Shape::from_triangles(&self.a), Shape::from_triangles(&self.b));
        let configuration = Configuration { pose_a: Pose::identity(), pose_b: self.pose_b };
        let truth = Pair::new(&a, &b).tightest_truth(&configuration);
        let (name, family) = (self.name.clone(), self.family.clone());
        TruthRow { name, family, differs: self.differs(&truth), ..TruthRow::of(self.line, &truth) }
    }

    fn differs(&self, truth: &Truth) -> Option<String> {
        let hit = self.listed.hit?;
        let mut all = Vec::new();
        if truth.hit != hit {
            let word = |hit| if hit { "a hit" } else { "no hit" };
            all.push(format!("the answer is {}, but the file says {}", word(truth.hit), word(hit)));
        }
        if let Some(listed) = self.listed.distance {
            // The listed one is rounded, to one side or the other.
            let (lo, hi) = (truth.distance_lo.next_down(), truth.distance_hi.next_up());
            if !(lo <= listed && listed <= hi) {
                all.push(format!("the distance is {:e}, but the file says {listed:e}", truth.distance_hi));
            }
        }
        if let Some(listed) = self.listed.margin {
            let size = self.listed.size.unwrap_or_else(|| self.size());
            if truth.margin < listed - MARGIN_TOLERANCE * size {
                all.push(format!("the margin is {:e}, but the file says {listed:e}", truth.margin));
            }
        }
        Some(all.join("; "))
    }

    /// The largest absolute coordinate.
    fn size(&self) -> f64 {
        self.a.iter().chain(&self.b).flatten().map(|p| p.coords.amax()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: &str = "0 0 0 0x1p2 0 0 0 4 0";
    const ABOVE: &str = "1 1 0.5 2 1 2 1 2 2";

    #[test]
    fn a_case_is_answered_with_and_without_its_truth() {
        let answers = |text: &str| -> Vec<TruthRow> { read(text).unwrap().iter().map(Case::answer).collect() };
        let bare = answers(&format!("# a comment\n\nx y 1 1 {FLOOR} {ABOVE}\n"));
        assert_eq!((bare[0].index, bare[0].hit, bare[0].distance_lo), (3, false, Some(0.5)));
        assert_eq!((bare[0].name.as_deref(), bare[0].differs.as_deref()), (Some("x"), None));
        let right = answers(&format!("x y 1 1 {FLOOR} {ABOVE} | 0 0x1p-1 0 4"));
        assert_eq!(right[0].differs.as_deref(), Some(""));
        let wrong = answers(&format!("x y 1 1 {FLOOR} {ABOVE} | 1 0 0.25 4"));
        let said = wrong[0].differs.as_deref().unwrap();
        assert!(said.contains("no hit") && said.contains("5e-1") && said.contains("margin"), "{said}");
    }

    #[test]
    fn a_line_of_numbers_places_the_second_triangle() {
        let line = format!("{FLOOR} {ABOVE} 1 0 0 0 1 0 0 0 1 0 0 -0.25");
        let bare = read(&line).unwrap()[0].answer();
        assert_eq!((bare.index, bare.distance_hi, bare.differs), (1, Some(0.25), None));
        assert_eq!(read(&format!("{line} 0 0.25")).unwrap()[0].answer().differs.as_deref(), Some(""));
        assert_ne!(read(&format!("{line} 1 0")).unwrap()[0].answer().differs.as_deref(), Some(""));
    }

    #[test]
    fn a_bad_line_is_named() {
        let refused = |line: &str| read(&format!("x y 1 1 {FLOOR} {ABOVE}\n{line}")).err().unwrap();
        for (line, expected) in [
            ("x y 1", "line 2: it must begin"),
            ("x y 0 1", "line 2: \"0\" is not a number of triangles"),
            (&format!("x y 1 2 {FLOOR} {ABOVE}"), "line 2: 1 + 2 triangles need 27 coordinates, not 18"),
            (&format!("x y 1 1 {FLOOR} 1 1 nan 2 1 2 1 2 2"), "line 2: word 16: \"nan\" is not a finite number"),
            (&format!("x y 1 1 {FLOOR} {ABOVE} | 2"), "line 2: hit must be 0 or 1"),
            (&format!("x y 1 1 {FLOOR} {ABOVE} | 0 1 2 3 4"), "line 2: at most hit"),
        ] {
            assert!(refused(line).starts_with(expected), "{line}: {}", refused(line));
        }
        assert_eq!(read("\n# nothing\n").err().unwrap(), "it has no cases");
    }
}
