//! The gate for plugin files: what a shared library must be before anybody's loader touches it.
//!
//! The bytes are a stranger's, so they are parsed in the jailed runner ([`crate::Launcher::inspect`]) and nowhere else.
//! What is found here stops accidents and lazy attacks, and tells an author how to mend the build; the boundary is the
//! jail, which holds for what passes as well.

mod build;
mod facts;
mod rules;

use goblin::container::{Container, Ctx, Endian};
use goblin::elf::Elf;
use goblin::elf::program_header::{PT_LOAD, ProgramHeader};
use serde::{Deserialize, Serialize};

use crate::text;
pub use build::Build;
pub use facts::Facts;
pub use rules::{RULES, Rule};

/// Largest plugin file, bytes.
pub const MAX_BYTES: u64 = 64 << 20;

/// What the gate found in a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Inspection {
    /// Why it may not be loaded; empty when it may.
    pub rejections: Vec<Rejection>,
    /// What a curator wants to know; none of it is a reason to refuse. Absent when the file cannot be read as ELF.
    pub facts: Option<Facts>,
}

impl Inspection {
    /// Of a file that could not be read as ELF.
    pub fn unreadable(what: impl Into<String>) -> Self {
        Self { rejections: vec![rules::UNREADABLE.rejection(what.into())], facts: None }
    }
}

/// One reason to refuse a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rejection {
    /// Short name of the rule, e.g. `libraries`.
    pub rule: String,
    /// What was found.
    pub what: String,
    /// Why that cannot be.
    pub why: String,
    /// How to mend it in the author's build.
    pub mend: String,
}

impl std::fmt::Display for Rejection {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}; {}: {}", self.what, self.why, self.mend)
    }
}

/// A library that plugins may link, with the symbol versions that this machine's copy defines.
#[derive(Clone, Debug, Default)]
pub struct Offered {
    /// Its name as plugins ask for it.
    pub name: String,
    /// E.g. `GLIBC_2.36`.
    pub versions: Vec<String>,
}

/// Why these bytes may not be loaded; empty when they may.
pub fn rejections(bytes: &[u8], offered: &[Offered]) -> Vec<Rejection> {
    match readable(bytes) {
        Ok(elf) => broken(&Subject { bytes, elf: &elf, offered }),
        Err(what) => Inspection::unreadable(what).rejections,
    }
}

/// Looks at a file's bytes, all of its code included.
pub fn inspect(bytes: &[u8], offered: &[Offered]) -> Inspection {
    let elf = match readable(bytes) {
        Ok(elf) => elf,
        Err(what) => return Inspection::unreadable(what),
    };
    let subject = Subject { bytes, elf: &elf, offered };
    Inspection { rejections: broken(&subject), facts: Some(Facts::of(&subject)) }
}

fn readable(bytes: &[u8]) -> Result<Elf<'_>, String> {
    whole(bytes).and_then(|()| Elf::parse(bytes).map_err(|e| format!("its ELF structure is broken ({e})")))
}

fn broken(subject: &Subject<'_>) -> Vec<Rejection> {
    RULES.iter().filter_map(|rule| (rule.broken)(subject).map(|what| rule.rejection(what))).collect()
}

/// The symbol versions that one of this machine's own libraries defines.
pub fn versions_of(library: &[u8]) -> Vec<String> {
    let Ok(elf) = Elf::parse(library) else { return Vec::new() };
    let defined = elf.verdef.iter().flat_map(|section| section.iter()).filter_map(|def| {
        let first = def.iter().next()?;
        elf.dynstrtab.get_at(first.vda_name).map(one_line)
    });
    defined.collect()
}

/// What a rule looks at.
pub struct Subject<'a> {
    bytes: &'a [u8],
    elf: &'a Elf<'a>,
    offered: &'a [Offered],
}

impl Subject<'_> {
    /// The values of a dynamic tag.
    fn dynamic(&self, tag: u64) -> impl Iterator<Item = u64> + '_ {
        let all = self.elf.dynamic.iter().flat_map(|dynamic| dynamic.dyns.iter());
        all.filter(move |entry| entry.d_tag == tag).map(|entry| entry.d_val)
    }

    fn segments(&self, kind: u32) -> impl Iterator<Item = &ProgramHeader> {
        self.elf.program_headers.iter().filter(move |header| header.p_type == kind)
    }

    fn offers(&self, name: &str) -> bool {
        self.offered.iter().any(|library| library.name == name)
    }

    /// A string of the dynamic table.
    fn string(&self, offset: u64) -> String {
        usize::try_from(offset).ok().and_then(|at| self.elf.dynstrtab.get_at(at)).map_or_else(|| "?".into(), one_line)
    }
}

/// Does the file hold everything that its headers promise? Half a file is the commonest broken one, and the loader
/// would find out by a bus error.
fn whole(bytes: &[u8]) -> Result<(), String> {
    if !bytes.starts_with(b"\x7fELF") {
        return Err("it is not an ELF file".into());
    }
    let header = Elf::parse_header(bytes).map_err(|_| "it ends within its first header".to_string())?;
    let length = bytes.len() as u64;
    let sections = header.e_shoff.saturating_add(u64::from(header.e_shnum) * u64::from(header.e_shentsize));
    let headers = header.e_phoff.saturating_add(u64::from(header.e_phnum) * u64::from(header.e_phentsize));
    if sections.max(headers) > length {
        return Err(format!(
            "it is truncated: its headers end at byte {}, the file at {length}",
            sections.max(headers)
        ));
    }
    let lazy = Elf::lazy_parse(header).map_err(|e| format!("its first header is broken ({e})"))?;
    let container = if lazy.is_64 { Container::Big } else { Container::Little };
    let endian = if lazy.little_endian { Endian::Little } else { Endian::Big };
    let context = Ctx::new(container, endian);
    let segments = ProgramHeader::parse(bytes, header.e_phoff as usize, header.e_phnum as usize, context)
        .map_err(|e| format!("its program headers are broken ({e})"))?;
    for segment in segments.iter().filter(|segment| segment.p_type == PT_LOAD) {
        let end = segment.p_offset.saturating_add(segment.p_filesz);
        if end > length {
            return Err(format!("it is truncated: a segment ends at byte {end}, the file at {length}"));
        }
    }
    Ok(())
}

/// Foreign text for people, short.
fn one_line(text: &str) -> String {
    const MOST: usize = 120;
    text::one_line(text, MOST)
}
