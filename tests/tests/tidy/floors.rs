//! Which crate may depend on which: read from the manifests through `cargo metadata`, the floors from ARCHITECTURE.md.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use ocb_tests::place::{root, text};
use ocb_tests::process::{command, output};
use serde_json::Value;

/// What `cargo metadata` says of the workspace and everything it depends on.
pub fn metadata() -> Value {
    let text =
        output(command(env!("CARGO")).current_dir(root()).args(["metadata", "--format-version", "1", "--locked"]));
    serde_json::from_str(&text).expect("cargo metadata prints JSON")
}

/// The packages of the workspace.
fn members(metadata: &Value) -> Vec<&Value> {
    let ids: BTreeSet<&str> = strings(&metadata["workspace_members"]).collect();
    let packages = metadata["packages"].as_array().expect("packages").iter();
    packages.filter(|p| ids.contains(p["id"].as_str().expect("id"))).collect()
}

fn package_name(package: &Value) -> String {
    package["name"].as_str().expect("name").to_owned()
}

/// Members by name, with the names of what they depend on outside of tests.
fn dependencies(metadata: &Value) -> BTreeMap<String, BTreeSet<String>> {
    let of = |p: &Value| -> BTreeSet<String> {
        let needs = p["dependencies"].as_array().expect("dependencies").iter();
        needs.filter(|d| d["kind"] != "dev").map(package_name).collect()
    };
    members(metadata).into_iter().map(|p| (package_name(p), of(p))).collect()
}

/// Members by name, with their floors. ARCHITECTURE.md draws one line per folder; a line without a number continues the floor
/// above it, and `plugins/*` stands for every plugin that has no line of its own.
fn floors(metadata: &Value) -> BTreeMap<String, usize> {
    let page = text(Path::new("ARCHITECTURE.md")).expect("a text");
    let drawing = page.split("```").find(|part| part.contains("\nfloor 0 ")).expect("a drawing of the floors");
    let (mut drawn, mut floor): (BTreeMap<&str, usize>, usize) = (BTreeMap::new(), 0);
    for line in drawing.lines().filter(|line| !line.trim().is_empty()) {
        let mut words = line.split_whitespace();
        let mut folder = words.next().expect("a word");
        if folder == "floor" {
            floor = words.next().and_then(|number| number.parse().ok()).expect("the number of a floor");
            folder = words.next().expect("a folder");
        }
        drawn.insert(folder, floor);
    }
    let root = Path::new(metadata["workspace_root"].as_str().expect("a path"));
    let floor_of = |p: &Value| {
        let manifest = Path::new(p["manifest_path"].as_str().expect("a path"));
        let folder = manifest.parent().expect("a folder").strip_prefix(root).expect("a folder of the workspace");
        let folder = folder.to_str().expect("UTF-8");
        let any_plugin = drawn.get("plugins/*").filter(|_| folder.starts_with("plugins/"));
        *drawn.get(folder).or(any_plugin).unwrap_or_else(|| panic!("{folder} has no floor in ARCHITECTURE.md"))
    };
    members(metadata).into_iter().map(|p| (package_name(p), floor_of(p))).collect()
}

fn strings(list: &Value) -> impl Iterator<Item = &str> {
    list.as_array().expect("a list").iter().map(|v| v.as_str().expect("text"))
}

/// Names of all packages that `name` is built from, tests aside.
fn closure(metadata: &Value, name: &str) -> BTreeSet<String> {
    let packages = metadata["packages"].as_array().expect("packages");
    let name_of: BTreeMap<&str, &str> =
        packages.iter().map(|p| (p["id"].as_str().expect("id"), p["name"].as_str().expect("name"))).collect();
    let nodes = metadata["resolve"]["nodes"].as_array().expect("nodes");
    let node: BTreeMap<&str, &Value> = nodes.iter().map(|n| (n["id"].as_str().expect("id"), n)).collect();
    let start = name_of.iter().find(|(id, n)| **n == name && node.contains_key(*id)).expect("a member").0;
    let (mut open, mut seen) = (vec![*start], BTreeSet::new());
    while let Some(id) = open.pop() {
        if seen.insert(id) {
            let deps = node[id]["deps"].as_array().expect("deps").iter();
            let normal =
                deps.filter(|d| d["dep_kinds"].as_array().is_some_and(|k| k.iter().any(|k| k["kind"].is_null())));
            open.extend(normal.map(|d| d["pkg"].as_str().expect("pkg")));
        }
    }
    seen.into_iter().map(|id| name_of[id].to_owned()).collect()
}

const PLUGIN_API: &str = "opencollbench-plugin";
/// What plugins share: tests between two triangles. It knows nothing of ours either.
const TRIANGLES: &str = "ocb-triangles";
/// What plugins with binary hierarchies share.
const HIERARCHY: &str = "ocb-hierarchy";
/// What the plugins for convex objects share.
const BODIES: &str = "ocb-bodies";
/// What the plugins that approximate share: distances to a surface, lattices, trees of balls.
const FIELDS: &str = "ocb-fields";
/// The methods that the advisor compares with, and their plugins export.
const METHODS: &str = "ocb-methods";
/// The program that calls these methods and meshopt, in the jail.
const ADVISOR: &str = "ocb-advisor";
/// Sixteen numbers at once. It knows nothing of ours either.
const LANES: &str = "ocb-lanes";
/// The methods of ocb-fast and simdop, which ocb-auto chooses from.
const WIDE: &str = "ocb-wide";
const PLUGINS: [&str; 17] = [
    "ocb-auto",
    "ocb-box-tree",
    "ocb-brute-force",
    "ocb-convex",
    "ocb-convex-parts",
    "ocb-distance-field",
    "ocb-dop-tree",
    "ocb-fast",
    "ocb-inner-spheres",
    "ocb-obb-tree",
    "ocb-parry",
    "ocb-restricted-box-tree",
    "ocb-rss-tree",
    "ocb-simdop",
    "ocb-sphere-tree",
    "ocb-v-clip",
    "ocb-voxmap-pointshell",
];

#[test]
fn a_crate_depends_only_on_lower_floors() {
    let metadata = metadata();
    let floors = floors(&metadata);
    for (name, needs) in dependencies(&metadata) {
        let floor = floors[&name];
        let wrong: Vec<_> = needs.iter().filter(|n| floors.get(*n).is_some_and(|other| *other >= floor)).collect();
        assert!(wrong.is_empty(), "{name} is on floor {floor} of ARCHITECTURE.md; {wrong:?} is not below");
    }
}

/// Lower floors are not all open to everybody: this is the list of what each crate may use.
#[test]
fn a_crate_depends_only_on_what_is_listed_for_it() {
    let mut may: BTreeMap<&str, &[&str]> = BTreeMap::from([
        (PLUGIN_API, &[] as &[&str]),
        (TRIANGLES, &[]),
        (LANES, &[]),
        (BODIES, &[PLUGIN_API, TRIANGLES]),
        (HIERARCHY, &[PLUGIN_API, TRIANGLES]),
        (WIDE, &[PLUGIN_API, TRIANGLES, LANES, HIERARCHY]),
        (FIELDS, &[PLUGIN_API, TRIANGLES]),
        (METHODS, &[PLUGIN_API, TRIANGLES, FIELDS]),
        ("ocb-core", &[]),
        ("ocb-chart", &[]),
        ("ocb-citation", &[]),
        ("ocb-slurm", &[]),
        ("opencollbench-record", &[]),
        ("ocb-advice", &["ocb-core"]),
        (ADVISOR, &["ocb-advice", "ocb-core", "ocb-sandbox", METHODS, PLUGIN_API]),
        ("ocb-sandbox", &["ocb-core", PLUGIN_API]),
        ("ocb-stability", &["ocb-core"]),
        ("ocb-model", &["ocb-advice", "ocb-chart", "ocb-core", "ocb-stability"]),
        ("ocb-lab", &["ocb-advice", "ocb-core", "ocb-model", "ocb-sandbox", "ocb-stability"]),
        (
            "ocb-service",
            &[
                "ocb-advice",
                "ocb-chart",
                "ocb-citation",
                "ocb-core",
                "ocb-lab",
                "ocb-model",
                "ocb-sandbox",
                "ocb-slurm",
            ],
        ),
        ("ocb-server", &["ocb-core", "ocb-service"]),
        ("ocb-cli", &["ocb-core", "ocb-advice", "ocb-service", "ocb-server"]),
        (
            "ocb-tests",
            &["ocb-chart", "ocb-core", "ocb-sandbox", "ocb-slurm", "ocb-service", "ocb-server", "ocb-cli", PLUGIN_API],
        ),
    ]);
    may.extend(PLUGINS.map(|p| (p, &[PLUGIN_API, TRIANGLES, BODIES, HIERARCHY, WIDE, FIELDS, METHODS] as &[&str])));
    let members = dependencies(&metadata());
    for (name, needs) in &members {
        let allowed = may
            .get(name.as_str())
            .unwrap_or_else(|| panic!("{name} is not listed: say in this test what it may depend on"));
        let ours = needs.iter().filter(|n| members.contains_key(*n));
        let wrong: Vec<_> = ours.filter(|n| !allowed.contains(&n.as_str())).collect();
        assert!(wrong.is_empty(), "{name} must not depend on {wrong:?}");
    }
}

/// A machine that only measures is built from the lab alone.
#[test]
fn the_lab_knows_no_store_no_account_and_nothing_of_http() {
    let lab = closure(&metadata(), "ocb-lab");
    assert!(lab.contains("ocb-sandbox"), "the test sees no dependencies at all");
    let service = ["ocb-service", "ocb-server", "sqlx", "object_store", "argon2", "lettre", "axum", "hyper", "tokio"];
    let known: Vec<_> = service.into_iter().filter(|name| lab.contains(*name)).collect();
    assert!(known.is_empty(), "{known:?}");
}

/// They are called in a jailed program of their own.
#[test]
fn server_and_command_hold_no_library_of_the_advisor() {
    let metadata = metadata();
    let foreign =
        |name: &String| name == "meshopt" || name.starts_with("parry3d") || name == METHODS || name == ADVISOR;
    let of = |name: &str| closure(&metadata, name).into_iter().filter(foreign).collect::<BTreeSet<String>>();
    assert!(of(ADVISOR).len() > 3, "the test sees no dependencies at all");
    for name in ["ocb-cli", "ocb-server", "ocb-lab"] {
        assert_eq!(of(name), BTreeSet::new(), "{name} is built with what runs in the jail alone");
    }
}

#[test]
fn only_the_sandbox_can_load_a_library() {
    for (name, needs) in dependencies(&metadata()) {
        assert!(
            name == "ocb-sandbox" || !needs.contains("libloading"),
            "{name} depends on libloading: foreign code is loaded by the runner alone"
        );
    }
}

#[test]
fn the_oracle_shares_no_code_with_an_algorithm() {
    let metadata = metadata();
    let core = closure(&metadata, "ocb-core");
    assert!(core.contains("nalgebra"), "the test sees no dependencies at all");
    for plugin in PLUGINS {
        let own = closure(&metadata, plugin);
        // Plumbing such as serde may be shared; geometry and arithmetic on coordinates may not.
        let geometry = |n: &str| {
            ["parry", "robust", "nalgebra", "dashu", "ocb-"].iter().any(|g| n.starts_with(g)) || n == PLUGIN_API
        };
        let shared: Vec<_> = own.intersection(&core).filter(|n| geometry(n)).collect();
        assert!(shared.is_empty(), "{plugin} and the oracle are both built from {shared:?}");
    }
}
