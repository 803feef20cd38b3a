//! The C interface in Rust: a field-by-field mirror of `include/opencollbench/*.h`, which is the specification. The
//! meaning of every field and function is told there; `tests/layout.rs` compares every size and offset.
//!
//! Plugin authors use [`crate::Algorithm`] and [`crate::export!`] instead; this module is for hosts.

use core::ffi::{c_char, c_void};

pub mod contacts;
pub mod distance;
pub mod parameters;
pub mod scene;

/// `OCB_ABI_MAJOR`: two sides fit when theirs are equal.
pub const ABI_MAJOR: u32 = 1;
/// `OCB_ABI_MINOR`: grows when something is appended.
pub const ABI_MINOR: u32 = 0;
/// `OCB_NO_TRIANGLE`.
pub const NO_TRIANGLE: u32 = u32::MAX;
/// Name of the one symbol that a plugin exports, with the final 0 that dlsym wants.
pub const ENTRY_SYMBOL: &core::ffi::CStr = c"ocb_entry_v1";
/// Name of the optional layout note of Rust plugins, see `layout`.
pub const LAYOUT_SYMBOL: &core::ffi::CStr = c"OCB_LAYOUT_V1";

/// `ocb_status`. An integer, not an enum: the other side may return anything.
pub type Status = i32;
/// `OCB_OK`.
pub const OK: Status = 0;
/// `OCB_GAVE_UP`.
pub const GAVE_UP: Status = 1;
/// `OCB_UNSUPPORTED`.
pub const UNSUPPORTED: Status = 2;
/// `OCB_ERROR`.
pub const ERROR: Status = 3;

/// `OCB_CAPABILITY_SINGLE_PRECISION`.
pub const CAPABILITY_SINGLE_PRECISION: u32 = 1;
/// `OCB_CAPABILITY_COHERENT`.
pub const CAPABILITY_COHERENT: u32 = 2;
/// `OCB_CAPABILITY_SOLID`.
pub const CAPABILITY_SOLID: u32 = 4;
/// `OCB_CAPABILITY_THREADS`.
pub const CAPABILITY_THREADS: u32 = 8;
/// `OCB_CAPABILITY_COUNTS`.
pub const CAPABILITY_COUNTS: u32 = 16;

/// `OCB_COUNTS_BV_TESTS`.
pub const COUNTS_BV_TESTS: u32 = 1;
/// `OCB_COUNTS_PRIMITIVE_TESTS`.
pub const COUNTS_PRIMITIVE_TESTS: u32 = 2;
/// `OCB_COUNTS_PER_TRIANGLE`.
pub const COUNTS_PER_TRIANGLE: u32 = 4;

/// `OCB_REQUEST_SOLID`.
pub const REQUEST_SOLID: u32 = 1;

/// `ocb_entry_v1`.
pub type Entry = unsafe extern "C" fn(host_abi_major: u32) -> *const Plugin;

/// `ocb_instance`: the plugin's own; only ever behind a pointer.
#[repr(C)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Instance {
    _private: [u8; 0],
}

/// `ocb_object`: the plugin's own; only ever behind a pointer.
#[repr(C)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Object {
    _private: [u8; 0],
}

/// `ocb_host`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Host {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// Minor version of the host's ABI.
    pub abi_minor: u32,
    /// Table of functions that the host offers.
    pub get_extension: Option<unsafe extern "C" fn(host: *const Host, id: *const c_char) -> *const c_void>,
}

/// `ocb_counts`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Counts {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// `COUNTS_*` bits: what has been counted.
    pub flags: u32,
    /// Tests between two bounding volumes.
    pub bv_tests: u64,
    /// Tests between two primitives.
    pub primitive_tests: u64,
    /// Tests per triangle of A, or null.
    pub tests_a: *mut u32,
    /// Tests per triangle of B, or null.
    pub tests_b: *mut u32,
}

impl Counts {
    /// As the host passes it; the arrays are null, or as long as the objects have triangles.
    pub const fn new(tests_a: *mut u32, tests_b: *mut u32) -> Self {
        Self { struct_size: size_of::<Self>() as u32, flags: 0, bv_tests: 0, primitive_tests: 0, tests_a, tests_b }
    }
}

/// `ocb_plugin`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Plugin {
    /// ABI of the plugin; first, and so for ever.
    pub abi_major: u32,
    /// Minor version of that ABI.
    pub abi_minor: u32,
    /// Size as the plugin was compiled.
    pub struct_size: u32,
    /// Number of algorithms.
    pub algorithm_count: u32,
    /// The algorithms.
    pub algorithms: *const *const Algorithm,
}

/// `ocb_algorithm`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Algorithm {
    /// Size as the plugin was compiled.
    pub struct_size: u32,
    /// `CAPABILITY_*` bits.
    pub capabilities: u32,
    /// Unique, stable id.
    pub id: *const c_char,
    /// Name for people.
    pub name: *const c_char,
    /// Version of the algorithm.
    pub version: *const c_char,
    /// Authors, or null.
    pub authors: *const c_char,
    /// SPDX licence expression, or null.
    pub license: *const c_char,
    /// Home page, or null.
    pub url: *const c_char,
    /// Paper, or null.
    pub paper: *const c_char,
    /// Makes what belongs to one run.
    pub create: Option<unsafe extern "C" fn(host: *const Host, instance: *mut *mut Instance) -> Status>,
    /// Frees it.
    pub destroy: Option<unsafe extern "C" fn(instance: *mut Instance)>,
    /// The build.
    pub load_mesh: Option<
        unsafe extern "C" fn(
            instance: *mut Instance,
            positions: *const f64,
            vertex_count: u32,
            triangles: *const u32,
            triangle_count: u32,
            object: *mut *mut Object,
        ) -> Status,
    >,
    /// Frees an object.
    pub free_mesh: Option<unsafe extern "C" fn(instance: *mut Instance, object: *mut Object)>,
    /// Collision query, first contact.
    pub collide: Option<
        unsafe extern "C" fn(
            instance: *mut Instance,
            a: *mut Object,
            pose_a: *const f64,
            b: *mut Object,
            pose_b: *const f64,
            request: *const CollideRequest,
            result: *mut CollideResult,
        ) -> Status,
    >,
    /// Table of an extension.
    pub get_extension: Option<unsafe extern "C" fn(instance: *mut Instance, id: *const c_char) -> *const c_void>,
    /// Sentence about the latest error.
    pub error_message: Option<unsafe extern "C" fn(instance: *mut Instance) -> *const c_char>,
}

/// `ocb_collide_request`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct CollideRequest {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// [`REQUEST_SOLID`] or 0.
    pub flags: u32,
    /// Where to count the work, or null.
    pub counts: *mut Counts,
}

impl CollideRequest {
    /// As the host passes it.
    pub const fn new(flags: u32, counts: *mut Counts) -> Self {
        Self { struct_size: size_of::<Self>() as u32, flags, counts }
    }
}

/// `ocb_collide_result`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct CollideResult {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// 1: they meet; 0: they do not.
    pub hit: u32,
    /// Triangle of A, or [`NO_TRIANGLE`].
    pub triangle_a: u32,
    /// Triangle of B, or [`NO_TRIANGLE`].
    pub triangle_b: u32,
}

impl CollideResult {
    /// As the host passes it.
    pub const fn new() -> Self {
        Self { struct_size: size_of::<Self>() as u32, hit: 0, triangle_a: NO_TRIANGLE, triangle_b: NO_TRIANGLE }
    }
}

impl Default for CollideResult {
    fn default() -> Self {
        Self::new()
    }
}

// SAFETY: descriptors are immutable static data by the contract of plugin.h; nothing is ever written through them.
unsafe impl Sync for Plugin {}
// SAFETY: as for `Plugin`.
unsafe impl Sync for Algorithm {}
