//! Compiles the fixtures, once per test program, into a folder beside it.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::SystemTime;

use ocb_sandbox::protocol::{answer, request};

const C: &[&str] = &["-std=gnu11", "-O1", "-fPIC", "-shared", "-fvisibility=hidden", "-w", "-I", INCLUDE];
const CPP: &[&str] = &["-std=gnu++17", "-O1", "-fPIC", "-shared", "-fvisibility=hidden", "-I", INCLUDE];
const RUST: &[&str] = &["--edition", "2024", "-O"];
const INCLUDE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../plugin-api/include");
/// The plugin's side of the interface in Rust, which depends on nothing.
const INTERFACE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../plugin-api/src");

/// `fixtures/fixture.c` with these faults.
pub fn fixture(defines: &[&str]) -> PathBuf {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' { c.to_ascii_lowercase() } else { '-' };
    let name: String = defines.join("+").chars().map(plain).collect();
    let linked = match defines.first() {
        Some(&("ATTACK=throw_out" | "ATTACK=catch_inside")) => vec![once("exceptions.o", |file| {
            cc(&[CPP, &["-c", &source("attacks/exceptions.cpp"), "-o", file]].concat());
        })],
        Some(&"ATTACK=panic_out") => vec![once("libpanics.a", |file| {
            rustc(&[RUST, &["--crate-type", "staticlib", &source("attacks/panics.rs"), "-o", file]].concat());
        })],
        _ => Vec::new(),
    };
    once(&format!("fixture{name}.so"), |file| {
        let mut defines: Vec<String> = defines.iter().map(|d| format!("-D{d}")).collect();
        // Where things lie in the shared memory, as anybody could find out who reads these sources.
        defines.push(format!("-DCONTACTS_AT={}", answer::CONTACTS));
        defines.push(format!("-DPOSES_AT={}", request::POSES));
        let source = source("fixture.c");
        let mut words = C.to_vec();
        words.extend(defines.iter().map(String::as_str));
        words.push(&source);
        words.extend(linked.iter().filter_map(|part| part.to_str()));
        words.extend(["-lm", "-Wl,--as-needed", "-lstdc++", "-lgcc_s", "-o", file]);
        cc(&words);
    })
}

/// One of `fixtures/honest/`.
pub fn honest(name: &str) -> PathBuf {
    let from = source(&format!("honest/{name}"));
    let interface = once("libopencollbench_plugin.rlib", |file| {
        let crate_name = ["--crate-type", "rlib", "--crate-name", "opencollbench_plugin"];
        rustc(&[RUST, &crate_name, &[&format!("{INTERFACE}/lib.rs"), "-o", file]].concat());
    });
    let interface = format!("opencollbench_plugin={}", interface.display());
    once(&format!("{name}.so"), |file| match name.rsplit('.').next() {
        Some("c") => cc(&[C, &["-fopenmp", &from, "-lm", "-o", file]].concat()),
        Some("cpp") => cc(&[CPP, &[&from, "-lstdc++", "-o", file]].concat()),
        _ => rustc(&[RUST, &["--crate-type", "cdylib", "--extern", &interface, &from, "-o", file]].concat()),
    })
}

fn source(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name).to_str().unwrap().into()
}

/// The file of that name, made by the first who asks, one at a time, unless it is newer than all that it is made of.
fn once(name: &str, make: impl FnOnce(&str)) -> PathBuf {
    static MAKING: Mutex<()> = Mutex::new(());
    let _one = MAKING.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = std::env::current_exe().unwrap().with_extension("fixtures");
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(name);
    if changed(&file).is_none_or(|made| made <= newest_source()) {
        // Whoever is interrupted leaves no half of it behind.
        let part = folder.join(format!("part-{name}"));
        make(part.to_str().unwrap());
        std::fs::rename(part, &file).unwrap();
    }
    file
}

/// When the newest of this program, the fixtures' sources and the interface was written.
fn newest_source() -> SystemTime {
    static NEWEST: OnceLock<SystemTime> = OnceLock::new();
    *NEWEST.get_or_init(|| {
        let mut left = vec![std::env::current_exe().unwrap(), source("").into(), INCLUDE.into(), INTERFACE.into()];
        let mut newest = SystemTime::UNIX_EPOCH;
        while let Some(path) = left.pop() {
            newest = newest.max(changed(&path).unwrap());
            let inside = std::fs::read_dir(&path).into_iter().flatten();
            left.extend(inside.map(|entry| entry.unwrap().path()));
        }
        newest
    })
}

fn changed(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|file| file.modified()).ok()
}

/// Runs the C compiler, which compiles C++ as well.
pub fn cc(words: &[&str]) {
    run("cc", words);
}

/// Runs the Rust compiler of this build.
fn rustc(words: &[&str]) {
    run("rustc", words);
}

#[expect(clippy::disallowed_methods, reason = "the tests compile their fixtures")]
fn run(compiler: &str, words: &[&str]) {
    let done = Command::new(compiler).args(words).output();
    let done = done.unwrap_or_else(|e| panic!("the tests need a compiler named {compiler}: {e}"));
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}
