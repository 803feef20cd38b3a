//! Running compilers.
#![allow(dead_code, reason = "each test binary uses a part")]

use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of this package.
pub fn package() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// A command: a compiler, or what starts one.
#[expect(clippy::disallowed_methods, reason = "the templates are built as their readers build them")]
pub fn command(program: &str) -> Command {
    Command::new(program)
}

/// Runs a command and panics with everything it said when it fails.
pub fn run(command: &mut Command) {
    let output = command.output().unwrap_or_else(|error| panic!("cannot start {command:?}: {error}"));
    assert!(
        output.status.success(),
        "{command:?} failed:\n{}{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
}

/// The language standards that the headers promise to compile as.
pub const STANDARDS: [(&str, &str); 6] =
    [("c", "c11"), ("c", "c17"), ("c++", "c++11"), ("c++", "c++14"), ("c++", "c++17"), ("c++", "c++20")];

/// Checks a source file as every standard with every compiler there is; gcc must be there.
pub fn compile_as_every_standard(source: &Path) {
    compile_as(&STANDARDS, source);
}

/// The same as these standards.
pub fn compile_as(standards: &[(&str, &str)], source: &Path) {
    for (compilers, required) in [(["gcc", "g++"], true), (["clang", "clang++"], false)] {
        // Under qemu-user a program that is not there starts, and ends at once with 127.
        let found = command(compilers[0]).arg("--version").output().is_ok_and(|output| output.status.success());
        assert!(found || !required, "{} is needed: install gcc and g++", compilers[0]);
        if !found {
            continue;
        }
        for (language, standard) in standards {
            run(command(compilers[usize::from(*language == "c++")])
                .args(["-x", language, &format!("-std={standard}")])
                .args(["-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", "-I"])
                .arg(package().join("include"))
                .arg(source));
        }
    }
}
