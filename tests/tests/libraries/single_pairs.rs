//! Pairs of single triangles: one that a tracker reported, and the same pairs in another unit of length.

use nalgebra::Point3;
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_tests::place::shared;

use super::support::{Algorithm, distance, hit};

/// Those that answer both questions.
const ALGORITHMS: [&str; 4] = ["box-tree", "coal", "fcl", "parry"];
/// The powers of two by which pairs are made smaller.
const SCALES: [i32; 3] = [0, -10, -20];
/// Pairs of the family.
const COUNT: usize = 10;

/// A pair with its exact distance.
struct Single {
    triangles: [[Point3<f64>; 3]; 2],
    hit: bool,
    distance: f64,
}

/// A number as C99 writes it in hexadecimal, or in decimal.
fn number(word: &str) -> f64 {
    let Some((mantissa, exponent)) = word.split_once("0x").and_then(|(_, rest)| rest.split_once('p')) else {
        return word.parse().unwrap_or_else(|e| panic!("{word}: {e}"));
    };
    let digits = mantissa.replace('.', "");
    let places = 4 * (digits.len() - mantissa.find('.').unwrap_or(digits.len())) as i32;
    let whole = u64::from_str_radix(&digits, 16).expect("hexadecimal digits") as f64;
    let power: i32 = exponent.parse().expect("an exponent");
    whole * 2f64.powi(power - places) * if word.starts_with('-') { -1.0 } else { 1.0 }
}

/// The first pairs whose name or family is this.
fn pairs(wanted: &str, count: usize) -> Vec<Single> {
    let text = std::fs::read_to_string(shared("stability/pairs.txt")).expect("readable");
    let parse = |line: &str| {
        let (left, right) = line.split_once('|').expect("the truth after a bar");
        let words: Vec<&str> = left.split_whitespace().collect();
        assert_eq!(words[2..4], ["1", "1"], "single triangles");
        let at: Vec<f64> = words[4..].iter().map(|word| number(word)).collect();
        let triangle =
            |first: usize| [0, 3, 6].map(|k| Point3::new(at[first + k], at[first + k + 1], at[first + k + 2]));
        let truth: Vec<f64> = right.split_whitespace().map(number).collect();
        Single { triangles: [triangle(0), triangle(9)], hit: truth[0] == 1.0, distance: truth[1] }
    };
    let found = text.lines().filter(|line| line.split_whitespace().take(2).any(|word| word == wanted));
    let found: Vec<Single> = found.take(count).map(parse).collect();
    assert_eq!(found.len(), count, "{wanted}");
    found
}

/// What an algorithm says of a pair in a unit `scale` times as large.
fn asked(algorithm: &'static str, single: &Single, scale: f64) -> (bool, f64) {
    let soup =
        |t: &[Point3<f64>; 3]| Mesh::new(t.iter().map(|p| p * scale).collect(), vec![[0, 1, 2]]).expect("a triangle");
    let [a, b] = [soup(&single.triangles[0]), soup(&single.triangles[1])];
    let mut session = Algorithm::plain(algorithm).start(&a, Some(&b));
    let still = Configuration { pose_a: Pose::identity(), pose_b: Pose::identity() };
    (hit(&mut session, &still), distance(&mut session, &still))
}

/// Among the pairs of a family: wrong booleans, and distances off by more than a millionth of the right one.
fn wrong(algorithm: &'static str, singles: &[Single], power: i32) -> [usize; 2] {
    let scale = 2f64.powi(power);
    let answers: Vec<_> = singles.iter().map(|single| (single, asked(algorithm, single, scale))).collect();
    let booleans = answers.iter().filter(|(single, (hit, _))| *hit != single.hit).count();
    let off = |right: f64, found: f64| (found - right).abs() > 1e-6 * right.max(f64::MIN_POSITIVE);
    let distances = answers.iter().filter(|(single, (_, found))| off(single.distance * scale, *found)).count();
    [booleans, distances]
}

/// The tables, as the document shows them.
pub fn tables() -> String {
    let mut text =
        "\n## One pair of triangles, 1.8e-12 apart (PQP, issue 4)\n\n| algorithm | distance |\n| --- | ---: |\n"
            .to_owned();
    let issue = &pairs("PQP#4", 1)[0];
    text += &format!("| exact | {:.3e} |\n", issue.distance);
    for algorithm in ALGORITHMS {
        text += &format!("| `{algorithm}` | {:.3e} |\n", asked(algorithm, issue, 1.0).1);
    }
    text += "\n## The same triangles in a smaller unit\n\n";
    text += &format!(
        "{COUNT} pairs, a corner of one over the face of the other, multiplied by a power of two, which rounds nothing. \
         Wrong booleans / distances wrong by more than a millionth.\n\n| algorithm |"
    );
    SCALES.iter().for_each(|power| text += &format!(" 2^{power} |"));
    text += &format!("\n| --- |{}\n", " ---: |".repeat(SCALES.len()));
    let singles = pairs("vf-near", COUNT);
    for algorithm in ALGORITHMS {
        text += &format!("| `{algorithm}` |");
        for power in SCALES {
            let [booleans, distances] = wrong(algorithm, &singles, power);
            text += &format!(" {booleans} / {distances} |");
        }
        text += "\n";
    }
    text
}
