//! Twenty faults, each with what finds it.

use std::collections::BTreeSet;
use std::path::PathBuf;

use futures::{StreamExt as _, future};
use ocb_tests::place::{built, root};
use ocb_tests::process::{command, output};

use super::{engine, found, tried};

/// What the fault is, by number, and the family or relation that finds it.
const FAULTS: [(u32, &str, &str); 20] = [
    (1, "an absolute length decides on touching", "vertex-face"),
    (2, "squared normals are compared with 1e-15", "units"),
    (3, "edges and corners do not belong to a triangle", "edge-edge"),
    (4, "only the edges of B are put through A", "many-contacts"),
    (5, "not a number for needles", "slivers"),
    (6, "the last triangle is dropped", "retriangulation"),
    (7, "the answer before, as long as little moves", "vertex-face"),
    (8, "single precision that is not declared", "slivers"),
    (9, "the pose of A is ignored", "rotation"),
    (10, "the rotation of B is transposed", "axes"),
    (11, "what faces away is not there", "coplanar"),
    (12, "a buffer for 64 contacts", "many-contacts"),
    (13, "a triangle without area ends the process", "zero-area"),
    (14, "the same object in the same place never ends", "identical"),
    (15, "distances of edges are forgotten", "edge-edge"),
    (16, "what is in the other's box is inside", "containment"),
    (17, "deep in each other takes very long", "deep"),
    (18, "world coordinates in single precision far out", "offset"),
    (19, "every 25th answer is wrong", "coherence"),
    (20, "triangles are lost by the order of their numbers", "retriangulation"),
];

/// The plugin with the faults, built here: nobody else shall ever meet it.
fn faulty() -> PathBuf {
    let release = built("ocb-runner");
    let arguments = ["build", "--release", "--locked", "--workspace", "--example", "faulty"];
    output(command(env!("CARGO")).current_dir(root()).args(arguments));
    release.with_file_name("examples").join("libfaulty.so")
}

#[tokio::test]
async fn every_fault_is_found_and_none_where_there_is_none() {
    let (engine, _folder) = engine(vec![faulty()]).await;
    // Without a fault none of the finders finds anything; `clean` asks all the others.
    let finders: BTreeSet<&str> = FAULTS.iter().map(|(_, _, finder)| *finder).collect();
    let clean = tried(&engine, "faulty", &finders.iter().copied().collect::<Vec<_>>()).await;
    assert_eq!(clean.families.len() + clean.relations.len(), finders.len());
    let table = engine.stability().await.expect("a table");
    let beyond: Vec<String> = table.families.into_iter().filter(|f| f.beyond).map(|f| f.id).collect();
    // On a busy machine a question may take long without a fault of its own.
    let unexpected: Vec<_> =
        found(&clean).into_iter().filter(|(id, slow)| !slow && !beyond.iter().any(|b| b == id)).collect();
    assert!(unexpected.is_empty(), "without a fault: {unexpected:?}");

    let missed: Vec<String> = futures::stream::iter(FAULTS)
        .map(async |(fault, what, finder)| {
            let tried = tried(&engine, &format!("faulty:fault={fault}"), &[finder]).await;
            // Fault 17 alone is one of time.
            let seen = found(&tried).iter().any(|(_, slow)| *slow == (fault == 17));
            (!seen).then(|| format!("fault {fault}, {what}: not seen by {finder}"))
        })
        .buffer_unordered(2)
        .filter_map(future::ready)
        .collect()
        .await;
    assert!(missed.is_empty(), "{missed:#?}");

    let search = tried(&engine, "faulty:fault=1", &["search"]).await.search.expect("a search");
    let climbing = search.climbing.expect("climbing finds an absolute length");
    assert!(
        5 * climbing <= search.uniform.unwrap_or(search.most),
        "{climbing} questions, uniform {:?}",
        search.uniform
    );
    engine.shutdown().await;
}
