//! The compiled filter does what the list says, argument by argument: run here by an interpreter of its own, and against
//! the kernel in `sweep.rs`.

#[path = "common/list.rs"]
mod list;

use list::{List, Verdict};
use ocb_sandbox::seccomp;
use seccompiler::sock_filter;

const OWN: i32 = 4242;
const X86_64: u32 = 0xc000_003e;

/// Classic BPF, as far as the compiler uses it.
fn run(program: &[sock_filter], nr: u32, architecture: u32, arguments: &[u64; 6]) -> u32 {
    let mut data = Vec::new();
    data.extend(nr.to_le_bytes());
    data.extend(architecture.to_le_bytes());
    data.extend(0u64.to_le_bytes());
    arguments.iter().for_each(|argument| data.extend(argument.to_le_bytes()));
    let (mut at, mut a) = (0usize, 0u32);
    loop {
        let one = &program[at];
        at += 1;
        let mut jump = |yes: bool| at += usize::from(if yes { one.jt } else { one.jf });
        match one.code {
            0x20 => a = u32::from_le_bytes(data[one.k as usize..][..4].try_into().unwrap()),
            0x54 => a &= one.k,
            0x05 => at += one.k as usize,
            0x15 => jump(a == one.k),
            0x25 => jump(a > one.k),
            0x35 => jump(a >= one.k),
            0x45 => jump(a & one.k != 0),
            0x06 => return one.k,
            other => panic!("instruction {other:#x}"),
        }
    }
}

fn verdict(program: &[sock_filter], nr: i64, arguments: &[u64; 6]) -> Verdict {
    match run(program, nr as u32, X86_64, arguments) {
        libc::SECCOMP_RET_ALLOW => Verdict::Allow,
        libc::SECCOMP_RET_USER_NOTIF => Verdict::Ask,
        other if other & 0xffff_0000 == libc::SECCOMP_RET_ERRNO => Verdict::Quiet((other & 0xffff) as i32),
        other => panic!("the filter returns {other:#x}"),
    }
}

/// The filter of the single-threaded track or of the other one, and what the list says.
fn both(threads: bool) -> (Vec<sock_filter>, List) {
    (seccomp::compile(OWN, threads).unwrap(), List::read(OWN, threads))
}

/// Numbers worth asking about: all there are, room above, the x32 twins, and the ends of the range.
fn numbers() -> impl Iterator<Item = i64> {
    (0..2048).chain((0x4000_0000..).take(2048)).chain([0x7fff_ffff, 0x8000_0000, 0xffff_ffff])
}

#[test]
fn every_number_is_treated_as_listed() {
    for threads in [false, true] {
        let (program, list) = both(threads);
        let mut asked = 0;
        for nr in numbers() {
            for arguments in [[0; 6], [u64::MAX; 6], [1; 6], [1 << 32; 6]] {
                let expected = list.verdict(nr, &arguments);
                assert_eq!(verdict(&program, nr, &arguments), expected, "{nr} {arguments:x?}");
                asked += u32::from(expected == Verdict::Ask);
            }
        }
        assert!(asked > 15_000, "{asked}");
    }
}

#[test]
fn a_foreign_architecture_is_killed() {
    let (program, _) = both(false);
    // i386, x32's own mark does not exist here, ARM 64, no machine at all.
    for architecture in [0x4000_0003, 0xc000_00b7, 0, u32::MAX] {
        for nr in [0, 1, 39, 231] {
            assert_eq!(run(&program, nr, architecture, &[0; 6]), libc::SECCOMP_RET_KILL_PROCESS);
        }
    }
}

/// Values near what a condition wants: each single bit changed, the neighbours, and the ends.
fn near(value: u64) -> impl Iterator<Item = u64> {
    let bits = (0..64).map(move |bit| value ^ (1 << bit));
    bits.chain([value.wrapping_add(1), value.wrapping_sub(1), value | 0xffff_ffff_0000_0000, u64::MAX, 0])
}

#[test]
fn every_condition_holds_bit_by_bit() {
    // The other track's list is this one and more.
    let (program, list) = both(true);
    let (mut conditions, mut denied) = (0, 0);
    for (nr, alternatives) in &list.allow {
        for all in alternatives {
            // What is not looked at is noise.
            let mut good = [0x5a5a_5a5a_a5a5_a5a5; 6];
            all.iter().for_each(|c| good[c.argument] = (good[c.argument] & !c.mask) | c.low);
            assert_eq!(verdict(&program, *nr, &good), Verdict::Allow, "{nr} {good:x?}");
            for condition in all {
                conditions += 1;
                let mut denied_here = 0;
                for value in near(good[condition.argument]) {
                    let mut arguments = good;
                    arguments[condition.argument] = value;
                    let expected = list.verdict(*nr, &arguments);
                    assert_eq!(verdict(&program, *nr, &arguments), expected, "{nr} {arguments:x?}");
                    denied_here += u32::from(expected == Verdict::Ask);
                }
                assert!(denied_here > 0, "nothing breaks a condition of {nr}");
                denied += denied_here;
                // A comparison of 32 bits would let this through.
                if condition.mask >> 32 != 0 {
                    let mut arguments = good;
                    arguments[condition.argument] |= 1 << 63;
                    assert_eq!(verdict(&program, *nr, &arguments), Verdict::Ask, "{nr} {arguments:x?}");
                }
            }
        }
    }
    assert!(conditions >= 20 && denied >= 500, "{conditions} conditions, {denied} denials");
}

/// What glibc's pthread_create asks for: VM FS FILES SIGHAND THREAD SYSVSEM SETTLS PARENT_SETTID CHILD_CLEARTID.
const NEW_THREAD: u64 = 0x3d_0f00;

#[test]
fn priority_inheritance_and_new_processes_are_not_there() {
    for threads in [false, true] {
        let (program, _) = both(threads);
        // LOCK_PI, UNLOCK_PI, TRYLOCK_PI, WAIT_REQUEUE_PI, CMP_REQUEUE_PI, LOCK_PI2, with and without PRIVATE, REALTIME.
        for operation in [6, 7, 8, 11, 12, 13] {
            for flags in [0, 128, 256, 384] {
                assert_eq!(verdict(&program, libc::SYS_futex, &[0, operation | flags, 0, 0, 0, 0]), Verdict::Ask);
            }
        }
        for nr in [libc::SYS_clone, libc::SYS_fork, libc::SYS_vfork, libc::SYS_execve, libc::SYS_execveat] {
            for flags in [0, 0x0120_0011] {
                assert_eq!(verdict(&program, nr, &[flags, 0, 0, 0, 0, 0]), Verdict::Ask);
            }
        }
        assert_eq!(verdict(&program, libc::SYS_clone3, &[0; 6]), Verdict::Quiet(libc::ENOSYS));
        assert_eq!(verdict(&program, libc::SYS_sched_setaffinity, &[0; 6]), Verdict::Quiet(libc::EPERM));
    }
}

#[test]
fn a_thread_is_all_that_the_multi_threaded_track_may_clone() {
    let clone = |threads, flags| verdict(&both(threads).0, libc::SYS_clone, &[flags, 0, 0, 0, 0, 0]);
    assert_eq!((clone(false, NEW_THREAD), clone(true, NEW_THREAD)), (Verdict::Ask, Verdict::Allow));
    // Every namespace, no thread at all, and each single bit beside, the upper half included.
    for flags in near(NEW_THREAD) {
        assert_eq!(clone(true, flags), Verdict::Ask, "{flags:#x}");
    }
}
