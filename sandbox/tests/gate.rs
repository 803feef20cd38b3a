//! The gate: each rule is broken by a file that a compiler really makes, and honest files pass.

mod common;

use std::path::{Path, PathBuf};

use common::{cc, fixture, launcher, runner, start};
use ocb_sandbox::gate::RULES;
use ocb_sandbox::{Inspection, Outcome};

fn inspect(file: &Path) -> Inspection {
    launcher().inspect(file).unwrap()
}

/// The file is refused by this rule and by no other, and the reason is a whole sentence with a way out.
fn check_refused(file: &Path, rule: &str, words: &str) {
    let inspection = inspect(file);
    let names: Vec<&str> = inspection.rejections.iter().map(|r| r.rule.as_str()).collect();
    assert_eq!(names, [rule], "{}", file.display());
    let text = inspection.rejections[0].to_string();
    assert!(text.contains(words), "{text}");
    // Nobody loads it: the reason comes from the gate, not from the loader.
    let Outcome::LoadError { reason } = launcher().describe(file).unwrap_err().outcome else { panic!("loaded") };
    assert_eq!(reason, text);
}

struct Folder(tempfile::TempDir);

impl Folder {
    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    /// Compiles a source into a shared library.
    fn build(&self, source: &str, flags: &[&str]) -> PathBuf {
        let from = self.file("source.c", source.as_bytes());
        let to = self.0.path().join(format!("{}.so", flags.join("").replace(['/', '$', ','], "-")));
        cc(&[&["-shared", "-fPIC", "-o", to.to_str().unwrap(), from.to_str().unwrap()], flags].concat());
        to
    }
}

fn folder() -> Folder {
    Folder(tempfile::tempdir().unwrap())
}

const ENTRY: &str = "void *ocb_entry_v1(unsigned v) { (void)v; return 0; }";

/// Changes bytes of a good file.
fn patched(folder: &Folder, name: &str, patch: impl Fn(&mut Vec<u8>)) -> PathBuf {
    let mut bytes = std::fs::read(fixture(&[])).unwrap();
    patch(&mut bytes);
    folder.file(name, &bytes)
}

#[test]
fn honest_files_pass() {
    let facts = inspect(&fixture(&[])).facts.unwrap();
    assert!(facts.libraries.contains(&"libc.so.6".to_string()), "{facts:?}");
    assert!(facts.newest_versions.iter().any(|v| v.starts_with("GLIBC_2.")), "{facts:?}");
    assert!(
        facts.constructors >= 1 && facts.relro && facts.build.compilers.iter().any(|c| c.contains("GCC")),
        "{facts:?}"
    );
    assert!(facts.build_id.is_some_and(|id| id.len() == 40 && id.chars().all(|c| c.is_ascii_hexdigit())));
    for name in ["libocb_brute_force.so", "libocb_box_tree.so", "libocb_fast.so", "libocb_parry.so"] {
        let shipped = runner().with_file_name(name);
        // Not built when the sandbox is built alone.
        if shipped.exists() {
            assert_eq!(inspect(&shipped).rejections, [], "{name}");
        }
    }
}

#[test]
fn a_file_tells_how_it_was_compiled() {
    let folder = folder();
    let sums = "double sum(const double *x, const double *y, int n) { double s = 0; \
                for (int i = 0; i < n; i++) s += x[i] * y[i]; return s; }";
    let built = |flags: &[&str]| {
        let source = format!("{ENTRY}\n{sums}");
        inspect(&folder.build(&source, &[flags, &["-ffast-math", "-funroll-loops"]].concat())).facts.unwrap().build
    };
    let plain = built(&["-O3"]);
    assert_eq!(plain.instruction_sets, [""; 0], "x86-64 alone");
    assert_eq!(plain.flags, [""; 0], "they were not recorded");
    let wide = built(&["-O3", "-mavx2", "-mfma", "-frecord-gcc-switches"]);
    assert!(["AVX", "FMA"].iter().all(|set| wide.instruction_sets.iter().any(|s| s == set)), "{wide:?}");
    assert!(!wide.instruction_sets.iter().any(|set| set == "AVX-512"), "{wide:?}");
    let widest = built(&["-O3", "-march=x86-64-v4", "-mprefer-vector-width=512", "-frecord-gcc-switches"]);
    assert!(widest.instruction_sets.iter().any(|set| set == "AVX-512"), "{widest:?}");
    let [flags] = &widest.flags[..] else { panic!("{widest:?}") };
    assert!(
        ["-O3", "-march=x86-64-v4", "-ffast-math"].iter().all(|flag| flags.split(' ').any(|f| f == *flag)),
        "{flags}"
    );
    assert!(!flags.contains("-fPIC") && !flags.contains("-mno-"), "only what decides: {flags}");
    assert!(plain.compilers.iter().chain(&widest.compilers).all(|compiler| compiler.contains("GCC")), "{plain:?}");
}

#[test]
fn what_is_no_whole_file_is_unreadable() {
    let folder = folder();
    check_refused(&folder.file("empty", b""), "readable", "it is not an ELF file");
    check_refused(&folder.file("script", b"#!/bin/sh\nexit 0\n"), "readable", "it is not an ELF file");
    check_refused(&folder.file("short", b"\x7fELF\x02\x01\x01"), "readable", "within its first header");
    let whole = std::fs::read(fixture(&[])).unwrap();
    for tenth in 1..10 {
        check_refused(&folder.file("half", &whole[..whole.len() * tenth / 10]), "readable", "truncated");
    }
    // Even without its section headers, which would give it away, half a file is noticed.
    let mut headless = whole[..whole.len() / 2].to_vec();
    headless[0x28..0x30].fill(0);
    headless[0x3a..0x40].fill(0);
    check_refused(&folder.file("headless", &headless), "readable", "truncated: a segment");
}

#[test]
fn other_machines_and_programs_are_refused() {
    let folder = folder();
    check_refused(&patched(&folder, "arm", |b| b[0x12] = 183), "machine", "x86_64-unknown-linux-gnu");
    check_refused(&patched(&folder, "freebsd", |b| b[7] = 9), "machine", "OS 9");
    let source = folder.file("p.c", format!("{ENTRY}\nint main(void) {{ return 0; }}").as_bytes());
    let program = folder.0.path().join("program");
    let (to, from) = (program.to_str().unwrap(), source.to_str().unwrap());
    cc(&["-pie", "-fPIE", "-rdynamic", "-o", to, from]);
    check_refused(&program, "shared library", "it is a program");
}

#[test]
fn dangerous_memory_is_refused() {
    let folder = folder();
    check_refused(&folder.build(ENTRY, &["-Wl,-z,execstack"]), "stack", "-z noexecstack");
    let relocated = folder.build(&format!("{ENTRY}\nextern int x; int *p(void) {{ return &x; }} "), &["-Wl,-z,notext"]);
    // The compiler made position-independent code of it, so the flag alone has no effect: an honest file.
    assert_eq!(inspect(&relocated).rejections, []);
    let assembly = format!("{ENTRY}\n__asm__(\".text\\n.quad ocb_entry_v1\\n\");");
    check_refused(&folder.build(&assembly, &["-Wl,-z,notext", "-w"]), "text relocations", "-fPIC");
    // Type PT_LOAD (1), flags R and X (5): now W as well.
    let open = patched(&folder, "writable", |bytes| {
        let code = program_headers(bytes).find(|at| bytes[*at] == 1 && bytes[at + 4] == 5).unwrap();
        bytes[code + 4] = 7;
    });
    check_refused(&open, "writable code", "linker scripts");
}

/// Where the program headers of a 64-bit file lie.
fn program_headers(bytes: &[u8]) -> impl Iterator<Item = usize> + use<> {
    let first = u64::from_le_bytes(bytes[0x20..0x28].try_into().unwrap()) as usize;
    (0..usize::from(bytes[0x38])).map(move |i| first + 56 * i)
}

#[test]
fn the_entry_must_be_a_function_of_the_file() {
    let folder = folder();
    check_refused(&folder.build("int other;", &[]), "entry", "does not export the function ocb_entry_v1");
    check_refused(&folder.build("int ocb_entry_v1;", &[]), "entry", "is not a global function");
    let uses = "void *ocb_entry_v1(unsigned); void *f(void) { return ocb_entry_v1(1); }";
    check_refused(&folder.build(uses, &[]), "entry", "does not define it");
    let hidden = "__attribute__((visibility(\"hidden\"))) void *ocb_entry_v1(unsigned v) { return (void *)(long)v; }";
    check_refused(&folder.build(hidden, &[]), "entry", "OCB_EXPORT");
}

#[test]
fn foreign_libraries_paths_and_hooks_are_refused() {
    let folder = folder();
    let other = folder.build("int other;", &["-Wl,-soname,libother.so.3"]);
    let uses = format!("{ENTRY}\nextern int other; int g(void) {{ return other; }}");
    check_refused(&folder.build(&uses, &[other.to_str().unwrap()]), "libraries", "it needs libother.so.3");
    check_refused(&folder.build(ENTRY, &["-Wl,-rpath,/opt/mine"]), "search paths", "/opt/mine");
    check_refused(&folder.build(ENTRY, &["-Wl,-rpath,$ORIGIN", "-Wl,--disable-new-dtags"]), "search paths", "patchelf");
    check_refused(&folder.build(ENTRY, &["-Wl,--auxiliary,libc.so.6"]), "loader hooks", "DT_AUXILIARY");
    check_refused(&folder.build(ENTRY, &["-Wl,--filter,libc.so.6"]), "loader hooks", "DT_FILTER");
    check_refused(&folder.build(ENTRY, &["-Wl,--audit,x.so"]), "loader hooks", "DT_AUDIT");
    let audited = folder.build(ENTRY, &["-Wl,--depaudit,x.so"]);
    check_refused(&audited, "loader hooks", "DT_DEPAUDIT");
    // No linker of today writes this one: a neighbour's tag is changed into it.
    let mut bytes = std::fs::read(&audited).unwrap();
    let (depaudit, config) = (0x6fff_fefb_u64.to_le_bytes(), 0x6fff_fefa_u64.to_le_bytes());
    let at = bytes.windows(8).position(|tag| tag == depaudit).expect("the tag of DT_DEPAUDIT");
    bytes[at..at + 8].copy_from_slice(&config);
    check_refused(&folder.file("config", &bytes), "loader hooks", "DT_CONFIG");
}

#[test]
fn too_many_symbols_are_refused() {
    let folder = folder();
    let symbols = |count: u32| {
        let one = ".macro one\\n.globl s\\\\@\\ns\\\\@:\\n.endm\\n";
        let all = format!("{ENTRY}\n__asm__(\".data\\n{one}.rept {count}\\none\\n.endr\\n.text\");");
        folder.build(&all, &["-Wl,--hash-style=gnu", "-nostdlib"])
    };
    assert_eq!(inspect(&symbols(199_000)).rejections, []);
    check_refused(&symbols(200_001), "symbols", "-fvisibility=hidden");
}

#[test]
fn a_version_that_is_not_here_is_refused() {
    let folder = folder();
    // A later glibc's symbol is made from one that is there, of equal length in the string table.
    let newer = patched(&folder, "newer", |bytes| {
        let at = bytes.windows(11).position(|w| w == b"GLIBC_2.2.5").expect("every library of this machine needs it");
        bytes[at..at + 11].copy_from_slice(b"GLIBC_9.9.9");
    });
    check_refused(&newer, "versions", "GLIBC_9.9.9 of libc.so.6");
    let bare = patched(&folder, "bare", |bytes| {
        bytes[0x28..0x30].fill(0);
        bytes[0x3a..0x40].fill(0);
    });
    check_refused(&bare, "versions", "section headers do not show them");
}

#[test]
fn a_dynamic_table_elsewhere_is_refused() {
    let folder = folder();
    // The second copy of the program header's offset leads the reader here and the loader there.
    let moved = patched(&folder, "moved", |bytes| {
        let dynamic = program_headers(bytes).find(|at| bytes[*at] == 2 && bytes[at + 1] == 0).unwrap();
        let address = u64::from_le_bytes(bytes[dynamic + 16..dynamic + 24].try_into().unwrap()) + 64;
        bytes[dynamic + 16..dynamic + 24].copy_from_slice(&address.to_le_bytes());
    });
    check_refused(&moved, "segments", "not where the loader looks");
}

#[test]
fn what_is_recorded_is_no_reason_to_refuse() {
    let folder = folder();
    let odd = format!(
        "{ENTRY}
        static int one(void) {{ return 1; }}
        static int (*choose(void))(void) {{ return one; }}
        int chosen(void) __attribute__((ifunc(\"choose\")));
        int socket(int, int, int); int use(void) {{ return socket(1, 2, 3); }}
        __attribute__((constructor)) static void a(void) {{}}
        __attribute__((constructor)) static void b(void) {{}}
        __attribute__((constructor)) static void c(void) {{}}"
    );
    let found = inspect(&folder.build(&odd, &["-Wl,-z,norelro"]));
    assert_eq!(found.rejections, []);
    let facts = found.facts.unwrap();
    assert!(facts.constructors >= 4 && facts.indirect_functions >= 1 && !facts.relro, "{facts:?}");
    assert_eq!(facts.notable_imports, ["socket"]);
    assert!(facts.other_exports >= 2, "{facts:?}");
    let remarks = facts.remarks().join(" ");
    assert!(["constructors", "IFUNC", "relro", "socket"].iter().all(|word| remarks.contains(word)), "{remarks}");
}

#[test]
fn a_file_too_large_is_not_even_copied() {
    let folder = folder();
    let path = folder.file("large.so", b"\x7fELF");
    std::fs::File::options().write(true).open(&path).unwrap().set_len((64 << 20) + 1).unwrap();
    let ending = launcher().inspect(&path).unwrap_err();
    assert!(matches!(&ending.outcome, Outcome::LoadError { reason } if reason.contains("strip")), "{ending}");
}

#[test]
fn a_session_with_an_honest_file_starts_after_all_this() {
    assert_eq!(start(&launcher(), &fixture(&[])).unwrap().finish().outcome, Outcome::Completed);
    assert!(RULES.iter().all(|rule| rule.why.len() > 10 && rule.mend.len() > 10));
}

/// A 64-bit word of the file.
fn word(bytes: &[u8], at: usize) -> u64 {
    u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
}

/// A file whose dynamic table is another one for the loader: the writable segment ends behind the table, and a segment that
/// was a note goes on from there, with the whole page again at the end of the file.
fn two_tables(bytes: &mut Vec<u8>) {
    const PAGE: u64 = 4096;
    let headers = |kind: u32| {
        let of_kind = |at: &usize| bytes[*at..at + 4] == kind.to_le_bytes();
        program_headers(bytes).filter(of_kind).collect::<Vec<_>>()
    };
    let (data, dynamic, note) = (*headers(1).last().unwrap(), headers(2)[0], headers(4)[0]);
    assert!(note > data, "the loader reads headers in their order");
    let (offset, address, size) = (word(bytes, data + 8), word(bytes, data + 16), word(bytes, data + 40));
    let file_size = word(bytes, data + 32);
    let table = word(bytes, dynamic + 8)..word(bytes, dynamic + 8) + word(bytes, dynamic + 32);
    let behind = table.end - offset;
    // The pages of the segment once more, with a search path in an empty entry of the table.
    let from = offset / PAGE * PAGE;
    bytes.resize(bytes.len().next_multiple_of(PAGE as usize), 0);
    let copy = bytes.len() as u64;
    bytes.extend_from_within(from as usize..(offset + file_size) as usize);
    let in_copy = |at: u64| (copy + (at - from)) as usize;
    let empty = table.clone().step_by(16).find(|at| word(bytes, *at as usize) == 0).expect("linkers leave some");
    assert!(empty + 32 <= table.end, "the last entry ends the table");
    bytes[in_copy(empty)] = 29;
    let mut set = |at: usize, value: u64| bytes[at..at + 8].copy_from_slice(&value.to_le_bytes());
    set(data + 32, behind);
    set(data + 40, behind);
    set(note, 1 | 6 << 32);
    set(note + 8, in_copy(table.end) as u64);
    for at in [16, 24] {
        set(note + at, address + behind);
    }
    set(note + 32, file_size - behind);
    set(note + 40, size - behind);
    set(note + 48, PAGE);
}

#[test]
fn a_page_that_two_segments_share_is_refused() {
    let folder = folder();
    check_refused(&patched(&folder, "two-tables", two_tables), "segments", "share a page of memory");
}

#[test]
fn other_linkers_keep_segments_on_pages_of_their_own() {
    let folder = folder();
    let data = format!("{ENTRY}\nint data[3000] = {{1}}; static int more[5000]; int *p(void) {{ return more; }}");
    for flags in [
        &["-Wl,-z,noseparate-code"][..],
        &["-Wl,-z,separate-code"],
        &["-Wl,-z,norelro"],
        &["-Wl,-z,max-page-size=4096"],
        &["-Wl,-z,max-page-size=65536"],
        &["-O2", "-s"],
    ] {
        assert_eq!(inspect(&folder.build(&data, flags)).rejections, [], "{flags:?}");
    }
}
