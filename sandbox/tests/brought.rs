//! Libraries beside a plugin: ours may bring them, a stranger's may not.

mod common;

use std::path::{Path, PathBuf};

use common::{cc, launcher_with, policy, start};
use ocb_sandbox::{Outcome, Policy};

/// The plain fixture with a library that it needs, `libbrought.so.1`, which needs another one, each in a folder of its own.
struct Plugin(tempfile::TempDir);

impl Plugin {
    fn build() -> Self {
        let plugin = Plugin(tempfile::tempdir().unwrap());
        for folder in ["near", "far"] {
            std::fs::create_dir(plugin.path(folder)).unwrap();
        }
        let source = |name: &str, text: &str| {
            std::fs::write(plugin.path(name), text).unwrap();
            plugin.path(name).to_str().unwrap().to_owned()
        };
        let shared = |words: &[&str]| cc(&[&["-shared", "-fPIC", "-w"], words].concat());
        let (far, near) = (plugin.far(), plugin.near());
        let (far, near) = (far.to_str().unwrap(), near.to_str().unwrap());
        shared(&["-Wl,-soname,libfar.so.2", "-o", far, &source("far.c", "int far(void) { return 1; }")]);
        let text = "int far(void); int near(void) { return far(); }";
        shared(&["-Wl,-soname,libbrought.so.1", "-o", near, &source("near.c", text), far]);
        let fixture = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/fixture.c");
        let include = concat!(env!("CARGO_MANIFEST_DIR"), "/../plugin-api/include");
        let user = source("user.c", "int near(void); int uses_it(void) { return near(); }");
        let file = plugin.file();
        let out = ["-o", file.to_str().unwrap(), "-lm", "-Wl,-rpath-link", plugin.0.path().to_str().unwrap()];
        shared(
            &[&["-std=gnu11", "-DCONTACTS_AT=0", "-DPOSES_AT=0", "-I", include, fixture, &user, near], &out[..]]
                .concat(),
        );
        plugin
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn file(&self) -> PathBuf {
        self.path("plugin.so")
    }

    fn near(&self) -> PathBuf {
        self.path("near/libbrought.so.1")
    }

    fn far(&self) -> PathBuf {
        self.path("far/libfar.so.2")
    }

    fn list(&self, files: &[&Path]) {
        let lines: String = files.iter().map(|file| format!("{}\n", file.display())).collect();
        std::fs::write(self.path("plugin.libraries"), lines).unwrap();
    }

    /// How a session ends that does nothing else.
    fn outcome(&self, trusted: bool) -> Outcome {
        let launcher = launcher_with(Policy { trusted, ..policy() });
        match start(&launcher, &self.file()) {
            Ok(session) => session.finish().outcome,
            Err(ending) => ending.outcome,
        }
    }

    fn refused(&self, trusted: bool, words: &str) {
        let Outcome::LoadError { reason } = self.outcome(trusted) else { panic!("{:?}", self.outcome(trusted)) };
        assert!(reason.contains(words), "{reason}");
    }
}

#[test]
fn a_plugin_of_ours_finds_what_is_listed_beside_it() {
    let plugin = Plugin::build();
    plugin.refused(true, "it needs libbrought.so.1; the jail contains only glibc, libgcc and libstdc++");
    plugin.list(&[&plugin.near(), &plugin.far()]);
    assert_eq!(plugin.outcome(true), Outcome::Completed);
    // Half a list is the loader's to tell.
    plugin.list(&[&plugin.near()]);
    plugin.refused(true, "libfar.so.2");
}

#[test]
fn a_folder_that_is_closed_to_others_is_no_hindrance() {
    use std::os::unix::fs::PermissionsExt;
    let plugin = Plugin::build();
    plugin.list(&[&plugin.near(), &plugin.far()]);
    std::fs::set_permissions(plugin.0.path(), std::fs::Permissions::from_mode(0o700)).unwrap();
    assert_eq!(plugin.outcome(true), Outcome::Completed);
}

#[test]
fn a_strangers_list_is_not_read() {
    let plugin = Plugin::build();
    plugin.list(&[&plugin.near(), &plugin.far()]);
    plugin.refused(false, "it needs libbrought.so.1");
}

#[test]
fn a_listed_library_that_is_gone_is_named() {
    let plugin = Plugin::build();
    plugin.list(&[&plugin.near(), &plugin.path("gone.so.3")]);
    plugin.refused(true, "gone.so.3, which is not installed; install it or rebuild the plugin");
}
