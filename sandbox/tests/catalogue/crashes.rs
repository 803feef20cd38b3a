//! Crashes and early ends.

use crate::Attack;
use crate::Expected::{Denied, Harmless, Left, Signal};
use crate::Form::{self, Query, QueryAndConstructor};

macro_rules! attack {
    ($id:literal, $title:literal, $name:literal, $form:expr, $expected:expr) => {
        Attack {
            id: $id,
            title: $title,
            defines: &[concat!("ATTACK=", $name)],
            form: $form as Form,
            expected: $expected,
        }
    };
}

pub const ALL: &[Attack] = &[
    attack!("C1", "store to address 8", "store_to_null", QueryAndConstructor, Signal(libc::SIGSEGV)),
    attack!("C1", "divide by zero", "divide_by_zero", Query, Signal(libc::SIGFPE)),
    attack!("C1", "undefined instruction", "undefined_instruction", Query, Signal(libc::SIGILL)),
    attack!("C1", "abort", "abort_self", QueryAndConstructor, Signal(libc::SIGABRT)),
    attack!("C1", "raise SIGABRT", "raise_abort", Query, Signal(libc::SIGABRT)),
    attack!("C2", "C++ exception that nobody catches", "throw_out", QueryAndConstructor, Signal(libc::SIGABRT)),
    attack!("C2", "C++ exception caught inside, told by iostream", "catch_inside", Query, Harmless),
    attack!("C3", "longjmp into a frame that is gone", "jump_back", Query, Signal(libc::SIGSEGV)),
    attack!("C3", "smash the stack of the runner", "smash_stack", Query, Signal(libc::SIGSEGV)),
    attack!("C4", "_exit(0)", "leave", QueryAndConstructor, Left(0)),
    attack!("C4", "exit(3)", "leave_politely", Query, Left(3)),
    Attack {
        id: "C6",
        title: "system call in the chooser of an indirect function (IFUNC)",
        defines: &["ATTACK=call_chosen", "RESOLVER"],
        form: Form::Loading,
        expected: Denied("socket"),
    },
    Attack {
        id: "C6",
        title: "1.5 GiB of thread-local storage",
        defines: &["ATTACK=touch_thread_storage", "THREAD_STORAGE=(3ul<<29)"],
        form: Query,
        expected: Left(127),
    },
    Attack {
        id: "C7",
        title: "exports malloc, memcpy and clock_gettime",
        defines: &["ATTACK=nothing_more", "INTERPOSE"],
        form: Query,
        expected: Harmless,
    },
];
