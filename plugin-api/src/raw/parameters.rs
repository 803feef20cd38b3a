//! Mirror of `ext/parameters.h`.

use core::ffi::c_char;

use super::{Instance, Status};

/// Id of the extension.
pub const ID: &core::ffi::CStr = c"ocb.parameters/1";
/// `OCB_PARAMETER_REAL`.
pub const REAL: u32 = 1;
/// `OCB_PARAMETER_INTEGER`.
pub const INTEGER: u32 = 2;

/// `ocb_parameter`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Parameter {
    /// Size as the plugin was compiled.
    pub struct_size: u32,
    /// [`REAL`] or [`INTEGER`].
    pub kind: u32,
    /// Name, unique in the algorithm.
    pub name: *const c_char,
    /// One sentence for people.
    pub description: *const c_char,
    /// Smallest value.
    pub minimum: f64,
    /// Largest value.
    pub maximum: f64,
    /// Value when nothing is said.
    pub default_value: f64,
}

/// `ocb_parameters`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Parameters {
    /// Size as the plugin was compiled.
    pub struct_size: u32,
    /// Number of parameters.
    pub parameter_count: u32,
    /// The parameters.
    pub parameters: *const *const Parameter,
    /// Sets one.
    pub set: Option<unsafe extern "C" fn(instance: *mut Instance, name: *const c_char, value: f64) -> Status>,
}

// SAFETY: descriptors are immutable static data by the contract of plugin.h; nothing is ever written through them.
unsafe impl Sync for Parameter {}
// SAFETY: as for `Parameter`.
unsafe impl Sync for Parameters {}
