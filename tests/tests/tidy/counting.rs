//! How `make test` counts: a wrong count would hide a failure.

use std::fs;
use std::process::Command;

use ocb_tests::place::root;
use ocb_tests::process::command;

const PASSED: &str = "     Running tests/sets.rs (ocb-core)
test result: ok. 9 passed; 0 failed; 0 ignored; 0 measured; 0 filtered out; finished in 1.93s
";
const NOT_RUN: &str = "     Running tests/real_input.rs (ocb-tests)
---- bunny stdout ----
thread 'bunny' panicked at tests/src/place.rs:25:5:
not run: objects missing, set OCB_SHARED

failures:
    bunny
test result: FAILED. 1 passed; 1 failed; 0 ignored; 0 measured; 0 filtered out; finished in 0.02s
error: test failed, to rerun pass `-p ocb-tests --test real_input`
";
const FAILED: &str = "     Running tests/board/main.rs (ocb-tests)
---- charts::median stdout ----
assertion failed: not run: is no reason in the middle of a line

failures:
    charts::median
test result: FAILED. 14 passed; 1 failed; 0 ignored; 0 measured; 0 filtered out; finished in 4.85s
error: test failed, to rerun pass `-p ocb-tests --test board`
";
const SILENT: &str = "     Running tests/killed_service.rs (ocb-service)
error: test failed, to rerun pass `-p ocb-service --test killed_service`
  signal 11 (Segmentation fault): target/release/deps/killed_service
";
const END: &str = "rust: 91 programs in 700 s\n";

/// What bash says of these logs, and whether it is content.
fn bash(words: &str, logs: &[(&str, &str)]) -> (String, bool) {
    let folder = tempfile::tempdir().expect("a folder");
    for (step, log) in logs {
        fs::write(folder.path().join(format!("{step}.log")), log).expect("written");
    }
    let script = root().join("tests/setup/count.sh").display().to_string();
    let mut bash: Command = command("bash");
    bash.args(["-c", &format!("set -uo pipefail; . {script}; {words}")]).current_dir(folder.path());
    let done = bash.output().expect("bash starts");
    (String::from_utf8(done.stdout).expect("text"), done.status.success())
}

fn summary(steps: &str, logs: &[(&str, &str)]) -> (String, bool) {
    let (said, content) = bash(&format!("summary . {steps}"), logs);
    (said.replace(" (output in .)", ""), content)
}

#[test]
fn every_kind_of_log_is_counted() {
    let logs = [
        ("rust", &*format!("{PASSED}{END}")),
        ("vitest", " Test Files  45 passed (45)\n\u{1b}[32m      Tests  2 failed | 242 passed (244)\u{1b}[0m\n"),
        ("browser", "ℹ tests 37\nℹ pass 36\nℹ fail 1\n"),
        ("dist", "test result: ok. 1 passed; 0 failed\nnot run: there is no dpkg on this machine\n"),
        ("python", "Ran 37 tests in 61.2s\nOK\ntest result: ok. 37 passed; 0 failed\n"),
        ("check", "test result: ok. 21 passed; 0 failed\ndeny: 3 passed, 1 failed\n"),
    ];
    let said = "1 not run: there is no dpkg on this machine\n328 passed, 4 failed\n";
    assert_eq!(summary("", &logs), (said.to_owned(), false));
}

#[test]
fn what_is_not_run_is_counted_apart_and_fails_nothing() {
    let log = format!("{PASSED}{NOT_RUN}{END}");
    let said = "1 not run: objects missing, set OCB_SHARED\n10 passed, 0 failed\n";
    assert_eq!(summary("", &[("rust", &log)]), (said.to_owned(), true));
    assert!(bash("only_not_run rust.log", &[("rust", &log)]).1);
}

#[test]
fn a_failure_beside_what_is_not_run_is_one() {
    let log = format!("{NOT_RUN}{FAILED}{PASSED}{END}");
    let said = "1 not run: objects missing, set OCB_SHARED\ntest: these steps failed: rust\n24 passed, 1 failed\n";
    assert_eq!(summary("rust", &[("rust", &log)]), (said.to_owned(), false));
    assert!(!bash("only_not_run rust.log", &[("rust", &log)]).1);
}

#[test]
fn a_program_that_dies_without_counts_is_one_failure() {
    // Behind one that failed with a count.
    let log = format!("{NOT_RUN}{SILENT}{PASSED}{END}");
    let (said, content) = summary("rust", &[("rust", &log)]);
    assert!(said.ends_with("10 passed, 1 failed\n") && !content, "{said}");
    assert!(!bash("only_not_run rust.log", &[("rust", &log)]).1);
}

#[test]
fn what_failing_tests_said_is_repeated() {
    let browser = "✔ a start\nℹ fail 1\n\n✖ failing tests:\n\n✖ a run\n  waited 180 s\n2-stock failed; to repeat it: node run.mjs\n✔ an end\n";
    let said = bash(
        "why rust.log browser.log none.log",
        &[("rust", &format!("{NOT_RUN}{FAILED}{PASSED}")), ("browser", browser)],
    );
    let expected = "---- charts::median stdout ----\nassertion failed: not run: is no reason in the middle of a line\n\
                    ✖ failing tests:\n✖ a run\n  waited 180 s\n";
    assert_eq!(said.0, expected);
}

#[test]
fn a_log_without_its_end_and_a_step_without_counts_fail() {
    let log = format!("{PASSED}{NOT_RUN}");
    assert!(!bash("only_not_run rust.log", &[("rust", &log)]).1, "it ended before its end");
    let (said, content) = summary("rust faults", &[("rust", &log)]);
    assert_eq!(
        (&*said, content),
        (
            "1 not run: objects missing, set OCB_SHARED\ntest: these steps failed: rust faults\n10 passed, 2 failed\n",
            false
        )
    );
    assert!(!summary("build", &[]).1, "nothing was tested");
}
