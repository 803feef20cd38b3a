//! Files, processes, rights, and the kernel's surface.

use crate::Attack;
use crate::Expected::{Denied, Says, Signal};
use crate::Form::{Query, QueryAndConstructor};

/// A system call with zeros for arguments.
macro_rules! raw {
    ($id:literal, $name:literal, $number:literal) => {
        attack!($id, concat!("call ", $name), "raw_call"[concat!("RAW=", $number)], Query, Denied($name))
    };
}

pub const FILES: &[Attack] = &[
    attack!("F1", "open /etc/passwd", "open_passwd", QueryAndConstructor, Says("ENOENT")),
    attack!("F2", "open /proc/self/mem for writing", "open_own_memory", Query, Denied("openat")),
    attack!("F3", "open /proc/1/environ", "open_environment_of_init", Query, Says("ENOENT")),
    attack!("F4", "open ../../etc/shadow", "open_by_traversal", Query, Says("ENOENT")),
    attack!("F5", "create a file", "create_file", Query, Denied("openat")),
    attack!("F6", "open the root folder", "open_root", Query, Says("ENOENT")),
    attack!("F6", "list a folder", "list_folder", Query, Denied("getdents64")),
    attack!("F7", "stat /etc/passwd", "stat_passwd", Query, Says("ENOENT")),
    raw!("F8", "symlink", "88"),
    raw!("F8", "chmod", "90"),
    raw!("F8", "chroot", "161"),
    raw!("F8", "mount", "165"),
    raw!("F8", "setns", "308"),
    raw!("F8", "unshare", "272"),
    raw!("F8", "open_by_handle_at", "304"),
    raw!("F8", "openat2", "437"),
    attack!("F9", "read the name of its program", "read_own_name", Query, Says("ENOENT")),
    attack!("F10", "open its own file 10,000 times", "many_descriptors", Query, Says("ENOENT after 0")),
    attack!("F11", "find an inherited descriptor", "write_inherited", Query, Says("0 inherited")),
    attack!("F11", "write to standard input", "write_to_zero", Query, Says("EBADF")),
    raw!("F12", "mincore", "27"),
    raw!("F12", "splice", "275"),
    raw!("F12", "vmsplice", "278"),
    attack!("R12", "fill the disk", "fill_disk", Query, Denied("ftruncate")),
    attack!("R12", "ask how large a file may be", "raise_file_size", Query, Says("file size limit 0")),
];

pub const PROCESSES: &[Attack] = &[
    attack!("P1", "execve /bin/sh", "exec_shell", QueryAndConstructor, Denied("execve")),
    raw!("P1", "execveat", "322"),
    attack!("P2", "fork bomb", "fork_bomb", QueryAndConstructor, Denied("clone")),
    raw!("P2", "fork", "57"),
    raw!("P2", "vfork", "58"),
    attack!("P2", "clone into a user namespace", "new_user_namespace", Query, Denied("clone")),
    attack!("P2", "clone3", "new_process_3", Query, Says("ENOSYS")),
    attack!("P3, T5", "start a thread", "new_thread", QueryAndConstructor, Denied("clone")),
    attack!("P4", "kill init", "kill_init", Query, Denied("kill")),
    attack!("P4", "kill everybody", "kill_everybody", Query, Denied("kill")),
    attack!("P4", "kill init's thread", "kill_init_thread", Query, Denied("tgkill")),
    attack!("P4", "queue a signal for init", "queue_signal", Query, Denied("rt_sigqueueinfo")),
    attack!("P4", "stop itself", "stop_self", Query, Denied("tgkill")),
    raw!("P5", "ptrace", "101"),
    raw!("P5", "process_vm_writev", "311"),
    raw!("P5", "pidfd_open", "434"),
    raw!("P5", "kcmp", "312"),
    raw!("P6", "setresuid", "117"),
    raw!("P6", "personality", "135"),
    raw!("P6", "modify_ldt", "154"),
    raw!("P6", "arch_prctl", "158"),
    raw!("P6", "reboot", "169"),
    raw!("P6", "syslog", "103"),
    attack!("P7", "become dumpable", "undo_dumpable", Query, Denied("prctl")),
    attack!("P7", "outlive its parent", "outlive_parent", Query, Denied("prctl")),
    attack!("P7", "make the time stamp counter fault", "fault_on_clock", Query, Denied("prctl")),
    attack!("P8", "raise the limit of processor time", "raise_cpu_limit", Query, Denied("prlimit64")),
    attack!("P9", "ignore SIGSEGV", "ignore_crash", Query, Says("EPERM")),
    attack!("P9", "crash with SIGSEGV ignored", "crash_with_handler", Query, Signal(libc::SIGSEGV)),
];

pub const KERNEL: &[Attack] = &[
    attack!("N1", "call socket", "raw_call"["RAW=41"], QueryAndConstructor, Denied("socket")),
    raw!("N1", "socketpair", "53"),
    raw!("N1", "connect", "42"),
    raw!("N2", "io_uring_setup", "425"),
    raw!("N2", "io_setup", "206"),
    raw!("K1", "bpf", "321"),
    raw!("K1", "userfaultfd", "323"),
    raw!("K1", "perf_event_open", "298"),
    raw!("K1, T15", "add_key", "248"),
    raw!("K1, T15", "shmget", "29"),
    raw!("K1", "landlock_create_ruleset", "444"),
    raw!("K1", "pkey_alloc", "330"),
    attack!("K2", "int 0x80", "other_gate", Query, Signal(libc::SIGSYS)),
    attack!("K3", "a number of the x32 interface", "raw_call"["RAW=0x40000027"], Query, Denied("?")),
    attack!("K4", "a number that does not exist", "raw_call"["RAW=9999"], Query, Denied("?")),
    attack!("K5", "install a filter of its own", "own_filter", Query, Denied("seccomp")),
    attack!("K5", "install one more filter", "one_more_filter", Query, Says("EPERM")),
    attack!("K7", "descriptor with its upper half set", "high_bits", Query, Denied("write")),
    attack!("K7", "futex with priority inheritance", "priority_futex", Query, Denied("futex")),
    attack!("K8", "eight threads race", "race", Query, Denied("clone")),
    raw!("K9", "setitimer", "38"),
    raw!("K9", "timer_create", "222"),
    attack!("K9", "alarm", "alarm_clock", Query, Denied("alarm")),
    attack!("K10", "become a real-time process", "be_real_time", Query, Denied("sched_setscheduler")),
    attack!("K10", "choose another CPU", "choose_cpu", Query, Says("EPERM")),
];
