//! The three templates build as their readers are told to, load, and answer correctly.
//!
//! They are loaded into this process, which nothing else of the project ever does with a plugin: they are our own, and
//! this is their test.

mod support;

use std::ffi::CStr;
use std::path::{Path, PathBuf};
use std::ptr::null_mut;

use opencollbench_plugin::{Pose, layout, raw};
use support::{command, package, run};

/// A loaded plugin with one algorithm.
struct Plugin {
    library: libloading::Library,
    algorithm: &'static raw::Algorithm,
}

impl Plugin {
    fn load(file: &Path) -> Self {
        // SAFETY: a template of ours, built a moment ago; it keeps the contract of plugin.h, as all reads below assume.
        unsafe {
            let library = libloading::Library::new(file).expect("the template loads");
            let entry = *library.get::<raw::Entry>(raw::ENTRY_SYMBOL).expect("the entry symbol");
            assert!(entry(raw::ABI_MAJOR + 1).is_null(), "a host of another ABI is refused");
            let plugin = &*entry(raw::ABI_MAJOR);
            assert_eq!((plugin.abi_major, plugin.algorithm_count), (raw::ABI_MAJOR, 1));
            assert_eq!(plugin.struct_size as usize, size_of::<raw::Plugin>());
            let algorithm = &**plugin.algorithms;
            assert_eq!(algorithm.struct_size as usize, size_of::<raw::Algorithm>());
            Self { library, algorithm }
        }
    }

    fn id(&self) -> &str {
        // SAFETY: see `load`.
        unsafe { CStr::from_ptr(self.algorithm.id) }.to_str().expect("UTF-8")
    }

    fn offers(&self, extension: &CStr) -> bool {
        // SAFETY: see `load`; without an instance it is asked what it can do at all.
        unsafe { !self.algorithm.get_extension.expect("get_extension")(null_mut(), extension.as_ptr()).is_null() }
    }

    /// First contact of two meshes of triangles given by their corners.
    fn collide(&self, a: &[[[f64; 3]; 3]], pose_a: &Pose, b: &[[[f64; 3]; 3]], pose_b: &Pose) -> Option<(u32, u32)> {
        // SAFETY: see `load`; the calls come in the order of plugin.h.
        unsafe {
            let mut instance = null_mut();
            if let Some(create) = self.algorithm.create {
                let host = raw::Host { struct_size: size_of::<raw::Host>() as u32, abi_minor: 0, get_extension: None };
                assert_eq!(create(&host, &mut instance), raw::OK);
            }
            let [object_a, object_b] = [a, b].map(|triangles| {
                let positions: Vec<[f64; 3]> = triangles.iter().flatten().copied().collect();
                let corners: Vec<u32> = (0..positions.len() as u32).collect();
                let mut object = null_mut();
                let load = self.algorithm.load_mesh.expect("load_mesh");
                let (vertices, count) = (positions.len() as u32, triangles.len() as u32);
                let status = load(instance, positions.as_ptr().cast(), vertices, corners.as_ptr(), count, &mut object);
                assert_eq!(status, raw::OK);
                object
            });
            let mut result = raw::CollideResult::new();
            let (pose_a, pose_b) = (pose_a.0.as_ptr(), pose_b.0.as_ptr());
            let collide = self.algorithm.collide.expect("collide");
            let request = raw::CollideRequest::new(0, null_mut());
            assert_eq!(collide(instance, object_a, pose_a, object_b, pose_b, &request, &mut result), raw::OK);
            if let Some(free) = self.algorithm.free_mesh {
                free(instance, object_a);
                free(instance, object_b);
            }
            if let Some(destroy) = self.algorithm.destroy {
                destroy(instance);
            }
            (result.hit == 1).then_some((result.triangle_a, result.triangle_b))
        }
    }
}

/// Quarter turn about z, then a translation.
fn turned(x: f64, y: f64, z: f64) -> Pose {
    Pose([0.0, -1.0, 0.0, x, 1.0, 0.0, 0.0, y, 0.0, 0.0, 1.0, z, 0.0, 0.0, 0.0, 1.0])
}

fn check(plugin: &Plugin) {
    let right = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let upright = [[0.2, 0.2, -1.0], [0.2, 0.2, 1.0], [0.3, 0.2, 1.0]];
    let far = [[9.0, 9.0, 9.0], [9.0, 9.0, 8.0], [9.0, 8.0, 9.0]];
    let point = |p: [f64; 3]| [p; 3];
    let here = Pose::IDENTITY;
    // The pair is named, in the order of the objects.
    assert_eq!(plugin.collide(&[far, right], &here, &[upright], &here), Some((1, 0)));
    assert_eq!(plugin.collide(&[upright], &here, &[far, far, right], &here), Some((0, 2)));
    assert_eq!(plugin.collide(&[right], &here, &[far], &here), None);
    // Both poses count: turned together nothing changes, turned alone it does.
    assert_eq!(plugin.collide(&[right], &turned(5.0, 6.0, 7.0), &[upright], &turned(5.0, 6.0, 7.0)), Some((0, 0)));
    assert_eq!(plugin.collide(&[right], &turned(0.0, 0.0, 0.0), &[upright], &here), None);
    assert_eq!(plugin.collide(&[right], &turned(0.25, 0.0, 0.0), &[upright], &here), Some((0, 0)));
    // Touching counts: at a corner, along an edge, in a plane. One ulp further it does not.
    let shifted = |x: f64| right.map(|p| [p[0] + x, p[1], p[2]]);
    assert_eq!(plugin.collide(&[right], &here, &[shifted(1.0)], &here), Some((0, 0)));
    assert_eq!(plugin.collide(&[right], &here, &[shifted(1.0f64.next_up())], &here), None);
    assert_eq!(plugin.collide(&[right], &here, &[right], &here), Some((0, 0)));
    // Triangles without area are segments and points.
    assert_eq!(plugin.collide(&[right], &here, &[point([0.25, 0.25, 0.0])], &here), Some((0, 0)));
    assert_eq!(plugin.collide(&[right], &here, &[point([0.75, 0.75, 0.0])], &here), None);
    assert_eq!(plugin.collide(&[point([1.0, 2.0, 3.0])], &here, &[point([1.0, 2.0, 3.5])], &here), None);
    assert_eq!(plugin.collide(&[point([1.0, 2.0, 3.0])], &here, &[point([1.0, 2.0, 3.0])], &here), Some((0, 0)));
}

fn make(template: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let build = format!("BUILD={}", folder.path().display());
    run(command("make").arg("-C").arg(package().join("templates").join(template)).arg(build));
    let file = folder.path().join("my_plugin.so");
    (folder, file)
}

#[test]
fn the_c_template_answers() {
    let (_folder, file) = make("c");
    let plugin = Plugin::load(&file);
    assert_eq!(plugin.id(), "my-algorithm-c");
    check(&plugin);
}

/// With `plugin.hpp` a correct plugin fits on a page.
#[test]
fn the_cpp_template_answers_in_fewer_than_sixty_lines() {
    let source = std::fs::read_to_string(package().join("templates/cpp/my_plugin.cpp")).expect("the template");
    assert!(source.lines().count() < 60);
    let (_folder, file) = make("cpp");
    let plugin = Plugin::load(&file);
    assert_eq!(plugin.id(), "my-algorithm-cpp");
    check(&plugin);
}

#[test]
fn a_class_in_cpp_offers_scenes_when_it_says_so() {
    let source = std::fs::read_to_string(package().join("templates/cpp/my_plugin.cpp")).expect("the template");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (says, offers) in
        [("", false), ("static constexpr bool scene = false;", false), ("static constexpr bool scene = true;", true)]
    {
        let head = "struct MyAlgorithm {\n";
        assert!(source.contains(head));
        let (code, file) = (folder.path().join("scene.cpp"), folder.path().join(format!("{}.so", says.len())));
        std::fs::write(&code, source.replace(head, &format!("{head}{says}\n"))).expect("written");
        run(command("g++")
            .args(["-std=c++17", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-fno-gnu-unique", "-I"])
            .arg(package().join("include"))
            .arg(&code)
            .arg("-o")
            .arg(&file));
        assert_eq!(Plugin::load(&file).offers(raw::scene::ID), offers, "{says}");
    }
}

#[test]
fn the_cpp_code_in_the_guide_compiles() {
    let guide = std::fs::read_to_string(package().join("README.md")).expect("the guide");
    let blocks: Vec<&str> =
        guide.split("```cpp\n").skip(1).map(|rest| rest.split("```").next().unwrap_or("")).collect();
    assert_eq!(blocks.len(), 1);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("guide.cpp");
    std::fs::write(&source, blocks[0]).expect("written");
    run(command("g++")
        .args(["-std=c++17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I"])
        .arg(package().join("include"))
        .arg(&source));
}

/// Built in a copy outside the repository, as an author would, with the versions that the workspace has locked.
#[test]
fn the_rust_template_answers() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let template = package().join("templates/rust");
    std::fs::create_dir(folder.path().join("src")).expect("a folder");
    std::fs::copy(template.join("src/lib.rs"), folder.path().join("src/lib.rs")).expect("copied");
    let manifest = std::fs::read_to_string(template.join("Cargo.toml")).expect("the manifest");
    assert!(manifest.contains("path = \"../..\""));
    let manifest = manifest.replace("\"../..\"", &format!("{:?}", package()));
    std::fs::write(folder.path().join("Cargo.toml"), manifest).expect("written");
    std::fs::copy(package().join("../Cargo.lock"), folder.path().join("Cargo.lock")).expect("copied");
    // Kept from run to run, so that the dependencies are compiled once.
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("rust-template");
    run(command(env!("CARGO"))
        .args(["build", "--release", "--quiet", "--target-dir"])
        .arg(&target)
        .current_dir(folder.path()));
    let plugin = Plugin::load(&target.join("release/libmy_plugin.so"));
    assert_eq!(plugin.id(), "my-algorithm-rust");
    check(&plugin);
    // SAFETY: the symbol of a template of ours, whose library stays loaded.
    unsafe {
        let note = plugin.library.get::<*const ()>(raw::LAYOUT_SYMBOL).expect("the layout note");
        assert_eq!(layout::check(note.into_raw().as_raw_ptr()), Ok(()));
    }
}
