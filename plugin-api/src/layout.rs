//! The layout note of Rust plugins: a description of every struct of the ABI as the plugin's compiler laid it out.
//!
//! `struct_size` does not see everything: a field that shrinks from `u64` to `u32` before padding leaves the size and
//! every later offset as they were. abi_stable's type layouts do see it, and say which field it is. The note is for
//! Rust alone; the contract is the C header, and a plugin without a note is as good as one with it.
//!
//! Two traps:
//! - **The note is data that the plugin has written.** It helps honest authors against stale builds; it proves nothing.
//!   Reading it follows pointers of the plugin's choice, so [`check`] may only be called inside the sandbox.
//! - **Cargo unifies features over a workspace.** A feature that changes a struct would change it in host and plugin at
//!   once, and the comparison would find nothing. So no feature of this crate may ever change a layout (`layout` itself
//!   only adds this module), and a test that wants two different layouts must build them in two workspaces.

use core::ffi::c_void;

use abi_stable::StableAbi;
use abi_stable::abi_stability::abi_checking::{AbiInstabilityErrors, ExpectedFound, check_layout_compatibility};
use abi_stable::library::AbiHeader;
use abi_stable::type_layout::{TLFieldOrFunction, TypeLayout};

use crate::raw;

/// Never made; its layout holds that of every struct of the ABI, each by value, so that the comparison need not be trusted
/// to follow pointers.
#[repr(C)]
#[derive(StableAbi)]
pub struct Abi {
    entry: unsafe extern "C" fn(u32) -> *const raw::Plugin,
    plugin: raw::Plugin,
    algorithm: raw::Algorithm,
    collide_request: raw::CollideRequest,
    collide_result: raw::CollideResult,
    distance: raw::distance::Distance,
    distance_request: raw::distance::DistanceRequest,
    distance_result: raw::distance::DistanceResult,
    contacts: raw::contacts::Contacts,
    contacts_request: raw::contacts::ContactsRequest,
    contacts_result: raw::contacts::ContactsResult,
    contact: raw::contacts::Contact,
    counts: raw::Counts,
    host: raw::Host,
    parameters: raw::parameters::Parameters,
    parameter: raw::parameters::Parameter,
    scene: raw::scene::Scene,
}

impl Abi {
    /// The layouts of all of them, for review.
    pub const STRUCTS: [&'static TypeLayout; 17] = [
        Self::LAYOUT,
        raw::Plugin::LAYOUT,
        raw::Algorithm::LAYOUT,
        raw::CollideRequest::LAYOUT,
        raw::CollideResult::LAYOUT,
        raw::distance::Distance::LAYOUT,
        raw::distance::DistanceRequest::LAYOUT,
        raw::distance::DistanceResult::LAYOUT,
        raw::contacts::Contacts::LAYOUT,
        raw::contacts::ContactsRequest::LAYOUT,
        raw::contacts::ContactsResult::LAYOUT,
        raw::contacts::Contact::LAYOUT,
        raw::Counts::LAYOUT,
        raw::Host::LAYOUT,
        raw::parameters::Parameters::LAYOUT,
        raw::parameters::Parameter::LAYOUT,
        raw::scene::Scene::LAYOUT,
    ];
}

/// What stands behind the symbol [`raw::LAYOUT_SYMBOL`].
#[repr(C)]
pub struct LayoutNote {
    /// Version of abi_stable's own structures; looked at first.
    header: AbiHeader,
    layout: &'static TypeLayout,
}

impl LayoutNote {
    /// The note of this build.
    pub const THIS: Self = Self::of::<Abi>();

    /// The note of a build with another idea of the ABI; for tests.
    pub const fn of<T: StableAbi>() -> Self {
        Self { header: AbiHeader::VALUE, layout: T::LAYOUT }
    }
}

/// Why a plugin's note does not fit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LayoutError {
    /// The plugin was built with an abi_stable whose notes this host cannot read.
    Unreadable,
    /// A struct differs; the text names the first such field.
    Different(String),
}

impl core::fmt::Display for LayoutError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Unreadable => write!(
                f,
                "the layout note was made with another version of abi_stable: build the plugin again with the host's \
                 version of opencollbench-plugin"
            ),
            Self::Different(what) => write!(
                f,
                "the plugin was built with another version of opencollbench-plugin ({what}); build it again with the \
                 host's version"
            ),
        }
    }
}

impl core::error::Error for LayoutError {}

/// Compares the note at the address of [`raw::LAYOUT_SYMBOL`] with this build's. Call it inside the sandbox only.
///
/// # Safety
/// `note` is the address of that symbol in a loaded library that stays loaded. What it points to is the plugin's word:
/// a lying plugin can crash the process here, or do anything else that it could do in its constructors.
pub unsafe fn check(note: *const c_void) -> Result<(), LayoutError> {
    // SAFETY: the caller has found the symbol; the header is plain bytes and comes first in every version of the note.
    let header = unsafe { &*note.cast::<AbiHeader>() };
    if !header.is_compatible(&AbiHeader::VALUE) {
        return Err(LayoutError::Unreadable);
    }
    // SAFETY: the header says that the note is one of ours; beyond that we take the plugin's word, as the caller knows.
    let note = unsafe { &*note.cast::<LayoutNote>() };
    check_layout_compatibility(<Abi as StableAbi>::LAYOUT, note.layout)
        .map_err(|errors| LayoutError::Different(first_difference(&errors)))
}

/// The deepest difference in a few words; abi_stable's own text lists both layouts whole.
fn first_difference(errors: &AbiInstabilityErrors) -> String {
    const MOST: usize = 200;
    let deepest = errors.errors.iter().max_by_key(|error| error.stack_trace.len());
    let trace = deepest.map(|error| error.stack_trace.as_slice()).unwrap_or_default();
    let words = match trace.last() {
        Some(ExpectedFound { expected: TLFieldOrFunction::Field(host), found: TLFieldOrFunction::Field(theirs) }) => {
            let name = |step: &ExpectedFound<TLFieldOrFunction>| match step.found {
                TLFieldOrFunction::Field(field) => field.name(),
                TLFieldOrFunction::Function(_) => "(function)",
            };
            let path = trace.iter().map(name).collect::<Vec<_>>().join(".");
            let (host, theirs) = (host.full_type().to_string(), theirs.full_type().to_string());
            if host == theirs {
                format!("'{path}' is laid out otherwise")
            } else {
                format!("'{path}' is {theirs} there and {host} here")
            }
        }
        _ => "the structs have other fields or another package version".to_string(),
    };
    words.chars().take(MOST).collect()
}
