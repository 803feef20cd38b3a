//! How a file was compiled: what its compilers wrote into it, and which instructions it holds. The instruction sets are found by
//! decoding the code, because an author could leave them out of a declaration.

use std::collections::BTreeSet;

use goblin::elf::program_header::{PF_X, PT_LOAD};
use goblin::elf::section_header::{SHF_EXECINSTR, SHT_PROGBITS};
use iced_x86::{CpuidFeature, Decoder, DecoderOptions, Instruction};
use serde::{Deserialize, Serialize};

use super::{Subject, one_line};

/// Texts kept of a section.
const TEXTS: usize = 8;
/// Fewer instructions of a set may be data between functions that look like instructions.
const LEAST: u32 = 16;
/// Extensions of x86-64 that make a difference to what is measured here. Not BMI: compilers write its TZCNT for any processor,
/// since older ones take it for BSF.
const SETS: [(&str, &[CpuidFeature]); 9] = [
    ("SSE3", &[CpuidFeature::SSE3]),
    ("SSSE3", &[CpuidFeature::SSSE3]),
    ("SSE4.1", &[CpuidFeature::SSE4_1]),
    ("SSE4.2", &[CpuidFeature::SSE4_2]),
    ("AVX", &[CpuidFeature::AVX]),
    ("F16C", &[CpuidFeature::F16C]),
    ("FMA", &[CpuidFeature::FMA]),
    ("AVX2", &[CpuidFeature::AVX2]),
    (
        "AVX-512",
        &[
            CpuidFeature::AVX512F,
            CpuidFeature::AVX512BW,
            CpuidFeature::AVX512CD,
            CpuidFeature::AVX512DQ,
            CpuidFeature::AVX512VL,
            CpuidFeature::AVX512_IFMA,
            CpuidFeature::AVX512_VBMI,
            CpuidFeature::AVX512_VBMI2,
        ],
    ),
];
/// Options that decide what code is made, by how they begin.
const DECISIVE: [&str; 12] = [
    "-O",
    "-march=",
    "-mcpu=",
    "-mprefer-vector-width=",
    "-flto",
    "-ffast-math",
    "-funsafe-math-optimizations",
    "-fassociative-math",
    "-freciprocal-math",
    "-ffinite-math-only",
    "-ffp-contract=",
    "-frounding-math",
];

/// How a file was compiled.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Build {
    /// What the compilers say of themselves.
    pub compilers: Vec<String>,
    /// The options that they recorded (`-frecord-gcc-switches`), those that decide what code is made; empty when they did not.
    pub flags: Vec<String>,
    /// Extensions of x86-64 whose instructions are in the file. It may choose among them when it runs.
    pub instruction_sets: Vec<String>,
}

impl Build {
    pub(super) fn of(s: &Subject<'_>) -> Self {
        let decisive = |options: String| {
            let kept = options.split_whitespace().filter(|o| DECISIVE.iter().any(|begin| o.starts_with(begin)));
            kept.collect::<Vec<_>>().join(" ")
        };
        Self {
            compilers: lines(texts(s, ".comment").filter(|text| !text.starts_with("Linker:"))),
            flags: lines(texts(s, ".GCC.command.line").map(decisive).filter(|options| !options.is_empty())),
            instruction_sets: instruction_sets(s),
        }
    }
}

/// The texts of a section, each ended by a zero.
fn texts<'a>(s: &'a Subject<'a>, section: &str) -> impl Iterator<Item = String> + 'a {
    const MOST: usize = 4096;
    let named = |name: usize| s.elf.shdr_strtab.get_at(name) == Some(section);
    let found = s.elf.section_headers.iter().find(|header| named(header.sh_name));
    let bytes = found.map_or(&[][..], |header| part(s.bytes, header.sh_offset, header.sh_size));
    let texts = bytes.split(|byte| *byte == 0).filter(|text| !text.is_empty()).take(1 << 12);
    texts.map(|text| String::from_utf8_lossy(&text[..text.len().min(MOST)]).into_owned())
}

fn lines(texts: impl Iterator<Item = String>) -> Vec<String> {
    let different: BTreeSet<String> = texts.map(|text| one_line(&text)).collect();
    different.into_iter().take(TEXTS).collect()
}

/// Decodes all code from start to end.
fn instruction_sets(s: &Subject<'_>) -> Vec<String> {
    let mut counts = [0_u32; SETS.len()];
    let mut instruction = Instruction::default();
    for code in code(s) {
        let mut decoder = Decoder::new(64, code, DecoderOptions::NONE);
        while decoder.can_decode() {
            decoder.decode_out(&mut instruction);
            for feature in instruction.cpuid_features() {
                if let Some(set) = SETS.iter().position(|(_, features)| features.contains(feature)) {
                    counts[set] += 1;
                }
            }
        }
    }
    let named = SETS.iter().zip(counts).filter(|(_, count)| *count >= LEAST);
    named.map(|((name, _), _)| (*name).to_string()).collect()
}

/// The sections that hold code; of a file that names no sections the executable segments.
fn code<'a>(s: &'a Subject<'a>) -> Vec<&'a [u8]> {
    let sections = s.elf.section_headers.iter();
    let executable = sections.filter(|h| h.sh_type == SHT_PROGBITS && h.sh_flags & u64::from(SHF_EXECINSTR) != 0);
    let found = once(s, executable.map(|h| (h.sh_offset, h.sh_size)));
    if !found.is_empty() {
        return found;
    }
    once(s, s.segments(PT_LOAD).filter(|h| h.p_flags & PF_X != 0).map(|h| (h.p_offset, h.p_filesz)))
}

/// These parts of the file, together no more than the file: a thousand headers may name the same part.
fn once<'a>(s: &Subject<'a>, parts: impl Iterator<Item = (u64, u64)>) -> Vec<&'a [u8]> {
    let mut left = s.bytes.len();
    let parts = parts.map(|(offset, size)| part(s.bytes, offset, size));
    parts
        .take_while(|code| {
            left = left.saturating_sub(code.len());
            left > 0
        })
        .collect()
}

fn part(bytes: &[u8], offset: u64, size: u64) -> &[u8] {
    let (begin, end) = (offset as usize, offset.saturating_add(size) as usize);
    bytes.get(begin..end).unwrap_or_default()
}
