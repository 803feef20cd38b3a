//! `ocb stability` on a service: tried there, told here.

use std::io::{BufRead, BufReader};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

use crate::support::{Desk, Serving};

/// A family that is tried quickly.
const FAMILY: &str = "vertex-face";

#[test]
fn a_service_tries_an_algorithm_and_the_command_tells_what_it_found() {
    let (desk, there) = (Desk::new(), Desk::with(&["libocb_box_tree.so", "libocb_parry.so"]));
    there.account("ada");
    let service = Serving::start(&there);
    let (token, _) = service.log_in("ada");
    let account = ["--server", &service.url, "--token", &token];
    let with = |args: &[&str]| {
        let all: Vec<String> =
            ["stability"].iter().chain(args).chain(&account).map(|word| (*word).to_owned()).collect();
        all
    };
    fn words(all: &[String]) -> Vec<&str> {
        all.iter().map(String::as_str).collect()
    }

    let quick = ["--family", FAMILY, "--seeds", "1"];
    let found = desk.json(&words(&with(&[&["box-tree"], &quick[..]].concat())));
    let method = &found["methods"][0];
    assert_eq!((&method["families"][0]["family"], &method["complete"]), (&FAMILY.into(), &true.into()), "{found:#}");
    // One that fails, beside one that does not: the code says so, and both are told.
    let out = desk.path("cases");
    let cases = ["--out", out.to_str().expect("text")];
    let both = desk.run(&words(&with(&[&["box-tree", "parry-f32"], &quick[..], &cases].concat())));
    assert_eq!(both.code, 3, "{both:?}");
    assert!(both.stdout.contains("box-tree") && both.stdout.contains("parry-f32"), "{}", both.stdout);
    assert!(both.stderr.contains(&format!("parry-f32: {}/stability/", service.url)), "{}", both.stderr);
    assert!(out.join("parry-f32").join(FAMILY).join("a.obj").is_file());

    assert!(desk.refused(&words(&with(&["nonsense"]))).contains("There is no algorithm \"nonsense\""));
    assert!(desk.refused(&words(&with(&["box-tree", "--at", "1e-3"]))).contains("--server"));
    assert!(desk.refused(&["stability", "box-tree", "--server", &service.url]).contains("--token"));

    // Interrupted here, it is cancelled there.
    let mut child = desk.command(&words(&with(&["box-tree", "--seeds", "10"]))).spawn().expect("it starts");
    let mut lines = BufReader::new(child.stderr.take().expect("stderr")).lines().map_while(Result::ok);
    let id = lines.find_map(|line| line.split_once("/stability/").map(|(_, id)| id.to_owned())).expect("an address");
    kill(Pid::from_raw(i32::try_from(child.id()).expect("a pid")), Signal::SIGINT).expect("it runs");
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    let look = reqwest::blocking::Client::new().get(format!("{}/api/v1/stability-runs/{id}", service.url));
    let run: Value = look.bearer_auth(&token).send().expect("an answer").json().expect("JSON");
    assert_eq!(run["state"], "cancelled", "{run:#}");
    assert!(!desk.path("data").exists(), "nothing is made here");
}

#[test]
fn a_service_is_named_with_the_command_or_not_at_all() {
    let desk = Desk::new();
    let mut local = desk.command(&["stability", "nonsense"]);
    local.env("OCB_SERVER", "http://127.0.0.1:1").env("OCB_TOKEN", "t");
    let ended = local.output().expect("it starts");
    assert!(String::from_utf8_lossy(&ended.stderr).contains("There is no algorithm"), "{ended:?}");
}
