//! The service is killed at random moments while objects and plugins are uploaded, plugins are checked and published, and runs are
//! asked for. What was acknowledged is there afterwards, and nothing is half done.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use ocb_tests::place::{built, root};
use ocb_tests::process::{command, output};
use ocb_tests::service::{Guest, Service, add_account};
use serde_json::{Value, json};

use crate::{alone, asked, empty};

/// The template in C, somebody's plugin: it answers one kind of question, and its check takes a third of the time of one that
/// answers all.
const ALGORITHM: &str = "my-algorithm-c";
const INSTALLED: [&str; 2] = ["libocb_box_tree.so", "libocb_brute_force.so"];

/// Times that the service is killed during one version's life, and of these during its check: one that was begun three times is given
/// up.
const CUTS_OF_A_VERSION: u64 = 25;
const CUTS_OF_A_CHECK: u64 = 2;

/// Numbers that no two things of these tests share.
static NUMBER: AtomicU64 = AtomicU64::new(1);

fn number() -> u64 {
    NUMBER.fetch_add(1, Ordering::Relaxed)
}

/// What the service has said yes to.
#[derive(Default)]
struct Promised {
    /// Objects by id, with their SHA-256.
    objects: BTreeMap<String, Value>,
    /// Plugins by id, with their SHA-256.
    plugins: BTreeMap<String, Value>,
    runs: Vec<String>,
}

/// The clients at work when the service is killed.
struct People {
    guest: Guest,
    developer: Guest,
    curator: Guest,
}

/// The steps of the published plugin that were acknowledged, and the one that was under way.
struct Steps {
    state: &'static str,
    under_way: Option<&'static str>,
}

fn manifest(version: u64) -> Value {
    json!({
        "name": "All pairs", "version": version.to_string(), "authors": "Somebody", "license": "MIT OR Apache-2.0",
        "source": "https://example.org/all-pairs", "queries": ["collision_first"],
    })
}

/// A tetrahedron that nobody else has.
fn object() -> Vec<u8> {
    let size = number();
    format!("v 0 0 0\nv {size} 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n").into_bytes()
}

fn spec() -> Value {
    json!({
        "object_a": "stock:torus-knot@600", "query": "collision_first", "passes": 1,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 60 } },
        "algorithms": ["box-tree", "brute-force"],
    })
}

impl People {
    fn of(service: &Service) -> Self {
        let guest = Guest::default();
        // Who asks twice at once before anybody knows them is two guests.
        guest.get(service, "/objects");
        Self { guest, developer: Guest::member(service, "developer"), curator: Guest::member(service, "curator") }
    }

    /// All at once, until the connection breaks: objects, plugins that fail their check, runs, and steps of a public plugin.
    fn work(&self, service: &Service, promised: &mut Promised, plugin: &str, steps: &mut Steps) {
        let Promised { objects, plugins, runs } = promised;
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while let Some((status, told)) = self.guest.send_object(service, "own.obj", object()) {
                    assert_eq!(status, 201, "{told}");
                    objects.insert(id(&told), told["sha256"].clone());
                    std::thread::sleep(Duration::from_millis(10));
                }
            });
            scope.spawn(|| {
                let bytes = || format!("\x7fELF, and nothing behind it but {}", number()).into_bytes();
                while let Some((status, told)) = self.developer.send_plugin(service, &manifest(number()), bytes()) {
                    // Too many wait, or too many were sent: then for a moment none is.
                    match status {
                        201 => drop(plugins.insert(id(&told), told["sha256"].clone())),
                        409 | 429 => std::thread::sleep(Duration::from_millis(20)),
                        _ => panic!("{status}: {told}"),
                    }
                }
            });
            scope.spawn(|| {
                while let Some((status, told)) = self.guest.send(service, "/runs", &spec()) {
                    assert_eq!(status, 201, "{told}");
                    runs.push(id(&told));
                    let cancelled = self.guest.send(service, &format!("/runs/{}/cancel", id(&told)), &json!({}));
                    if cancelled.is_none() {
                        break;
                    }
                }
            });
            scope.spawn(|| self.decide(service, plugin, steps));
        });
    }

    /// Takes the plugin out and brings it back, over and over.
    fn decide(&self, service: &Service, plugin: &str, steps: &mut Steps) {
        loop {
            let (action, to) = if steps.state == "public" { ("suspend", "suspended") } else { ("reinstate", "public") };
            steps.under_way = Some(to);
            let body = json!({ "action": action, "reason": "It may be killed." });
            let Some((status, told)) = self.curator.send(service, &format!("/plugins/{plugin}/decisions"), &body)
            else {
                return;
            };
            assert_eq!((status, &told["state"]), (200, &json!(to)), "{told}");
            *steps = Steps { state: to, under_way: None };
        }
    }
}

fn id(told: &Value) -> String {
    told["id"].as_str().expect("an id").to_owned()
}

/// The service ends at a moment that nobody chose.
fn kill_soon(service: &Service) {
    let nanos = SystemTime::now().duration_since(UNIX_EPOCH).expect("a clock").subsec_nanos();
    std::thread::sleep(Duration::from_millis(u64::from(nanos / 1000 % 700)));
    let pid = nix::unistd::Pid::from_raw(i32::try_from(service.pid()).expect("a pid"));
    nix::sys::signal::kill(pid, nix::sys::signal::Signal::SIGKILL).expect("the service was alive");
}

/// Everything that was promised is there, whole.
fn assert_kept(people: &People, service: &Service, promised: &Promised) {
    for (id, sha256) in &promised.objects {
        assert_eq!(&people.guest.get(service, &format!("/objects/{id}"))["sha256"], sha256, "object {id}");
        let mesh = people.guest.look(service, &format!("/objects/{id}/mesh.glb"));
        assert!(mesh.status().is_success(), "the mesh of object {id}: {}", mesh.status());
    }
    for (id, sha256) in &promised.plugins {
        let plugin = people.developer.get(service, &format!("/plugins/{id}"));
        assert_eq!(&plugin["sha256"], sha256, "plugin {id}");
        assert_told(&plugin);
    }
    for id in &promised.runs {
        assert_eq!(people.guest.get(service, &format!("/runs/{id}"))["id"], id.as_str());
    }
}

/// The state of a plugin is what its history says, neither more nor less.
fn assert_told(plugin: &Value) {
    let last = plugin["history"].as_array().and_then(|history| history.last()).expect("a history");
    let fits: &[&str] = match last["action"].as_str().expect("a word") {
        "submitted" => &["uploaded", "vetted"],
        "validated" => &["validated"],
        "failed the check" => &["failed"],
        "offered" => &["awaiting"],
        "approved" | "reinstated" => &["public"],
        "suspended" => &["suspended"],
        "withdrew" => &["withdrawn"],
        other => panic!("{other}: {plugin:#}"),
    };
    assert!(fits.iter().any(|state| plugin["state"] == *state), "half done: {plugin:#}");
}

fn offered(people: &People, service: &Service) -> bool {
    let all = people.guest.get(service, "/algorithms");
    all.as_array().expect("algorithms").iter().any(|a| a["id"] == ALGORITHM)
}

/// Starts again after a kill; the audit log must be whole.
fn again(data: &Path, service: Service) -> Service {
    service.kill();
    output(command(built("ocb")).args(["admin", "audit", "--data"]).arg(data));
    Service::start_with(data, &INSTALLED)
}

/// Looks at a plugin until `enough` of it.
fn wait(people: &People, service: &Service, plugin: &str, enough: impl Fn(&Value) -> bool) -> Value {
    let end = Instant::now() + Duration::from_secs(240);
    loop {
        let now = people.developer.get(service, &format!("/plugins/{plugin}"));
        if enough(&now) {
            return now;
        }
        assert!(Instant::now() < end, "waited in vain for {now:#}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

fn is_checking(plugin: &Value) -> bool {
    plugin["state"] == "uploaded" || plugin["state"] == "vetted"
}

/// Takes a step that must be allowed.
fn step(by: &Guest, service: &Service, plugin: &str, action: &str) {
    let (status, told) = by.post(service, &format!("/plugins/{plugin}/decisions"), &json!({ "action": action }));
    assert_eq!(status, 200, "{told}");
}

/// Sends a plugin, once few enough of those before it wait for their check.
fn sent(people: &People, service: &Service, manifest: &Value, bytes: &[u8]) -> Value {
    let end = Instant::now() + Duration::from_secs(240);
    loop {
        let (status, told) = people.developer.send_plugin(service, manifest, bytes.to_vec()).expect("an answer");
        if status == 201 {
            return told;
        }
        assert!(matches!(status, 409 | 429) && Instant::now() < end, "{status}: {told}");
        std::thread::sleep(Duration::from_millis(100));
    }
}

/// The plugin.
fn compiled(folder: &Path) -> Vec<u8> {
    let (source, library) = (root().join("plugin-api/templates/c/my_plugin.c"), folder.join("all-pairs.so"));
    let mut cc = command("cc");
    cc.args(["-std=c11", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-ffp-contract=off", "-I"]);
    output(cc.arg(root().join("plugin-api/include")).arg(source).arg("-o").arg(&library));
    std::fs::read(library).expect("it is compiled")
}

/// Sends a version of the plugin and publishes it; its check is cut short `cuts` times, the first time perhaps before it began.
fn publish(data: &Path, mut service: Service, people: &People, cuts: u64) -> (Service, String) {
    let mut bytes = compiled(data);
    let version = number();
    bytes.extend(version.to_le_bytes());
    let sent = sent(people, &service, &manifest(version), &bytes);
    let plugin = id(&sent);
    for cut in 0..cuts {
        if cut > 0 {
            let begun =
                |now: &Value| !is_checking(now) || now["lines"].as_array().is_some_and(|lines| !lines.is_empty());
            wait(people, &service, &plugin, begun);
        }
        kill_soon(&service);
        service = again(data, service);
        let now = people.developer.get(&service, &format!("/plugins/{plugin}"));
        assert_eq!(now["sha256"], sent["sha256"]);
        assert_told(&now);
    }
    let now = wait(people, &service, &plugin, |now| !is_checking(now));
    assert_eq!(now["state"], "validated", "{now:#}");
    step(&people.developer, &service, &plugin, "offer");
    step(&people.curator, &service, &plugin, "approve");
    (service, plugin)
}

#[test]
fn nothing_promised_is_lost_and_nothing_half_published_at_a_kill() {
    let _alone = alone();
    let cuts = asked("OCB_KILLS", 8);
    let data = empty("kills");
    for role in ["developer", "curator"] {
        add_account(&data, role);
    }
    let mut service = Service::start_with(&data, &INSTALLED);
    let people = People::of(&service);
    let mut whole = Promised::default();
    let mut left = cuts;
    while left > 0 {
        let now = left.min(CUTS_OF_A_VERSION);
        let plugin;
        (service, plugin) = publish(&data, service, &people, now.min(CUTS_OF_A_CHECK));
        let mut steps = Steps { state: "public", under_way: None };
        for _ in CUTS_OF_A_CHECK..now {
            service = cut(&data, service, &people, &plugin, &mut steps, &mut whole);
        }
        step(&people.developer, &service, &plugin, "withdraw");
        assert!(!offered(&people, &service), "what was withdrawn is offered");
        left -= now;
    }
    assert_kept(&people, &service, &whole);
    let Promised { objects, plugins, runs } = whole;
    println!("{cuts} kills: {} objects, {} plugins, {} runs kept", objects.len(), plugins.len(), runs.len());
    assert!(!objects.is_empty() && !plugins.is_empty() && !runs.is_empty());
}

/// Everybody works, the service is killed, and the service comes back with all that it had promised.
fn cut(
    data: &Path,
    mut service: Service,
    people: &People,
    plugin: &str,
    steps: &mut Steps,
    whole: &mut Promised,
) -> Service {
    let mut promised = Promised::default();
    std::thread::scope(|scope| {
        scope.spawn(|| people.work(&service, &mut promised, plugin, steps));
        kill_soon(&service);
    });
    service = again(data, service);
    assert_kept(people, &service, &promised);
    let now = people.curator.get(&service, &format!("/plugins/{plugin}"));
    assert_told(&now);
    let state = [Some(steps.state), steps.under_way].into_iter().flatten().find(|state| now["state"] == *state);
    let state = state.unwrap_or_else(|| panic!("{} was acknowledged: {now:#}", steps.state));
    assert_eq!(offered(people, &service), state == "public", "{now:#}");
    *steps = Steps { state, under_way: None };
    whole.objects.append(&mut promised.objects);
    whole.plugins.append(&mut promised.plugins);
    whole.runs.append(&mut promised.runs);
    service
}
