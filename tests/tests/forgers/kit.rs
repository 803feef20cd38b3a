//! The kit: one library for each cost class, and the names of its algorithms.

use std::path::{Path, PathBuf};

use ocb_tests::place::root;
use ocb_tests::process::{command, output};

use crate::layout;

/// What a question costs an honest algorithm.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// 0.3 us: as short as the clock can tell.
    Ns300,
    /// 1 us.
    Us1,
    /// 3 us.
    Us3,
    /// 20 us.
    Us20,
    /// 100 us.
    Us100,
    /// 7 ms: longer than a block of questions may be.
    Ms7,
}

impl Class {
    /// Behind the names of its algorithms.
    pub fn name(self) -> &'static str {
        match self {
            Class::Ns300 => "300ns",
            Class::Us1 => "1us",
            Class::Us3 => "3us",
            Class::Us20 => "20us",
            Class::Us100 => "100us",
            Class::Ms7 => "7ms",
        }
    }

    fn nanoseconds(self) -> u32 {
        match self {
            Class::Ns300 => 300,
            Class::Us1 => 1_000,
            Class::Us3 => 3_000,
            Class::Us20 => 20_000,
            Class::Us100 => 100_000,
            Class::Ms7 => 7_000_000,
        }
    }
}

/// The two that set the measure: one algorithm under two names.
pub const HONEST: [&str; 2] = ["honest", "honest_twin"];
/// An honest one that is measured after the noisy ones.
pub const FRIEND: &str = "friend";

/// What all are compared with, where it is ours.
pub const REFERENCE: &str = "box-tree";
/// The name of the slow one under its id.
pub const SLOW_REFERENCE: &str = "noise_slow";

/// Does its name say that it answers honestly, with its time where it belongs?
pub fn is_honest(name: &str) -> bool {
    HONEST.contains(&name) || name == FRIEND
}

/// Names of all algorithms in the order of the library.
pub fn all() -> Vec<&'static str> {
    let list = include_str!("../../../sandbox/tests/fixtures/forgers/list.h");
    let rows = list.lines().filter_map(|line| line.trim().strip_prefix("ONE("));
    let names: Vec<&str> = rows.filter_map(|row| row.split(',').next()).collect();
    assert!(names.len() > 40 && names[..2] == HONEST && names.contains(&FRIEND), "the kit's list is not readable");
    names
}

/// The compiled libraries.
pub struct Kit {
    folder: PathBuf,
}

impl Kit {
    /// In a folder where the libraries are foreign: not beside the runner.
    pub fn new(folder: &Path) -> Self {
        Kit { folder: folder.to_path_buf() }
    }

    /// The library of a class, compiled when it is asked for the first time.
    pub fn library(&self, class: Class) -> PathBuf {
        self.compiled(&format!("libforgers_{}.so", class.name()), class, None)
    }

    /// A library with one slow algorithm, under the id of [`REFERENCE`].
    pub fn twin_of_the_reference(&self) -> PathBuf {
        self.compiled("libtwin.so", Class::Us20, Some(format!("-DTWIN_OF=\"{REFERENCE}\"")))
    }

    fn compiled(&self, name: &str, class: Class, define: Option<String>) -> PathBuf {
        let library = self.folder.join(name);
        if !library.exists() {
            let source = root().join("sandbox/tests/fixtures/forgers/plugin.c");
            let mut cc = command("cc");
            cc.args(["-std=gnu11", "-O2", "-fPIC", "-shared", "-fvisibility=hidden", "-w"])
                .args(layout::defines())
                .args(define);
            cc.arg("-I").arg(root().join("plugin-api/include"));
            cc.arg(format!("-DCLASS={}", class.name())).arg(format!("-DCLASS_NS={}", class.nanoseconds()));
            output(cc.arg(&source).args(["-lm", "-o"]).arg(&library));
        }
        library
    }
}
