//! Files, processes, rights, and the kernel's surface.

use crate::Expected::{Denied, Says, Signal};
use crate::Form::{Query, QueryAndConstructor};
use crate::{Attack, Expected, Form};

const fn attack(
    id: &'static str,
    title: &'static str,
    defines: &'static [&'static str],
    form: Form,
    expected: Expected,
) -> Attack {
    Attack { id, title, defines, form, expected }
}

/// A system call with zeros for arguments.
macro_rules! raw {
    ($id:literal, $name:literal, $number:literal) => {
        attack($id, concat!("call ", $name), &["ATTACK=raw_call", concat!("RAW=", $number)], Query, Denied($name))
    };
}

pub const FILES: &[Attack] = &[
    attack("F1", "open /etc/passwd", &["ATTACK=open_passwd"], QueryAndConstructor, Says("ENOENT")),
    attack("F2", "open /proc/self/mem for writing", &["ATTACK=open_own_memory"], Query, Denied("openat")),
    attack("F3", "open /proc/1/environ", &["ATTACK=open_environment_of_init"], Query, Says("ENOENT")),
    attack("F4", "open ../../etc/shadow", &["ATTACK=open_by_traversal"], Query, Says("ENOENT")),
    attack("F5", "create a file", &["ATTACK=create_file"], Query, Denied("openat")),
    attack("F6", "open the root folder", &["ATTACK=open_root"], Query, Says("EACCES")),
    attack("F6", "list a folder", &["ATTACK=list_folder"], Query, Denied("getdents64")),
    attack("F7", "stat /etc/passwd", &["ATTACK=stat_passwd"], Query, Says("ENOENT")),
    raw!("F8", "symlink", "88"),
    raw!("F8", "chmod", "90"),
    raw!("F8", "chroot", "161"),
    raw!("F8", "mount", "165"),
    raw!("F8", "setns", "308"),
    raw!("F8", "unshare", "272"),
    raw!("F8", "open_by_handle_at", "304"),
    raw!("F8", "openat2", "437"),
    attack("F9", "read the name of its program", &["ATTACK=read_own_name"], Query, Says("ENOENT")),
    attack("F10", "open its own file 10,000 times", &["ATTACK=many_descriptors"], Query, Says("EMFILE after 29")),
    attack("F11", "find an inherited descriptor", &["ATTACK=write_inherited"], Query, Says("0 inherited")),
    attack("F11", "write to standard input", &["ATTACK=write_to_zero"], Query, Says("EBADF")),
    raw!("F12", "mincore", "27"),
    raw!("F12", "splice", "275"),
    raw!("F12", "vmsplice", "278"),
    attack("R12", "fill the disk", &["ATTACK=fill_disk"], Query, Denied("ftruncate")),
    attack("R12", "ask how large a file may be", &["ATTACK=raise_file_size"], Query, Says("file size limit 0")),
];

pub const PROCESSES: &[Attack] = &[
    attack("P1", "execve /bin/sh", &["ATTACK=exec_shell"], QueryAndConstructor, Denied("execve")),
    raw!("P1", "execveat", "322"),
    attack("P2", "fork bomb", &["ATTACK=fork_bomb"], QueryAndConstructor, Denied("clone")),
    raw!("P2", "fork", "57"),
    raw!("P2", "vfork", "58"),
    attack("P2", "clone into a user namespace", &["ATTACK=new_user_namespace"], Query, Denied("clone")),
    attack("P2", "clone3", &["ATTACK=new_process_3"], Query, Says("ENOSYS")),
    attack("P3, T5", "start a thread", &["ATTACK=new_thread"], QueryAndConstructor, Denied("clone")),
    attack("P4", "kill init", &["ATTACK=kill_init"], Query, Denied("kill")),
    attack("P4", "kill everybody", &["ATTACK=kill_everybody"], Query, Denied("kill")),
    attack("P4", "kill init's thread", &["ATTACK=kill_init_thread"], Query, Denied("tgkill")),
    attack("P4", "queue a signal for init", &["ATTACK=queue_signal"], Query, Denied("rt_sigqueueinfo")),
    attack("P4", "stop itself", &["ATTACK=stop_self"], Query, Denied("tgkill")),
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
    attack("P7", "become dumpable", &["ATTACK=undo_dumpable"], Query, Denied("prctl")),
    attack("P7", "outlive its parent", &["ATTACK=outlive_parent"], Query, Denied("prctl")),
    attack("P7", "make the time stamp counter fault", &["ATTACK=fault_on_clock"], Query, Denied("prctl")),
    attack("P8", "raise the limit of processor time", &["ATTACK=raise_cpu_limit"], Query, Denied("prlimit64")),
    attack("P9", "ignore SIGSEGV", &["ATTACK=ignore_crash"], Query, Says("EPERM")),
    attack("P9", "crash with SIGSEGV ignored", &["ATTACK=crash_with_handler"], Query, Signal(libc::SIGSEGV)),
];

pub const KERNEL: &[Attack] = &[
    attack("N1", "call socket", &["ATTACK=raw_call", "RAW=41"], QueryAndConstructor, Denied("socket")),
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
    attack("K2", "int 0x80", &["ATTACK=other_gate"], Query, Signal(libc::SIGSYS)),
    attack("K3", "a number of the x32 interface", &["ATTACK=raw_call", "RAW=0x40000027"], Query, Denied("?")),
    attack("K4", "a number that does not exist", &["ATTACK=raw_call", "RAW=9999"], Query, Denied("?")),
    attack("K5", "install a filter of its own", &["ATTACK=own_filter"], Query, Denied("seccomp")),
    attack("K7", "descriptor with its upper half set", &["ATTACK=high_bits"], Query, Denied("write")),
    attack("K7", "futex with priority inheritance", &["ATTACK=priority_futex"], Query, Denied("futex")),
    attack("K8", "eight threads race", &["ATTACK=race"], Query, Denied("clone")),
    raw!("K9", "setitimer", "38"),
    raw!("K9", "timer_create", "222"),
    attack("K9", "alarm", &["ATTACK=alarm_clock"], Query, Denied("alarm")),
    attack("K10", "become a real-time process", &["ATTACK=be_real_time"], Query, Denied("sched_setscheduler")),
    attack("K10", "choose another CPU", &["ATTACK=choose_cpu"], Query, Says("EPERM")),
];
