//! Crashes and early ends.

use crate::Attack;
use crate::Expected::{Denied, Harmless, Left, Signal};
use crate::Form::{Loading, Query, QueryAndConstructor, ThirdObject};

pub const ALL: &[Attack] = &[
    attack!("C1", "store to address 8", "store_to_null", QueryAndConstructor, Signal(libc::SIGSEGV)),
    attack!("C1", "store to address 8", "store_to_null", ThirdObject, Signal(libc::SIGSEGV)),
    attack!("C1", "divide by zero", "divide_by_zero", Query, Signal(libc::SIGFPE)),
    attack!("C1", "undefined instruction", "undefined_instruction", Query, Signal(libc::SIGILL)),
    attack!("C1", "abort", "abort_self", QueryAndConstructor, Signal(libc::SIGABRT)),
    attack!("C1", "raise SIGABRT", "raise_abort", Query, Signal(libc::SIGABRT)),
    attack!("C2", "C++ exception that nobody catches", "throw_out", QueryAndConstructor, Signal(libc::SIGABRT)),
    attack!("C2", "C++ exception caught inside, told by iostream", "catch_inside", Query, Harmless),
    attack!("C2", "Rust panic that nobody catches", "panic_out", QueryAndConstructor, Signal(libc::SIGABRT)),
    attack!("C3", "longjmp into a frame that is gone", "jump_back", Query, Signal(libc::SIGSEGV)),
    attack!("C3", "smash the stack of the runner", "smash_stack", Query, Signal(libc::SIGSEGV)),
    attack!("C4", "_exit(0)", "leave", QueryAndConstructor, Left(0)),
    attack!("C4", "_exit(0)", "leave", ThirdObject, Left(0)),
    attack!("C4", "exit(3)", "leave_politely", Query, Left(3)),
    attack!(
        "C6",
        "system call in the chooser of an indirect function (IFUNC)",
        "call_chosen"["RESOLVER"],
        Loading,
        Denied("socket")
    ),
    attack!(
        "C6",
        "1.5 GiB of thread-local storage",
        "touch_thread_storage"["THREAD_STORAGE=(3ul<<29)"],
        Query,
        Left(127)
    ),
    attack!("C6", "ten thousand relocations", "nothing_more"["RELOCATIONS=10000"], Query, Harmless),
    attack!("C7", "exports malloc, memcpy and clock_gettime", "nothing_more"["INTERPOSE"], Query, Harmless),
];
