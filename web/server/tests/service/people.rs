//! Accounts, roles, tokens, and who may do what.

use std::collections::BTreeSet;

use ocb_service::model::Role;
use reqwest::{Method, Response, StatusCode};
use serde_json::{Value, json};

use crate::support::{Guest, Service, header, problem, small_spec};

pub const PASSWORD: &str = "a long enough password";

/// A browser that is logged in as a new account of this role.
pub async fn member(service: &Service, name: &str, role: Role) -> Guest {
    service.engine.add_account(name, PASSWORD, role).await.expect("an account");
    let guest = service.guest();
    let entered = log_in(&guest, name, PASSWORD).await;
    assert_eq!(entered.status(), StatusCode::OK);
    guest
}

pub async fn log_in(guest: &Guest, name: &str, password: &str) -> Response {
    let body = json!({ "name": name, "password": password });
    guest.post("/api/v1/account/login").json(&body).send().await.expect("an answer")
}

async fn who(guest: &Guest) -> Value {
    guest.json("/api/v1/account").await["account"].clone()
}

#[tokio::test]
async fn an_account_takes_over_what_the_guest_made_and_is_left_everywhere() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (guest, elsewhere) = (service.guest(), service.guest());
    let run = guest.start(&small_spec()).await;
    assert_eq!(who(&guest).await, Value::Null);

    let body = json!({ "name": "Ada@example.org", "password": PASSWORD, "keep": true });
    let made = guest.post("/api/v1/account").json(&body).send().await.expect("an answer");
    assert_eq!(made.status(), StatusCode::CREATED);
    let cookie = header(&made, "set-cookie");
    for part in ["ocb_session=", "HttpOnly", "SameSite=Lax", "Path=/"] {
        assert!(cookie.contains(part), "{cookie}");
    }
    assert_eq!(who(&guest).await["role"], "user");
    assert_eq!(guest.json("/api/v1/runs").await[0]["id"], run);
    assert_eq!(guest.json(&format!("/api/v1/runs/{run}")).await["mine"], true);

    // The same account elsewhere sees the same runs; leaving everywhere leaves there, too.
    assert_eq!(log_in(&elsewhere, "ada@EXAMPLE.org", PASSWORD).await.status(), StatusCode::OK);
    assert_eq!(elsewhere.json("/api/v1/runs").await[0]["id"], run);
    let left = guest.post("/api/v1/account/logout-everywhere").send().await.expect("an answer");
    assert_eq!(left.status(), StatusCode::NO_CONTENT);
    assert_eq!((who(&guest).await, who(&elsewhere).await), (Value::Null, Value::Null));
    assert_eq!(guest.json("/api/v1/runs").await, json!([]));
    service.stop().await;
}

#[tokio::test]
async fn nobody_learns_which_names_there_are_by_logging_in() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    member(&service, "known", Role::User).await;
    let guest = service.guest();
    let wrong = problem(log_in(&guest, "known", "some other password").await, 403).await;
    let unknown = problem(log_in(&guest, "unknown", "some other password").await, 403).await;
    assert_eq!(wrong, unknown);
    // A name is tried ten times a minute, from wherever.
    for _ in 0..8 {
        log_in(&service.guest(), "known", "some other password").await;
    }
    assert!(problem(log_in(&guest, "known", PASSWORD).await, 429).await.contains("wait"));
    service.stop().await;
}

#[tokio::test]
async fn other_sites_cannot_act_in_a_visitors_name() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = member(&service, "victim", Role::User).await;
    let sent = guest.post("/api/v1/account/logout").header("origin", "https://evil.example").send().await;
    problem(sent.expect("an answer"), 403).await;
    let sent = guest.post("/api/v1/runs").header("sec-fetch-site", "cross-site").json(&small_spec()).send().await;
    problem(sent.expect("an answer"), 403).await;
    assert_eq!(who(&guest).await["name"], "victim");
    service.stop().await;
}

#[tokio::test]
async fn a_token_does_what_it_is_for_and_nothing_else() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = member(&service, "robot", Role::Developer).await;
    let asked = json!({ "name": "script", "scopes": ["plugins"] });
    let made = guest.post("/api/v1/account/tokens").json(&asked).send().await.expect("an answer");
    assert_eq!(made.status(), StatusCode::CREATED);
    let made: Value = made.json().await.expect("JSON");
    let secret = made["secret"].as_str().expect("a secret").to_owned();
    let program = service.guest();
    let with = |method: Method, path: &str| {
        program.client.request(method, format!("{}{path}", service.url)).bearer_auth(&secret).send()
    };
    assert_eq!(with(Method::GET, "/api/v1/plugins").await.expect("an answer").status(), StatusCode::OK);
    problem(with(Method::POST, "/api/v1/runs").await.expect("an answer"), 403).await;
    problem(with(Method::GET, "/api/v1/account/tokens").await.expect("an answer"), 403).await;
    let listed = guest.json("/api/v1/account/tokens").await;
    assert!(!listed.to_string().contains(&secret) && listed[0]["name"] == "script");
    let path = format!("/api/v1/account/tokens/{}", listed[0]["id"].as_str().expect("an id"));
    let ended = guest.client.delete(format!("{}{path}", service.url)).send().await.expect("an answer");
    assert_eq!(ended.status(), StatusCode::NO_CONTENT);
    problem(with(Method::GET, "/api/v1/plugins").await.expect("an answer"), 401).await;
    service.stop().await;
}

#[tokio::test]
async fn curators_welcome_developers_and_administrators_make_curators() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let user = member(&service, "newcomer", Role::User).await;
    let curator = member(&service, "curator", Role::Curator).await;
    let administrator = member(&service, "admin", Role::Administrator).await;
    let request = json!({ "reason": "I have a faster tree." });
    let asked = user.post("/api/v1/account/developer").json(&request).send().await.expect("an answer");
    assert_eq!(asked.status(), StatusCode::NO_CONTENT);
    let accounts = curator.json("/api/v1/accounts").await;
    let of =
        |name: &str| accounts.as_array().expect("a list").iter().find(|a| a["name"] == name).expect("there").clone();
    assert_eq!(of("newcomer")["developer_request"], "I have a faster tree.");
    let give = |by: &Guest, to: &str, role: &str| {
        let path = format!("/api/v1/accounts/{}/role", of(to)["id"].as_str().expect("an id"));
        by.post(&path).json(&json!({ "role": role })).send()
    };
    problem(give(&curator, "newcomer", "curator").await.expect("an answer"), 403).await;
    problem(give(&curator, "curator", "administrator").await.expect("an answer"), 403).await;
    problem(give(&curator, "admin", "user").await.expect("an answer"), 403).await;
    assert_eq!(give(&curator, "newcomer", "developer").await.expect("an answer").status(), StatusCode::OK);
    assert_eq!(who(&user).await["role"], "developer");
    assert_eq!(give(&administrator, "newcomer", "curator").await.expect("an answer").status(), StatusCode::OK);
    assert_eq!(service.engine.broken_audit().await.expect("a log"), None);
    service.stop().await;
}

/// Who may get further than the door, by route: everybody, whoever is logged in, developers, curators. Whose thing it is
/// comes on top: `publishing.rs` and the tests above.
const DOORS: &[(&str, &[&str])] = &[
    (
        "everybody",
        &[
            "get /account",
            "post /account",
            "post /account/login",
            "post /account/logout",
            "post /advice",
            "get /advice/{id}",
            "post /advice/{id}/cancel",
            "get /advice/{id}/certificate.json",
            "get /advice/{id}/reduced.obj",
            "get /algorithms",
            "get /board",
            "get /board.csv",
            "get /campaigns",
            "get /campaigns/{id}",
            "get /configurations",
            "post /configurations",
            "delete /configurations/{id}",
            "get /configurations/{id}/deletion-preview",
            "get /configurations/{id}/file",
            "post /estimates",
            "get /examples",
            "get /featured",
            "post /mails/off/{secret}",
            "get /objects",
            "post /objects",
            "get /objects/{id}",
            "delete /objects/{id}",
            "get /objects/{id}/deletion-preview",
            "get /objects/{id}/mesh.glb",
            "put /objects/{id}/visibility",
            "get /openapi.json",
            "get /plugins",
            "get /plugins/{id}",
            "get /plugins/{id}/citation",
            "get /plugins/{id}/events",
            "get /runs",
            "post /runs",
            "get /runs/{id}",
            "delete /runs/{id}",
            "get /runs/{id}/deletion-preview",
            "post /runs/{id}/cancel",
            "post /runs/{id}/refine",
            "post /runs/{id}/save-configurations",
            "get /runs/{id}/chart",
            "get /runs/{id}/chart.csv",
            "get /runs/{id}/chart.parquet",
            "get /runs/{id}/columns.arrow",
            "get /runs/{id}/configurations.parquet",
            "get /runs/{id}/configurations/{configuration}/contacts",
            "get /runs/{id}/ecdf",
            "get /runs/{id}/events",
            "get /runs/{id}/heatmap",
            "get /runs/{id}/heatmap.glb",
            "get /runs/{id}/heatmap.ply",
            "get /runs/{id}/citation",
            "get /runs/{id}/repro.zip",
            "get /runs/{id}/records.csv",
            "get /runs/{id}/triangles.parquet",
            "get /runs/{id}/records.parquet",
            "get /runs/{id}/selection",
            "get /runs/{id}/selection.arrow",
            "get /runs/{id}/vertices/{vertex}",
            "put /runs/{id}/visibility",
            "get /runs/{id}/witnesses.arrow",
            "get /runs/{id}/worst",
            "get /stability",
            "post /stability-runs",
            "get /stability-runs",
            "get /stability-runs/{id}",
            "delete /stability-runs/{id}",
            "post /stability-runs/{id}/cancel",
            "post /workloads",
            "get /workloads",
            "get /workloads/{id}",
            "delete /workloads/{id}",
            "post /workloads/{id}/again",
            "post /workloads/{id}/cancel",
            "get /workloads/{id}/stretch",
            "get /workloads/{id}/group",
            "get /workloads/{id}/scene",
            "get /workloads/{id}/objects/{object}/mesh.glb",
            "get /workloads/{id}/objects/{object}/heatmap",
            "get /workloads/{id}/objects/{object}/heatmap.csv",
            "get /workloads/{id}/objects/{object}/heatmap.glb",
            "get /workloads/{id}/objects/{object}/heatmap.ply",
            "get /workloads/{id}/queries.parquet",
            "get /workloads/{id}/recording.ocbrec",
            "get /workloads/{id}/reduced.ocbrec",
            "get /status",
            "get /suite",
            "get /data",
            "get /data.tar",
            "delete /data",
            "post /data/keep",
        ],
    ),
    (
        "logged in",
        &[
            "delete /account",
            "get /account/deletion-preview",
            "put /account/address",
            "delete /account/address",
            "post /account/address/confirmation",
            "get /account/choices",
            "put /account/choices",
            "post /account/developer",
            "post /account/invitation",
            "post /account/logout-everywhere",
            "post /account/password",
            "post /account/signing-key",
            "delete /account/signing-key",
            "get /account/tokens",
            "post /account/tokens",
            "delete /account/tokens/{id}",
            "get /notices",
            "delete /notices/{id}",
            "post /notices/{id}/read",
            "post /plugins/{id}/decisions",
        ],
    ),
    ("developer", &["post /plugins"]),
    (
        "curator",
        &[
            "get /accounts",
            "post /accounts/{id}/role",
            "get /campaigns/preview",
            "post /campaigns",
            "post /campaigns/{id}/cancel",
            "get /curation",
            "get /curation/stability-runs",
            "get /invitations",
            "post /invitations",
            "delete /invitations/{id}",
        ],
    ),
];

/// Every route of the document asked by every role: a route that nobody has put into the table fails, and so does one that
/// lets somebody in who has no business there.
#[tokio::test]
async fn every_route_has_its_door() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let roles = [
        ("everybody", service.guest()),
        ("logged in", member(&service, "user", Role::User).await),
        ("developer", member(&service, "developer", Role::Developer).await),
        ("curator", member(&service, "curator", Role::Curator).await),
    ];
    let document = serde_json::to_value(ocb_server::document()).expect("JSON");
    let paths = document["paths"].as_object().expect("paths");
    let routes: BTreeSet<String> = paths
        .iter()
        .flat_map(|(path, methods)| {
            let path = path.strip_prefix("/api/v1").expect("the prefix").to_owned();
            methods.as_object().expect("methods").keys().map(move |method| format!("{method} {path}"))
        })
        .collect();
    let known: BTreeSet<String> = DOORS.iter().flat_map(|(_, routes)| routes.iter().map(|r| (*r).to_owned())).collect();
    let forgotten: Vec<_> = routes.symmetric_difference(&known).collect();
    assert!(forgotten.is_empty(), "these are only in the document or only in the table of doors: {forgotten:?}");
    let mut asked = 0;
    for (needed, (_, routes)) in DOORS.iter().enumerate() {
        // These end the session that asks; they are walked through above.
        for route in routes.iter().filter(|route| !route.contains("/logout")) {
            let (method, path) = route.split_once(' ').expect("method and path");
            let path = path
                .replace("{id}", "0193f1a0-0000-7000-8000-000000000000")
                .replace("{vertex}", "0")
                .replace("{object}", "0")
                .replace("{configuration}", "0");
            for (rank, (role, guest)) in roles.iter().enumerate() {
                let method = Method::from_bytes(method.to_uppercase().as_bytes()).expect("a method");
                let request = guest.client.request(method.clone(), format!("{}/api/v1{path}", service.url));
                let request = if method == Method::POST { request.json(&json!({})) } else { request };
                let status = request.send().await.expect("an answer").status().as_u16();
                let expected = if rank >= needed {
                    "no"
                } else if rank == 0 {
                    "401"
                } else {
                    "403"
                };
                let told = if matches!(status, 401 | 403) { status.to_string() } else { "no".to_owned() };
                assert_eq!(told, expected, "{route} asked by {role} gives {status}");
                assert!(status < 500, "{route} asked by {role} gives {status}");
                asked += 1;
            }
        }
    }
    assert!(asked > 130, "{asked}");
    service.stop().await;
}
