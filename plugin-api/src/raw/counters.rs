//! Mirror of `ext/counters.h`.

use super::contacts::{ContactsRequest, ContactsResult};
use super::distance::{DistanceRequest, DistanceResult};
use super::{CollideRequest, CollideResult, Instance, Object, Status};

/// Id of the extension.
pub const ID: &core::ffi::CStr = c"ocb.counters/1";
/// `OCB_COUNTS_BV_TESTS`.
pub const BV_TESTS: u32 = 1;
/// `OCB_COUNTS_PRIMITIVE_TESTS`.
pub const PRIMITIVE_TESTS: u32 = 2;
/// `OCB_COUNTS_PER_TRIANGLE`.
pub const PER_TRIANGLE: u32 = 4;

/// `ocb_counts`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Counts {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// What has been counted.
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
    /// As the host passes it; the arrays are null, or zeroed and as long as the objects have triangles.
    pub const fn new(tests_a: *mut u32, tests_b: *mut u32) -> Self {
        Self { struct_size: size_of::<Self>() as u32, flags: 0, bv_tests: 0, primitive_tests: 0, tests_a, tests_b }
    }
}

/// `ocb_counters`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Counters {
    /// Size as the plugin was compiled.
    pub struct_size: u32,
    /// 0.
    pub reserved: u32,
    /// `collide` that counts.
    pub count_collide: Option<
        unsafe extern "C" fn(
            instance: *mut Instance,
            a: *mut Object,
            pose_a: *const f64,
            b: *mut Object,
            pose_b: *const f64,
            request: *const CollideRequest,
            result: *mut CollideResult,
            counts: *mut Counts,
        ) -> Status,
    >,
    /// `distance` that counts.
    pub count_distance: Option<
        unsafe extern "C" fn(
            instance: *mut Instance,
            a: *mut Object,
            pose_a: *const f64,
            b: *mut Object,
            pose_b: *const f64,
            request: *const DistanceRequest,
            result: *mut DistanceResult,
            counts: *mut Counts,
        ) -> Status,
    >,
    /// `contacts` that counts.
    pub count_contacts: Option<
        unsafe extern "C" fn(
            instance: *mut Instance,
            a: *mut Object,
            pose_a: *const f64,
            b: *mut Object,
            pose_b: *const f64,
            request: *const ContactsRequest,
            result: *mut ContactsResult,
            counts: *mut Counts,
        ) -> Status,
    >,
}
