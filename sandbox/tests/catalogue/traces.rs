//! What a plugin could leave for its next trial, or say to another one.

use crate::Attack;
use crate::Expected::{Denied, Refused, Says};
use crate::Form::{Loading, Query, Twice};

pub const ALL: &[Attack] = &[
    attack!(
        "T14",
        "a table of answers",
        "nothing_more"["TABLE=(65<<20)"],
        Loading,
        Refused("at most 67108864 are allowed")
    ),
    attack!("T15", "leave a file", "create_file", Twice, Denied("openat")),
    attack!("T15", "leave shared memory", "leave_shared_memory", Twice, Denied("openat")),
    attack!("T15", "leave a key", "raw_call"["RAW=248"], Twice, Denied("add_key")),
    attack!("T15, T17", "lock its own file", "lock_own_file", Twice, Denied("flock")),
    attack!("T15, T17", "lock a part of its own file", "lock_own_record", Twice, Says("EPERM")),
    attack!("T15", "listen on an abstract socket", "abstract_socket", Twice, Denied("socket")),
    attack!("T15", "leave marks in its file, its memory, its name", "leave_marks", Twice, Says("0 marks")),
    attack!("T17", "talk through a socket of virtual machines", "virtual_socket", Query, Denied("socket")),
    attack!("T17", "talk through shared memory of System V", "raw_call"["RAW=29"], Query, Denied("shmget")),
];
