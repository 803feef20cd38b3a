//! Every dependency's licence is one that deny.toml allows.

use ocb_tests::place::root;
use spdx::{Expression, ParseMode};

#[test]
fn every_dependency_has_a_licence_that_deny_toml_allows() {
    let deny = std::fs::read_to_string(root().join("deny.toml")).expect("deny.toml");
    let list = deny.split_once("allow = [").expect("an allow list").1.split_once(']').expect("its end").0;
    let allowed: Vec<&str> = list.split('"').skip(1).step_by(2).collect();
    assert!(allowed.contains(&"MIT"), "the allow list was not read: {allowed:?}");

    let metadata = super::floors::metadata();
    let mut wrong = Vec::new();
    for package in metadata["packages"].as_array().expect("packages") {
        let text = package["license"].as_str().unwrap_or("");
        let fits = Expression::parse_mode(text, ParseMode::LAX)
            .is_ok_and(|e| e.evaluate(|requirement| allowed.contains(&requirement.to_string().as_str())));
        if !fits {
            wrong.push(format!("{} {}: {text:?}", package["name"], package["version"]));
        }
    }
    assert!(wrong.is_empty(), "licences that deny.toml does not allow:\n{}", wrong.join("\n"));
}
