//! Mutated input for what reads strangers' bytes: the gate and the supervisor's parser.
//!
//! A slice runs in every test; `OCB_FUZZ=1000000` (as `make soak` does) says how many files the gate reads, ten times as
//! many messages the parser, and a thousandth of it are trials whose plugin writes over the answer's memory.

mod common;

use std::os::fd::AsRawFd;
use std::time::{Duration, Instant};

use common::{apart, fixture, launcher_with, policy, start};
use ocb_core::query::Query;
use ocb_sandbox::control::{Control, Report};
use ocb_sandbox::protocol::{
    SLOT_WORDS, answer, contacts_to_copy, parse_answer, parse_counters, parse_descriptors, parse_inspection,
    parse_status, parse_text_len, slot,
};
use ocb_sandbox::{Outcome, Policy, gate};

/// How many inputs: so many times `OCB_FUZZ`, or the slice.
fn inputs(slice: u64, share: f64) -> u64 {
    let asked = std::env::var("OCB_FUZZ").ok().and_then(|n| n.parse::<f64>().ok());
    asked.map_or(slice, |n| (n * share).ceil() as u64)
}

/// A small generator: the inputs differ, the test does not.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }

    /// A number on which parsers stumble.
    fn nasty(&mut self, length: u64) -> u64 {
        let around = |base: u64, n: u64| base.wrapping_add(n % 5).wrapping_sub(2);
        let n = self.next();
        match n % 9 {
            0 => 0,
            1 => u64::MAX,
            2 => around(length, n >> 8),
            3 => around(1 << 31, n >> 8),
            4 => around(1 << 32, n >> 8),
            5 => around(1 << 63, n >> 8),
            6 => (n >> 8) % (length + 1),
            7 => 1 << ((n >> 8) % 64),
            _ => n,
        }
    }
}

/// Where the structures of an ELF file lie: these are worth changing, the rest is code.
fn structures(file: &[u8]) -> Vec<std::ops::Range<usize>> {
    let word = |at: usize| u64::from_le_bytes(file[at..at + 8].try_into().unwrap()) as usize;
    let half = |at: usize| usize::from(u16::from_le_bytes([file[at], file[at + 1]]));
    let (segments, sections) = (word(0x20), word(0x28));
    let mut places = vec![0..64, segments..segments + 56 * half(0x38), sections..sections + 64 * half(0x3c)];
    for i in 0..half(0x3c) {
        let header = sections + 64 * i;
        let kind = u32::from_le_bytes(file[header + 4..header + 8].try_into().unwrap());
        let (start, size) = (word(header + 24), word(header + 32));
        // Not code and data (1) and not the zeroed part (8), which has no bytes.
        if !matches!(kind, 0 | 1 | 8) && size > 0 {
            places.push(start..start + size);
        }
    }
    places
}

fn mutate(file: &[u8], places: &[std::ops::Range<usize>], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..=numbers.below(4) {
        let place = &places[numbers.below(places.len())];
        let width = [1, 2, 4, 8][numbers.below(4)];
        let at = (place.start + numbers.below(place.len())) & !(width - 1);
        let value = numbers.nasty(file.len() as u64).to_le_bytes();
        match numbers.below(12) {
            0 => bytes.truncate(numbers.below(bytes.len() + 1)),
            1 => {
                // One structure over another.
                let from = &places[numbers.below(places.len())];
                let n = from.len().min(64);
                if at + n <= bytes.len() && from.start + n <= bytes.len() {
                    bytes.copy_within(from.start..from.start + n, at);
                }
            }
            _ if at + width <= bytes.len() => bytes[at..at + width].copy_from_slice(&value[..width]),
            _ => {}
        }
    }
    bytes
}

#[test]
fn the_gate_reads_anything() {
    let files: Vec<Vec<u8>> = [&[][..], &["ATTACK=store_to_null", "IN_CONSTRUCTOR"]]
        .iter()
        .map(|defines| std::fs::read(fixture(defines)).unwrap())
        .collect();
    let places: Vec<_> = files.iter().map(|file| structures(file)).collect();
    let offered = ["libc.so.6", "libm.so.6"].map(|name| gate::Offered { name: name.into(), versions: Vec::new() });
    let mut numbers = Numbers(0x0dd0_5eed);
    let (mut passed, mut refused, mut longest) = (0u64, std::collections::BTreeMap::new(), Duration::ZERO);
    for i in 0..inputs(20_000, 1.0) {
        let which = numbers.below(files.len());
        let bytes = mutate(&files[which], &places[which], &mut numbers);
        let begun = Instant::now();
        let inspection = gate::inspect(&bytes, &offered);
        let took = begun.elapsed();
        longest = longest.max(took);
        assert!(took < Duration::from_secs(2), "input {i} took {took:?}");
        match inspection.rejections.first() {
            None => passed += 1,
            Some(rejection) => *refused.entry(rejection.rule.clone()).or_insert(0u64) += 1,
        }
    }
    println!("passed {passed}, refused {refused:?}, longest {longest:?}");
    assert!(refused.len() >= 8, "the mutations reach too few rules: {refused:?}");
}

const DESCRIPTORS: &[u8] = br#"[{"id":"a","name":"A","version":"1","authors":"","license":"","url":"","paper":"",
    "queries":[],"counters":false,"witness_points":false,"single_precision":false,"solid":false,"coherent":false,"threads":false,"scene":false,
    "parameters":[{"name":"k","description":"","minimum":0,"maximum":1,"default":0.5,"integer":false}]}]"#;
const FINDINGS: &[u8] = br#"{"rejections":[{"rule":"r","what":"w","why":"y","mend":"m"}],"facts":null}"#;

#[test]
fn the_parser_reads_anything() {
    let mut numbers = Numbers(0xfeed);
    let queries = [Query::CollisionFirst, Query::CollisionAll, Query::Proximity];
    let (mut answers, mut violations, mut texts) = (0u64, 0u64, 0u64);
    assert!(parse_inspection(FINDINGS).is_ok());
    for i in 0..inputs(300_000, 10.0) {
        // Mostly small words, so that every branch is reached, among them those that parsers stumble on.
        let words: [u64; SLOT_WORDS] = std::array::from_fn(|_| match numbers.below(4) {
            0 => numbers.nasty(answer::TESTS as u64),
            _ => numbers.next() % 5,
        });
        let announced = contacts_to_copy(&words);
        assert!(announced <= answer::CONTACT_CAPACITY && announced as u64 <= words[slot::TOTAL]);
        let contacts: Vec<u64> = (0..announced.min(4)).map(|_| numbers.next()).collect();
        match parse_answer(queries[numbers.below(3)], &words, &contacts) {
            Ok(_) => answers += 1,
            Err(_) => violations += 1,
        }
        let _ = (parse_status(&words), parse_counters(&words));
        assert!(parse_text_len(&words).map_or(true, |len| len <= answer::TEXT_BYTES));
        if i.is_multiple_of(16) {
            let mut text = if i.is_multiple_of(32) { DESCRIPTORS } else { FINDINGS }.to_vec();
            for _ in 0..=numbers.below(3) {
                let at = numbers.below(text.len());
                text[at] = numbers.next() as u8;
            }
            if numbers.below(4) == 0 {
                text.truncate(numbers.below(text.len()));
            }
            let plain = |text: &String| !text.chars().any(char::is_control);
            let described = parse_descriptors(&text).unwrap_or_default();
            assert!(described.iter().all(|d| plain(&d.id) && plain(&d.name) && plain(&d.url)));
            let found = parse_inspection(&text).unwrap_or_default();
            assert!(found.rejections.iter().all(|r| plain(&r.what) && plain(&r.mend)));
            texts += u64::from(!described.is_empty()) + u64::from(!found.rejections.is_empty());
        }
    }
    println!("{answers} answers, {violations} violations, {texts} readable texts");
    assert!(
        answers > 1000 && violations > 1000 && texts > 100,
        "{answers} answers, {violations} violations, {texts} texts"
    );
}

/// No plugin reaches the control socket (the runner closes it before it loads anything); what our own processes say on it
/// is read with the same care.
#[test]
fn the_control_socket_reads_anything() {
    let reports = [
        &br#""InitStarted""#[..],
        br#"{"RunnerStarted":{"own_ids":true}}"#,
        br#"{"RunnerEnded":{"status":139}}"#,
        br#"{"Fault":{"step":"Ids","reason":"no"}}"#,
    ];
    let (ours, theirs) = Control::pair().unwrap();
    let theirs = theirs.into_fd();
    let mut numbers = Numbers(0xc0de);
    let (mut read, mut refused) = (0u64, 0u64);
    for _ in 0..inputs(20_000, 1.0) {
        let mut bytes = reports[numbers.below(4)].to_vec();
        for _ in 0..numbers.below(3) {
            let at = numbers.below(bytes.len());
            bytes[at] = numbers.nasty(256) as u8;
        }
        bytes.truncate(1 + numbers.below(2 * bytes.len()));
        // SAFETY: a live buffer of this length.
        let sent = unsafe { libc::send(theirs.as_raw_fd(), bytes.as_ptr().cast(), bytes.len(), 0) };
        assert_eq!(sent, bytes.len() as isize);
        match ours.receive::<Report>() {
            Ok(Some(_)) => read += 1,
            Ok(None) => panic!("nobody has left"),
            Err(_) => refused += 1,
        }
    }
    drop(theirs);
    assert!(matches!(ours.receive::<Report>(), Ok(None)));
    assert!(read > 1000 && refused > 1000, "{read} read, {refused} refused");
}

/// A plugin that writes random words over the answer's head, slot and text, then leaves, crashes, loops or goes on.
#[test]
fn a_scribbling_plugin_gets_an_outcome() {
    scribbled("scribble", 1, inputs(25, 0.001));
}

/// The same by a thread, at any moment of the host's reading.
#[test]
fn a_scribbling_thread_gets_an_outcome() {
    scribbled("scribble_meanwhile", 2, inputs(10, 0.0005));
}

fn scribbled(attack: &str, threads: usize, trials: u64) {
    let plugin = fixture(&[&format!("ATTACK={attack}"), "IN_CONTACTS"]);
    let launcher = launcher_with(Policy { query_seconds: 0.3, threads, ..policy() });
    let mut numbers = Numbers(0x5c21);
    let mut outcomes = std::collections::BTreeMap::new();
    // A few trials may all come through; more of them show that some do not.
    let kinds = 4 - threads;
    for trial in 0..20 * trials {
        if trial >= trials && outcomes.len() >= kinds {
            break;
        }
        let mut session = start(&launcher, &plugin).expect("nothing has struck yet");
        let begun = Instant::now();
        for _ in 0..20 {
            let query = if numbers.below(2) == 0 { Query::CollisionAll } else { Query::CollisionFirst };
            if session.query(query, &apart(f64::from_bits(numbers.next() >> 12 | 0x3fe0_0000_0000_0000))).is_err() {
                break;
            }
        }
        let ending = session.finish();
        assert!(
            !matches!(ending.outcome, Outcome::SandboxFault { .. } | Outcome::LoadError { .. }),
            "trial {trial}: {ending}"
        );
        assert!(begun.elapsed() < Duration::from_secs(30), "trial {trial} took {:?}", begun.elapsed());
        *outcomes.entry(ending.outcome.name()).or_insert(0u64) += 1;
    }
    println!("{attack}: {outcomes:?}");
    assert!(outcomes.len() >= kinds, "{outcomes:?}");
}
