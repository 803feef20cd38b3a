//! What one has made, here and on a service: shown, taken along, deleted.

use crate::support::{Desk, Ended, Serving};

#[test]
fn what_the_command_line_made_is_shown_taken_along_and_deleted() {
    let desk = Desk::new();
    let bench = ["bench", "stock:torus-knot@600", "--algorithm", "box-tree", "--count", "20", "--passes", "1"];
    let run = desk.json(&bench)["id"].as_str().expect("an id").to_owned();
    let shown = desk.run(&["data", "show"]).stdout;
    assert!(shown.contains(&run) && shown.contains("1 run, 0 objects"), "{shown}");
    let tar = desk.path("all.tar").to_str().expect("text").to_owned();
    let taken = desk.json(&["data", "export", "-o", &tar]);
    assert_eq!(taken["bytes"].as_u64(), std::fs::metadata(&tar).ok().map(|file| file.len()));
    let bytes = std::fs::read(&tar).expect("a file");
    let name = format!("opencollbench/runs/{run}/run.json");
    assert!(bytes.windows(name.len()).any(|part| part == name.as_bytes()), "{name} is in the archive");

    // Without a terminal and without --yes nothing goes, and it is told what would.
    let Ended { code, stdout, stderr } = desk.run(&["data", "delete", "run", "latest"]);
    assert_eq!((code, stdout.as_str()), (2, ""), "{stderr}");
    assert!(stderr.contains(&run) && stderr.contains("Nothing was deleted; add --yes"), "{stderr}");
    assert_eq!(desk.json(&["data", "show"])["runs"][0]["id"], run);
    let gone = desk.json(&["data", "delete", "run", "latest", "--yes"]);
    assert_eq!(gone["runs"][0]["id"], run);
    assert_eq!(desk.json(&["data", "show"])["runs"], serde_json::json!([]));
    assert!(desk.refused(&["data", "delete", "run", &run, "--yes"]).contains(&run));
    assert!(desk.refused(&["data", "delete", "run"]).contains("ID"));
    assert!(desk.run(&["data", "delete", "all", "--yes"]).stdout.starts_with("Deleted: 0 runs, 0 objects"));
}

fn things<'a>(args: &[&'a str], account: &[&'a str]) -> Vec<&'a str> {
    [&["data"], args, account].concat()
}

#[test]
fn what_an_account_has_on_a_service_is_its_own() {
    let (desk, there) = (Desk::new(), Desk::with(&["libocb_box_tree.so"]));
    there.account("ada");
    let service = Serving::start(&there);
    let (token, post) = service.log_in("ada");
    let run = post(
        "/runs",
        serde_json::json!({
            "object_a": "stock:torus-knot@600", "query": "proximity", "algorithms": ["box-tree"], "passes": 1,
            "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 20 } },
        }),
    );
    let run = run["id"].as_str().expect("an id");
    let account = ["--server", &service.url, "--token", &token];
    assert_eq!(desk.json(&things(&["show"], &account))["runs"][0]["id"], run);
    let tar = desk.path("all.tar").to_str().expect("text").to_owned();
    assert!(desk.json(&things(&["export", "-o", &tar], &account))["bytes"].as_u64() > Some(1024));

    // A backup of the service while it is at work: the account and its run are there where it is restored.
    let backup = desk.path("backup.tar").to_str().expect("text").to_owned();
    assert!(there.json(&["backup", &backup])["rows"]["runs"].as_u64() >= Some(1));
    assert!(there.refused(&["backup", &backup]).contains("exists already"));
    assert!(there.refused(&["restore", &backup]).contains("in use"));
    let elsewhere = Desk::new();
    assert!(elsewhere.run(&["restore", &backup]).stdout.starts_with("Restored: "));
    let copy = Serving::start(&elsewhere);
    let (token, _) = copy.log_in("ada");
    let shown = desk.json(&things(&["show"], &["--server", &copy.url, "--token", &token]));
    assert_eq!(shown["runs"][0]["id"], run);
    assert!(elsewhere.refused(&["backup", &tar]).contains("exists already"));

    assert_eq!(desk.json(&things(&["delete", "run", run, "--yes"], &account))["runs"][0]["id"], run);
    assert!(desk.refused(&things(&["delete", "run", run, "--yes"], &account)).contains("There is no run"));
    assert!(desk.refused(&["data", "show", "--server", &service.url]).contains("--token"));
    let link = desk.refused(&["cite", "run", run, "--server", &service.url]);
    assert!(link.contains("There is no run"), "{link}");
    assert!(!desk.path("data").exists(), "nothing is made here");
}

#[test]
fn without_certificates_of_authorities_services_are_reached_over_plain_http_alone() {
    let desk = Desk::with(&["libocb_box_tree.so"]);
    let refused = |args: &[&str], server: &str| {
        let mut command = desk.command(&[args, &["--server", server, "--token", "none"]].concat());
        let ended = command.env("SSL_CERT_FILE", "/dev/null").env_remove("SSL_CERT_DIR").output().expect("it starts");
        let told = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert_eq!(ended.status.code(), Some(2), "{told}");
        told
    };
    for server in ["http://127.0.0.1:1", "127.0.0.1:1"] {
        let told = refused(&["data", "show"], server);
        assert!(told.contains(&format!("No service answers at {server}/")), "{told}");
    }
    for command in [&["data", "show"][..], &["work", "--once"]] {
        let told = refused(command, "https://127.0.0.1:1");
        assert!(told.starts_with("ocb: Cannot set up HTTPS to https://127.0.0.1:1: "), "{told}");
        assert!(told.contains("No CA certificates") && told.contains("(Debian: ca-certificates)"), "{told}");
    }
}
