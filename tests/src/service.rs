//! A running `ocb serve`, as a guest sees it.

use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use reqwest::blocking::{Client, Response};
use reqwest::header::{HeaderMap, HeaderName};
use serde_json::Value;

use crate::place::built;
use crate::process::command;

/// The built service on a data folder. Dropping it kills it.
pub struct Service {
    child: Child,
    url: String,
}

impl Service {
    /// Starts on a free port of the loopback interface, with every plugin that is built, and waits until it answers. It measures
    /// nothing unasked.
    pub fn start(data: &Path) -> Self {
        Self::start_with(data, &[])
    }

    /// The same with these plugins alone, or with every one when none is named.
    pub fn start_with(data: &Path, plugins: &[&str]) -> Self {
        Self::start_saying(data, plugins, &[])
    }

    /// The same with more arguments.
    pub fn start_saying(data: &Path, plugins: &[&str], more: &[&str]) -> Self {
        Self::start_among(data, plugins, more, &[])
    }

    /// The same with variables of the environment.
    pub fn start_among(data: &Path, plugins: &[&str], more: &[&str], environment: &[(&str, &str)]) -> Self {
        let address = free_address();
        let mut serve = command(built("ocb"));
        serve.arg("serve").arg("--data").arg(data).args(["--listen", &address, "--idle", "off"]).args(more);
        serve.envs(environment.iter().copied());
        for plugin in plugins {
            serve.arg("--plugins").arg(built(plugin));
        }
        let child = serve.stdout(Stdio::null()).spawn().expect("the service starts");
        let mut service = Self { child, url: format!("http://{address}/api/v1") };
        let client = Client::new();
        let end = Instant::now() + Duration::from_secs(60);
        while !client.get(format!("{}/status", service.url)).send().is_ok_and(|r| r.status().is_success()) {
            if let Some(status) = service.child.try_wait().expect("the service's state") {
                panic!("the service ended at once: {status}");
            }
            assert!(Instant::now() < end, "the service does not answer");
            std::thread::sleep(Duration::from_millis(20));
        }
        service
    }

    /// Where its API begins.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Where its pages begin.
    pub fn pages(&self) -> &str {
        self.url.trim_end_matches("/api/v1")
    }

    /// Process id of the service.
    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// Ends the service by SIGKILL. What the system has taken over is not lost by that, as it would be with the power.
    pub fn kill(mut self) {
        self.child.kill().expect("the service was alive");
        self.child.wait().expect("the service is gone");
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        // After `kill` both calls only find nothing left to do.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// An address on the loopback interface that nobody listens on.
pub fn free_address() -> String {
    let port = TcpListener::bind("127.0.0.1:0").and_then(|l| l.local_addr()).expect("a free port").port();
    format!("127.0.0.1:{port}")
}

/// The password of every account that tests make.
pub const PASSWORD: &str = "a long enough password";

/// Makes an account of this role and name on a data folder that no service has open.
pub fn add_account(data: &Path, role: &str) {
    let mut admin = command(built("ocb"));
    admin.args(["admin", "create", role, "--role", role, "--data"]).arg(data).env("OCB_PASSWORD", PASSWORD);
    crate::process::output(&mut admin);
}

/// A visitor with a cookie of their own, who may talk to the service again after it was restarted on another port.
pub struct Guest {
    client: Client,
}

impl Default for Guest {
    fn default() -> Self {
        Self::new(HeaderMap::new())
    }
}

impl Guest {
    fn new(headers: HeaderMap) -> Self {
        // The service is on this machine: to read the system's certificates for each visitor would keep a CPU busy for long.
        let client = Client::builder().tls_certs_only([]).cookie_store(true).timeout(Duration::from_secs(120));
        Self { client: client.default_headers(headers).build().expect("an HTTP client") }
    }

    /// A visitor whom a proxy lets in from this address.
    pub fn from_address(address: &str) -> Self {
        Self::new(HeaderMap::from_iter([(
            HeaderName::from_static("x-forwarded-for"),
            address.parse().expect("an address"),
        )]))
    }

    /// A visitor who has entered the account of this name.
    pub fn member(service: &Service, name: &str) -> Self {
        let guest = Self::default();
        let body = serde_json::json!({ "name": name, "password": PASSWORD });
        let (status, told) = guest.post(service, "/account/login", &body);
        assert_eq!(status, 200, "{name} cannot log in: {told}");
        guest
    }

    /// Status and JSON of an upload of a plugin; `None` when the connection was cut.
    pub fn send_plugin(&self, service: &Service, manifest: &Value, bytes: Vec<u8>) -> Option<(u16, Value)> {
        let file = reqwest::blocking::multipart::Part::bytes(bytes).file_name("plugin.so");
        let form = reqwest::blocking::multipart::Form::new().text("manifest", manifest.to_string()).part("file", file);
        whole(self.client.post(format!("{}/plugins", service.url)).multipart(form))
    }

    /// Status and JSON of an upload of an object; `None` when the connection was cut.
    pub fn send_object(&self, service: &Service, name: &str, bytes: Vec<u8>) -> Option<(u16, Value)> {
        let part = reqwest::blocking::multipart::Part::bytes(bytes).file_name(name.to_owned());
        let form = reqwest::blocking::multipart::Form::new().part("file", part);
        whole(self.client.post(format!("{}/objects", service.url)).multipart(form))
    }

    /// Status and JSON of a POST of JSON; `None` when the connection was cut.
    pub fn send(&self, service: &Service, path: &str, body: &Value) -> Option<(u16, Value)> {
        whole(self.client.post(format!("{}{path}", service.url)).json(body))
    }

    /// The answer to a GET below `/api/v1`.
    pub fn look(&self, service: &Service, path: &str) -> Response {
        self.client.get(format!("{}{path}", service.url)).send().unwrap_or_else(|e| panic!("GET {path}: {e}"))
    }

    /// Reads a page or an answer, given below the address of the service, that must be there.
    pub fn page(&self, service: &Service, path: &str) {
        let answer = self.client.get(format!("{}{path}", service.pages())).send();
        let answer = answer.unwrap_or_else(|e| panic!("GET {path}: {e}"));
        assert!(answer.status().is_success(), "GET {path}: {}", answer.status());
        answer.bytes().unwrap_or_else(|e| panic!("GET {path}: {e}"));
    }

    /// JSON that a GET must succeed with.
    pub fn get(&self, service: &Service, path: &str) -> Value {
        let answer = self.look(service, path);
        let status = answer.status();
        let text = answer.text().expect("a body");
        assert!(status.is_success(), "GET {path}: {status} {text}");
        serde_json::from_str(&text).unwrap_or_else(|e| panic!("GET {path}: {e}: {text}"))
    }

    /// Status and JSON of a POST of JSON.
    pub fn post(&self, service: &Service, path: &str, body: &Value) -> (u16, Value) {
        self.send(service, path, body).unwrap_or_else(|| panic!("POST {path}: no answer"))
    }

    /// Status and JSON of an upload.
    pub fn upload(&self, service: &Service, name: &str, bytes: Vec<u8>) -> (u16, Value) {
        self.send_object(service, name, bytes).unwrap_or_else(|| panic!("upload of {name}: no answer"))
    }

    /// Asks for a run that must be accepted; gives its id.
    pub fn submit(&self, service: &Service, spec: &Value) -> String {
        let (status, run) = self.post(service, "/runs", spec);
        assert_eq!(status, 201, "{spec} was refused: {run}");
        run["id"].as_str().expect("an id").to_owned()
    }

    /// Looks at the run until `enough` of it, and gives it as it was then. What may be over in a moment wants [`Guest::catch`].
    pub fn wait(&self, service: &Service, run: &str, what: &str, enough: impl Fn(&Value) -> bool) -> Value {
        self.until(service, run, Duration::from_millis(50), what, enough)
    }

    /// The same in a hurry, which keeps a CPU busy.
    pub fn catch(&self, service: &Service, run: &str, what: &str, enough: impl Fn(&Value) -> bool) -> Value {
        self.until(service, run, Duration::from_millis(5), what, enough)
    }

    fn until(&self, at: &Service, run: &str, every: Duration, what: &str, enough: impl Fn(&Value) -> bool) -> Value {
        let end = Instant::now() + Duration::from_secs(180);
        loop {
            let now = self.get(at, &format!("/runs/{run}"));
            if enough(&now) {
                return now;
            }
            assert!(Instant::now() < end, "waited in vain until {what}: {now}");
            std::thread::sleep(every);
        }
    }
}

/// The whole answer, or nothing: half of one tells nothing. An answer without a body is null.
fn whole(request: reqwest::blocking::RequestBuilder) -> Option<(u16, Value)> {
    let response = request.send().ok()?;
    let status = response.status().as_u16();
    let text = response.text().ok()?;
    let body = if text.is_empty() { Value::Null } else { serde_json::from_str(&text).ok()? };
    Some((status, body))
}

/// Process ids of everything that `pid` started and that still runs, and what that started.
pub fn descendants(pid: u32) -> Vec<u32> {
    let mut found = Vec::new();
    let tasks = std::fs::read_dir(format!("/proc/{pid}/task")).into_iter().flatten().flatten();
    for task in tasks {
        let children = std::fs::read_to_string(task.path().join("children")).unwrap_or_default();
        for child in children.split_whitespace().filter_map(|c| c.parse().ok()) {
            found.push(child);
            found.extend(descendants(child));
        }
    }
    found
}

/// The process below `pid` that holds a plugin, if there is one now.
pub fn runner_below(pid: u32) -> Option<u32> {
    descendants(pid).into_iter().find(|p| {
        let arguments = std::fs::read(format!("/proc/{p}/cmdline")).unwrap_or_default();
        let mut arguments = arguments.split(|b| *b == 0);
        arguments.next().is_some_and(|program| program.ends_with(b"ocb-runner")) && arguments.next() == Some(b"run")
    })
}
