//! What is private is not there for others: every route that the document has, asked by those who have no business there.

use std::collections::BTreeSet;
use std::time::Duration;

use ocb_core::mesh::obj;
use ocb_core::stock;
use ocb_service::model::Role;
use reqwest::{Method, Response, StatusCode};
use serde_json::{Value, json};

use crate::people::member;
use crate::stream::follow;
use crate::support::{Guest, Service, header, problem, small_spec};

/// An id that nothing has.
const NOTHING: &str = "0193f1a0-0000-7000-8000-000000000000";
/// Values of parameters that the document does not list.
const VALUES: &[(&str, &str)] = &[
    ("algorithm", "box-tree"),
    ("kind", "ecdf"),
    ("where", "wrong"),
    ("vertex", "0"),
    ("configuration", "0"),
    ("object", "0"),
    ("sequence", "10"),
];
/// Routes below an id that belong to the account that asks, or to curators: `people.rs` asks those.
const OF_ACCOUNTS: &[&str] = &["account", "accounts", "invitations"];
/// Everybody's; what they hold of private runs is asked for where they are tested, in `campaigns.rs`.
const OF_ALL: &[&str] = &["campaigns"];

/// Who made what.
pub struct Made {
    pub owner: Guest,
    object: String,
    /// By resource: the first part of the path.
    ids: Vec<(&'static str, String)>,
}

impl Made {
    /// An object of their own, a run and advice with it, a stability run, a replayed recording, a plugin that did not get far, and
    /// the notice that says so.
    pub async fn by(owner: Guest) -> Self {
        let object = uploaded(&owner).await;
        let run = owner.start(&spec(&object)).await;
        follow(&owner, &run, 0).await;
        let advice = owner.post("/api/v1/advice").json(&question(&object)).send().await.expect("an answer");
        let place = header(&advice, "location");
        while owner.json(&place).await["state"] != "done" {
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
        let advice = place.rsplit('/').next().expect("an id").to_owned();
        let asked = json!({ "algorithm": "box-tree", "parts": ["vertex-face"], "seeds": 1 });
        let tried = owner.post("/api/v1/stability-runs").json(&asked).send().await.expect("an answer");
        let tried = header(&tried, "location");
        while owner.json(&tried).await["state"] != "done" {
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
        let tried = tried.rsplit('/').next().expect("an id").to_owned();
        let replayed = crate::workloads::replayed(&owner).await;
        let saved = owner.post(&format!("/api/v1/runs/{run}/save-configurations")).send().await.expect("an answer");
        let saved = saved.json::<Value>().await.expect("JSON")["id"].as_str().expect("an id").to_owned();
        let plugin: Value = crate::publishing::garbage(&owner, 0).await.json().await.expect("JSON");
        let plugin = plugin["id"].as_str().expect("an id").to_owned();
        // Its author is told that the check has ended.
        while owner.json("/api/v1/notices").await == json!([]) {
            tokio::time::sleep(Duration::from_millis(100)).await;
        }
        let notice = owner.json("/api/v1/notices").await[0]["id"].as_str().expect("an id").to_owned();
        let ids = vec![
            ("runs", run),
            ("objects", object.clone()),
            ("advice", advice),
            ("stability-runs", tried),
            ("workloads", replayed),
            ("configurations", saved),
            ("plugins", plugin),
            ("notices", notice),
        ];
        Self { owner, object, ids }
    }

    /// Its id among these.
    pub fn id(&self, resource: &str) -> &str {
        let known = self.ids.iter().find(|(name, _)| *name == resource);
        &known.unwrap_or_else(|| panic!("no test makes something private among the {resource}; add it here")).1
    }

    async fn let_see(&self, resource: &str, who: &str) -> Response {
        let path = format!("/api/v1/{resource}/{}/visibility", self.id(resource));
        let request = self.owner.request(Method::PUT, &path);
        request.json(&json!({ "visibility": who })).send().await.expect("an answer")
    }
}

/// An object that advice reduces; everybody's is the same.
pub async fn uploaded(by: &Guest) -> String {
    let mesh = stock::generate("torus-knot", 800).expect("a mesh");
    let object: Value = by.upload("mine.obj", obj::write(&mesh)).await.json().await.expect("JSON");
    object["id"].as_str().expect("an id").to_owned()
}

pub fn spec(object: &str) -> Value {
    let mut spec = small_spec();
    (spec["object_a"], spec["query"], spec["algorithms"]) = (object.into(), "proximity".into(), json!(["box-tree"]));
    spec
}

fn question(object: &str) -> Value {
    json!({ "object_a": object, "question": { "kind": "distance", "tolerance": 0.05 } })
}

/// A route below an id: its method, its resource, and its address with the id left open.
struct Route {
    method: Method,
    resource: String,
    address: String,
}

/// Every route of the document below an id, with a value for whatever it needs.
fn routes() -> Vec<Route> {
    let document = serde_json::to_value(ocb_server::document()).expect("JSON");
    let mut routes = Vec::new();
    for (path, methods) in
        document["paths"].as_object().expect("paths").iter().filter(|(path, _)| path.contains("{id}"))
    {
        let resource = path.split('/').nth(3).expect("/api/v1/resource").to_owned();
        for (method, operation) in methods.as_object().expect("methods") {
            let mut address = path.clone();
            let mut query = Vec::new();
            for parameter in operation["parameters"].as_array().into_iter().flatten() {
                let name = parameter["name"].as_str().expect("a name");
                let value = || value_of(name, &parameter["schema"], &document);
                match (parameter["in"].as_str(), parameter["required"].as_bool()) {
                    (Some("path"), _) if name != "id" => address = address.replace(&format!("{{{name}}}"), &value()),
                    (Some("query"), Some(true)) => query.push(format!("{name}={}", value())),
                    _ => {}
                }
            }
            let address = if query.is_empty() { address } else { format!("{address}?{}", query.join("&")) };
            let method = Method::from_bytes(method.to_uppercase().as_bytes()).expect("a method");
            routes.push(Route { method, resource: resource.clone(), address });
        }
    }
    routes
}

/// A value of our own, or the first that the schema lists.
fn value_of(name: &str, schema: &Value, document: &Value) -> String {
    let known = VALUES.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned());
    let named = schema["$ref"].as_str().and_then(|to| document.pointer(&to[1..])).unwrap_or(schema);
    let listed = named["enum"][0].as_str().or_else(|| named["oneOf"][0]["enum"][0].as_str()).map(str::to_owned);
    known.or(listed).unwrap_or_else(|| panic!("no value is known for the parameter {name:?}; add one: {named}"))
}

async fn ask(by: &Guest, route: &Route, id: &str) -> Response {
    let request = by.request(route.method.clone(), &route.address.replace("{id}", id));
    let changes = matches!(route.method, Method::POST | Method::PUT);
    let body = match route.resource.as_str() {
        "plugins" => json!({ "action": "withdraw", "reason": "" }),
        "workloads" => json!({}),
        _ => json!({ "visibility": "unlisted" }),
    };
    let request = if changes { request.json(&body) } else { request };
    request.send().await.expect("an answer")
}

/// Asks every route of these resources for somebody else's thing: the answer is that to what nobody has.
async fn hidden(made: &Made, stranger: &Guest, resources: &[&str]) -> usize {
    let mut asked = 0;
    for route in routes().iter().filter(|route| resources.contains(&route.resource.as_str())) {
        let id = made.id(&route.resource);
        let told = problem(ask(stranger, route, id).await, 404).await;
        let nothing = problem(ask(stranger, route, NOTHING).await, 404).await;
        assert_eq!(told.replace(id, NOTHING), nothing, "{} {}", route.method, route.address);
        asked += 1;
    }
    asked
}

/// Asks for everything that can be looked at; all of it is there.
async fn seen(made: &Made, by: &Guest, resources: &[&str]) -> usize {
    let mut asked = 0;
    let looks = |route: &&Route| route.method == Method::GET && resources.contains(&route.resource.as_str());
    for route in routes().iter().filter(looks) {
        let answer = ask(by, route, made.id(&route.resource)).await;
        // What is only the owner's to look at says that it is there.
        let there = answer.status().is_success() || answer.status() == StatusCode::FORBIDDEN;
        assert!(there, "{} {}: {:?}", route.method, route.address, answer.text().await);
        asked += 1;
    }
    asked
}

#[tokio::test]
async fn what_is_private_is_not_there_for_others() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let made = Made::by(member(&service, "owner", Role::Developer).await).await;
    let resources: BTreeSet<_> = routes().into_iter().map(|route| route.resource).collect();
    for resource in resources.iter().filter(|resource| ![OF_ACCOUNTS, OF_ALL].concat().contains(&resource.as_str())) {
        made.id(resource);
    }
    // To a guest and to an account; decisions about plugins are for accounts, so that a guest hears 401 there.
    let (guest, account) = (service.guest(), member(&service, "stranger", Role::User).await);
    let linked = ["runs", "objects", "advice"];
    let there = seen(&made, &guest, &linked).await;

    let tag = header(&made.owner.get(&mesh(&made.object)).send().await.expect("an answer"), "etag");
    let cached = || guest.get(&mesh(&made.object)).header("if-none-match", &tag).send();
    assert_eq!(cached().await.expect("an answer").status(), StatusCode::NOT_MODIFIED);
    let own = guest.start(&small_spec()).await;
    follow(&guest, &own, 0).await;

    let beside = format!(
        "/api/v1/runs/{own}/heatmap?algorithm=box-tree&measure=time&statistic=median&outliers=keep&against_run={}",
        made.id("runs")
    );
    // Another question of another object: told so, as long as it may be known.
    problem(guest.get(&beside).send().await.expect("an answer"), 422).await;

    // The run alone: nothing of it is there, nor beside another run.
    assert_eq!(made.let_see("runs", "private").await.status(), StatusCode::OK);
    let mut asked = hidden(&made, &guest, &["runs", "stability-runs", "workloads", "configurations"]).await
        + hidden(&made, &account, &["runs", "stability-runs", "workloads", "configurations", "plugins", "notices"])
            .await;
    problem(guest.get(&beside).send().await.expect("an answer"), 404).await;
    seen(&made, &guest, &["objects", "advice"]).await;

    // The object: neither it nor anything made with it, also for those who keep a copy or ask for something new.
    assert_eq!(made.let_see("runs", "unlisted").await.status(), StatusCode::OK);
    assert_eq!(made.let_see("objects", "private").await.status(), StatusCode::OK);
    for stranger in [&guest, &account] {
        asked += hidden(&made, stranger, &linked).await;
    }
    problem(cached().await.expect("an answer"), 404).await;
    let mut second = small_spec();
    second["object_b"] = made.object.clone().into();
    let with_it = [
        ("runs", spec(&made.object)),
        ("runs", second),
        ("estimates", spec(&made.object)),
        ("advice", question(&made.object)),
    ];
    for (resource, body) in &with_it {
        let nothing: Value = serde_json::from_str(&body.to_string().replace(&made.object, NOTHING)).expect("JSON");
        let path = format!("/api/v1/{resource}");
        let told = problem(guest.post(&path).json(body).send().await.expect("an answer"), 404).await;
        let unknown = problem(guest.post(&path).json(&nothing).send().await.expect("an answer"), 404).await;
        assert_eq!(told.replace(&made.object, NOTHING), unknown);
    }
    // Its owner still has everything, and is told that the run is no more seen than its object.
    assert_eq!(seen(&made, &made.owner, &linked).await, there);
    assert_eq!(made.owner.json(&format!("/api/v1/runs/{}", made.id("runs"))).await["visibility"], "private");
    println!(
        "{asked} answers to strangers say no more than that there is nothing, {there} routes show it to its owner"
    );
    service.stop().await;
}

fn mesh(object: &str) -> String {
    format!("/api/v1/objects/{object}/mesh.glb")
}

#[tokio::test]
async fn what_is_public_is_in_the_lists_of_others_and_only_accounts_publish() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let made = Made::by(member(&service, "owner", Role::Developer).await).await;
    let stranger = service.guest();
    let lists = async || {
        let objects = stranger.json("/api/v1/objects").await;
        let listed = objects.as_array().expect("a list").iter().any(|object| object["id"] == made.object);
        (listed, stranger.json("/api/v1/board").await["results"].as_u64().expect("a number"))
    };
    assert_eq!(lists().await, (false, 0), "what is unlisted is in no list");
    // No more than see its object.
    assert!(problem(made.let_see("runs", "public").await, 409).await.contains("make that public first"));
    let published: Value = made.let_see("objects", "public").await.json().await.expect("JSON");
    assert_eq!((&published["visibility"], &published["mine"]), (&json!("public"), &json!(true)));
    assert_eq!(lists().await, (true, 0));
    assert_eq!(made.let_see("runs", "public").await.status(), StatusCode::OK);
    assert_eq!(lists().await, (true, 1), "what the run measured is on the board");
    let theirs = stranger.json(&format!("/api/v1/objects/{}", made.object)).await;
    assert_eq!((&theirs["visibility"], &theirs["mine"]), (&json!("public"), &json!(false)));
    // Others do not decide, guests do not publish, and nobody hides what ships with the service.
    for resource in ["runs", "objects"] {
        let path = format!("/api/v1/{resource}/{}/visibility", made.id(resource));
        let taken = stranger.request(Method::PUT, &path).json(&json!({ "visibility": "private" })).send().await;
        assert!(problem(taken.expect("an answer"), 403).await.starts_with("Only the owner"));
    }
    let stock = stranger.request(Method::PUT, "/api/v1/objects/stock:box@500/visibility");
    let hidden = stock.json(&json!({ "visibility": "private" })).send().await.expect("an answer");
    problem(hidden, 403).await;
    let path = format!("/api/v1/objects/{}/visibility", uploaded(&stranger).await);
    let published = stranger.request(Method::PUT, &path).json(&json!({ "visibility": "public" })).send().await;
    assert!(problem(published.expect("an answer"), 403).await.contains("account page"));
    // With the object the run leaves the board.
    assert_eq!(made.let_see("objects", "private").await.status(), StatusCode::OK);
    assert_eq!(lists().await, (false, 0));
    service.stop().await;
}

#[tokio::test]
async fn a_curator_ends_a_stability_run_and_does_not_see_it() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let (owner, curator) = (service.guest(), member(&service, "curator", Role::Curator).await);
    let begun = owner.post("/api/v1/stability-runs").json(&json!({ "algorithm": "box-tree", "seeds": 10 }));
    let place = header(&begun.send().await.expect("an answer"), "location");
    let open = curator.json("/api/v1/curation/stability-runs").await;
    assert!(place.ends_with(open[0]["id"].as_str().expect("an id")), "{open:#}");
    let end = format!("{place}/cancel");
    problem(service.guest().post(&end).send().await.expect("an answer"), 404).await;
    let ended = curator.post(&end).send().await.expect("an answer");
    assert_eq!(ended.status(), StatusCode::OK);
    let ended: Value = ended.json().await.expect("JSON");
    assert_eq!((&ended["state"], &ended["message"]), (&"cancelled".into(), &"Cancelled by a curator.".into()));
    assert!(ended["result"].is_null(), "{ended:#}");
    problem(curator.get(&place).send().await.expect("an answer"), 404).await;
    assert_eq!(owner.json(&place).await["state"], "cancelled");
    service.stop().await;
}

#[tokio::test]
async fn a_stream_ends_when_its_run_becomes_private() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (owner, stranger) = (service.guest(), service.guest());
    let mut spec = small_spec();
    // Long enough that it is private before it is done.
    (spec["method"]["sampling"]["count"], spec["passes"]) = (20_000.into(), 5.into());
    let run = owner.start(&spec).await;
    let path = format!("/api/v1/runs/{run}");
    let stream = stranger.get(&format!("{path}/events")).send().await.expect("an answer");
    assert_eq!(stream.status(), StatusCode::OK);
    let hide = owner.request(Method::PUT, &format!("{path}/visibility")).json(&json!({ "visibility": "private" }));
    assert_eq!(hide.send().await.expect("an answer").status(), StatusCode::OK);
    // Preliminary results are for the owner alone.
    let values = format!("{path}/heatmap?algorithm=box-tree&measure=time&statistic=median&outliers=keep");
    while owner.get(&values).send().await.expect("an answer").status() != StatusCode::OK {
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    assert_eq!(owner.json(&values).await["preliminary"], true);
    let made = Made { owner: owner.clone(), object: String::new(), ids: vec![("runs", run.clone())] };
    assert!(hidden(&made, &stranger, &["runs"]).await > 0);
    let cancelled = owner.post(&format!("{path}/cancel")).send().await.expect("an answer");
    assert_eq!(cancelled.status(), StatusCode::OK);
    let text = stream.text().await.expect("the stream ends");
    assert!(!text.contains("cancelled") && !text.contains(r#""preliminary":true"#), "{text}");
    problem(stranger.get(&format!("{path}/events")).send().await.expect("an answer"), 404).await;
    assert!(follow(&owner, &run, 0).await.last().is_some_and(|event| event.data["state"] == "cancelled"));
    service.stop().await;
}
