//! The 65,536-triangle bunny against itself, in configurations whose answers several programs agree about.

use super::support::{Algorithm, LIBRARIES, configurations, distance, hit, mesh, numbers};

/// Every fiftieth of the thousand.
const STRIDE: usize = 50;

#[test]
fn collisions_are_found_where_they_are_and_nowhere_else() {
    let bunny = mesh("bunny65k");
    for id in LIBRARIES {
        let mut session = Algorithm::plain(id).start(&bunny, None);
        for (set, expected) in [("W1", false), ("W2", false), ("W3", true)] {
            for (i, configuration) in configurations(&format!("bunny65k.{set}"), STRIDE) {
                assert_eq!(hit(&mut session, &configuration), expected, "{id} {set} {i}");
            }
        }
    }
}

#[test]
fn distances_equal_the_known_ones() {
    let bunny = mesh("bunny65k");
    for id in ["fcl", "coal"] {
        let mut session = Algorithm::plain(id).start(&bunny, None);
        for set in ["W1", "W2"] {
            let known = numbers(&format!("configurations/bunny65k.{set}.distance.f64"));
            for (i, configuration) in configurations(&format!("bunny65k.{set}"), STRIDE) {
                let (found, known) = (distance(&mut session, &configuration), known[i]);
                assert!((found - known).abs() <= 1e-12 * known, "{id} {set} {i}: {found} instead of {known}");
            }
        }
        for (i, configuration) in configurations("bunny65k.W3", STRIDE) {
            assert_eq!(distance(&mut session, &configuration), 0.0, "{id} W3 {i}");
        }
    }
}
