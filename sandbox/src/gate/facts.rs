//! What a curator wants to know of a plugin file and the gate does not judge.

use std::collections::BTreeSet;

use goblin::elf::dynamic::{
    DF_1_NOW, DF_BIND_NOW, DT_BIND_NOW, DT_FLAGS, DT_FLAGS_1, DT_INIT, DT_INIT_ARRAYSZ, DT_NEEDED,
};
use goblin::elf::note::NT_GNU_BUILD_ID;
use goblin::elf::program_header::PT_GNU_RELRO;
use goblin::elf::reloc::R_X86_64_IRELATIVE;
use goblin::elf::sym::STT_GNU_IFUNC;
use serde::{Deserialize, Serialize};

use super::{Build, Subject, one_line};

/// Names kept of a long list.
const NAMES: usize = 32;
/// Notes, relocations and symbols looked at.
const ENTRIES: usize = 1 << 20;

/// What a curator wants to know. Lists are cut; all text is the file's own and unverified.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Facts {
    /// Size of the file, bytes.
    pub bytes: u64,
    /// Libraries that it links.
    pub libraries: Vec<String>,
    /// Newest symbol version per kind, e.g. `GLIBC_2.34`.
    pub newest_versions: Vec<String>,
    /// Functions that run while it is loaded, before anybody calls it. Every compiler adds one or two.
    pub constructors: u64,
    /// Functions chosen while it is loaded (IFUNC): their choosers run then, too.
    pub indirect_functions: u64,
    /// It links a library of threads.
    pub threads: bool,
    /// Relocated data becomes read-only after loading.
    pub relro: bool,
    /// All symbols are bound while it is loaded.
    pub bind_now: bool,
    /// Build id, hex.
    pub build_id: Option<String>,
    /// How it was compiled.
    pub build: Build,
    /// x86-64 level that it says it needs: 1 to 4.
    pub isa_level: Option<u8>,
    /// Dynamic symbols that it defines beside the entry. RTLD_LOCAL keeps them from anybody else.
    pub other_exports: u64,
    /// Imported functions that reach for the system: what a curator looks at first.
    pub notable_imports: Vec<String>,
}

/// Imports that a plugin rarely needs; the jail stops what they do.
const NOTABLE: [&str; 34] = [
    "execve",
    "execv",
    "execvp",
    "posix_spawn",
    "system",
    "popen",
    "fork",
    "vfork",
    "clone",
    "socket",
    "connect",
    "bind",
    "getaddrinfo",
    "ptrace",
    "process_vm_readv",
    "process_vm_writev",
    "kill",
    "prctl",
    "syscall",
    "dlopen",
    "dlsym",
    "dlmopen",
    "mprotect",
    "pthread_create",
    "signal",
    "sigaction",
    "clock_gettime",
    "gettimeofday",
    "time",
    "open",
    "fopen",
    "opendir",
    "getenv",
    "personality",
];

impl Facts {
    pub(super) fn of(s: &Subject<'_>) -> Self {
        let libraries: Vec<String> = s.dynamic(DT_NEEDED).map(|at| s.string(at)).take(NAMES).collect();
        let threads = libraries.iter().any(|name| ["libgomp", "libomp", "libtbb"].iter().any(|t| name.starts_with(t)));
        let defined = || s.elf.dynsyms.iter().filter(|sym| sym.st_shndx != 0).take(ENTRIES);
        let imported = s.elf.dynsyms.iter().filter(|sym| sym.st_shndx == 0).take(ENTRIES);
        let imported: BTreeSet<&str> = imported.filter_map(|sym| s.elf.dynstrtab.get_at(sym.st_name)).collect();
        let relocations = s.elf.dynrelas.iter().chain(s.elf.pltrelocs.iter()).take(ENTRIES);
        let chosen = relocations.filter(|r| r.r_type == R_X86_64_IRELATIVE).count() as u64;
        let flag = |tag, bit| s.dynamic(tag).any(|flags| flags & bit != 0);
        Facts {
            bytes: s.bytes.len() as u64,
            newest_versions: newest_versions(s),
            constructors: s.dynamic(DT_INIT_ARRAYSZ).sum::<u64>() / 8 + s.dynamic(DT_INIT).count() as u64,
            indirect_functions: chosen + defined().filter(|sym| sym.st_type() == STT_GNU_IFUNC).count() as u64,
            threads,
            relro: s.segments(PT_GNU_RELRO).next().is_some(),
            bind_now: s.dynamic(DT_BIND_NOW).next().is_some()
                || flag(DT_FLAGS, DF_BIND_NOW)
                || flag(DT_FLAGS_1, DF_1_NOW),
            build_id: build_id(s),
            build: Build::of(s),
            isa_level: isa_level(s),
            other_exports: (defined().count() as u64).saturating_sub(1),
            notable_imports: NOTABLE.iter().filter(|name| imported.contains(*name)).map(|n| (*n).to_string()).collect(),
            libraries,
        }
    }

    /// The lines of a report that an author or curator should look at.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        // One or two come from every compiler.
        if self.constructors > 3 {
            remarks.push(format!("{} functions run while it is loaded (constructors).", self.constructors));
        }
        if self.indirect_functions > 0 {
            let n = self.indirect_functions;
            remarks.push(format!("{n} functions are chosen while it is loaded (IFUNC), which runs code then."));
        }
        if !self.relro || !self.bind_now {
            remarks.push("It is not linked with -z relro -z now, so its function pointers stay writable.".into());
        }
        if let Some(level @ 3..) = self.isa_level {
            remarks.push(format!("It needs x86-64-v{level}; an older processor ends it with SIGILL."));
        }
        if !self.notable_imports.is_empty() {
            remarks.push(format!("It imports {}.", self.notable_imports.join(", ")));
        }
        remarks
    }

    /// One sentence of what it is.
    pub fn sentence(&self) -> String {
        let or_none = |list: &[String]| if list.is_empty() { "nothing".to_string() } else { list.join(", ") };
        let compilers = &self.build.compilers;
        let compilers =
            if compilers.is_empty() { "a compiler that does not say".into() } else { compilers.join(" and ") };
        let flags = &self.build.flags;
        let flags = if flags.is_empty() { String::new() } else { format!(" with {}", flags.join(" and with ")) };
        let sets = &self.build.instruction_sets;
        let sets = if sets.is_empty() { "x86-64 alone".into() } else { sets.join(", ") };
        format!(
            "A shared library of {} bytes, links {}, needs {}, built by {compilers}{flags}, has instructions of {sets}.",
            self.bytes,
            or_none(&self.libraries),
            or_none(&self.newest_versions),
        )
    }
}

/// The newest version of each kind, by the numbers in it.
fn newest_versions(s: &Subject<'_>) -> Vec<String> {
    let mut newest: Vec<(String, Vec<u64>, String)> = Vec::new();
    let files = s.elf.verneed.iter().flat_map(|section| section.iter()).take(NAMES);
    for name in files.flat_map(|file| file.iter().take(256).map(|need| need.vna_name).collect::<Vec<_>>()) {
        let Some(version) = s.elf.dynstrtab.get_at(name).map(one_line) else { continue };
        let Some((kind, numbers)) = version.rsplit_once('_') else { continue };
        let numbers: Vec<u64> = numbers.split('.').filter_map(|n| n.parse().ok()).collect();
        match newest.iter().position(|(known, ..)| known == kind) {
            Some(known) if newest[known].1 < numbers => newest[known] = (kind.to_string(), numbers, version),
            None if newest.len() < NAMES => newest.push((kind.to_string(), numbers, version)),
            _ => {}
        }
    }
    newest.into_iter().map(|(_, _, version)| version).collect()
}

fn build_id(s: &Subject<'_>) -> Option<String> {
    let note = notes(s).find(|(name, kind, _)| *name == "GNU" && *kind == NT_GNU_BUILD_ID)?;
    Some(note.2.iter().take(32).map(|byte| format!("{byte:02x}")).collect())
}

/// Bits of GNU_PROPERTY_X86_ISA_1_NEEDED in the note of GNU properties.
fn isa_level(s: &Subject<'_>) -> Option<u8> {
    const PROPERTIES: u32 = 5;
    const ISA_1_NEEDED: u32 = 0xc000_8002;
    let note = notes(s).find(|(name, kind, _)| *name == "GNU" && *kind == PROPERTIES)?;
    let word = |at: usize| note.2.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let mut at = 0;
    while let (Some(kind), Some(size)) = (word(at), word(at + 4)) {
        if kind == ISA_1_NEEDED {
            let bits = word(at + 8)? & 0xf;
            return (bits != 0).then(|| (32 - bits.leading_zeros()) as u8);
        }
        at = at.checked_add(8)?.checked_add((size as usize).next_multiple_of(8))?;
    }
    None
}

/// The readable notes: name, kind, content.
fn notes<'a>(s: &'a Subject<'a>) -> impl Iterator<Item = (&'a str, u32, &'a [u8])> {
    let notes = s.elf.iter_note_headers(s.bytes).into_iter().flatten();
    // A broken note ends the walk: the iterator would report it again and again.
    notes.map_while(Result::ok).take(256).map(|note| (note.name.trim_end_matches('\0'), note.n_type, note.desc))
}
