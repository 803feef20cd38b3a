//! A second opinion: CGAL's exact kernel, in a program of its own (`tests/oracle-check/cgal.cpp`, development only).

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use dashu_int::IBig;
use nalgebra::Point3;
use ocb_core::oracle::{Pair, Shape};

use crate::common::families::Case;
use crate::common::reference::Grid;

const PAIRS: usize = 20_000;

/// Builds the program, unless it is newer than its source and this program, and lets it answer.
#[expect(clippy::disallowed_methods, reason = "the second opinion is a program of its own")]
fn ask_cgal(input: &str) -> String {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/oracle-check/cgal.cpp");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let program = folder.join("cgal");
    let changed = |path: &Path| std::fs::metadata(path).and_then(|file| file.modified()).ok();
    let this = std::env::current_exe().expect("this program");
    if changed(&program) <= changed(&source).max(changed(&this)) {
        // Whoever is interrupted leaves no half of it behind.
        let part = folder.join("cgal.part");
        let mut compiler = Command::new("c++");
        compiler.args(["-std=c++17", "-O2", "-o"]).args([&part, &source]).args(["-lmpfr", "-lgmp"]);
        let built = compiler.status().expect("c++ starts").success();
        assert!(built, "{} needs CGAL (Debian: libcgal-dev); `make check-oracle` installs it", source.display());
        std::fs::rename(part, &program).expect("the program has its name");
    }
    // By way of a file: nobody has to read and write at once.
    let questions = folder.join("pairs.txt");
    std::fs::write(&questions, input).expect("the pairs are written");
    let answers = Command::new(&program)
        .stdin(std::fs::File::open(&questions).expect("the pairs are read"))
        .stderr(Stdio::inherit())
        .output()
        .expect("the program starts");
    assert!(answers.status.success(), "CGAL's program ended with {}", answers.status);
    String::from_utf8(answers.stdout).expect("text")
}

/// CGAL forbids triangles without area.
fn has_area(points: &[[IBig; 3]]) -> bool {
    let [u, v] = [1, 2].map(|i| [0, 1, 2].map(|k| &points[i][k] - &points[0][k]));
    (0..3).any(|i| &u[i] * &v[(i + 1) % 3] != &u[(i + 1) % 3] * &v[i])
}

fn line(case: &Case) -> String {
    let mut line = String::new();
    let mut add = |x: f64| write!(line, "{x:e} ").expect("room");
    let corners = case.a.iter().chain(&case.b).flat_map(|p: &Point3<f64>| p.coords.data.0[0]);
    corners.for_each(&mut add);
    for pose in [&case.configuration.pose_a, &case.configuration.pose_b] {
        pose.to_row_major()[..12].iter().copied().for_each(&mut add);
    }
    line
}

fn fraction(text: &str) -> (IBig, IBig) {
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    let whole = |digits: &str| digits.trim().parse().expect("a whole number");
    (whole(numerator), whole(denominator))
}

#[test]
fn cgal_says_the_same() {
    let cases: Vec<(Case, Grid)> = (0..)
        .map(|number| {
            let case = Case::draw(0xc6a1_0000_0000 + number);
            let c = &case.configuration;
            let grid = Grid::new([(&c.pose_a, &case.a), (&c.pose_b, &case.b)]);
            (case, grid)
        })
        .filter(|(_, grid)| grid.points.iter().all(|p| has_area(p)))
        .take(PAIRS)
        .collect();
    let mut questions = String::new();
    cases.iter().for_each(|(case, _)| writeln!(questions, "{}", line(case)).expect("room"));
    let answers = ask_cgal(&questions);
    assert_eq!(answers.lines().count(), PAIRS);
    let (mut hits, mut close) = (0, 0);
    for ((case, grid), answer) in cases.iter().zip(answers.lines()) {
        let (hit, squared) = answer.split_once(' ').expect("two words");
        let hit = hit == "1";
        let (numerator, denominator) = fraction(squared);
        // The integers of our own tests, to the last digit.
        let exact = grid.squared_distance([0, 1, 2], [0, 1, 2]);
        assert_eq!((hit, true), (exact.is_zero(), exact.is(&numerator, &denominator)), "{case:?}: CGAL says {answer}");
        let (a, b) = (Shape::from_triangles(&[case.a]), Shape::from_triangles(&[case.b]));
        let pair = Pair::new(&a, &b);
        assert_eq!(pair.hit(&case.configuration), hit, "{case:?}");
        let t = pair.tightest_truth(&case.configuration);
        assert_eq!(t.hit, hit, "{case:?}");
        assert!(exact.root_is_in((t.distance_lo, t.distance_hi)), "{case:?}: {t:?}, CGAL says {answer}");
        assert!(t.distance_hi <= t.distance_lo.next_up(), "{case:?}: {t:?}");
        hits += usize::from(hit);
        close += usize::from(!hit && t.distance_hi < 1e-12 * pair.scene_size(&case.configuration));
    }
    // Near-degenerate ones must be among them.
    assert!(hits > PAIRS / 10 && hits < PAIRS * 9 / 10 && close > PAIRS / 100, "{hits} hits, {close} nearly");
    println!("{PAIRS} pairs, {hits} of them meet, {close} are closer than 1e-12 of the scene's size: 0 differences");
}
