//! Mirror of `ext/draft/scene.h`.

/// Id of the extension.
pub const ID: &core::ffi::CStr = c"ocb.scene/1";

/// `ocb_scene`: offering it is the promise.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Scene {
    /// Size as the plugin was compiled.
    pub struct_size: u32,
}
