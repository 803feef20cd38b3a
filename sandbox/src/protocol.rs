//! What lies where in the shared memory, and the parsing of everything that a runner says.
//!
//! Two memory files carry the conversation: the **request** (written by the supervisor alone) and the **answer**
//! (writable by the runner). The supervisor writes a command with one question or a batch of them, then its number; the
//! runner writes as many answers, then the same number. The next command does not exist before the answers to this one
//! have been copied out. A third file, the **trial**, holds meshes and parameters, sealed.
//!
//! Parsing is pure: it takes words that were copied once and returns values or the broken rule.

use nalgebra::Point3;
use ocb_core::query::{Answer, Counters, Query};
use serde::{Deserialize, Serialize};

use crate::descriptor::Descriptor;
use crate::gate::Inspection;
use crate::text;

/// Byte offsets in the request file. Words that different sides poll lie on cache lines of their own; the number, which is
/// written last, shares its line with what the runner reads first.
pub mod request {
    /// u32: number of the newest command.
    pub const NUMBER: usize = 0;
    /// u64: the command, a [`super::Command`].
    pub const COMMAND: usize = 8;
    /// u64: how many questions it asks, 1 to [`super::MAX_BATCH`].
    pub const QUESTIONS: usize = 16;
    /// u64 per question: the number of the object that stands first in the low half, of the one that stands second in the high
    /// half. The first question's shares the line of the number.
    pub const OBJECTS: usize = 24;
    /// u32: the supervisor sleeps on the answer's number.
    pub const SUPERVISOR_SLEEPS: usize = 576;
    /// 4 u64, of the object that is to be built: vertices, triangles, and where both begin in the trial file.
    pub const MESH: usize = 704;
    /// 16 + 16 u64 per question: bits of the row-major poses of the first and of the second object.
    pub const POSES: usize = 768;
    /// From one question's poses to the next one's.
    pub const POSES_STRIDE: usize = 256;
    /// Size of the file.
    pub const BYTES: usize = (POSES + POSES_STRIDE * super::MAX_BATCH).next_multiple_of(4096);
}

/// Byte offsets in the answer file.
pub mod answer {
    /// u32: number of the newest answered command.
    pub const NUMBER: usize = 0;
    /// u32: the runner sleeps on the request's number.
    pub const RUNNER_SLEEPS: usize = 128;
    /// u32: 1 + the descriptor of the seccomp listener, once the filter is in force.
    pub const LISTENER: usize = 256;
    /// u32 each, written before the plugin is loaded: ABI of Landlock in force, number of sealed mappings, whether memory
    /// can no longer become executable. 0 is "not in force".
    pub const HARDENING: usize = 260;
    /// The slots, one per question: [`super::SLOT_WORDS`] u64 each.
    pub const SLOT: usize = 512;
    /// From one slot to the next.
    pub const SLOT_STRIDE: usize = 8 * super::SLOT_WORDS;
    /// Text: descriptors or a reason.
    pub const TEXT: usize = SLOT + SLOT_STRIDE * super::MAX_BATCH;
    /// At most so much text.
    pub const TEXT_BYTES: usize = 256 << 10;
    /// Contacts: u64 each, triangle of A in the low half, of B in the high half.
    pub const CONTACTS: usize = TEXT + TEXT_BYTES;
    /// At most so many.
    pub const CONTACT_CAPACITY: usize = 1 << 16;
    /// u32 for each triangle of A, then for each of B from [`tests_b`] on: in how many primitive tests of all counted queries
    /// it took part.
    pub const TESTS: usize = CONTACTS + 8 * CONTACT_CAPACITY;

    /// Where B's counts begin.
    pub fn tests_b(triangles: [u32; 2]) -> usize {
        TESTS + (4 * triangles[0] as usize).next_multiple_of(8)
    }

    /// Size of the file for objects of so many triangles.
    pub fn bytes(triangles: [u32; 2]) -> usize {
        tests_b(triangles) + (4 * triangles[1] as usize).next_multiple_of(8)
    }
}

/// Byte offsets for a program that does one piece of work (`inside/task.rs`), in what is free of the same two files.
pub mod work {
    /// u32 of the request: times may be taken.
    pub const GRANTED: usize = 640;
    /// u64 of the answer: see [`progress`].
    pub const PROGRESS: usize = 320;
    /// u32 of the answer: it waits until times may be taken.
    pub const ASKS: usize = 328;
    /// u64 of the answer: 1 + the number of bytes of the result, once that is there.
    pub const DONE: usize = 336;
    /// Where the result begins in the answer.
    pub const RESULT: usize = super::answer::TEXT;
    /// Largest part of a step.
    const MOST: u64 = (1 << 28) - 1;

    /// One word, so that no half of it is ever read: the step, what is done of it, and of how much.
    pub fn progress(step: u8, done: u64, total: u64) -> u64 {
        u64::from(step) << 56 | done.min(MOST) << 28 | total.min(MOST)
    }

    /// The parts of such a word, whatever it is.
    pub fn progress_of(word: u64) -> (u8, u32, u32) {
        ((word >> 56) as u8, (word >> 28 & MOST) as u32, (word & MOST) as u32)
    }
}

/// What the supervisor asks the runner to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u64)]
pub enum Command {
    /// The null plugin's answer, which is none: measures the round trip.
    Null = 0,
    /// Sleep until the next command, without watching for it.
    Rest = 7,
    /// Give up the listener's descriptor, which the supervisor has by now.
    CloseListener = 1,
    /// Load the plugin file, unless the gate refuses it, and describe it in the text.
    Open = 2,
    /// Read the plugin file as ELF, without loading it, and say in the text what the gate finds.
    Inspect = 6,
    /// Put the tighter system call filter in force.
    Tighten = 11,
    /// Choose the trial's algorithm, make an instance, set the parameters.
    Prepare = 3,
    /// Build the next object, whose mesh is shown.
    Build = 4,
    /// Queries.
    CollisionFirst = 8,
    /// All contacts.
    CollisionAll = 9,
    /// Distance.
    Proximity = 10,
    /// The same with counters where there are any.
    CountCollisionFirst = 16,
    /// All contacts, counted.
    CountCollisionAll = 17,
    /// Distance, counted.
    CountProximity = 18,
}

impl Command {
    /// All of them.
    pub const ALL: [Command; 14] = [
        Command::Null,
        Command::Rest,
        Command::CloseListener,
        Command::Inspect,
        Command::Open,
        Command::Tighten,
        Command::Prepare,
        Command::Build,
        Command::CollisionFirst,
        Command::CollisionAll,
        Command::Proximity,
        Command::CountCollisionFirst,
        Command::CountCollisionAll,
        Command::CountProximity,
    ];

    /// From its number.
    pub fn from_word(word: u64) -> Option<Self> {
        Self::ALL.into_iter().find(|command| *command as u64 == word)
    }

    /// The command that asks a query.
    pub fn ask(query: Query, counted: bool) -> Self {
        match (query, counted) {
            (Query::CollisionFirst, false) => Command::CollisionFirst,
            (Query::CollisionAll, false) => Command::CollisionAll,
            (Query::Proximity, false) => Command::Proximity,
            (Query::CollisionFirst, true) => Command::CountCollisionFirst,
            (Query::CollisionAll, true) => Command::CountCollisionAll,
            (Query::Proximity, true) => Command::CountProximity,
        }
    }
}

/// Most questions that one command asks.
pub const MAX_BATCH: usize = 64;

/// Number of 64-bit words in an answer's slot.
pub const SLOT_WORDS: usize = 24;

/// Meaning of the slot's words.
pub mod slot {
    /// An `ocb_status`, or [`NOT_LOADED`].
    pub const STATUS: usize = 0;
    /// Length of the text, bytes.
    pub const TEXT_LEN: usize = 1;
    /// Collision: hit. Distance: flags of `ocb_distance_result`.
    pub const HIT_OR_FLAGS: usize = 2;
    /// Triangle of A, then of B.
    pub const TRIANGLES: usize = 3;
    /// Contacts found.
    pub const TOTAL: usize = 5;
    /// Bits of the distance.
    pub const DISTANCE: usize = 6;
    /// Bits of point A, then of point B.
    pub const POINTS: usize = 7;
    /// Flags of `ocb_counts`, BV tests, primitive tests.
    pub const COUNTS: usize = 13;
    /// Status: the file is no plugin that can be used; the text says why.
    pub const NOT_LOADED: u64 = 100;
}

/// How a command went, as far as the status goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// Done.
    Ok,
    /// `OCB_GAVE_UP`.
    GaveUp,
    /// `OCB_UNSUPPORTED`.
    Unsupported,
    /// `OCB_ERROR`.
    Error,
    /// The file is no usable plugin.
    NotLoaded,
}

/// Reads the status word.
pub fn parse_status(words: &[u64; SLOT_WORDS]) -> Result<Status, String> {
    Ok(match words[slot::STATUS] {
        0 => Status::Ok,
        1 => Status::GaveUp,
        2 => Status::Unsupported,
        3 => Status::Error,
        slot::NOT_LOADED => Status::NotLoaded,
        other => return Err(format!("{} is not a status", other as u32 as i32)),
    })
}

/// How many bytes of text the slot announces.
pub fn parse_text_len(words: &[u64; SLOT_WORDS]) -> Result<usize, String> {
    match usize::try_from(words[slot::TEXT_LEN]) {
        Ok(len) if len <= answer::TEXT_BYTES => Ok(len),
        _ => Err(format!("a text of {} bytes, but at most {} fit", words[slot::TEXT_LEN], answer::TEXT_BYTES)),
    }
}

/// How many contacts are to be copied out.
pub fn contacts_to_copy(words: &[u64; SLOT_WORDS]) -> usize {
    usize::try_from(words[slot::TOTAL]).map_or(answer::CONTACT_CAPACITY, |n| n.min(answer::CONTACT_CAPACITY))
}

/// Reads an answer from a copy of the slot and of the contacts. Numbers inside (distances, triangle ids) are passed on
/// as they are: judging them is the validation's work.
pub fn parse_answer(query: Query, words: &[u64; SLOT_WORDS], contacts: &[u64]) -> Result<Answer, String> {
    match parse_status(words)? {
        Status::Ok => {}
        Status::GaveUp => return Ok(Answer::GaveUp),
        Status::Unsupported => return Ok(Answer::Unsupported),
        Status::Error | Status::NotLoaded => return Err("an error where an answer was expected".into()),
    }
    let triangle = |i: usize| u32::try_from(words[slot::TRIANGLES + i]).map_err(|_| "a triangle id of 33 bits");
    match query {
        Query::CollisionFirst => {
            let hit = match words[slot::HIT_OR_FLAGS] {
                0 => false,
                1 => true,
                other => return Err(format!("hit must be 0 or 1 and is {other}")),
            };
            let pair = [triangle(0)?, triangle(1)?];
            // A half-named pair stays: it is checked like any other and fails.
            Ok(Answer::Collision { hit, pair: (hit && pair != [u32::MAX; 2]).then_some(pair) })
        }
        Query::CollisionAll => Ok(Answer::Contacts {
            total: words[slot::TOTAL],
            pairs: contacts.iter().map(|w| [*w as u32, (*w >> 32) as u32]).collect(),
        }),
        Query::Proximity => {
            let flags = words[slot::HIT_OR_FLAGS];
            let point = |i: usize| {
                let at = slot::POINTS + 3 * i;
                Point3::new(f64::from_bits(words[at]), f64::from_bits(words[at + 1]), f64::from_bits(words[at + 2]))
            };
            Ok(Answer::Distance {
                distance: f64::from_bits(words[slot::DISTANCE]),
                points: (flags & 1 != 0).then(|| [point(0), point(1)]),
                triangles: if flags & 2 != 0 { Some([triangle(0)?, triangle(1)?]) } else { None },
            })
        }
    }
}

/// Reads the counters beside an answer; `None` when the algorithm has not counted.
pub fn parse_counters(words: &[u64; SLOT_WORDS]) -> Option<Counters> {
    let [flags, bv_tests, primitive_tests] = [0, 1, 2].map(|i| words[slot::COUNTS + i]);
    (flags & 3 != 0).then_some(Counters {
        bv_tests: (flags & 1 != 0).then_some(bv_tests),
        primitive_tests: (flags & 2 != 0).then_some(primitive_tests),
    })
}

/// Whether the tests per triangle beside an answer are to be read.
pub fn counts_per_triangle(words: &[u64; SLOT_WORDS]) -> bool {
    words[slot::COUNTS] & 4 != 0
}

/// Reads what the gate has found. The reader of foreign bytes is our own code, and yet it is only believed as far as this.
pub fn parse_inspection(text: &[u8]) -> Result<Inspection, String> {
    let inspection: Inspection =
        serde_json::from_slice(text).map_err(|e| format!("the gate's findings are not readable ({e})"))?;
    let builds = inspection.facts.iter().map(|f| &f.build);
    let lists = inspection.facts.iter().flat_map(|f| [&f.libraries, &f.newest_versions, &f.notable_imports]);
    let lists = lists.chain(builds.flat_map(|b| [&b.compilers, &b.flags, &b.instruction_sets]));
    let texts = lists.flatten().chain(inspection.rejections.iter().flat_map(|r| [&r.rule, &r.what, &r.why, &r.mend]));
    let strange = texts.into_iter().any(|said| said.len() > 8192 || !said.chars().all(text::is_plain));
    if strange { Err("the gate's findings hold text that it never writes".into()) } else { Ok(inspection) }
}

/// Reads what a plugin says of itself.
pub fn parse_descriptors(text: &[u8]) -> Result<Vec<Descriptor>, String> {
    let descriptors: Vec<Descriptor> =
        serde_json::from_slice(text).map_err(|e| format!("the descriptors are not readable ({e})"))?;
    if descriptors.is_empty() || descriptors.len() > 64 {
        return Err(format!("{} algorithms; 1 to 64 are allowed", descriptors.len()));
    }
    for (i, one) in descriptors.iter().enumerate() {
        if descriptors[..i].iter().any(|other| other.id == one.id) {
            return Err(format!("two of its algorithms have the id '{}'", text::one_line(&one.id, 64)));
        }
    }
    descriptors.into_iter().map(Descriptor::bounded).collect()
}

/// What an algorithm answers with its parameters set.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Answers {
    /// The kinds of query.
    pub queries: Vec<Query>,
    /// It loads scenes of many objects.
    pub scene: bool,
}

/// Reads them.
pub fn parse_answers(text: &[u8]) -> Result<Answers, String> {
    let answers: Answers = serde_json::from_slice(text).map_err(|e| format!("its queries are not readable ({e})"))?;
    let n = answers.queries.len();
    if n > 3 { Err(format!("{n} kinds of query; there are 3")) } else { Ok(answers) }
}

/// Text for people from bytes of the plugin, in lines.
pub fn clean_text(bytes: &[u8]) -> String {
    text::lines(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slot_of(status: u64) -> [u64; SLOT_WORDS] {
        let mut words = [0; SLOT_WORDS];
        words[slot::STATUS] = status;
        words
    }

    /// A small generator: the inputs differ, the test does not.
    fn numbers(mut state: u64) -> impl FnMut() -> u64 {
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            // Mostly small words, so that every branch is reached.
            if state & 3 == 0 { state } else { state % 4 }
        }
    }

    #[test]
    fn any_words_are_an_answer_or_a_violation() {
        let mut next = numbers(0x9e37_79b9_7f4a_7c15);
        let (mut answers, mut violations) = (0, 0);
        for _ in 0..300_000 {
            let words: [u64; SLOT_WORDS] = std::array::from_fn(|_| next());
            let contacts: Vec<u64> = (0..contacts_to_copy(&words).min(4)).map(|_| next()).collect();
            for query in [Query::CollisionFirst, Query::CollisionAll, Query::Proximity] {
                match parse_answer(query, &words, &contacts) {
                    Ok(_) => answers += 1,
                    Err(_) => violations += 1,
                }
            }
            let _ = (parse_counters(&words), parse_text_len(&words));
            assert!(contacts_to_copy(&words) <= answer::CONTACT_CAPACITY);
        }
        assert!(answers > 1000 && violations > 1000, "{answers} answers, {violations} violations");
    }

    #[test]
    fn any_bytes_are_descriptors_or_a_reason() {
        let good = br#"[{"id":"a","name":"A","version":"1","authors":"","license":"","url":"","paper":"","queries":[],
            "counters":false,"witness_points":false,"single_precision":false,"solid":false,"coherent":false,"threads":false,"scene":false,"parameters":[]}]"#;
        assert_eq!(parse_descriptors(good).unwrap()[0].id, "a");
        let mut next = numbers(1);
        for _ in 0..20_000 {
            let mut bytes = good.to_vec();
            for _ in 0..=next() % 4 {
                let at = next() as usize % bytes.len();
                bytes[at] = next() as u8;
            }
            let _ = parse_descriptors(&bytes);
        }
        assert!(parse_descriptors(b"[]").is_err());
        assert!(parse_descriptors(&[b'['; 100_000]).is_err());
    }

    #[test]
    fn the_rules_of_an_answer() {
        let mut words = slot_of(0);
        words[slot::HIT_OR_FLAGS] = 1;
        words[slot::TRIANGLES..slot::TRIANGLES + 2].copy_from_slice(&[7, u64::from(u32::MAX)]);
        let answer = parse_answer(Query::CollisionFirst, &words, &[]).unwrap();
        assert_eq!(answer, Answer::Collision { hit: true, pair: Some([7, u32::MAX]) });
        words[slot::TRIANGLES] = 1 << 32;
        assert!(parse_answer(Query::CollisionFirst, &words, &[]).is_err());
        words[slot::HIT_OR_FLAGS] = 2;
        assert!(parse_answer(Query::CollisionFirst, &words, &[]).is_err());
        for status in [3, 4, slot::NOT_LOADED, u64::MAX] {
            assert!(parse_answer(Query::Proximity, &slot_of(status), &[]).is_err(), "{status}");
        }
        assert_eq!(parse_answer(Query::Proximity, &slot_of(1), &[]), Ok(Answer::GaveUp));
        assert_eq!(parse_answer(Query::Proximity, &slot_of(2), &[]), Ok(Answer::Unsupported));
    }

    #[test]
    fn commands_survive_the_crossing() {
        for command in Command::ALL {
            assert_eq!(Command::from_word(command as u64), Some(command));
        }
        assert_eq!(Command::from_word(99), None);
    }
}
