//! What a library answers may depend on its settings, and a run that asks for more says so.

use ocb_core::query::Query;
use ocb_sandbox::{Launcher, Policy, Profile};
use ocb_tests::place::built;
use ocb_tests::process::command;

use super::support::library;

#[test]
fn a_volume_without_distances_is_not_asked_for_them() {
    let policy = Policy { trusted: true, profile: Profile::Dev, ..Policy::default() };
    let launcher = Launcher::new(built("ocb-runner"), policy);
    for name in ["fcl", "coal"] {
        let answers = |volume: f64| {
            let queries = launcher.queries(&library(name), name, &[("bv".to_string(), volume)]).expect("its queries");
            queries.contains(&Query::Proximity)
        };
        assert_eq!([0.0, 1.0, 2.0].map(answers), [false, true, true], "{name}");
    }
    let data = tempfile::tempdir().expect("a folder");
    let mut ocb = command(built("ocb"));
    ocb.arg("--data").arg(data.path()).args(["bench", "stock:torus-knot@600", "--count", "20", "--distance", "0.1"]);
    let done = ocb.args(["--query", "pq", "--algorithm", "fcl:bv=0"]).output().expect("ocb is started");
    let said = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(2), "{said}");
    assert!(said.contains("The algorithm \"fcl:bv=0\" does not answer the proximity query; these do: "), "{said}");
}
