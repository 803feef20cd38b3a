//! `ocb serve` from start to stop.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::support::{Desk, Ended};

#[test]
fn it_serves_until_it_is_told_to_stop() {
    let desk = Desk::new();
    let free = TcpListener::bind("127.0.0.1:0").and_then(|port| port.local_addr()).expect("a port").to_string();
    for signal in [Signal::SIGTERM, Signal::SIGINT] {
        let serve = ["serve", "--address", "127.0.0.1:0", "--json", "--idle", "off", "--metrics", &free];
        let mut child = desk.command(&serve).spawn().expect("it starts");
        let stdout = BufReader::new(child.stdout.take().expect("stdout"));
        let url = stdout.lines().map_while(Result::ok).find_map(|line| {
            let (_, rest) = line.split_once("http://")?;
            rest.split('"').next().map(str::to_owned)
        });
        let url = url.expect("an address");
        let answer = get(&url, "/api/v1/status");
        assert!(answer.starts_with("HTTP/1.1 200") || answer.starts_with("HTTP/1.0 200"), "{answer}");
        assert!(answer.contains("\"algorithms\":"), "{answer}");
        // Figures for the operator are at an address of their own.
        let figures = get(&free, "/metrics");
        for expected in [
            "ocb_http_requests_total{method=\"GET\",route=\"/api/v1/status\",status=\"200\"} 1\n",
            "ocb_http_request_seconds_count 1\n",
            "ocb_queue_oldest_seconds 0",
            "ocb_stored_bytes 0\n",
        ] {
            assert!(figures.contains(expected), "{expected}: {figures}");
        }
        // Methods that visitors invent are not kept one by one.
        ask(&url, "BREW", "/");
        let figures = get(&free, "/metrics");
        assert!(figures.contains("method=\"other\"") && !figures.contains("BREW"), "{figures}");
        assert!(figures.ends_with("# EOF\n") && !get(&url, "/metrics").contains("ocb_stored"), "{figures}");
        kill(Pid::from_raw(i32::try_from(child.id()).expect("a pid")), signal).expect("it runs");
        let ended = child.wait_with_output().expect("it ends");
        assert_eq!(ended.status.code(), Some(0), "{}", String::from_utf8_lossy(&ended.stderr));
    }
}

fn get(address: &str, path: &str) -> String {
    ask(address, "GET", path)
}

fn ask(address: &str, method: &str, path: &str) -> String {
    let mut connection = TcpStream::connect(address).expect("it listens");
    write!(connection, "{method} {path} HTTP/1.0\r\nHost: {address}\r\n\r\n").expect("it reads");
    let mut answer = String::new();
    connection.read_to_string(&mut answer).expect("it answers");
    answer
}

#[test]
fn an_address_in_use_is_refused() {
    let desk = Desk::new();
    let taken = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = taken.local_addr().expect("an address").to_string();
    let sentence = desk.refused(&["serve", "--address", &address]);
    assert!(sentence.contains(&address), "{sentence}");
    desk.refused(&["serve", "--address", "everywhere"]);
    assert!(!desk.path("data").exists());
}

#[test]
fn what_is_wrong_with_a_mail_server_is_told_without_its_password() {
    let desk = Desk::new();
    let serve = |more: &[&str]| desk.refused(&[&["serve", "--address", "127.0.0.1:0"], more].concat());
    for (url, expected) in [
        ("https://ada:secret@mail.example.org", "must begin with smtps:// or smtp://"),
        ("smtps://ada:secret@mail.example.org:port", "invalid port"),
        ("smtps://ada:secret@mail.example.org/inbox", "more than a host and a port"),
    ] {
        let told = serve(&["--smtp-url", url, "--mail-from", "ocb@example.org"]);
        assert!(told.contains(expected) && !told.contains("secret"), "{url}: {told}");
    }
    let server = ["--smtp-url", "smtps://ada:secret@mail.example.org"];
    let told = serve(&server);
    assert!(told.contains("--mail-from") && !told.contains("secret"), "{told}");
    let told = serve(&[&server[..], &["--mail-from", "nobody"]].concat());
    assert!(told.contains("name@example.org") && !told.contains("secret"), "{told}");
    let told = serve(&[&server[..], &["--mail-from", "ocb@example.org", "--public-url", "here"]].concat());
    assert!(told.contains("https://host") && !told.contains("secret"), "{told}");
    for (file, expected) in [(desk.path("nothing"), "nothing"), (desk.path("authority.pem"), "no certificate")] {
        std::fs::write(desk.path("authority.pem"), "none").expect("a file");
        let file = file.to_str().expect("plain text").to_owned();
        let told = serve(&[&server[..], &["--mail-from", "ocb@example.org", "--smtp-ca", &file]].concat());
        assert!(told.contains(expected) && !told.contains("secret"), "{told}");
    }
    assert!(!desk.path("data").exists(), "nothing was opened");
}

#[test]
fn the_systemd_units_start_commands_that_exist_with_the_same_hardening() {
    let unit =
        |name: &str| std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)).unwrap();
    let units = ["opencollbench.service", "opencollbench-work.service"].map(unit);
    for (unit, command) in units.iter().zip(["serve", "work"]) {
        let start = unit.lines().find_map(|line| line.strip_prefix("ExecStart=/opt/opencollbench/ocb ")).unwrap();
        let Ended { code, stdout, stderr } = Desk::new().run(&start.split(' ').chain(["--help"]).collect::<Vec<_>>());
        assert_eq!(code, 0, "{stderr}");
        assert!(stdout.contains(&format!("Usage: ocb {command}")), "{stdout}");
        // What the machine's unit hands over by its environment.
        let variables = ["OCB_INTERNAL_SERVER", "OCB_MACHINE_TOKEN"];
        assert!(command == "serve" || variables.iter().all(|it| unit.contains(it) && stdout.contains(it)), "{stdout}");
    }
    let hardening = units.each_ref().map(|unit| {
        let settings = unit.lines().skip_while(|line| !line.starts_with("NoNewPrivileges"));
        settings.take_while(|line| *line != "[Install]").filter(|line| line.contains('=')).collect::<Vec<_>>()
    });
    assert!(hardening[0].len() > 15 && hardening[0] == hardening[1], "{hardening:?}");
}
