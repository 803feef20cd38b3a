//! Attacks on the time. What shows only over many questions is asked in whole passes.

use ocb_sandbox::integrity::Check;

use crate::Attack;
use crate::Expected::{Caught, Harmless, SaysAlike, WorkSeen, Wrong, WrongOrViolation};
use crate::Form::{Loading, Pass, Query, Twice};

/// Work that takes some 50 microseconds.
const WORK: &str = "WORK=100000";

pub const ALL: &[Attack] = &[
    attack!("T2", "nothing, for comparison: uneven work, honestly done", "nothing_more"[WORK, "UNEVEN"], Pass, Harmless),
    attack!(
        "T2",
        "remember questions that come exactly again",
        "nothing_more"[WORK, "MEMOISES", "AS_THEY_ARE"],
        Pass,
        Harmless
    ),
    attack!(
        "T3",
        "remember questions up to a common motion",
        "nothing_more"[WORK, "MEMOISES"],
        Pass,
        Caught(&[Check::Batches])
    ),
    attack!("T6", "commit early and work on while nothing is asked", "work_on", Pass, WrongOrViolation),
    attack!("T7", "do the work only where one question is asked", "nothing_more"[WORK, "SKIPS_IN_BATCHES"], Pass, Wrong),
    attack!(
        "T8",
        "flatten the times in some of the processes",
        "nothing_more"[WORK, "UNEVEN", "FLATTENS"],
        Pass,
        Harmless
    ),
    attack!(
        "T9",
        "waste time while it is loaded, so that more is subtracted",
        "waste_time"["WORK=10000000"],
        Loading,
        WorkSeen
    ),
    attack!("T10", "fill the caches for whoever comes next", "pollute_caches", Twice, Harmless),
    attack!("T11", "slow the processor's clock down with wide vectors", "heavy_vectors", Query, Harmless),
    attack!(
        "T12",
        "tell one trial from another by process, limits, and inodes and times of files",
        "fingerprint",
        Twice,
        SaysAlike("process ")
    ),
];
