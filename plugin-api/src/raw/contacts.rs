//! Mirror of `ext/contacts.h`.

use super::{Counts, Instance, Object, Status};

/// Id of the extension.
pub const ID: &core::ffi::CStr = c"ocb.contacts/1";

/// `ocb_contact`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Contact {
    /// Triangle of A.
    pub a: u32,
    /// Triangle of B.
    pub b: u32,
}

/// `ocb_contacts_request`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct ContactsRequest {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// No flag is defined yet.
    pub flags: u32,
    /// Room for the contacts.
    pub contacts: *mut Contact,
    /// For how many.
    pub capacity: u64,
    /// Where to count the work, or null.
    pub counts: *mut Counts,
}

impl ContactsRequest {
    /// As the host passes it.
    pub const fn new(contacts: *mut Contact, capacity: u64, counts: *mut Counts) -> Self {
        Self { struct_size: size_of::<Self>() as u32, flags: 0, contacts, capacity, counts }
    }
}

/// `ocb_contacts_result`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct ContactsResult {
    /// Size as the host was compiled.
    pub struct_size: u32,
    /// How many contacts there are, which may be more than `capacity`.
    pub total: u64,
}

impl ContactsResult {
    /// As the host passes it.
    pub const fn new() -> Self {
        Self { struct_size: size_of::<Self>() as u32, total: 0 }
    }
}

impl Default for ContactsResult {
    fn default() -> Self {
        Self::new()
    }
}

/// `ocb_contacts`.
#[repr(C)]
#[derive(Clone, Copy)]
#[cfg_attr(feature = "layout", derive(abi_stable::StableAbi))]
pub struct Contacts {
    /// Size as the plugin was compiled.
    pub struct_size: u32,
    /// Collision query, all contacts.
    pub contacts: Option<
        unsafe extern "C" fn(
            instance: *mut Instance,
            a: *mut Object,
            pose_a: *const f64,
            b: *mut Object,
            pose_b: *const f64,
            request: *const ContactsRequest,
            result: *mut ContactsResult,
        ) -> Status,
    >,
}
