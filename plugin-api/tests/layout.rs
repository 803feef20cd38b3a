//! The Rust mirror is the C interface: every size, offset and constant, and the layout note.

mod support;

use std::fmt::Write as _;
use std::mem::offset_of;

use abi_stable::StableAbi;
use opencollbench_plugin::layout::{self, Abi, LayoutError, LayoutNote, check};
use opencollbench_plugin::raw::{self, contacts, distance, parameters, scene};

/// C assertions for the size and alignment of each struct and the offset of each of its fields.
macro_rules! assertions {
    ($out:ident, $($c:literal = $rust:ty { $($field:ident)+ })+) => {$(
        writeln!($out, "CHECK(sizeof({}) == {});", $c, size_of::<$rust>()).unwrap();
        writeln!($out, "CHECK(ALIGN_OF({}) == {});", $c, align_of::<$rust>()).unwrap();
        $(writeln!($out, "CHECK(offsetof({}, {}) == {});", $c, stringify!($field), offset_of!($rust, $field)).unwrap();)+
    )+};
}

fn c_assertions() -> String {
    let mut out = String::from(
        "#include <stddef.h>\n\
         #include <opencollbench/ext/contacts.h>\n#include <opencollbench/ext/distance.h>\n\
         #include <opencollbench/ext/parameters.h>\n#include <opencollbench/ext/draft/scene.h>\n\
         #ifdef __cplusplus\n#define CHECK(x) static_assert(x, #x)\n#define ALIGN_OF(t) alignof(t)\n\
         #else\n#define CHECK(x) _Static_assert(x, #x)\n#define ALIGN_OF(t) _Alignof(t)\n#endif\n",
    );
    assertions!(out,
        "ocb_plugin" = raw::Plugin { abi_major abi_minor struct_size algorithm_count algorithms }
        "ocb_algorithm" = raw::Algorithm {
            struct_size capabilities id name version authors license url paper create destroy load_mesh free_mesh
            collide get_extension error_message
        }
        "ocb_host" = raw::Host { struct_size abi_minor get_extension }
        "ocb_counts" = raw::Counts { struct_size flags bv_tests primitive_tests tests_a tests_b }
        "ocb_collide_request" = raw::CollideRequest { struct_size flags counts }
        "ocb_collide_result" = raw::CollideResult { struct_size hit triangle_a triangle_b }
        "ocb_distance_request" = distance::DistanceRequest { struct_size flags counts }
        "ocb_distance_result" = distance::DistanceResult {
            struct_size flags distance point_a point_b triangle_a triangle_b
        }
        "ocb_distance" = distance::Distance { struct_size distance }
        "ocb_contact" = contacts::Contact { a b }
        "ocb_contacts_request" = contacts::ContactsRequest { struct_size flags contacts capacity counts }
        "ocb_contacts_result" = contacts::ContactsResult { struct_size total }
        "ocb_contacts" = contacts::Contacts { struct_size contacts }
        "ocb_parameter" = parameters::Parameter {
            struct_size kind name description minimum maximum default_value
        }
        "ocb_parameters" = parameters::Parameters { struct_size parameter_count parameters set }
        "ocb_scene" = scene::Scene { struct_size }
    );
    for (c, rust) in [
        ("OCB_ABI_MAJOR", raw::ABI_MAJOR),
        ("OCB_ABI_MINOR", raw::ABI_MINOR),
        ("OCB_NO_TRIANGLE", raw::NO_TRIANGLE),
        ("OCB_OK", raw::OK as u32),
        ("OCB_GAVE_UP", raw::GAVE_UP as u32),
        ("OCB_UNSUPPORTED", raw::UNSUPPORTED as u32),
        ("OCB_ERROR", raw::ERROR as u32),
        ("OCB_CAPABILITY_SINGLE_PRECISION", raw::CAPABILITY_SINGLE_PRECISION),
        ("OCB_CAPABILITY_COHERENT", raw::CAPABILITY_COHERENT),
        ("OCB_CAPABILITY_SOLID", raw::CAPABILITY_SOLID),
        ("OCB_CAPABILITY_THREADS", raw::CAPABILITY_THREADS),
        ("OCB_CAPABILITY_COUNTS", raw::CAPABILITY_COUNTS),
        ("OCB_REQUEST_SOLID", raw::REQUEST_SOLID),
        ("OCB_DISTANCE_HAS_POINTS", distance::HAS_POINTS),
        ("OCB_DISTANCE_HAS_TRIANGLES", distance::HAS_TRIANGLES),
        ("OCB_COUNTS_BV_TESTS", raw::COUNTS_BV_TESTS),
        ("OCB_COUNTS_PRIMITIVE_TESTS", raw::COUNTS_PRIMITIVE_TESTS),
        ("OCB_COUNTS_PER_TRIANGLE", raw::COUNTS_PER_TRIANGLE),
        ("OCB_PARAMETER_REAL", parameters::REAL),
        ("OCB_PARAMETER_INTEGER", parameters::INTEGER),
    ] {
        writeln!(out, "CHECK((uint32_t){c} == {rust}u);").unwrap();
    }
    for (c, rust) in [
        ("OCB_EXT_DISTANCE", distance::ID),
        ("OCB_EXT_CONTACTS", contacts::ID),
        ("OCB_EXT_PARAMETERS", parameters::ID),
        ("OCB_EXT_SCENE", scene::ID),
    ] {
        // An assertion cannot compare strings, only their lengths; the next test reads them.
        writeln!(out, "CHECK(sizeof({c}) == {});", rust.count_bytes() + 1).unwrap();
    }
    out
}

#[test]
fn sizes_offsets_and_constants_are_equal_on_both_sides() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("layout.c");
    std::fs::write(&source, c_assertions()).expect("written");
    support::compile_as_every_standard(&source);
}

#[test]
fn extension_ids_are_equal_on_both_sides() {
    for (header, macro_name, id) in [
        ("distance", "OCB_EXT_DISTANCE", distance::ID),
        ("contacts", "OCB_EXT_CONTACTS", contacts::ID),
        ("parameters", "OCB_EXT_PARAMETERS", parameters::ID),
        ("draft/scene", "OCB_EXT_SCENE", scene::ID),
    ] {
        let path = support::package().join(format!("include/opencollbench/ext/{header}.h"));
        let text = std::fs::read_to_string(path).expect("the header");
        let line = format!("#define {macro_name} {id:?}");
        assert!(text.lines().any(|l| l == line), "{header}.h has no line {line}");
    }
}

/// What changes here changes the ABI: see CHANGELOG.md before accepting it.
#[test]
fn the_layout_is_the_one_that_was_reviewed() {
    let text: String = Abi::STRUCTS.iter().map(|layout| layout.to_string()).collect();
    // Where a struct stands in its file, and which version this package has, are not the ABI.
    let stable = |line: &&str| !line.trim_start().starts_with("line:") && !line.trim_start().starts_with("package:");
    let lines: Vec<&str> = text.lines().filter(stable).map(str::trim_end).collect();
    // C's `char` is `i8` or `u8`, as the processor's convention has it; nothing of ours points to a `u8`.
    let text = lines.join("\n").replace(&format!("*const {}", std::any::type_name::<std::ffi::c_char>()), "*const i8");
    insta::assert_snapshot!(text);
}

#[test]
fn the_own_note_fits() {
    static NOTE: LayoutNote = LayoutNote::THIS;
    // SAFETY: a note of this very build.
    assert_eq!(unsafe { check((&raw const NOTE).cast()) }, Ok(()));
}

/// `primitive_tests` is half as wide, and yet no size and no other offset differs: only the note can tell.
#[test]
fn a_note_with_one_narrower_field_does_not_fit_and_names_it() {
    #[repr(C)]
    #[derive(StableAbi)]
    struct Counts {
        struct_size: u32,
        flags: u32,
        bv_tests: u64,
        primitive_tests: u32,
        tests_a: *mut u32,
        tests_b: *mut u32,
    }
    #[repr(C)]
    #[derive(StableAbi)]
    struct Abi {
        entry: unsafe extern "C" fn(u32) -> *const raw::Plugin,
        plugin: raw::Plugin,
        algorithm: raw::Algorithm,
        collide_request: raw::CollideRequest,
        collide_result: raw::CollideResult,
        distance: distance::Distance,
        distance_request: distance::DistanceRequest,
        distance_result: distance::DistanceResult,
        contacts: contacts::Contacts,
        contacts_request: contacts::ContactsRequest,
        contacts_result: contacts::ContactsResult,
        contact: contacts::Contact,
        counts: Counts,
        host: raw::Host,
        parameters: parameters::Parameters,
        parameter: parameters::Parameter,
        scene: scene::Scene,
    }
    assert_eq!(size_of::<Abi>(), size_of::<layout::Abi>());
    static NOTE: LayoutNote = LayoutNote::of::<Abi>();
    // SAFETY: an honest note, of another ABI.
    let error = unsafe { check((&raw const NOTE).cast()) }.expect_err("another ABI");
    assert!(matches!(&error, LayoutError::Different(what) if what.contains("primitive_tests")), "{error}");
    let sentence = "the plugin was built with another version of opencollbench-plugin ('counts.primitive_tests' is u32 \
                    there and u64 here); build it again with the host's version";
    assert_eq!(error.to_string(), sentence);
}

#[test]
fn a_note_of_another_abi_stable_is_not_read() {
    let strange = [0u8; 64];
    // SAFETY: a header that is not ours; nothing beyond it may be read.
    assert_eq!(unsafe { check(strange.as_ptr().cast()) }, Err(LayoutError::Unreadable));
}
