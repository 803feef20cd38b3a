//! Schemathesis asks every route of the OpenAPI document what the document allows and what it does not: no answer is a fault
//! of ours, and each is one that the document has.

use std::path::Path;

use ocb_tests::place::root;
use ocb_tests::process::command;
use ocb_tests::service::{Guest, PASSWORD, Service, add_account};
use serde_json::json;

use crate::{alone, asked, empty};

/// What must hold of every answer. That a request which fits the schema is accepted is not among it: no schema says which
/// selections, names and licences there are, and the answer to others is a sentence.
const CHECKS: &str = "not_a_server_error,status_code_conformance,content_type_conformance,response_headers_conformance,\
                      response_schema_conformance,missing_required_header,unsupported_method,allow_header_conformance";

/// Routes that end the session which asks them.
const LEAVING: &str = "/account/(logout|logout-everywhere|password)$";
/// These, and streams: they end with what they follow, which may be long after this.
const NOT_NOW: &str = "/events$|/account/(logout|logout-everywhere|password)$";

/// Cases for each route and phase; the campaign asks for more.
fn examples() -> String {
    asked("OCB_API_EXAMPLES", 1).to_string()
}

/// The cookie of a new session of this account, as a header.
fn session(service: &Service, name: &str) -> String {
    let body = json!({ "name": name, "password": PASSWORD });
    let client = reqwest::blocking::Client::new();
    let entered = client.post(format!("{}/account/login", service.url())).json(&body).send().expect("an answer");
    let cookies = entered.headers().get_all("set-cookie").iter().filter_map(|value| value.to_str().ok());
    let pairs: Vec<_> = cookies.filter_map(|cookie| cookie.split(';').next()).collect();
    format!("Cookie: {}", pairs.join("; "))
}

/// Asks the routes that `which` chooses; what was found is in the output, with the line that shows it again.
fn ask(service: &Service, cookie: &str, configuration: &Path, which: &[&str]) {
    let tool = root().join(".tools/schemathesis/bin/st");
    assert!(tool.exists(), "{} is missing; run tests/setup/tools.sh test", tool.display());
    let mut st = command(tool);
    st.arg("--config-file").arg(configuration);
    st.args(["run", &format!("{}/openapi.json", service.url()), "--header", cookie, "--checks", CHECKS]);
    st.args(["--seed", "1", "--max-examples", &examples(), "--continue-on-failure", "--no-color"]);
    st.args(["--request-timeout", "60", "--no-shrink", "--warnings", "off"]);
    st.args(which).current_dir(configuration.parent().expect("a folder"));
    let done = st.output().expect("schemathesis starts");
    let text = String::from_utf8_lossy(&done.stdout);
    assert!(done.status.success(), "{which:?}\n{text}\n{}", String::from_utf8_lossy(&done.stderr));
    let cases = text.lines().find(|line| line.contains(" generated, ")).expect("a summary");
    println!("{which:?}: {}", cases.trim());
}

#[test]
fn every_answer_is_one_that_the_document_has() {
    let _alone = alone();
    let data = empty("api");
    for role in ["administrator", "user"] {
        add_account(&data, role);
    }
    let service = Service::start_with(&data, &["libocb_box_tree.so", "libocb_brute_force.so"]);
    let administrator = Guest::member(&service, "administrator");
    let run = administrator.submit(
        &service,
        &json!({
            "object_a": "stock:torus-knot@600", "query": "proximity", "passes": 2,
            "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 60 } },
            "algorithms": ["box-tree", "brute-force"],
        }),
    );
    administrator.wait(&service, &run, "the run is done", |run| run["state"] == "done");
    let cookie = session(&service, "administrator");
    let plain = data.join("plain.toml");
    std::fs::write(&plain, "").expect("the data folder can be written");
    // With a run and an algorithm that there are, the other values reach further than the first look.
    let within = data.join("within.toml");
    let named = format!("[parameters]\n\"path.id\" = \"{run}\"\n\"query.algorithm\" = \"box-tree\"\n");
    std::fs::write(&within, named).expect("the data folder can be written");

    ask(&service, &cookie, &within, &["--include-tag", "results", "--phases", "coverage,fuzzing"]);
    let all = ["--exclude-tag", "results", "--exclude-path-regex", NOT_NOW, "--phases", "examples,coverage,fuzzing"];
    ask(&service, &cookie, &plain, &all);
    let leaving = ["--include-path-regex", LEAVING, "--phases", "coverage,fuzzing"];
    ask(&service, &session(&service, "user"), &plain, &leaving);
    assert_eq!(administrator.get(&service, "/account")["account"]["name"], "administrator");
}
