//! What tracked files may look like.

use std::path::Path;

use ocb_tests::place::{text, tracked};

const CODE: [&str; 11] = ["rs", "ts", "vue", "mjs", "css", "c", "cpp", "h", "hpp", "sh", "sql"];

fn is_code(path: &Path) -> bool {
    path.extension().is_some_and(|e| CODE.iter().any(|c| e == *c))
}

/// Written by a program and checked against its source by a test of its own.
fn is_generated(path: &Path) -> bool {
    let path = path.to_string_lossy();
    path.contains("snapshots/") || path.ends_with(".lock") || path.ends_with("package-lock.json")
}

/// The lines of tracked files that contain one of `needles`, as `path:line: text`.
fn lines_with(needles: &[&str], which: impl Fn(&Path) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    for path in tracked().into_iter().filter(|p| which(p)) {
        for (i, line) in
            text(&path).iter().flat_map(|t| t.lines().enumerate().map(|(i, l)| (i, l.to_owned())).collect::<Vec<_>>())
        {
            if needles.iter().any(|n| line.contains(n)) {
                found.push(format!("{}:{}: {}", path.display(), i + 1, line.trim()));
            }
        }
    }
    found
}

#[test]
fn no_code_file_is_longer_than_500_lines() {
    let files = tracked();
    assert!(files.iter().filter(|p| is_code(p)).count() > 50, "git lists too few files: is this a checkout?");
    let long: Vec<_> = files
        .iter()
        .filter(|p| is_code(p) && !is_generated(p))
        .filter_map(|p| Some((p, text(p)?.lines().count())).filter(|(_, n)| *n > 500))
        .collect();
    assert!(long.is_empty(), "one thing per file, split these: {long:?}");
}

#[test]
fn no_tracked_file_is_large() {
    let size = |p: &Path| std::fs::metadata(ocb_tests::place::root().join(p)).map_or(0, |m| m.len());
    let large: Vec<_> = tracked().into_iter().filter(|p| size(p) > 1 << 20).collect();
    assert!(large.is_empty(), "larger than 1 MiB: {large:?}");
}

#[test]
fn nothing_names_a_machine_or_a_package_registry() {
    // Put together here, so that this file is not its own finding.
    let hosts = [
        ["registry", "npmjs"],
        ["crates", "io:"],
        ["crates", "io/"],
        ["files", "pythonhosted"],
        ["pypi", "org"],
        ["deb", "debian"],
    ];
    let mut needles: Vec<String> = hosts.map(|h| h.join(".")).to_vec();
    needles.extend(["root", "home", "Users", "work", "farm"].map(|d| format!("/{d}/")));
    let needles: Vec<&str> = needles.iter().map(String::as_str).collect();
    // A path begins there: `web/work/` or `https://host/home/` is none.
    let path_like = |line: &str| {
        needles.iter().any(|n| {
            line.match_indices(n).any(|(i, _)| {
                let before = line[..i].chars().next_back();
                !n.starts_with('/') || !before.is_some_and(|c| c.is_alphanumeric() || "_.-}".contains(c))
            })
        })
    };
    let found: Vec<_> = lines_with(&needles, |_| true)
        .into_iter()
        .filter(|hit| path_like(hit.splitn(3, ':').nth(2).unwrap_or("")))
        .collect();
    assert!(found.is_empty(), "these work on one machine only:\n{}", found.join("\n"));
}

#[test]
fn lock_files_hold_no_download_addresses() {
    let found = lines_with(&["\"resolved\":"], |p| p.ends_with("package-lock.json"));
    assert!(
        found.is_empty(),
        "add omit-lockfile-registry-resolved=true to .npmrc and lock again:\n{}",
        found.join("\n")
    );
    let cargo = text(Path::new("Cargo.lock")).expect("Cargo.lock");
    let sources: std::collections::BTreeSet<&str> = cargo.lines().filter(|l| l.starts_with("source = ")).collect();
    assert_eq!(sources.len(), 1, "Cargo.lock names more than the usual registry: {sources:?}");
}

#[test]
fn nothing_is_left_undone_or_switched_off() {
    let marks = ["to", "unimplemented", "FIX", "#[ig", ".sk", ".on", "it.to", "describe.sk"];
    let ends = ["do!(", "!(", "ME", "nore", "ip(", "ly(", "do(", "ip"];
    let needles: Vec<String> = marks.iter().zip(ends).map(|(a, b)| format!("{a}{b}")).collect();
    let needles: Vec<&str> = needles.iter().map(String::as_str).collect();
    // `.skip(` is an iterator's method in Rust; in the pages' tests it switches a test off.
    let in_rust = |hit: &String| hit.split(':').next().is_some_and(|p| p.ends_with(".rs")) && hit.contains(needles[4]);
    let found: Vec<_> = lines_with(&needles, is_code).into_iter().filter(|h| !in_rust(h)).collect();
    assert!(found.is_empty(), "no stub, no switched-off test:\n{}", found.join("\n"));
}

/// A library whose manifest says that it holds no tests is not built a second time to look for them, which saves minutes;
/// so none may be there.
#[test]
fn libraries_without_tests_hold_none() {
    let manifests = tracked().into_iter().filter(|p| p.ends_with("Cargo.toml"));
    let mut told = 0;
    let mut found = Vec::new();
    for manifest in manifests {
        let says = |line: &str| text(&manifest).is_some_and(|t| t.lines().any(|l| l == line));
        let sources = manifest.with_file_name("src");
        let below = |p: &Path| p.starts_with(&sources) && p.extension().is_some_and(|e| e == "rs");
        for (line, needles) in
            [("test = false", &["#[test]", "cfg(test)"][..]), ("doctest = false", &["/// ```", "//! ```"])]
        {
            if says(line) {
                told += 1;
                found.extend(lines_with(needles, below));
            }
        }
    }
    assert!(told > 10, "no manifest says so: is this the workspace?");
    assert!(found.is_empty(), "tests that never run (mend the manifest beside them): {found:?}");
}
