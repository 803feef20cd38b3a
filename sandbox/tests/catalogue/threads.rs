//! The multi-threaded track.

use crate::Attack;
use crate::Expected::{Denied, Harmless, Says, TimedOut};
use crate::Form::{Threads, ThreadsContacts};

pub const ALL: &[Attack] = &[
    attack!("P2", "fork bomb", "fork_bomb", Threads, Denied("clone")),
    attack!("P2", "clone into a user namespace", "new_user_namespace", Threads, Denied("clone")),
    attack!("P3", "a hundred threads", "many_threads", Threads, Says("16 threads, then EAGAIN")),
    attack!("P10", "leave a thread behind and answer", "leave_thread", Threads, Harmless),
    attack!("P10", "end the thread that answers, leave another", "end_first_thread", Threads, TimedOut),
    attack!("K8", "eight threads race for a socket", "race_of_eight", Threads, Denied("socket")),
    attack!("K10", "choose another CPU", "choose_cpu", Threads, Says("EPERM")),
    attack!(
        "I5",
        "change the answer after its commit, by a thread",
        "change_answer_later"["CHANGED"],
        ThreadsContacts,
        Harmless
    ),
];
