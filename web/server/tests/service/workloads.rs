//! Recordings from the upload to the result.

use std::collections::HashMap;
use std::time::Duration;

use ocb_core::configuration::Configuration;
use ocb_core::pose::Pose;
use ocb_core::scene::{DisabledPair, Geometry, Scene, SceneObject};
use ocb_core::stock;
use ocb_core::workload::{Answered, Kind, Recorded};
use ocb_service::Recording;
use ocb_service::model::Role;
use ocb_service::recording::About;
use ocb_service::scene_file::SceneFile;
use reqwest::{Method, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::support::{Guest, Service, header, problem};

/// A knot and a ball in it, which are adjacent.
fn scene() -> SceneFile {
    let mut meshes = HashMap::new();
    let knot = SceneFile::keep(&mut meshes, stock::generate("torus-knot", 800).expect("a mesh"));
    let object = |name: &str, geometry| SceneObject {
        name: name.into(),
        link: None,
        geometry,
        pose: Pose::identity(),
        source: String::new(),
        scale: [1.0; 3],
        licence: None,
    };
    let objects = vec![object("knot", knot), object("ball", Geometry::Sphere { radius: 0.3 })];
    let disabled = vec![DisabledPair { a: 0, b: 1, reason: "adjacent links".into() }];
    SceneFile { scene: Scene { name: "robot".into(), objects, disabled }, meshes }
}

/// The ball passes the knot, five queries a group; the program was told that nothing ever collides.
fn recording(queries: u64) -> Vec<u8> {
    let at = |x: f64| Pose { translation: [x, 0.0, 0.0].into(), ..Pose::identity() };
    let query = |i: u64| Recorded {
        sequence: 10 + i,
        group: i / 5,
        objects: [0, 1],
        configuration: Configuration { pose_a: Pose::identity(), pose_b: at(4.0 * i as f64 / queries as f64) },
        kind: Kind::Collide,
        limit: 0.0,
        answered: Answered { hit: Some(false), distance: None },
        seconds: Some(1e-6),
        library: 0,
    };
    let about = About {
        program: "robot".into(),
        recorder: "test".into(),
        libraries: vec!["fcl 0.7.0".into()],
        seen: queries + 2,
        dropped: vec![ocb_service::recording::Dropped { reason: "sampled".into(), count: 2 }],
    };
    let recording = Recording { scene: scene(), about, queries: (0..queries).map(query).collect() };
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("robot.ocbrec");
    recording.write(&file).expect("a recording");
    std::fs::read(file).expect("its bytes")
}

async fn send(guest: &Guest, spec: Value, file: Vec<u8>) -> reqwest::Response {
    send_as(guest, "robot.ocbrec", spec, file).await
}

async fn send_as(guest: &Guest, name: &'static str, spec: Value, file: Vec<u8>) -> reqwest::Response {
    let part = reqwest::multipart::Part::bytes(file).file_name(name);
    let form = reqwest::multipart::Form::new().text("spec", spec.to_string()).part("file", part);
    guest.post("/api/v1/workloads").multipart(form).send().await.expect("an answer")
}

fn spec() -> Value {
    json!({ "algorithms": ["box-tree"], "tracks": ["shuffled"], "passes": 1, "budget_seconds": 5.0 })
}

async fn done(guest: &Guest, place: &str) -> Value {
    loop {
        let now = guest.json(place).await;
        match now["state"].as_str() {
            Some("queued" | "running") => tokio::time::sleep(Duration::from_millis(100)).await,
            _ => return now,
        }
    }
}

/// A replayed recording; gives its id.
pub async fn replayed(guest: &Guest) -> String {
    let sent = send(guest, spec(), recording(40)).await;
    assert_eq!(sent.status(), StatusCode::CREATED);
    let place = header(&sent, "location");
    assert_eq!(done(guest, &place).await["state"], "done");
    place.rsplit('/').next().expect("an id").to_owned()
}

#[tokio::test]
async fn a_replay_also_finds_the_simplest_scene_when_it_is_asked_to() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let with = |reduce: Value| {
        let mut spec = spec();
        spec["reduce"] = reduce;
        spec
    };
    let refused = send(&guest, with(json!({ "tolerance": 0.1, "near": 0.05 })), recording(40)).await;
    assert!(problem(refused, 422).await.contains("less than half of the tolerance"));
    let mut longer = with(json!({ "tolerance": 0.1 }));
    longer["budget_seconds"] = json!(200);
    let refused = send(&guest, longer, recording(40)).await;
    assert!(problem(refused, 422).await.contains("may measure for"), "four replays are counted as four");
    // Brute force knows no whole scene: both scenes are compared in the order in which it was asked.
    let mut other = with(json!({ "tolerance": 2.0 }));
    (other["algorithms"], other["tracks"]) = (json!(["brute-force"]), json!(["scene", "shuffled"]));
    let sent = send(&guest, other, recording(40)).await;
    let ended = done(&guest, &header(&sent, "location")).await;
    assert_eq!((&ended["state"], &ended["message"]), (&"done".into(), &Value::Null));
    assert_eq!(ended["result"]["reduced"]["speed"][0]["algorithm"], "brute-force");
    let sent =
        send(&guest, with(json!({ "tolerance": 2.0, "outside_only": true, "frontier": true })), recording(400)).await;
    assert_eq!(sent.status(), StatusCode::CREATED);
    let place = header(&sent, "location");
    let ended = done(&guest, &place).await;
    assert_eq!((&ended["state"], &ended["message"]), (&"done".into(), &Value::Null));
    let reduced = &ended["result"]["reduced"];
    // With so much tolerance a ball will do for the knot; the ball is as simple as can be.
    let bodies: Vec<_> = reduced["objects"].as_array().expect("a list").iter().map(|it| &it["body"]).collect();
    assert_eq!((bodies.len(), bodies[1]), (2, &json!("object")), "{reduced:#}");
    assert!(reduced["objects"][0]["after"].as_u64() < reduced["objects"][0]["before"].as_u64(), "{reduced:#}");
    assert_eq!((&reduced["queries"], &reduced["outside_only"]), (&json!(400), &json!(true)));
    assert_eq!(reduced["held_out"]["queries"], 80);
    let speed = &reduced["speed"][0];
    assert_eq!((&speed["algorithm"], &speed["wrong"]), (&json!("box-tree"), &json!(0)));
    assert!(speed["faster"][0].as_f64().is_some_and(|ratio| ratio > 0.0), "{speed}");
    // The objects, which have no tolerance, and bodies for seven tolerances.
    let points = reduced["frontier"]["series"][0]["points"].as_array().expect("a list");
    let at: Vec<Option<f64>> = points.iter().map(|point| point["x"].as_f64()).collect();
    assert_eq!(at, [None, Some(0.25), Some(0.5), Some(1.0), Some(2.0), Some(4.0), Some(8.0), Some(16.0)]);
    // Its recording can be replayed in turn, and goes with the replay.
    let (bytes, _) = guest.bytes(&format!("{place}/reduced.ocbrec")).await;
    let again = send(&guest, spec(), bytes).await;
    let second = header(&again, "location");
    let of_bodies = done(&guest, &second).await;
    assert_eq!((&of_bodies["state"], &of_bodies["result"]["queries"]), (&"done".into(), &json!(400)));
    assert_eq!(of_bodies["result"]["reduced"], Value::Null);
    let none = guest.get(&format!("{second}/reduced.ocbrec")).send().await.expect("an answer");
    assert!(problem(none, 404).await.contains("no reduced scene"));
    let blobs = service.blobs();
    let gone = guest.request(Method::DELETE, &place).send().await.expect("an answer");
    assert_eq!(gone.status(), StatusCode::NO_CONTENT);
    // Recording and table; the reduced recording is the other one's.
    assert_eq!(service.blobs(), blobs - 2);
    let gone = guest.request(Method::DELETE, &second).send().await.expect("an answer");
    assert_eq!((gone.status(), service.blobs()), (StatusCode::NO_CONTENT, blobs - 4));
}

#[tokio::test]
async fn a_recording_is_uploaded_replayed_and_taken_away() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let file = recording(2000);
    let sent = send(&guest, spec(), file.clone()).await;
    assert_eq!(sent.status(), StatusCode::CREATED);
    let place = header(&sent, "location");
    let queued: Value = sent.json().await.expect("JSON");
    assert_eq!((&queued["recording"]["queries"], &queued["total"]), (&2000.into(), &2000.into()));
    assert_eq!(
        (&queued["recording"]["program"], &queued["recording"]["file"]),
        (&"robot".into(), &"robot.ocbrec".into())
    );
    let ended = done(&guest, &place).await;
    assert_eq!((&ended["state"], &ended["done"]), (&"done".into(), &2000.into()), "{:#}", ended["message"]);
    let result = &ended["result"];
    // The ball starts in the knot and ends apart from it.
    let hits = result["hits"].as_u64().expect("a count");
    assert!((100..1900).contains(&hits), "{hits}");
    let first = &result["recorded"]["false_answers"][0];
    assert_eq!(first["claim"], "missed_collision");
    let algorithm = &result["tracks"][0]["algorithms"][0];
    assert_eq!((&algorithm["n"], &algorithm["of"], &algorithm["wrong"]), (&2000.into(), &2000.into(), &0.into()));

    // The parts of the timeline are the whole, and so are their stretches.
    let timeline = &result["timeline"];
    let sum = |list: &Value| list.as_array().expect("a list").iter().map(|n| n.as_u64().expect("a count")).sum::<u64>();
    assert_eq!((sum(&timeline["queries"]), sum(&timeline["hits"])), (2000, hits));
    assert_eq!(sum(&timeline["series"][0]["n"]), 2000);
    let from = timeline["from"].as_array().expect("a list");
    assert_eq!((from.len(), &from[0], &from[1]), (400, &json!(10), &json!(15)));
    let whole = guest.json(&format!("{place}/stretch")).await;
    assert_eq!(whole["algorithms"][0]["pairs"], algorithm["pairs"]);
    let [mut n, mut of_hits] = [0, 0];
    for (a, b) in [("", "&to=1010"), ("from=1010", "")] {
        let part = guest.json(&format!("{place}/stretch?{a}{b}")).await;
        n += part["algorithms"][0]["n"].as_u64().expect("a count");
        of_hits += part["algorithms"][0]["pairs"][0]["hits"].as_u64().expect("a count");
    }
    assert_eq!((n, of_hits), (2000, hits));
    let (table, media_type) = guest.bytes(&format!("{place}/queries.parquet")).await;
    assert!(media_type.contains("parquet") && table.starts_with(b"PAR1"));
    assert_eq!(guest.bytes(&format!("{place}/recording.ocbrec")).await.0, file);

    // Where a group stands, and what its objects look like.
    let group = guest.json(&format!("{place}/group?sequence=23")).await;
    assert_eq!(
        (&group["group"], &group["from"], &group["to"], &group["queries"]),
        (&json!(2), &json!(20), &json!(25), &json!(5))
    );
    let ball = &group["objects"][1];
    assert_eq!((&ball["object"], &ball["pose"][3]), (&json!(1), &json!(4.0 * 10.0 / 2000.0)));
    assert_eq!(guest.json(&format!("{place}/group?group=2")).await, group);
    let none = guest.get(&format!("{place}/group?sequence=9")).send().await.expect("an answer");
    assert!(problem(none, 422).await.contains("no query 9"));
    let (mesh, _) = guest.bytes(&format!("{place}/objects/1/mesh.glb")).await;
    assert!(mesh.starts_with(b"glTF"));
    let none = guest.get(&format!("{place}/objects/2/mesh.glb")).send().await.expect("an answer");
    assert!(problem(none, 422).await.contains("it has 2"));

    let scene = guest.json(&format!("{place}/scene")).await;
    let pair = json!({ "objects": [0, 1], "queries": 2000, "disabled": "adjacent links" });
    assert_eq!((&scene["pairs"], &scene["asked_though_disabled"]), (&json!([pair]), &1.into()));
    assert_eq!((scene["objects"].as_array().map(Vec::len), &scene["placed_by_queries"]), (Some(2), &true.into()));

    heatmaps(&guest, &place).await;

    // Another replay of it needs no upload, and under one key it is one.
    let again = json!({ "algorithms": ["brute-force"], "tracks": ["recorded"], "passes": 1, "budget_seconds": 5.0 });
    let ask = || guest.post(&format!("{place}/again")).header("idempotency-key", "k").json(&again).send();
    let [one, two] = [ask().await.expect("an answer"), ask().await.expect("an answer")];
    assert_eq!((one.status(), two.status()), (StatusCode::CREATED, StatusCode::OK));
    let second = header(&one, "location");
    assert_eq!(header(&two, "location"), second);
    assert_eq!(done(&guest, &second).await["result"]["tracks"][0]["track"], "recorded");
    assert_eq!(guest.json("/api/v1/workloads").await.as_array().map(Vec::len), Some(2));

    // The recording stays while one of both is there.
    let remove = |path: String| guest.request(Method::DELETE, &path).send();
    let blobs = service.blobs();
    assert_eq!(remove(place.clone()).await.expect("an answer").status(), StatusCode::NO_CONTENT);
    problem(guest.get(&place).send().await.expect("an answer"), 404).await;
    assert_eq!(service.blobs(), blobs - 1, "its table");
    guest.bytes(&format!("{second}/recording.ocbrec")).await;
    assert_eq!(guest.json("/api/v1/data").await["workloads"], 1);
    assert_eq!(remove("/api/v1/data".into()).await.expect("an answer").status(), StatusCode::OK);
    assert_eq!(service.blobs(), 0);
    service.stop().await;
}

#[tokio::test]
async fn a_scene_without_queries_is_kept_and_shown() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let guest = service.guest();
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("robot.ocbscene");
    scene().write(&file, &[]).expect("a scene");
    let bytes = std::fs::read(file).expect("its bytes");
    // More than may wait at a time: none of them waits.
    let mut places = Vec::new();
    for _ in 0..5 {
        let sent = send_as(&guest, "robot.ocbscene", spec(), bytes.clone()).await;
        assert_eq!(sent.status(), StatusCode::CREATED);
        places.push(header(&sent, "location"));
        let kept: Value = sent.json().await.expect("JSON");
        assert_eq!((&kept["state"], &kept["total"], &kept["result"]), (&"done".into(), &0.into(), &Value::Null));
        assert!(kept["finished_us"].is_number() && kept["recording"]["objects"] == 2, "{kept}");
    }
    let place = &places[0];
    let shown = guest.json(&format!("{place}/scene")).await;
    let pair = json!({ "objects": [0, 1], "queries": 0, "disabled": "adjacent links" });
    assert_eq!((&shown["pairs"], &shown["placed_by_queries"]), (&json!([pair]), &false.into()));
    let [knot, ball] = [0, 1].map(|i| &shown["about"][i]);
    assert_eq!((&knot["name"], &knot["triangles"], &knot["bound"]), (&"knot".into(), &800.into(), &Value::Null));
    assert!(ball["name"] == "ball" && ball["bound"].as_f64().is_some_and(|bound| bound > 0.0), "{ball}");
    assert!(guest.bytes(&format!("{place}/objects/1/mesh.glb")).await.0.starts_with(b"glTF"));
    assert_eq!(guest.bytes(&format!("{place}/recording.ocbrec")).await.0, bytes);
    let told =
        async |answer: reqwest::RequestBuilder, status| problem(answer.send().await.expect("an answer"), status).await;
    let again = told(guest.post(&format!("{place}/again")).json(&spec()), 422).await;
    assert!(again.contains("\"robot.ocbscene\" has no queries"), "{again}");
    assert!(told(guest.get(&format!("{place}/group?group=0")), 422).await.contains("no group 0"));
    assert!(told(guest.get(&format!("{place}/queries.parquet")), 404).await.contains("has not been replayed"));
    problem(service.guest().get(place).send().await.expect("an answer"), 404).await;
    let gone = guest.request(Method::DELETE, "/api/v1/data").send().await.expect("an answer");
    assert_eq!((gone.status(), service.blobs()), (StatusCode::OK, 0));
    service.stop().await;
}

/// The heatmaps of both objects agree with the counts of the result, and the files with the heatmaps.
async fn heatmaps(guest: &Guest, place: &str) {
    let of = |object: u32, file: &str, more: &str| {
        format!("{place}/objects/{object}/heatmap{file}?algorithm=box-tree&order=shuffled&measure={more}")
    };
    let numbers = |map: &Value, what: &str| -> Vec<f64> {
        map[what].as_array().expect("a list").iter().map(|it| it.as_f64().unwrap_or(0.0)).collect()
    };
    let counts = |map: &Value| numbers(map, "counts").iter().sum::<f64>();
    let knot = guest.json(&of(0, "", "queries")).await;
    assert_eq!((&knot["n"], &knot["unit"], &knot["object"]), (&2000.into(), &"queries".into(), &0.into()));
    // Each query has one triangle of the knot, with three vertices; a vertex without a query has no value.
    assert_eq!((counts(&knot), numbers(&knot, "values")), (6000.0, numbers(&knot, "counts")));
    let values = knot["values"].as_array().expect("a list");
    assert!(values.iter().any(Value::is_null) && values.iter().all(|value| *value != json!(0.0)));
    let [first, second] = [of(0, "", "queries&to=1010"), of(0, "", "queries&from=1010")];
    let [first, second] = [guest.json(&first).await, guest.json(&second).await];
    assert_eq!((&first["n"], &second["n"]), (&1000.into(), &1000.into()));
    let sum: Vec<f64> = numbers(&first, "counts").iter().zip(numbers(&second, "counts")).map(|(a, b)| a + b).collect();
    assert_eq!(sum, numbers(&knot, "counts"));
    let ball = guest.json(&of(1, "", "time")).await;
    assert_eq!((&ball["n"], &ball["unit"], counts(&ball)), (&2000.into(), &"ns".into(), 6000.0));
    let [lo, hi] = [0, 1].map(|end| ball["range"][end].as_f64().expect("a number"));
    assert!(0.0 < lo && lo < hi, "{lo} to {hi}");
    assert_eq!(guest.json(&of(1, "", "wrong")).await["range"], json!([0.0, 0.0]));

    let (csv, media_type) = guest.bytes(&of(1, ".csv", "time")).await;
    let csv = String::from_utf8(csv).expect("text");
    let (head, lines) = csv.split_once('\n').expect("a head");
    assert!(media_type.contains("csv") && head == "vertex,value_ns,count", "{media_type}: {head}");
    // An empty field is a vertex that no query touched.
    let value = |line: &str| match line.split(',').nth(1).expect("three fields") {
        "" => Value::Null,
        number => json!(number.parse::<f64>().expect("a number")),
    };
    assert_eq!(lines.lines().map(value).collect::<Vec<_>>(), *ball["values"].as_array().expect("a list"));
    let (ply, _) = guest.bytes(&of(1, ".ply", "time&colormap=cividis&scale=log")).await;
    let head = String::from_utf8_lossy(&ply[..600]).into_owned();
    assert!(
        head.contains("run: robot.ocbrec, object 1, order shuffled") && head.contains("colormap: cividis"),
        "{head}"
    );
    assert!(guest.bytes(&of(1, ".glb", "time")).await.0.starts_with(b"glTF"));
    let told = async |path: String| problem(guest.get(&path).send().await.expect("an answer"), 422).await;
    assert!(told(of(2, "", "time")).await.contains("it has 2"));
    assert!(told(of(0, "", "time").replace("box-tree", "gjk")).await.contains("those that did: box-tree"));
}

#[tokio::test]
async fn what_cannot_be_replayed_is_refused_in_a_sentence() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let guest = service.guest();
    let told = async |spec: Value, file: Vec<u8>| problem(send(&guest, spec, file).await, 422).await;
    assert!(told(spec(), b"solid".to_vec()).await.contains("\"robot.ocbrec\" is not a scene: it is not a zip archive"));
    let good = recording(20);
    assert!(told(spec(), good[..good.len() / 2].to_vec()).await.contains("robot.ocbrec"));
    let with = |name: &str, value: Value| {
        let mut spec = spec();
        spec[name] = value;
        spec
    };
    assert!(told(with("passes", json!(0)), good.clone()).await.contains("1 to 64"));
    assert!(told(with("speed", json!(1)), good.clone()).await.contains("unknown field"));
    assert!(told(with("algorithms", json!(["no-such"])), good.clone()).await.contains("no-such"));
    let long = told(with("budget_seconds", json!(3600)), good.clone()).await;
    assert!(long.contains("limit is 10 minutes") && long.contains("Set the budget to 600 s"), "{long}");
    let nothing = guest.post("/api/v1/workloads").multipart(reqwest::multipart::Form::new()).send().await;
    problem(nothing.expect("an answer"), 400).await;
    assert_eq!((service.blobs(), guest.json("/api/v1/workloads").await), (0, json!([])), "nothing was kept");
    service.stop().await;
}

#[tokio::test]
async fn a_replay_is_cancelled_by_its_owner_or_a_curator_and_ends_at_once() {
    let service = Service::start_with(&["libocb_brute_force.so"]).await;
    let (owner, curator) = (service.guest(), member(&service, "curator", Role::Curator).await);
    // Some three minutes of work.
    let slow = json!({ "algorithms": ["brute-force"], "passes": 64, "budget_seconds": 200.0 });
    let file = recording(20_000);
    let mut places = Vec::new();
    for _ in 0..3 {
        places.push(header(&send(&owner, slow.clone(), file.clone()).await, "location"));
    }
    let refused = send(&owner, slow.clone(), file.clone()).await;
    assert!(problem(refused, 429).await.contains("3 of your recordings"));
    while owner.json(&places[0]).await["state"] == "queued" {
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    assert_eq!(owner.json(&places[2]).await["runs_ahead"], 2);
    let end = async |who: &Guest, place: &str| who.post(&format!("{place}/cancel")).send().await.expect("an answer");
    problem(end(&service.guest(), &places[0]).await, 404).await;
    assert_eq!(end(&owner, &places[0]).await.status(), StatusCode::OK);
    assert_eq!(owner.json(&places[0]).await["state"], "cancelled");
    assert_eq!(end(&curator, &places[1]).await.status(), StatusCode::NO_CONTENT);
    problem(curator.get(&places[1]).send().await.expect("an answer"), 404).await;
    let told = owner.json(&places[1]).await;
    assert_eq!((&told["state"], &told["message"]), (&"cancelled".into(), &"Cancelled by a curator.".into()));
    // The third one begins as soon as the first has let go, and goes with everything else.
    while owner.json(&places[2]).await["state"] == "queued" {
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    let gone = owner.request(Method::DELETE, "/api/v1/data").send().await.expect("an answer");
    assert_eq!(gone.status(), StatusCode::OK);
    assert_eq!(service.blobs(), 0);
    service.stop().await;
}
