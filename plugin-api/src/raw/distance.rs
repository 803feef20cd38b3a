//! Mirror of `ext/distance.h`.

use super::{Counts, Instance, NO_TRIANGLE, Object, Status};

/// Id of the extension.
pub const ID: &core::ffi::CStr = c"ocb.distance/1";
/// `OCB_DISTANCE_HAS_POINTS`.
pub const HAS_POINTS: u32 = 1;
/// `OCB_DISTANCE_HAS_TRIANGLES`.
pub const HAS_TRIANGLES: u32 = 2;

/// `ocb_distance_request`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct DistanceRequest {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// [`super::REQUEST_SOLID`] or 0.
    pub flags: u32,
    /// Where to count the work, or null.
    pub counts: *mut Counts,
}

impl DistanceRequest {
    /// As the host passes it.
    pub const fn new(flags: u32, counts: *mut Counts) -> Self {
        Self { struct_size: size_of::<Self>() as u32, flags, counts }
    }
}

/// `ocb_distance_result`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct DistanceResult {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// `HAS_*` bits.
    pub flags: u32,
    /// Minimum distance, 0 when the surfaces meet.
    pub distance: f64,
    /// Witness point on A, world frame.
    pub point_a: [f64; 3],
    /// Witness point on B, world frame.
    pub point_b: [f64; 3],
    /// Triangle of `point_a`.
    pub triangle_a: u32,
    /// Triangle of `point_b`.
    pub triangle_b: u32,
}

impl DistanceResult {
    /// As the host passes it.
    pub const fn new() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            flags: 0,
            distance: 0.0,
            point_a: [0.0; 3],
            point_b: [0.0; 3],
            triangle_a: NO_TRIANGLE,
            triangle_b: NO_TRIANGLE,
        }
    }
}

impl Default for DistanceResult {
    fn default() -> Self {
        Self::new()
    }
}

/// `ocb_distance`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Distance {
    /// Size as the plugin was compiled.
    pub struct_size: u32,
    /// Proximity query.
    pub distance: Option<
        unsafe extern "C" fn(
            instance: *mut Instance,
            a: *mut Object,
            pose_a: *const f64,
            b: *mut Object,
            pose_b: *const f64,
            request: *const DistanceRequest,
            result: *mut DistanceResult,
        ) -> Status,
    >,
}
