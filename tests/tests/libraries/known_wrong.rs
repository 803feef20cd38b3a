//! The wrong answers that are known, side by side: `plugins/cpp/KNOWN-WRONG.md` says what the libraries answer today.

use ocb_tests::place::{built, root};

use super::{near_contact, single_pairs, units};

const DOCUMENT: &str = "plugins/cpp/KNOWN-WRONG.md";

const HEAD: &str = "# Known wrong answers

Written by `tests/tests/libraries/`, which asks all of this anew, in the jail, and compares: a library that becomes better,
or worse, changes this page. What is true says the oracle, in exact arithmetic. Why each is as it is says the README of the
library.

## Almost touching, and just meeting

Wrong booleans of 20. Configurations of the object with itself at a distance of 1e-4, moved along the line between the
nearest points until they are so far apart, or so deep in each other; the bounding boxes have diagonal 1.
";

#[test]
fn the_known_wrong_answers_are_still_those() {
    let found = format!("{HEAD}{}{}{}", near_contact::tables(), single_pairs::tables(), units::table());
    let written = std::fs::read_to_string(root().join(DOCUMENT)).unwrap_or_default();
    if found != written {
        let beside = built("ocb-runner").with_file_name("KNOWN-WRONG.md");
        std::fs::write(&beside, &found).expect("written");
        panic!("{DOCUMENT} is out of date; what is true today is in {}:\n{found}", beside.display());
    }
}
