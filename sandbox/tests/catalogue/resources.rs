//! Memory, time, output.

use crate::Attack;
use crate::Expected::{Denied, OutOfMemory, OutputLimit, Says, Signal, TimedOut};
use crate::Form::{Query, QueryAndConstructor, ThirdObject};

pub const ALL: &[Attack] = &[
    attack!("R1", "allocate and touch for ever", "touch_forever", Query, OutOfMemory),
    attack!("R1", "allocate and touch for ever", "touch_forever", ThirdObject, OutOfMemory),
    attack!("R1", "the same with shared memory", "share_forever", Query, OutOfMemory),
    attack!("R2", "reserve 1 TiB", "reserve_terabyte", Query, Says("ENOMEM")),
    attack!("R3", "200,000 mappings", "many_mappings", Query, Says("ENOMEM, at the kernel's limit")),
    attack!("R4", "lock all memory", "lock_all", Query, Denied("mlockall")),
    attack!("R5", "endless loop", "loop", QueryAndConstructor, TimedOut),
    attack!("R5", "endless loop", "loop", ThirdObject, TimedOut),
    attack!("R6", "sleep for ever", "sleep_forever", Query, TimedOut),
    attack!("R6", "deadlock", "deadlock", Query, TimedOut),
    attack!("R7", "endless loop with SIGXCPU ignored", "ignore_cpu_limit", Query, TimedOut),
    attack!("R8", "flood of standard error", "flood", Query, OutputLimit),
    attack!("R8", "flood of standard output", "flood_output", Query, OutputLimit),
    attack!("R9", "endless recursion", "recurse_forever", Query, Signal(libc::SIGSEGV)),
    attack!("R10", "200,000 times sched_yield", "yield_often", Query, Says("yielded")),
    attack!("R11", "constructor that sleeps", "sleep_forever", QueryAndConstructor, TimedOut),
];
