//! What a plugin file must be, rule by rule, with the reason and the way to mend it.

use goblin::elf::dynamic::{
    DF_TEXTREL, DT_AUDIT, DT_CONFIG, DT_DEPAUDIT, DT_FLAGS, DT_NEEDED, DT_RPATH, DT_RUNPATH, DT_TEXTREL, DT_VERNEEDNUM,
};
use goblin::elf::header::{EI_CLASS, EI_DATA, EI_OSABI, ELFCLASS64, ELFDATA2LSB, EM_X86_64, ET_DYN};
use goblin::elf::program_header::{PF_W, PF_X, PT_DYNAMIC, PT_GNU_STACK, PT_INTERP, PT_LOAD};
use goblin::elf::sym::{STB_GLOBAL, STT_FUNC};

use super::{Rejection, Subject, one_line};
use crate::confine::root::OPENMP;

/// The function that every plugin exports.
const ENTRY: &str = "ocb_entry_v1";
/// The loader, which libraries may name as a library too.
const LOADER: &str = "ld-linux-x86-64.so.2";

/// Another library's symbols before this one's; goblin has no names for these two.
const DT_AUXILIARY: u64 = 0x7fff_fffd;
const DT_FILTER: u64 = 0x7fff_ffff;

/// One rule.
pub struct Rule {
    /// Short name.
    pub name: &'static str,
    /// Why it stands.
    pub why: &'static str,
    /// How to mend a file that breaks it.
    pub mend: &'static str,
    /// What breaks it, if something does.
    pub broken: fn(&Subject<'_>) -> Option<String>,
}

impl Rule {
    /// This rule, broken by `what`.
    pub fn rejection(&self, what: String) -> Rejection {
        Rejection { rule: self.name.into(), what, why: self.why.into(), mend: self.mend.into() }
    }
}

/// The rule in front of all others: without it there is nothing to look at.
pub const UNREADABLE: Rule = Rule {
    name: "readable",
    why: "only a whole ELF file can be loaded",
    mend: "build a shared library, e.g. cc -shared -fPIC plugin.c -o plugin.so, and copy it in binary mode and whole",
    broken: |_| None,
};

/// All others, in the order in which they are told.
pub const RULES: [Rule; 13] = [
    Rule {
        name: "machine",
        why: "plugins run on Linux on x86-64",
        mend: "build for x86_64-unknown-linux-gnu",
        broken: |s| {
            let header = &s.elf.header;
            let bytes = &header.e_ident;
            let fits = bytes[EI_CLASS] == ELFCLASS64
                && bytes[EI_DATA] == ELFDATA2LSB
                && header.e_machine == EM_X86_64
                // System V, or GNU for a library with indirect functions.
                && matches!(bytes[EI_OSABI], 0 | 3);
            let bits = if bytes[EI_CLASS] == ELFCLASS64 { 64 } else { 32 };
            (!fits).then(|| {
                format!(
                    "it is built for another machine ({bits} bits, machine {}, OS {})",
                    header.e_machine, bytes[EI_OSABI]
                )
            })
        },
    },
    Rule {
        name: "shared library",
        why: "a plugin is loaded into a running program",
        mend: "link with -shared (cc) or crate-type = [\"cdylib\"] (Rust)",
        broken: |s| {
            let program = s.segments(PT_INTERP).next().is_some();
            match s.elf.header.e_type {
                ET_DYN if !program => None,
                ET_DYN => Some("it is a program, not a shared library".into()),
                other => Some(format!("its ELF type is {other}, that of a shared library is {ET_DYN}")),
            }
        },
    },
    Rule {
        name: "segments",
        why: "the check must read exactly what the loader maps",
        mend: "use the linker's own layout; packers and post-link editors break it",
        broken: misplaced,
    },
    Rule {
        name: "writable code",
        why: "the jail maps nothing both writable and executable",
        mend: "remove -Wl,-N, -Wl,--omagic and linker scripts that merge code with data",
        broken: |s| {
            let both = |flags: u32| flags & PF_W != 0 && flags & PF_X != 0;
            s.segments(PT_LOAD).any(|load| both(load.p_flags)).then(|| "a segment is writable and executable".into())
        },
    },
    Rule {
        name: "stack",
        why: "an executable stack would make all data of the process executable",
        mend: "link with -z noexecstack; for assembly files add .section .note.GNU-stack,\"\",@progbits",
        broken: |s| {
            let mut stacks = s.segments(PT_GNU_STACK);
            match (stacks.next(), stacks.next()) {
                (None, _) => Some("it does not declare its stack non-executable (no PT_GNU_STACK)".into()),
                (Some(_), Some(_)) => Some("it has more than one PT_GNU_STACK".into()),
                (Some(stack), None) => (stack.p_flags & PF_X != 0).then(|| "it asks for an executable stack".into()),
            }
        },
    },
    Rule {
        name: "text relocations",
        why: "code would have to be writable while it is loaded",
        mend: "compile everything, static libraries too, with -fPIC",
        broken: |s| {
            let flagged = s.dynamic(DT_FLAGS).any(|flags| flags & DF_TEXTREL != 0);
            (flagged || s.dynamic(DT_TEXTREL).next().is_some()).then(|| "it has text relocations".into())
        },
    },
    Rule {
        name: "entry",
        why: "the host finds a plugin by this function (see plugin.h)",
        mend: "define it with OCB_EXPORT (C), or export the plugin with the macro of the Rust crate",
        broken: |s| {
            let is_entry = |name: Option<&str>| name == Some(ENTRY);
            let found = s.elf.dynsyms.iter().find(|sym| is_entry(s.elf.dynstrtab.get_at(sym.st_name)));
            match found {
                None => Some(format!("it does not export the function {ENTRY}")),
                Some(sym) if sym.st_shndx == 0 => Some(format!("it uses {ENTRY} but does not define it")),
                Some(sym) if sym.st_bind() != STB_GLOBAL || sym.st_type() != STT_FUNC => {
                    Some(format!("its {ENTRY} is not a global function"))
                }
                Some(_) => None,
            }
        },
    },
    Rule {
        name: "libraries",
        why: "the jail contains only glibc, libgcc and libstdc++",
        mend: "link other libraries statically (the .a file, or -static-libgomp where there is one) or leave them out",
        broken: |s| {
            let known = |name: &str| name == LOADER || name == OPENMP || s.offers(name);
            let foreign: Vec<String> =
                s.dynamic(DT_NEEDED).map(|at| s.string(at)).filter(|name| !known(name)).take(8).collect();
            (!foreign.is_empty()).then(|| format!("it needs {}", foreign.join(", ")))
        },
    },
    Rule {
        name: "threads",
        why: "the library starts threads, which only the multi-threaded track allows (if the machine has the library)",
        mend: "compile without -fopenmp, or declare OCB_CAPABILITY_THREADS and enter the multi-threaded track",
        broken: |s| {
            let needed = s.dynamic(DT_NEEDED).any(|at| s.string(at) == OPENMP);
            (needed && !s.offers(OPENMP)).then(|| format!("it needs {OPENMP}"))
        },
    },
    Rule {
        name: "versions",
        why: "this machine's libraries do not have that version",
        mend: "build on an older system, e.g. in a container of Debian 12 or of the oldest system you want to serve",
        broken: unknown_versions,
    },
    Rule {
        name: "search paths",
        why: "they name folders of the author's machine, which the jail does not have",
        mend: "remove -Wl,-rpath, or run patchelf --remove-rpath FILE",
        broken: |s| {
            let paths: Vec<String> =
                [DT_RPATH, DT_RUNPATH].into_iter().flat_map(|tag| s.dynamic(tag)).map(|at| s.string(at)).collect();
            (!paths.is_empty()).then(|| format!("it searches libraries in {}", paths.join(":")))
        },
    },
    Rule {
        name: "loader hooks",
        why: "they put code between the loader and other libraries",
        mend: "remove -Wl,--auxiliary, --filter, --audit, --depaudit and -z config",
        broken: |s| {
            let hooks = [
                (DT_AUDIT, "DT_AUDIT"),
                (DT_DEPAUDIT, "DT_DEPAUDIT"),
                (DT_AUXILIARY, "DT_AUXILIARY"),
                (DT_FILTER, "DT_FILTER"),
                (DT_CONFIG, "DT_CONFIG"),
            ];
            let found: Vec<&str> =
                hooks.into_iter().filter(|(tag, _)| s.dynamic(*tag).next().is_some()).map(|(_, name)| name).collect();
            (!found.is_empty()).then(|| format!("it has {}", found.join(", ")))
        },
    },
    Rule {
        name: "symbols",
        why: "the host looks up one function, and a large symbol table slows down the start of every trial",
        mend: "compile with -fvisibility=hidden (cc), or use crate-type cdylib (Rust)",
        broken: |s| {
            const MOST: usize = 200_000;
            let count = s.elf.dynsyms.len();
            (count > MOST).then(|| format!("it has {count} dynamic symbols; at most {MOST} are allowed"))
        },
    },
];

/// Segments that overlap, or a dynamic table that is not where the loader will find it.
fn misplaced(s: &Subject<'_>) -> Option<String> {
    const PAGE: u64 = 4096;
    let (mut end, mut page_end) = (0, 0);
    for load in s.segments(PT_LOAD) {
        if load.p_filesz > load.p_memsz || load.p_vaddr % PAGE != load.p_offset % PAGE {
            return Some("a segment does not fit its place in memory".into());
        }
        if load.p_vaddr < end {
            return Some("its segments overlap or are out of order".into());
        }
        // The loader maps whole pages: of one that two segments share, the later one's bytes are seen.
        if load.p_vaddr / PAGE * PAGE < page_end {
            return Some("two of its segments share a page of memory".into());
        }
        let last = load.p_vaddr.checked_add(load.p_memsz);
        (end, page_end) = match last.and_then(|end| Some((end, end.checked_next_multiple_of(PAGE)?))) {
            Some(ends) => ends,
            None => return Some("a segment reaches past the end of memory".into()),
        };
    }
    let mut tables = s.segments(PT_DYNAMIC);
    let (Some(table), None) = (tables.next(), tables.next()) else {
        return Some("it does not have exactly one dynamic table".into());
    };
    let inside = s.segments(PT_LOAD).any(|load| {
        let at = table.p_vaddr.checked_sub(load.p_vaddr);
        at.is_some()
            && at == table.p_offset.checked_sub(load.p_offset)
            && at.and_then(|at| at.checked_add(table.p_filesz)).is_some_and(|end| end <= load.p_filesz)
    });
    (!inside).then(|| "its dynamic table is not where the loader looks for it".into())
}

/// Symbol versions that this machine's libraries do not define.
fn unknown_versions(s: &Subject<'_>) -> Option<String> {
    let promised = s.dynamic(DT_VERNEEDNUM).any(|count| count > 0);
    let Some(section) = &s.elf.verneed else {
        return promised.then(|| "it needs symbol versions, but its section headers do not show them".into());
    };
    let mut missing: Vec<String> = Vec::new();
    for file in section.iter().take(64) {
        let name = s.elf.dynstrtab.get_at(file.vn_file).map(one_line).unwrap_or_default();
        let Some(library) = s.offered.iter().find(|library| library.name == name) else { continue };
        // A library that could not be read defines nothing that we know of; then the loader is left to say it.
        if library.versions.is_empty() {
            continue;
        }
        for version in file.iter().take(256) {
            let version = s.elf.dynstrtab.get_at(version.vna_name).map(one_line).unwrap_or_default();
            if !library.versions.contains(&version) && missing.len() < 4 {
                missing.push(format!("{version} of {name}"));
            }
        }
    }
    (!missing.is_empty()).then(|| format!("it needs {}", missing.join(", ")))
}
