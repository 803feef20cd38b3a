//! The plugin through the C interface: the one place that sees both the ABI's structs and our own types.

use std::ffi::{CStr, CString, c_char, c_void};

use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW};
use ocb_core::query::Query;
use ocb_sandbox::descriptor::{Descriptor, Parameter};
use ocb_sandbox::protocol::slot::NOT_LOADED;
use opencollbench_plugin::layout;
use opencollbench_plugin::raw::{self, contacts, distance, parameters, scene};

/// Longest string that is read from a plugin.
const STRING_BYTES: usize = 4096;

/// Why a command cannot be answered.
pub struct Failure {
    /// Status word of the slot.
    pub status: u64,
    /// One sentence without its full stop.
    pub reason: String,
}

impl Failure {
    /// The plugin or the runner cannot go on.
    pub fn error(reason: impl Into<String>) -> Self {
        Failure { status: raw::ERROR as u64, reason: reason.into() }
    }

    /// The file is no usable plugin.
    pub fn not_loaded(reason: impl Into<String>) -> Self {
        Failure { status: NOT_LOADED, reason: reason.into() }
    }
}

/// The bytes of a file that nobody writes any more; most of them are never touched, so they are mapped, not read.
pub struct Mapped(*mut c_void, usize);

impl Mapped {
    /// Maps the whole file.
    pub fn open(path: &str) -> std::io::Result<Self> {
        use std::os::fd::AsRawFd;
        let file = std::fs::File::open(path)?;
        // Its size by seeking: asking for its facts is not on the list of system calls.
        let len = std::io::Seek::seek(&mut &file, std::io::SeekFrom::End(0))? as usize;
        if len == 0 {
            return Ok(Mapped(std::ptr::null_mut(), 0));
        }
        // SAFETY: a fresh read-only mapping at an address of the kernel's choice.
        let at =
            unsafe { libc::mmap(std::ptr::null_mut(), len, libc::PROT_READ, libc::MAP_PRIVATE, file.as_raw_fd(), 0) };
        if at == libc::MAP_FAILED { Err(std::io::Error::last_os_error()) } else { Ok(Mapped(at, len)) }
    }

    /// All of it.
    pub fn bytes(&self) -> &[u8] {
        if self.1 == 0 {
            return &[];
        }
        // SAFETY: mapped above with this length; the jail's files are read-only, so it neither changes nor shrinks.
        // Where there is no root of our own, only plugins built from our own sources come as far as this.
        unsafe { std::slice::from_raw_parts(self.0.cast(), self.1) }
    }
}

impl Drop for Mapped {
    fn drop(&mut self) {
        if self.1 > 0 {
            // SAFETY: our own mapping, which nothing refers to any more.
            unsafe { libc::munmap(self.0, self.1) };
        }
    }
}

/// A loaded plugin file. Never unloaded: its destructors have no business here.
pub struct Plugin {
    algorithms: Vec<Algorithm>,
}

/// One algorithm with the extension tables that it has.
#[derive(Clone, Copy)]
pub struct Algorithm {
    /// The descriptor.
    pub raw: &'static raw::Algorithm,
    /// `ocb.distance/1`.
    pub distance: Option<&'static distance::Distance>,
    /// `ocb.contacts/1`.
    pub contacts: Option<&'static contacts::Contacts>,
    /// `ocb.parameters/1`.
    pub parameters: Option<&'static parameters::Parameters>,
    /// `ocb.scene/1`.
    pub scene: Option<&'static scene::Scene>,
}

impl Plugin {
    /// Loads the file. Constructors run here, under the whole jail.
    pub fn open(path: &str) -> Result<Plugin, Failure> {
        // SAFETY: loading runs foreign code, which is what this process is jailed for.
        let library = unsafe { Library::open(Some(path), RTLD_NOW | RTLD_LOCAL) }
            .map_err(|e| Failure::not_loaded(loader_reason(&e, path)))?;
        let library = std::mem::ManuallyDrop::new(library);
        // SAFETY: by plugin.h the symbol, if it is there, is a function of this type.
        let entry = unsafe { library.get::<raw::Entry>(raw::ENTRY_SYMBOL.to_bytes_with_nul()) }
            .map_err(|_| Failure::not_loaded("it does not export the function ocb_entry_v1 (see plugin.h)"))?;
        // SAFETY: as above; the address is only handed on.
        if let Ok(note) = unsafe { library.get::<*const c_void>(raw::LAYOUT_SYMBOL.to_bytes_with_nul()) } {
            // SAFETY: the library stays loaded, and a lying note can do no more than a constructor.
            unsafe { layout::check(note.as_raw_ptr()) }.map_err(|e| Failure::not_loaded(e.to_string()))?;
        }
        // SAFETY: by plugin.h.
        let plugin = unsafe { entry(raw::ABI_MAJOR) };
        if plugin.is_null() {
            return Err(Failure::not_loaded(format!(
                "it was built for another major version of the interface; this host speaks version {}",
                raw::ABI_MAJOR
            )));
        }
        // SAFETY: the two version words come first in every version of the struct.
        let [major, minor] = unsafe { *plugin.cast::<[u32; 2]>() };
        if major != raw::ABI_MAJOR {
            return Err(Failure::not_loaded(format!(
                "it was built for version {major}.{minor} of the interface; this host speaks version {}",
                raw::ABI_MAJOR
            )));
        }
        // SAFETY: of our major version, static by plugin.h, and as long as it says.
        let plugin = unsafe { sized(plugin, |p| (*p).struct_size, "ocb_plugin") }?;
        let count = plugin.algorithm_count as usize;
        if !(1..=64).contains(&count) || plugin.algorithms.is_null() {
            return Err(Failure::not_loaded(format!("it offers {count} algorithms; 1 to 64 are allowed")));
        }
        // SAFETY: by plugin.h so many pointers stand there.
        let pointers = unsafe { std::slice::from_raw_parts(plugin.algorithms, count) };
        let algorithms = pointers.iter().map(|p| Algorithm::read(*p)).collect::<Result<Vec<_>, _>>()?;
        Ok(Plugin { algorithms })
    }

    /// What it says of itself.
    pub fn describe(&self) -> Result<Vec<Descriptor>, Failure> {
        let descriptors = self.algorithms.iter().map(Algorithm::describe).collect::<Result<Vec<_>, _>>()?;
        for (i, one) in descriptors.iter().enumerate() {
            if descriptors[..i].iter().any(|other| other.id == one.id) {
                return Err(Failure::not_loaded(format!("two of its algorithms have the id '{}'", one.id)));
            }
        }
        Ok(descriptors)
    }

    /// The algorithm of that id.
    pub fn algorithm(&self, id: &str) -> Result<Algorithm, Failure> {
        self.algorithms.iter().find(|a| text(a.raw.id) == id).copied().ok_or_else(|| {
            let known: Vec<String> = self.algorithms.iter().map(|a| text(a.raw.id)).collect();
            Failure::not_loaded(format!("it has no algorithm '{id}'; it has {}", known.join(", ")))
        })
    }
}

/// dlopen's words without the path, which means nothing outside the jail.
fn loader_reason(error: &libloading::Error, path: &str) -> String {
    let mut text = error.to_string();
    if let Some(source) = std::error::Error::source(error) {
        text = source.to_string();
    }
    let text = text.replace(&format!("{path}: "), "").replace(path, "the file");
    if text.contains("cannot change memory protections") || text.contains("cannot enable executable stack") {
        return format!("it asks for an executable stack ({text}); link it with -z noexecstack");
    }
    text
}

/// A struct of the plugin that is at least as long as this host's version of it.
///
/// # Safety
/// `pointer` is null or points to a static struct that begins as `T` does, up to its own `struct_size`.
unsafe fn sized<T>(pointer: *const T, size: impl Fn(*const T) -> u32, name: &str) -> Result<&'static T, Failure> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(Failure::not_loaded(format!("a pointer to {name} is null or not aligned")));
    }
    let size = size(pointer) as usize;
    if size < size_of::<T>() {
        return Err(Failure::not_loaded(format!(
            "its struct {name} declares a size of {size} bytes; in version 1 of the interface it has {}",
            size_of::<T>()
        )));
    }
    // SAFETY: long enough, and static by the caller's word.
    Ok(unsafe { &*pointer })
}

impl Algorithm {
    fn read(pointer: *const raw::Algorithm) -> Result<Self, Failure> {
        // SAFETY: by plugin.h a static struct.
        let raw = unsafe { sized(pointer, |p| (*p).struct_size, "ocb_algorithm") }?;
        let algorithm = Self::with(raw, std::ptr::null_mut())?;
        if raw.load_mesh.is_none() {
            return Err(Failure::not_loaded(format!("algorithm '{}' has no load_mesh", text(raw.id))));
        }
        if algorithm.queries().is_empty() {
            return Err(Failure::not_loaded(format!("algorithm '{}' answers no query", text(raw.id))));
        }
        Ok(algorithm)
    }

    /// With the tables that it offers for an instance whose parameters are set; with null, that it can offer at all.
    pub fn with(raw: &'static raw::Algorithm, instance: *mut raw::Instance) -> Result<Self, Failure> {
        let extension = |id: &CStr| match raw.get_extension {
            // SAFETY: by plugin.h, with the plugin's own instance or null, and a live string.
            Some(get) => unsafe { get(instance, id.as_ptr()) },
            None => std::ptr::null(),
        };
        macro_rules! table {
            ($module:ident, $type:ident) => {{
                let pointer = extension($module::ID).cast::<$module::$type>();
                let name = concat!("ocb_", stringify!($module));
                // SAFETY: by plugin.h null or a static table of this type.
                if pointer.is_null() { None } else { Some(unsafe { sized(pointer, |p| (*p).struct_size, name) }?) }
            }};
        }
        Ok(Algorithm {
            raw,
            distance: table!(distance, Distance),
            contacts: table!(contacts, Contacts),
            parameters: table!(parameters, Parameters),
            scene: table!(scene, Scene),
        })
    }

    /// What it answers.
    pub fn queries(&self) -> Vec<Query> {
        let answers = [
            (Query::CollisionFirst, self.raw.collide.is_some()),
            (Query::CollisionAll, self.contacts.is_some_and(|c| c.contacts.is_some())),
            (Query::Proximity, self.distance.is_some_and(|d| d.distance.is_some())),
        ];
        answers.into_iter().filter(|(_, can)| *can).map(|(query, _)| query).collect()
    }

    fn describe(&self) -> Result<Descriptor, Failure> {
        let raw = self.raw;
        for (what, pointer) in [("id", raw.id), ("name", raw.name), ("version", raw.version)] {
            if pointer.is_null() {
                return Err(Failure::not_loaded(format!("an algorithm has no {what}")));
            }
        }
        Ok(Descriptor {
            id: text(raw.id),
            name: text(raw.name),
            version: text(raw.version),
            authors: text(raw.authors),
            license: text(raw.license),
            url: text(raw.url),
            paper: text(raw.paper),
            queries: self.queries(),
            counters: raw.capabilities & raw::CAPABILITY_COUNTS != 0,
            witness_points: self.distance.is_some_and(|d| d.distance.is_some()),
            single_precision: raw.capabilities & raw::CAPABILITY_SINGLE_PRECISION != 0,
            solid: self.knows_solids(),
            coherent: raw.capabilities & raw::CAPABILITY_COHERENT != 0,
            threads: raw.capabilities & raw::CAPABILITY_THREADS != 0,
            scene: self.scene.is_some(),
            parameters: self.knobs()?.into_iter().map(knob).collect(),
        })
    }

    /// Does it heed the flag for solid bodies?
    pub fn knows_solids(&self) -> bool {
        self.raw.capabilities & raw::CAPABILITY_SOLID != 0
    }

    fn knobs(&self) -> Result<Vec<&'static parameters::Parameter>, Failure> {
        let Some(table) = self.parameters else { return Ok(Vec::new()) };
        let count = table.parameter_count as usize;
        if count > 64 || (count > 0 && table.parameters.is_null()) {
            return Err(Failure::not_loaded(format!("it has {count} parameters; at most 64 are allowed")));
        }
        // SAFETY: by parameters.h each pointer is to a static struct, and so many stand there.
        (0..count).map(|i| unsafe { sized(*table.parameters.add(i), |p| (*p).struct_size, "ocb_parameter") }).collect()
    }

    /// Sets a parameter after looking at its name and range.
    pub fn set(&self, instance: *mut raw::Instance, name: &str, value: f64) -> Result<(), Failure> {
        let known = self.knobs()?.into_iter().map(knob).find(|k| k.name == name);
        let knob = known.ok_or_else(|| Failure::not_loaded(format!("it has no parameter '{name}'")))?;
        if !(knob.minimum..=knob.maximum).contains(&value) || (knob.integer && value.fract() != 0.0) {
            let kind = if knob.integer { "a whole number" } else { "a number" };
            return Err(Failure::not_loaded(format!(
                "parameter '{name}' must be {kind} from {} to {}, not {value}",
                knob.minimum, knob.maximum
            )));
        }
        let c_name = CString::new(name).map_err(|_| Failure::not_loaded("a parameter's name has a zero byte"))?;
        let set = self.parameters.and_then(|table| table.set);
        let set = set.ok_or_else(|| Failure::not_loaded("its ocb.parameters/1 has no function 'set'"))?;
        // SAFETY: by parameters.h; the instance is the plugin's own.
        match unsafe { set(instance, c_name.as_ptr(), value) } {
            raw::OK => Ok(()),
            _ => Err(self.said(instance, &format!("it refused {value} for its parameter '{name}'"))),
        }
    }

    /// The plugin's own words about its latest error, behind what we know of it.
    pub fn said(&self, instance: *mut raw::Instance, what: &str) -> Failure {
        // SAFETY: by plugin.h; the string is copied before the next call.
        let words = self.raw.error_message.map(|message| text(unsafe { message(instance) })).unwrap_or_default();
        Failure::error(if words.is_empty() { what.to_string() } else { format!("{what}: {words}") })
    }
}

fn knob(raw: &parameters::Parameter) -> Parameter {
    Parameter {
        name: text(raw.name),
        description: text(raw.description),
        minimum: raw.minimum,
        maximum: raw.maximum,
        default: raw.default_value,
        integer: raw.kind == parameters::INTEGER,
    }
}

/// A plugin's string, cut; empty for null.
fn text(pointer: *const c_char) -> String {
    if pointer.is_null() {
        return String::new();
    }
    // SAFETY: by plugin.h a string that ends with 0; a lie ends in a fault inside the jail.
    let len = unsafe { libc::strnlen(pointer, STRING_BYTES) };
    // SAFETY: `strnlen` has just read these bytes.
    let bytes = unsafe { std::slice::from_raw_parts(pointer.cast::<u8>(), len) };
    String::from_utf8_lossy(bytes).into_owned()
}
