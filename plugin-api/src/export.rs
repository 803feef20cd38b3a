//! [`export!`](crate::export!): from traits to the C interface. What C calls is in `calls.rs`; authors need not read either.

mod calls;

use core::ffi::{CStr, c_char, c_void};
use core::ptr;

use crate::algorithm::{Algorithm, Contacts, Distance, Parameters, Query, Scene};
use crate::raw;

/// Exports algorithms as a plugin. Once per crate, and the crate type is `cdylib`:
///
/// ```text
/// opencollbench_plugin::export!(Mine);                                 // collision, first contact
/// opencollbench_plugin::export!(Mine: distance contacts counts);       // with extensions
/// opencollbench_plugin::export!(Mine: parameters, Other: distance);    // two algorithms
/// ```
#[macro_export]
macro_rules! export {
    ($($algorithm:ty $(: $($extension:ident)+)?),+ $(,)?) => {
        #[doc = "The entry point of the plugin, see plugin.h."]
        #[unsafe(no_mangle)]
        pub extern "C" fn ocb_entry_v1(host_abi_major: u32) -> *const $crate::raw::Plugin {
            static ALGORITHMS: &[&$crate::raw::Algorithm] = &[$(&{
                const EXTENSIONS: $crate::export::Extensions =
                    $crate::export::Extensions::NONE$($(.$extension::<$algorithm>())+)?;
                extern "C" fn get_extension(
                    instance: *mut $crate::raw::Instance,
                    id: *const ::core::ffi::c_char,
                ) -> *const ::core::ffi::c_void {
                    static TABLES: $crate::export::Extensions = EXTENSIONS;
                    TABLES.find::<$algorithm>(instance, id)
                }
                $crate::export::algorithm::<$algorithm>(&EXTENSIONS, get_extension)
            }),+];
            static PLUGIN: $crate::raw::Plugin = $crate::export::plugin(ALGORITHMS);
            if host_abi_major == $crate::raw::ABI_MAJOR { &PLUGIN } else { ::core::ptr::null() }
        }
        $crate::__layout_note!();
    };
}

/// The layout note beside the entry point. Two macros, because a `cfg` inside one would ask for the author's features.
#[cfg(feature = "layout")]
#[doc(hidden)]
#[macro_export]
macro_rules! __layout_note {
    () => {
        #[doc = "Layout note, see opencollbench_plugin::layout."]
        #[unsafe(no_mangle)]
        pub static OCB_LAYOUT_V1: $crate::layout::LayoutNote = $crate::layout::LayoutNote::THIS;
    };
}

/// No layout note without the feature.
#[cfg(not(feature = "layout"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __layout_note {
    () => {};
}

/// The descriptor of a plugin.
#[doc(hidden)]
pub const fn plugin(algorithms: &'static [&'static raw::Algorithm]) -> raw::Plugin {
    raw::Plugin {
        abi_major: raw::ABI_MAJOR,
        abi_minor: raw::ABI_MINOR,
        struct_size: size_of::<raw::Plugin>() as u32,
        algorithm_count: algorithms.len() as u32,
        algorithms: algorithms.as_ptr().cast(),
    }
}

/// The descriptor of an algorithm.
#[doc(hidden)]
pub const fn algorithm<A: Algorithm>(
    extensions: &Extensions,
    get_extension: unsafe extern "C" fn(*mut raw::Instance, *const c_char) -> *const c_void,
) -> raw::Algorithm {
    let about = A::ABOUT;
    let mut capabilities = if extensions.counts { raw::CAPABILITY_COUNTS } else { 0 };
    let mut next = 0;
    while next < about.capabilities.len() {
        capabilities |= about.capabilities[next] as u32;
        next += 1;
    }
    raw::Algorithm {
        struct_size: size_of::<raw::Algorithm>() as u32,
        capabilities,
        id: about.id.as_ptr(),
        name: about.name.as_ptr(),
        version: about.version.as_ptr(),
        authors: about.authors.as_ptr(),
        license: about.license.as_ptr(),
        url: about.url.as_ptr(),
        paper: about.paper.as_ptr(),
        create: Some(calls::create::<A>),
        destroy: Some(calls::destroy::<A>),
        load_mesh: Some(calls::load_mesh::<A>),
        free_mesh: Some(calls::free_mesh::<A>),
        collide: Some(calls::collide::<A>),
        get_extension: Some(get_extension),
        error_message: Some(calls::error_message::<A>),
    }
}

/// What one algorithm exports beside the collision query.
#[doc(hidden)]
pub struct Extensions {
    distance: Option<raw::distance::Distance>,
    contacts: Option<raw::contacts::Contacts>,
    parameters: Option<raw::parameters::Parameters>,
    scene: Option<raw::scene::Scene>,
    counts: bool,
}

impl Extensions {
    /// Nothing.
    pub const NONE: Self = Self { distance: None, contacts: None, parameters: None, scene: None, counts: false };

    /// With `ocb.distance/1`.
    pub const fn distance<A: Distance>(mut self) -> Self {
        let struct_size = size_of::<raw::distance::Distance>() as u32;
        self.distance = Some(raw::distance::Distance { struct_size, distance: Some(calls::distance::<A>) });
        self
    }

    /// With `ocb.contacts/1`.
    pub const fn contacts<A: Contacts>(mut self) -> Self {
        let struct_size = size_of::<raw::contacts::Contacts>() as u32;
        self.contacts = Some(raw::contacts::Contacts { struct_size, contacts: Some(calls::contacts::<A>) });
        self
    }

    /// With `ocb.scene/1`.
    pub const fn scene<A: Scene>(mut self) -> Self {
        self.scene = Some(raw::scene::Scene { struct_size: size_of::<raw::scene::Scene>() as u32 });
        self
    }

    /// Every query reports its work.
    pub const fn counts<A: Algorithm>(mut self) -> Self {
        self.counts = true;
        self
    }

    /// With `ocb.parameters/1`.
    pub const fn parameters<A: Parameters>(mut self) -> Self {
        self.parameters = Some(raw::parameters::Parameters {
            struct_size: size_of::<raw::parameters::Parameters>() as u32,
            parameter_count: A::PARAMETERS.len() as u32,
            // `Parameter` is transparent over `raw::parameters::Parameter`, and a reference is a pointer.
            parameters: A::PARAMETERS.as_ptr().cast(),
            set: Some(calls::set::<A>),
        });
        self
    }

    /// The table of an extension, or null.
    #[expect(
        clippy::not_unsafe_ptr_arg_deref,
        reason = "called by the macro alone, whose expansion must hold no unsafe"
    )]
    pub fn find<A: Algorithm>(&'static self, instance: *mut raw::Instance, id: *const c_char) -> *const c_void {
        fn table<T>(table: Option<&'static T>, offered: bool) -> *const c_void {
            table.filter(|_| offered).map_or(ptr::null(), |table| ptr::from_ref(table).cast())
        }
        if id.is_null() {
            return ptr::null();
        }
        // SAFETY: the host passes a C string, and an instance of this algorithm or null (plugin.h).
        let (id, answers) = unsafe { (CStr::from_ptr(id), |query| calls::answers::<A>(instance, query)) };
        if id == raw::distance::ID {
            table(self.distance.as_ref(), answers(Query::Distance))
        } else if id == raw::contacts::ID {
            table(self.contacts.as_ref(), answers(Query::Contacts))
        } else if id == raw::parameters::ID {
            table(self.parameters.as_ref(), true)
        } else if id == raw::scene::ID {
            table(self.scene.as_ref(), true)
        } else {
            ptr::null()
        }
    }
}
