//! The memory of the process: code, clock, input, answer.

use crate::Attack;
use crate::Expected::{Bounded, Denied, Harmless, Left, Says, Signal, TimedOut, Violation, WorkSeen};
use crate::Form::{Contacts, Query, QueryAndConstructor, ThirdObject};

/// A word of the reference answers, as the test puts it into the host's memory.
pub const CANARY: u64 = 0x7a31_9c55_e2d8_06b4;

pub const ALL: &[Attack] = &[
    attack!("M1", "writable and executable memory", "writable_code", QueryAndConstructor, Denied("mmap")),
    attack!("M1", "make data executable", "data_to_code", Query, Denied("mprotect")),
    attack!("M1", "code from a memory file", "code_from_memory_file", Query, Denied("memfd_create")),
    attack!("M1", "map more code after it was loaded", "more_code"["KEEPS_ITS_FILE"], Query, Says("EPERM")),
    attack!("M1", "map more code after it was loaded", "more_code"["KEEPS_ITS_FILE"], ThirdObject, Says("EPERM")),
    attack!("M1", "map more of a file after it was loaded", "more_of_a_file"["KEEPS_ITS_FILE"], Query, Says("EPERM")),
    attack!("M2", "put a page over libc's code", "overlay_libc", Query, Says("EPERM")),
    attack!("M2", "make libc's code writable", "code_to_data", Query, Says("EPERM")),
    attack!("M2", "put a page over the vDSO", "overlay_clock", Query, Says("EPERM")),
    attack!("M3", "put a page over the clock's data", "overlay_clock_data", Query, Says("EPERM")),
    attack!("M4, T1", "put a clock of its own into every pointer", "patch_clocks"["WORK=3000000"], Query, WorkSeen),
    attack!("T4", "look for the next question while it answers this one", "look_ahead", Query, Harmless),
    attack!("T16", "answer at once", "nothing_more", Query, Bounded),
    attack!("I1", "store into the input", "store_into_input", Query, Signal(libc::SIGSEGV)),
    attack!("I1", "make the input writable", "unprotect_input", Query, Says("EACCES")),
    attack!("I2", "put a page over its own view of the input", "overlay_input", Query, Says("own view replaced")),
    attack!("I3", "jump ahead in the answers' numbers", "forge_number", Contacts, Violation),
    attack!("I3", "0xff over the answer's head, then loop", "forge_header", Contacts, Violation),
    attack!("I3, I8", "announce an answer that is not there, then sleep", "forge_next_answer", Contacts, TimedOut),
    attack!("I3", "say that it is no plugin when it is asked", "forge_not_loaded", Contacts, Violation),
    attack!("I3", "die with a lock in the answer's number", "die_with_a_lock", Contacts, Signal(libc::SIGSEGV)),
    attack!("I3", "announce the answer and leave", "forge_and_leave", Contacts, Left(0)),
    attack!("I9", "leave the floating-point state changed", "spoil_floating_point", Query, Harmless),
    attack!("I8", "announce an answer twice", "announce_twice", Contacts, Violation),
    attack!("I10", "search the environment", "search_reference", Query, Says("0 unknown words")),
    attack!(
        "I10",
        "search its memory for the host's answers",
        "search_memory"["CANARY=0x7a319c55e2d806b4ul"],
        Query,
        Says("0 of the host's, the question itself")
    ),
];
