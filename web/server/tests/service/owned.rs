//! What one has made: how long it stays, what goes with it, and that it is gone when it is taken away.

use std::collections::BTreeMap;
use std::io::Read;
use std::time::{SystemTime, UNIX_EPOCH};

use ocb_service::model::Role;
use reqwest::{Method, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::privacy::{Made, spec, uploaded};
use crate::stream::follow;
use crate::support::{Guest, Service, problem, small_spec};

const DAY_US: i64 = 24 * 3600 * 1_000_000;

async fn remove(by: &Guest, path: &str) -> Value {
    let answer = by.request(Method::DELETE, path).send().await.expect("an answer");
    assert_eq!(answer.status(), StatusCode::OK, "{path}");
    answer.json().await.expect("JSON")
}

async fn gone(by: &Guest, path: &str) {
    problem(by.get(path).send().await.expect("an answer"), 404).await;
}

fn now_us() -> i64 {
    SystemTime::now().duration_since(UNIX_EPOCH).expect("a time").as_micros() as i64
}

#[tokio::test]
async fn an_object_goes_with_what_was_made_with_it_and_with_no_file_of_others() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (owner, other) = (service.guest(), service.guest());
    let (object, theirs) = (uploaded(&owner).await, uploaded(&other).await);
    assert_eq!(service.blobs(), 1, "both over the same bytes");
    let run = owner.start(&spec(&object)).await;
    follow(&owner, &run, 0).await;
    let unrelated = owner.start(&small_spec()).await;
    follow(&owner, &unrelated, 0).await;
    let before = service.blobs();

    // Shown first, to its owner alone; nothing goes by looking.
    let path = format!("/api/v1/objects/{object}");
    let shown = owner.json(&format!("{path}/deletion-preview")).await;
    assert_eq!((&shown["runs"][0]["id"], shown["runs"].as_array().map(Vec::len)), (&json!(run), Some(1)));
    assert_eq!(shown["objects"], json!([{ "id": object, "name": "mine" }]));
    let bytes = shown["bytes"].as_u64().expect("bytes");
    assert!(bytes > 0 && service.blobs() == before, "{shown:#}");
    let taken = other.request(Method::DELETE, &path).send().await.expect("an answer");
    assert!(problem(taken, 403).await.starts_with("Only the owner"));

    assert_eq!(remove(&owner, &path).await, shown);
    for path in
        [path.clone(), format!("{path}/mesh.glb"), format!("/api/v1/runs/{run}"), format!("/api/v1/runs/{run}/events")]
    {
        gone(&owner, &path).await;
    }
    // The run's set, records and tests per triangle are gone, the object of the other and the other run are not.
    assert_eq!(service.blobs(), before - 3);
    other.bytes(&format!("/api/v1/objects/{theirs}/mesh.glb")).await;
    owner.bytes(&format!("/api/v1/runs/{unrelated}/records.parquet?algorithm=box-tree")).await;
    remove(&owner, &format!("/api/v1/runs/{unrelated}")).await;
    remove(&other, &format!("/api/v1/objects/{theirs}")).await;
    assert_eq!(service.blobs(), 0);
    // What is gone can be made again.
    let again = owner.start(&spec(&uploaded(&owner).await)).await;
    assert!(follow(&owner, &again, 0).await.last().is_some_and(|event| event.data["state"] == "done"));
    service.stop().await;
}

#[tokio::test]
async fn a_run_under_way_ends_when_it_is_taken_away() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let mut long = small_spec();
    (long["method"]["sampling"]["count"], long["passes"]) = (20_000.into(), 5.into());
    let (first, second) = (guest.start(&long).await, guest.start(&small_spec()).await);
    remove(&guest, &format!("/api/v1/runs/{first}")).await;
    gone(&guest, &format!("/api/v1/runs/{first}")).await;
    assert!(follow(&guest, &second, 0).await.last().is_some_and(|event| event.data["state"] == "done"));
    service.stop().await;
}

#[tokio::test]
async fn guests_things_go_after_thirty_days_unless_they_ask_and_those_of_accounts_stay() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (guest, member) = (service.guest(), member(&service, "member", Role::User).await);
    assert_eq!(guest.json("/api/v1/data").await["kept_until_us"], Value::Null, "nothing is kept yet");
    let (object, kept) = (uploaded(&guest).await, uploaded(&member).await);
    let until = guest.json("/api/v1/data").await["kept_until_us"].as_i64().expect("a time");
    assert!((until - now_us() - 30 * DAY_US).abs() < DAY_US, "{until}");
    assert_eq!(member.json("/api/v1/data").await["kept_until_us"], Value::Null);

    let sweep = async |day: i64| service.engine.sweep_once(now_us() + day * DAY_US).await.expect("it sweeps");
    assert_eq!(sweep(29).await, 0);
    let asked = guest.post("/api/v1/data/keep").send().await.expect("an answer");
    assert_eq!(asked.status(), StatusCode::OK);
    let longer = asked.json::<Value>().await.expect("JSON")["kept_until_us"].as_i64().expect("a time");
    assert!(longer > until, "{longer} {until}");
    assert_eq!(sweep(29).await, 0);
    assert_eq!(sweep(31).await, 1);
    gone(&guest, &format!("/api/v1/objects/{object}")).await;
    assert_eq!(sweep(31).await, 0, "whoever has nothing is not swept again");
    member.bytes(&format!("/api/v1/objects/{kept}/mesh.glb")).await;
    let all = remove(&member, "/api/v1/data").await;
    assert_eq!(all["objects"].as_array().map(Vec::len), Some(1));
    assert_eq!(service.blobs(), 0);
    service.stop().await;
}

#[tokio::test]
async fn everything_is_taken_along_in_one_archive() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let made = Made::by(member(&service, "owner", Role::Developer).await).await;
    let (bytes, media_type) = made.owner.bytes("/api/v1/data.tar").await;
    assert_eq!(media_type, "application/x-tar");
    let mut archive = tar::Archive::new(&bytes[..]);
    let mut files = BTreeMap::new();
    for entry in archive.entries().expect("an archive") {
        let mut entry = entry.expect("a file");
        let path = entry.path().expect("a path").to_str().expect("a name").to_owned();
        let mut content = Vec::new();
        entry.read_to_end(&mut content).expect("its content");
        files.insert(path, content);
    }
    let file = |path: &str| {
        files.get(&format!("opencollbench/{path}")).unwrap_or_else(|| panic!("{path}: {:?}", files.keys()))
    };
    let json = |path: &str| serde_json::from_slice::<Value>(file(path)).expect("JSON");
    let [run, object, advice, plugin] =
        ["runs", "objects", "advice", "plugins"].map(|resource| made.id(resource).to_owned());
    assert_eq!(json(&format!("runs/{run}/run.json")), made.owner.json(&format!("/api/v1/runs/{run}")).await);
    let (records, _) = made.owner.bytes(&format!("/api/v1/runs/{run}/records.parquet?algorithm=box-tree")).await;
    assert_eq!(*file(&format!("runs/{run}/box-tree.parquet")), records);
    file(&format!("runs/{run}/configurations.parquet"));
    // The object comes back as the same one.
    let mesh = ocb_core::mesh::obj::read(file(&format!("objects/{object}/object.obj"))).expect("an OBJ file").mesh;
    assert_eq!(json(&format!("objects/{object}/object.json"))["sha256"], mesh.sha256());
    assert_eq!(json(&format!("advice/{advice}/advice.json"))["state"], "done");
    assert!(files.keys().any(
        |path| path.starts_with(&format!("opencollbench/advice/{advice}/")) && path.ends_with(".certificate.json")
    ));
    let saved = made.id("configurations").to_owned();
    assert_eq!(
        json(&format!("configurations/{saved}.json"))["sha256"],
        ocb_service::sha256_hex(file(&format!("configurations/{saved}.file")))
    );
    assert_eq!(json(&format!("stability/{}.json", made.id("stability-runs")))["result"]["complete"], true);
    let workload = format!("workloads/{}", made.id("workloads"));
    assert_eq!(json(&format!("{workload}/workload.json"))["state"], "done");
    assert!(file(&format!("{workload}/queries.parquet")).starts_with(b"PAR1"));
    assert!(file(&format!("{workload}/recording.ocbrec")).starts_with(b"PK"));
    assert_eq!(json(&format!("plugins/{plugin}/plugin.json"))["id"], plugin);
    assert!(file(&format!("plugins/{plugin}/tree.so")).starts_with(b"\x7fELF"));
    assert_eq!(json("account.json")["name"], "owner");
    assert_eq!(json("notices.json"), made.owner.json("/api/v1/notices").await);
    assert_eq!(json("choices.json"), made.owner.json("/api/v1/account/choices").await);
    // A token exports what its scopes allow, and no account data.
    for (scopes, plugins) in [(json!(["runs"]), false), (json!(["runs", "plugins"]), true)] {
        let asked = json!({ "name": scopes.to_string(), "scopes": scopes });
        let token = made.owner.post("/api/v1/account/tokens").json(&asked).send().await.expect("an answer");
        let token: Value = token.json().await.expect("JSON");
        let program = service.guest().get("/api/v1/data.tar").bearer_auth(token["secret"].as_str().expect("a secret"));
        let bytes = program.send().await.expect("an answer").bytes().await.expect("an archive");
        let mut archive = tar::Archive::new(&bytes[..]);
        let paths: Vec<String> = archive
            .entries()
            .expect("an archive")
            .map(|entry| entry.expect("a file").path().expect("a path").display().to_string())
            .collect();
        let has = |folder: &str| paths.iter().any(|path| path.starts_with(&format!("opencollbench/{folder}")));
        assert_eq!((has("runs/"), has("plugins/")), (true, plugins), "{paths:?}");
        assert!(!["account", "choices", "notices"].iter().any(|file| has(file)), "{paths:?}");
    }
    // A stranger's holds nothing of it.
    let (empty, _) = service.guest().bytes("/api/v1/data.tar").await;
    assert_eq!(tar::Archive::new(&empty[..]).entries().expect("an archive").count(), 1, "only the list of nothing");
    service.stop().await;
}
