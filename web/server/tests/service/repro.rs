//! The repro archive of a run.

use std::io::{Cursor, Read};

use serde_json::{Value, json};

use crate::stream::follow;
use crate::support::{Service, problem, small_comparison};

#[tokio::test]
async fn a_run_is_taken_along_with_all_that_its_answers_follow_from() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let object = "v 0 0 0\nv 1 0.25 0\nv 0 1 0.125\nv 0.3 0.2 1.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let object: Value = guest.upload("own.obj", object).await.json().await.expect("JSON");
    let mut spec = small_comparison();
    spec["object_b"] = object["id"].clone();
    let run = guest.start(&spec).await;
    let path = format!("/api/v1/runs/{run}/repro.zip");
    let early = guest.get(&path).send().await.expect("an answer");
    // A run this small may be through already.
    if early.status() != 200 {
        assert!(problem(early, 409).await.contains("has not ended"));
    }
    follow(&guest, &run, 0).await;
    let (bytes, media_type) = guest.bytes(&path).await;
    assert_eq!(media_type, "application/zip");
    assert_eq!(guest.bytes(&path).await.0, bytes, "the same run gives the same bytes");
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).expect("an archive");
    let mut file = |name: &str| {
        let mut content = Vec::new();
        archive.by_name(name).expect("there").read_to_end(&mut content).expect("its content");
        content
    };
    let recipe: Value = serde_json::from_slice(&file("recipe.json")).expect("JSON");
    let shown = guest.json(&format!("/api/v1/runs/{run}")).await;
    assert_eq!((&recipe["run"], &recipe["spec"]), (&json!(run), &shown["spec"]));
    assert_eq!(recipe["seed"], shown["environment"]["draw"]["seed"]);
    assert_eq!(recipe["objects"][0]["file"], Value::Null, "a stock object is made, not sent");
    assert_eq!(recipe["objects"][1]["sha256"], object["sha256"]);
    let mesh = ocb_core::mesh::obj::read(&file("objects/b.obj")).expect("an OBJ file").mesh;
    assert_eq!(object["sha256"], mesh.sha256());
    let (records, _) = guest.bytes(&format!("/api/v1/runs/{run}/records.parquet?algorithm=box-tree")).await;
    assert_eq!(recipe["algorithms"][0]["id"], "box-tree");
    assert_eq!(file("answers/1.parquet"), records);
    assert!(file(recipe["algorithms"][1]["plugin"].as_str().expect("a plugin")).starts_with(b"\x7fELF"));
    service.stop().await;
}
