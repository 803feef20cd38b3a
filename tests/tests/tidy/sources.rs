//! What the sources of a floor may contain.

use std::path::{Path, PathBuf};

use ocb_tests::place::{text, tracked};

/// Rust sources below `folder`.
fn rust_below(folder: &str) -> Vec<(PathBuf, String)> {
    let files = tracked().into_iter().filter(|p| p.starts_with(folder) && p.extension().is_some_and(|e| e == "rs"));
    let found: Vec<_> = files.filter_map(|p| text(&p).map(|t| (p, t))).collect();
    assert!(!found.is_empty(), "no Rust sources below {folder}");
    found
}

/// The code of a line: nothing of a comment.
fn code(line: &str) -> &str {
    line.split("//").next().unwrap_or("")
}

fn hits(files: &[(PathBuf, String)], needles: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for (path, text) in files {
        for (i, line) in text.lines().enumerate() {
            if needles.iter().any(|n| code(line).contains(n)) {
                found.push(format!("{}:{}: {}", path.display(), i + 1, line.trim()));
            }
        }
    }
    found
}

#[test]
fn the_core_does_no_io_and_knows_no_clock() {
    let needles = [
        "std::fs",
        "std::net",
        "std::process",
        "std::thread",
        "std::time",
        "std::env",
        "println!",
        "SystemTime",
        "Instant",
    ];
    let mut files = rust_below("host/core/src");
    files.retain(|(p, _)| !p.ends_with("tests.rs"));
    let found = hits(&files, &needles);
    assert!(found.is_empty(), "host/core is pure:\n{}", found.join("\n"));
    let lib = text(Path::new("host/core/src/lib.rs")).expect("lib.rs");
    assert!(lib.contains("#![forbid(unsafe_code)]"), "host/core forbids unsafe code");
}

#[test]
fn what_is_named_by_its_hash_does_not_depend_on_the_systems_sines() {
    let functions = ["sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh"]
        .into_iter()
        .chain(["exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "powf", "cbrt", "hypot"]);
    let calls: Vec<String> = functions.flat_map(|f| [format!(".{f}("), format!("f64::{f}")]).collect();
    let calls: Vec<&str> = calls.iter().map(String::as_str).collect();
    for folder in ["stock", "sampling", "oracle", "bvh"] {
        let mut files = rust_below(&format!("host/core/src/{folder}"));
        files.retain(|(p, _)| !p.ends_with("tests.rs"));
        let found = hits(&files, &calls);
        assert!(found.is_empty(), "take these from libm, the same on every machine:\n{}", found.join("\n"));
    }
}

#[test]
fn unsafe_stands_in_few_files() {
    // The ABI on both of its sides, the jail, the place that pins threads to CPUs, a setting of the allocator, and instructions
    // that not every machine has; a test's support may play the host.
    const ALLOWED: [&str; 6] = [
        "plugin-api/",
        "sandbox/",
        "host/lab/src/machine.rs",
        "host/cli/src/memory.rs",
        "plugins/lib/lanes/",
        "plugins/lib/triangles/tests/support/",
    ];
    let mut found = Vec::new();
    for (path, text) in ["host", "plugin-api", "plugins", "sandbox", "web", "tests"].iter().flat_map(|f| rust_below(f))
    {
        let uses = text
            .lines()
            .any(|l| ["{", "fn", "impl", "extern", "trait"].iter().any(|k| code(l).contains(&["unsafe ", k].concat())));
        if uses && !ALLOWED.iter().any(|a| path.starts_with(a)) {
            found.push(path);
        }
    }
    assert!(found.is_empty(), "unsafe outside the files that may hold it: {found:?}");
}

#[test]
fn the_reference_never_enters_the_runner() {
    let found = hits(&rust_below("sandbox/src"), &["Truth", "Placed", "oracle", "Verdict", "validation"]);
    assert!(found.is_empty(), "the sandbox must not know the truth:\n{}", found.join("\n"));
}

#[test]
fn plugins_are_opened_in_the_runner_alone() {
    // The jail loads the system's own libraries before it closes itself off, which is no foreign code.
    let may = |p: &Path| {
        p.starts_with("sandbox/src/runner")
            || p.starts_with("sandbox/src/confine")
            || p.components().any(|c| c.as_os_str() == "tests")
    };
    let all = ["host", "web", "sandbox", "plugins", "plugin-api"].iter().flat_map(|f| rust_below(f));
    let found = hits(&all.filter(|(p, _)| !may(p)).collect::<Vec<_>>(), &["libloading", "dlopen("]);
    assert!(found.is_empty(), "only the runner opens a plugin:\n{}", found.join("\n"));
    let outside = ["host", "web", "tests"].iter().flat_map(|f| rust_below(f)).filter(|(p, _)| !p.ends_with(file!()));
    let found = hits(&outside.collect::<Vec<_>>(), &["goblin", "iced_x86", "gate::inspect"]);
    assert!(found.is_empty(), "a stranger's ELF file is read in the jail alone:\n{}", found.join("\n"));
}

#[test]
fn every_system_call_that_is_allowed_has_a_reason() {
    let policy = text(Path::new("sandbox/src/syscalls.json")).expect("the policy");
    let policy: serde_json::Value = serde_json::from_str(&policy).expect("JSON");
    let lists = policy.as_object().expect("an object").values().filter_map(|v| v.as_array());
    let entries: Vec<_> = lists.flatten().collect();
    assert!(entries.len() > 20, "only {} entries were read", entries.len());
    for entry in entries {
        let reason = entry["because"].as_str().unwrap_or("");
        assert!(reason.len() >= 6, "{} has no reason in sandbox/src/syscalls.json", entry["call"]);
    }
}
