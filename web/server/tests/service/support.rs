//! One service per test, on a free port, in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use ocb_service::{Ceilings, Engine, EngineConfig, MailServer, Profile};
use reqwest::{Client, Method, RequestBuilder, Response, StatusCode};
use serde_json::{Value, json};
use tempfile::TempDir;
use tokio::sync::oneshot;
use tokio::task::JoinHandle;

/// A running service.
pub struct Service {
    pub url: String,
    pub engine: Engine,
    stop: oneshot::Sender<()>,
    served: JoinHandle<()>,
    how: How,
    data: TempDir,
}

/// What stays the same when it is started again.
#[derive(Clone, Default)]
pub struct How {
    pub plugins: Vec<PathBuf>,
    pub suite: Option<PathBuf>,
    pub mail: Option<MailServer>,
    pub machine_note: Option<String>,
    pub ceilings: Option<Ceilings>,
    /// Address of a PostgreSQL database.
    pub database: Option<String>,
    /// Nothing is worked on.
    pub idle: bool,
    /// Plugins are checked with all questions, which takes a minute.
    pub whole_checks: bool,
}

impl Service {
    /// With these plugins of ours alone. What is sent to it is run with whatever jail this machine has.
    pub async fn start_with(plugins: &[&str]) -> Self {
        Self::open(How { plugins: ours(plugins), ..How::default() }).await
    }

    /// The same, which checks what it is sent as any service does.
    pub async fn start_checking(plugins: &[&str]) -> Self {
        Self::open(How { plugins: ours(plugins), whole_checks: true, ..How::default() }).await
    }

    /// The same, with the suite in this file.
    pub async fn start_on(plugins: &[&str], suite: &Path) -> Self {
        Self::open(How { plugins: ours(plugins), suite: Some(suite.to_owned()), ..How::default() }).await
    }

    /// The smallest one, whose mails this server takes.
    pub async fn start_mailing(mail: MailServer) -> Self {
        Self::open(How { plugins: ours(&["libocb_box_tree.so"]), mail: Some(mail), ..How::default() }).await
    }

    /// The smallest one with these ceilings, which works on nothing.
    pub async fn start_limited(ceilings: Ceilings) -> Self {
        let plugins = ours(&["libocb_box_tree.so", "libocb_brute_force.so"]);
        Self::open(How { plugins, ceilings: Some(ceilings), idle: true, ..How::default() }).await
    }

    /// The same on a database that it may share.
    pub async fn start_beside(database: &str) -> Self {
        let (plugins, database) = (ours(&["libocb_box_tree.so"]), Some(database.to_owned()));
        Self::open(How { plugins, database, idle: true, ..How::default() }).await
    }

    async fn open(how: How) -> Self {
        Self::open_in(tempfile::tempdir().expect("a temporary folder"), how).await
    }

    async fn open_in(data: TempDir, how: How) -> Self {
        let mut config = EngineConfig::beside_executable(data.path());
        config.runner = built().join("ocb-runner");
        config.advisor = built().join("ocb-advisor");
        config.plugins.clone_from(&how.plugins);
        config.suite.clone_from(&how.suite);
        config.machine_note.clone_from(&how.machine_note);
        config.database_url.clone_from(&how.database);
        config.profile = Profile::Dev;
        config.mail.clone_from(&how.mail);
        config.ceilings = how.ceilings.unwrap_or_default();
        config.dispatch = !how.idle;
        config.quick_checks = !how.whole_checks;
        config.quick_advice = true;
        let engine = Engine::open(config).await.expect("the engine opens");
        let listener = ocb_server::bind(([127, 0, 0, 1], 0).into()).await.expect("a free port");
        let url = format!("http://{}", listener.local_addr().expect("an address"));
        let (stop, stopped) = oneshot::channel();
        let served = tokio::spawn(ocb_server::serve(
            engine.clone(),
            ocb_server::Network::default(),
            listener,
            ocb_server::Aside::default(),
            async {
                let _ = stopped.await;
            },
        ));
        Self { url, engine, stop, served, how, data }
    }

    /// A browser with its own cookies.
    pub fn guest(&self) -> Guest {
        let client = Client::builder().cookie_store(true).timeout(Duration::from_secs(240)).build().expect("a client");
        Guest { client, url: self.url.clone() }
    }

    /// How many files it stores.
    pub fn blobs(&self) -> usize {
        let folders = std::fs::read_dir(self.data.path().join("blobs")).into_iter().flatten().flatten();
        folders.map(|folder| std::fs::read_dir(folder.path()).expect("a folder").count()).sum()
    }

    /// Takes every file off the disk that is stored under this hash.
    pub fn lose(&self, sha256: &str) {
        let mut folders = vec![self.data.path().to_path_buf()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
                if entry.path().is_dir() {
                    folders.push(entry.path());
                } else if entry.file_name().to_string_lossy().contains(sha256) {
                    std::fs::remove_file(entry.path()).expect("it is there");
                }
            }
        }
    }

    /// Ends the service and waits for it.
    pub async fn stop(self) {
        self.end().await;
    }

    /// Ends the service and starts another one on the same data.
    pub async fn restart(self) -> Self {
        let (data, how) = self.end().await;
        Self::open_in(data, how).await
    }

    /// The same with another mail server.
    pub async fn restart_mailing(self, mail: MailServer) -> Self {
        let (data, how) = self.end().await;
        Self::open_in(data, How { mail: Some(mail), ..how }).await
    }

    /// The same, on what is another hardware class by this note.
    pub async fn restart_noted(self, note: &str) -> Self {
        let (data, how) = self.end().await;
        Self::open_in(data, How { machine_note: Some(note.to_owned()), ..how }).await
    }

    async fn end(self) -> (TempDir, How) {
        self.stop.send(()).expect("the service runs");
        self.served.await.expect("no panic");
        self.engine.shutdown().await;
        (self.data, self.how)
    }
}

fn ours(plugins: &[&str]) -> Vec<PathBuf> {
    plugins.iter().map(|name| built().join(name)).collect()
}

/// A fresh schema in the harness's database.
#[expect(clippy::disallowed_methods, reason = "the test asks PostgreSQL's own program")]
pub fn database() -> String {
    let url = std::env::var("OCB_TEST_POSTGRES").expect("OCB_TEST_POSTGRES is not set: run `make test`");
    let schema = format!("test_{}", uuid::Uuid::new_v4().simple());
    let made = Command::new("psql").args(["-q", "-d", &url, "-c", &format!("CREATE SCHEMA {schema}")]).status();
    assert!(made.expect("psql is installed").success(), "no schema could be made at {url}");
    let join = if url.contains('?') { '&' } else { '?' };
    format!("{url}{join}options=-c%20search_path%3D{schema}")
}

/// The folder of the built runner and plugins: above that of this test program.
pub fn built() -> PathBuf {
    let program = std::env::current_exe().expect("a path");
    let folder = program.parent().and_then(|deps| deps.parent()).expect("target/<profile>/deps").to_path_buf();
    for file in ["ocb-runner", "ocb-advisor", "libocb_box_tree.so", "libocb_brute_force.so"] {
        let path = folder.join(file);
        assert!(path.exists(), "{} is missing; run `cargo build --release` first", path.display());
    }
    folder
}

/// A visitor.
#[derive(Clone)]
pub struct Guest {
    pub client: Client,
    url: String,
}

impl Guest {
    pub fn get(&self, path: &str) -> RequestBuilder {
        self.client.get(format!("{}{path}", self.url))
    }

    pub fn post(&self, path: &str) -> RequestBuilder {
        self.client.post(format!("{}{path}", self.url))
    }

    pub fn request(&self, method: Method, path: &str) -> RequestBuilder {
        self.client.request(method, format!("{}{path}", self.url))
    }

    /// The JSON that a path answers with 200.
    pub async fn json(&self, path: &str) -> Value {
        let response = self.get(path).send().await.expect("an answer");
        assert_eq!(response.status(), StatusCode::OK, "{path}");
        response.json().await.expect("JSON")
    }

    /// The bytes that a path answers with 200, and their media type.
    pub async fn bytes(&self, path: &str) -> (Vec<u8>, String) {
        let response = self.get(path).send().await.expect("an answer");
        assert_eq!(response.status(), StatusCode::OK, "{path}");
        let media_type = header(&response, "content-type");
        (response.bytes().await.expect("a body").to_vec(), media_type)
    }

    /// Uploads a file under a name.
    pub async fn upload(&self, name: &str, bytes: impl Into<Vec<u8>>) -> Response {
        self.send_file("/api/v1/objects", name, bytes).await
    }

    /// Sends a file in the form of an upload.
    pub async fn send_file(&self, path: &str, name: &str, bytes: impl Into<Vec<u8>>) -> Response {
        let part = reqwest::multipart::Part::bytes(bytes.into()).file_name(name.to_owned());
        let form = reqwest::multipart::Form::new().part("file", part);
        self.post(path).multipart(form).send().await.expect("an answer")
    }

    /// Asks for a run and gives its id.
    pub async fn start(&self, spec: &Value) -> String {
        let response = self.post("/api/v1/runs").json(spec).send().await.expect("an answer");
        assert_eq!(response.status(), StatusCode::CREATED);
        let location = header(&response, "location");
        let run: Value = response.json().await.expect("JSON");
        let id = run["id"].as_str().expect("an id").to_owned();
        assert_eq!(location, format!("/api/v1/runs/{id}"));
        id
    }
}

/// A small run of one algorithm: each more is six processes.
pub fn small_spec() -> Value {
    json!({
        "object_a": "stock:torus-knot@600",
        "query": "collision_first",
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 60 } },
        "algorithms": ["box-tree"],
        "passes": 1,
        "budget_seconds": 10.0,
    })
}

/// The same of two, which are compared.
pub fn small_comparison() -> Value {
    let mut spec = small_spec();
    spec["algorithms"] = json!(["box-tree", "brute-force"]);
    spec
}

pub fn header(response: &Response, name: &str) -> String {
    response.headers().get(name).and_then(|value| value.to_str().ok()).unwrap_or_default().to_owned()
}

/// Expects a problem document of that status whose detail is one sentence, and gives the sentence.
pub async fn problem(response: Response, status: u16) -> String {
    let (seen, media_type) = (response.status().as_u16(), header(&response, "content-type"));
    let text = response.text().await.expect("a body");
    assert_eq!(seen, status, "{text}");
    assert_eq!(media_type, "application/problem+json", "{text}");
    let problem: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(problem["status"], status);
    assert_eq!(problem["type"], "about:blank");
    let detail = problem["detail"].as_str().expect("a detail").to_owned();
    assert!(detail.ends_with('.') && !detail.contains('\n') && detail.len() > 10, "no sentence: {detail:?}");
    detail
}
