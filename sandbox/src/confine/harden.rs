//! The last steps, inside the runner's own process and before the plugin is loaded.

use std::ffi::{CStr, CString};
use std::io;
use std::path::Path;

use landlock::{
    ABI, Access, AccessFs, AccessNet, CompatLevel, Compatible, PathBeneath, PathFd, Ruleset, RulesetAttr,
    RulesetCreatedAttr, Scope,
};

use super::{ConfineError, checked};

/// Loads what plugins commonly link, so that its code can be sealed and does not count as the plugin's loading time.
/// `optional` libraries may be missing.
pub fn preload(required: &[&str], optional: &[&str]) -> Result<(), ConfineError> {
    for (name, must) in required.iter().map(|n| (n, true)).chain(optional.iter().map(|n| (n, false))) {
        let path = CString::new(*name).map_err(|e| ConfineError::Preload((*name).into(), e.to_string()))?;
        // SAFETY: a system library of this machine, trusted as the runner itself is; it stays loaded.
        let handle = unsafe { libc::dlopen(path.as_ptr(), libc::RTLD_NOW | libc::RTLD_GLOBAL) };
        if handle.is_null() && must {
            // SAFETY: single-threaded, directly after the failed call.
            let reason = unsafe { CStr::from_ptr(libc::dlerror()) }.to_string_lossy().into_owned();
            return Err(ConfineError::Preload((*name).into(), reason));
        }
    }
    Ok(())
}

/// Default action for every signal, none blocked. Rust's own handler for stack overflow would return into a fault loop
/// once sigaction is denied.
pub fn reset_signals() -> Result<(), ConfineError> {
    for signal in (1..32).filter(|s| ![libc::SIGKILL, libc::SIGSTOP].contains(s)) {
        // SAFETY: no handler of ours is running, and the default action needs no code.
        if unsafe { libc::signal(signal, libc::SIG_DFL) } == libc::SIG_ERR {
            return Err(ConfineError::Signals(io::Error::last_os_error()));
        }
    }
    nix::sys::signal::SigSet::empty().thread_set_mask().map_err(|e| ConfineError::Signals(e.into()))
}

/// No core dumps, no tracing by processes with the same ids.
pub fn make_undumpable() -> Result<(), ConfineError> {
    // SAFETY: integers only.
    checked(unsafe { libc::prctl(libc::PR_SET_DUMPABLE, 0, 0, 0, 0) }).map_err(ConfineError::Undumpable)
}

/// Seals every mapping that is not writable, and the vDSO with its data: nobody can put other pages over them (mseal,
/// Linux 6.10). Returns how many; 0 where the kernel cannot. Clocks are the supervisor's, so this is depth, not need.
pub fn seal_code() -> u32 {
    // SAFETY: the callback matches the declared type and only reads the record it is given.
    unsafe extern "C" fn seal_one(info: *mut libc::dl_phdr_info, _: usize, sealed: *mut libc::c_void) -> libc::c_int {
        // SAFETY: glibc passes a live record, and `sealed` is the counter given below.
        let (info, sealed) = unsafe { (&*info, &mut *sealed.cast::<u32>()) };
        for i in 0..usize::from(info.dlpi_phnum) {
            // SAFETY: `dlpi_phnum` headers stand there.
            let header = unsafe { &*info.dlpi_phdr.add(i) };
            let (start, end) = (info.dlpi_addr + header.p_vaddr, info.dlpi_addr + header.p_vaddr + header.p_memsz);
            let fixed = header.p_type == libc::PT_LOAD && header.p_flags & libc::PF_W == 0;
            let relocated = header.p_type == libc::PT_GNU_RELRO;
            if fixed {
                *sealed += mseal(start & !0xfff, end.next_multiple_of(0x1000));
            } else if relocated {
                *sealed += mseal(start & !0xfff, end & !0xfff);
            }
        }
        0
    }
    let mut sealed = 0u32;
    // SAFETY: the callback gets the counter back as the pointer it is.
    unsafe { libc::dl_iterate_phdr(Some(seal_one), (&raw mut sealed).cast()) };
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    if maps.is_empty() {
        // No /proc in the jail: the vDSO's code is where the kernel says, two pages; its data pages lie before it.
        // SAFETY: reads the auxiliary vector.
        let code = unsafe { libc::getauxval(libc::AT_SYSINFO_EHDR) };
        if code != 0 {
            sealed += mseal(code, code + 0x2000);
            for data_pages in [6, 5, 4] {
                let data = mseal(code - data_pages * 0x1000, code);
                sealed += data;
                if data == 1 {
                    break;
                }
            }
        }
    }
    sealed
}

/// 1 when the range is sealed now.
fn mseal(start: u64, end: u64) -> u32 {
    if end <= start {
        return 0;
    }
    // SAFETY: sealing changes no byte of memory, and nothing here unmaps or remaps what was loaded so far.
    let result = unsafe { libc::syscall(libc::SYS_mseal, start, end - start, 0) };
    u32::from(result == 0)
}

/// No page that was writable becomes executable (Linux 6.3). Tells whether the kernel has it; the filter holds the same
/// rule.
pub fn refuse_new_code() -> bool {
    const REFUSE_EXEC_GAIN: libc::c_ulong = 1;
    // SAFETY: integers only.
    unsafe { libc::prctl(libc::PR_SET_MDWE, REFUSE_EXEC_GAIN, 0, 0, 0) == 0 }
}

/// Landlock: read and execute below `allowed` and nothing else; no TCP, no signals to and no abstract sockets of others,
/// as far as this kernel has it. Returns the ABI in force. Files are the part that every ABI has.
pub fn landlock(allowed: &[&Path]) -> Result<u32, ConfineError> {
    let fault = |reason: String| {
        ConfineError::Landlock(format!("{reason}; the kernel needs Landlock (5.13 or newer, lsm=landlock at boot)"))
    };
    let mut last = String::from("no ABI tried");
    for (number, abi) in [(6, ABI::V6), (5, ABI::V5), (4, ABI::V4), (3, ABI::V3), (2, ABI::V2), (1, ABI::V1)] {
        let enforce = || -> Result<(), Box<dyn std::error::Error>> {
            let mut rules = Ruleset::default()
                .set_compatibility(CompatLevel::HardRequirement)
                .handle_access(AccessFs::from_all(abi))?;
            if number >= 4 {
                rules = rules.handle_access(AccessNet::from_all(abi))?;
            }
            if number >= 6 {
                rules = rules.scope(Scope::from_all(abi))?;
            }
            let mut rules = rules.create()?;
            for path in allowed {
                let below = PathBeneath::new(PathFd::new(path)?, AccessFs::ReadFile | AccessFs::Execute);
                rules = rules.add_rule(below)?;
            }
            rules.restrict_self()?;
            Ok(())
        };
        match enforce() {
            Ok(()) => return Ok(number),
            Err(reason) => last = reason.to_string(),
        }
    }
    Err(fault(last))
}
