//! The wrong answers that are known, side by side: `plugins/cpp/KNOWN-WRONG.md` says what the libraries answer today.

use ocb_tests::place::{built, root};

use super::{near_contact, single_pairs, units};

const DOCUMENT: &str = "plugins/cpp/KNOWN-WRONG.md";

const HEAD: &str = "# Known wrong answers

`tests/tests/libraries/` writes this page: it repeats all queries in the jail and compares the answers, so the page
changes when a library becomes better or worse. The oracle gives the true answers, in exact arithmetic. The README of
each library explains its errors.

## Almost touching, and just meeting

Number of wrong booleans in 20 configurations of the object with itself at a distance of 1e-4, moved along the line
between the nearest points to the given distance (apart) or depth (meeting). The bounding boxes have diagonal 1.
";

#[test]
fn the_known_wrong_answers_are_still_those() {
    let found = format!("{HEAD}{}{}{}", near_contact::tables(), single_pairs::tables(), units::table());
    let written = std::fs::read_to_string(root().join(DOCUMENT)).unwrap_or_default();
    if found != written {
        let beside = built("ocb-runner").with_file_name("KNOWN-WRONG.md");
        std::fs::write(&beside, &found).expect("written");
        panic!("{DOCUMENT} is out of date; the current version is in {}:\n{found}", beside.display());
    }
}
