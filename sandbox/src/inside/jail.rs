//! Builds the jail: launcher (outside) -> init (first process inside) -> runner, all of them the program that was started.
//!
//! The launcher is exec'd fresh and single-threaded, so that it may fork and run Rust code in the child, which the host
//! process with its threads may not. It stays outside as the parent whose death kills the jail. Init builds the root,
//! starts the runner, reaps it and reports how it ended; it never maps the memory that the plugin can write.

use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd, FromRawFd, OwnedFd};

use crate::confine::{self, ConfineError, root};
use crate::control::{Control, Order, Report};

/// Exit status of a jail process that could not do its step; the report on the control socket says which.
const FAULT: i32 = 120;
/// First of the ids outside that jails use, two each; far from the ids of people and services.
const FIRST_ID: u32 = 0x4000_0000;
/// The runner's user and group inside.
const RUNNER_ID: u32 = 1;

/// What comes with the order.
struct Files {
    trial: OwnedFd,
    request: OwnedFd,
    answer: OwnedFd,
    plugin: OwnedFd,
}

/// `PROGRAM launch`: descriptor 0 is the control socket, 2 the pipe of the plugin's messages.
pub fn launch() -> ! {
    // SAFETY: the sandbox starts this program with the control socket as descriptor 0, which nothing else here owns.
    let control = Control::from_fd(unsafe { OwnedFd::from_raw_fd(0) });
    let result = confine::die_with_parent().map_err(fault).and_then(|()| launch_with(&control));
    if let Err(report) = result {
        let _ = control.send(&report, &[]);
        std::process::exit(FAULT);
    }
    std::process::exit(0);
}

fn fault(error: ConfineError) -> Report {
    Report::Fault { step: error.step(), reason: error.to_string() }
}

fn talk(error: io::Error) -> Report {
    Report::Fault { step: "Control".into(), reason: format!("the control socket failed: {error}") }
}

fn launch_with(control: &Control) -> Result<(), Report> {
    // What the host process may have left open without close-on-exec.
    confine::close_from(3).map_err(|e| fault(ConfineError::Descriptors(e)))?;
    let Some((order, files)) = control.receive::<Order>().map_err(talk)? else { return Ok(()) };
    let mut files = files.into_iter();
    let mut file = || files.next().ok_or_else(|| talk(io::Error::other("the order's four files are missing")));
    let [trial, request, answer, plugin] = [file()?, file()?, file()?, file()?];
    // Init and runner are born into it.
    for entrance in files {
        confine::enter_group(entrance).map_err(fault)?;
    }
    let files = Files { trial, request, answer, plugin };
    if std::os::unix::process::parent_id() as i32 != order.supervisor {
        return Ok(()); // It died before the parent-death signal was set.
    }
    // Ctrl-C in a terminal is for the host, which then ends the jail in its own way. A process group is enough: a session would
    // get a scheduling group of its own, which can starve (sandbox/README.md, Limits).
    let _ = nix::unistd::setpgid(nix::unistd::Pid::from_raw(0), nix::unistd::Pid::from_raw(0));
    // SAFETY: an integer; the runner must be able to read what init creates.
    unsafe { libc::umask(0o022) };
    let mut libraries = root::find_libraries(order.startable_threads > 0).map_err(fault)?;
    libraries.extend(order.libraries.iter().map(|path| root::Library::brought(path)));
    let (released, release) = io::pipe().map_err(talk)?;
    let init = clone_init(order.namespaces).map_err(|e| fault(namespace_error(e)))?;
    if init == 0 {
        drop(release);
        let report = inside(&order, control, &files, &libraries, released);
        let (status, report) = match report {
            Ok(report) => (0, report),
            Err(report) => (FAULT, report),
        };
        let _ = control.send(&report, &[]);
        std::process::exit(status);
    }
    drop(released);
    let outside = || -> Result<(), Report> {
        let handle = confine::process_descriptor(init).map_err(talk)?;
        control.send(&Report::InitStarted, &[handle.as_fd()]).map_err(talk)?;
        let own_ids = if order.namespaces { map_ids(init).map_err(fault)? } else { false };
        let mut release = release;
        release.write_all(&[u8::from(own_ids)]).map_err(talk)
    };
    let result = outside();
    drop(files);
    let mut status = 0;
    // SAFETY: waits for our own child.
    unsafe { libc::waitpid(init, &raw mut status, 0) };
    result
}

fn namespace_error(error: io::Error) -> ConfineError {
    ConfineError::Namespaces(io::Error::other(format!(
        "this machine refuses new namespaces ({error}); allow unprivileged user namespaces (sysctl \
         user.max_user_namespaces, kernel.apparmor_restrict_unprivileged_userns), run as root, or run your own plugins with --profile dev (its \
         results are not ranked)"
    )))
}

/// Forks the first process of the jail, in namespaces of its own unless told otherwise. Returns twice, as fork does.
fn clone_init(namespaces: bool) -> io::Result<i32> {
    let flags = libc::CLONE_NEWUSER
        | libc::CLONE_NEWPID
        | libc::CLONE_NEWNET
        | libc::CLONE_NEWNS
        | libc::CLONE_NEWIPC
        | libc::CLONE_NEWUTS
        | libc::CLONE_NEWCGROUP;
    // SAFETY: all zeros is a valid clone_args: a fork.
    let mut arguments: libc::clone_args = unsafe { std::mem::zeroed() };
    arguments.flags = if namespaces { flags as u64 } else { 0 };
    arguments.exit_signal = libc::SIGCHLD as u64;
    // SAFETY: without a stack of its own the child continues on a copy of ours, as with fork; this process has one
    // thread, so the copy is consistent.
    let pid = unsafe { libc::syscall(libc::SYS_clone3, &raw mut arguments, size_of::<libc::clone_args>()) } as i32;
    if pid < 0 { Err(io::Error::last_os_error()) } else { Ok(pid) }
}

/// Two ids of the jail's own where we may choose ids (root), else our own id alone. Says which.
fn map_ids(init: i32) -> Result<bool, ConfineError> {
    let write = |file: &str, text: &str| {
        std::fs::OpenOptions::new()
            .write(true)
            .open(format!("/proc/{init}/{file}"))
            .and_then(|mut f| f.write_all(text.as_bytes()))
    };
    let (uid, gid) = (nix::unistd::geteuid(), nix::unistd::getegid());
    if uid.is_root() {
        let first = FIRST_ID + 2 * (init as u32 % (1 << 22));
        let range = format!("0 {first} 2");
        if write("uid_map", &range).is_ok() {
            return write("gid_map", &range).map(|()| true).map_err(ConfineError::IdMaps);
        }
    }
    write("setgroups", "deny")
        .and_then(|()| write("uid_map", &format!("{RUNNER_ID} {uid} 1")))
        .and_then(|()| write("gid_map", &format!("{RUNNER_ID} {gid} 1")))
        .map(|()| false)
        .map_err(ConfineError::IdMaps)
}

/// Init: everything up to the runner's start, then waits for its end.
fn inside(
    order: &Order,
    control: &Control,
    files: &Files,
    libraries: &[root::Library],
    mut released: io::PipeReader,
) -> Result<Report, Report> {
    let mut own_ids = [0];
    if released.read(&mut own_ids).map_err(talk)? != 1 {
        std::process::exit(0); // The launcher died.
    }
    let own_ids = own_ids[0] == 1;
    confine::die_with_parent().map_err(fault)?;
    let program = File::open("/proc/self/exe").map_err(talk)?;
    if own_ids {
        confine::drop_groups().map_err(fault)?;
    }
    if order.namespaces {
        root::private_mounts().map_err(fault)?;
        let trees = root::take(libraries).map_err(fault)?;
        if own_ids {
            // Not before the program is open: its folder may be closed to others.
            confine::take_ids(0).map_err(fault)?;
            confine::die_with_parent().map_err(fault)?;
        }
        root::build(&trees, files.plugin.as_fd(), order.plugin_bytes).map_err(fault)?;
        root::enter().map_err(fault)?;
        root::make_read_only().map_err(fault)?;
        confine::hide_host_name().map_err(fault)?;
    }
    confine::forget_keys();
    if !order.cpus.is_empty() {
        confine::stay_on_cpus(&order.cpus).map_err(fault)?;
    }
    // SAFETY: a plain fork of a single-threaded process.
    let runner = unsafe { libc::fork() };
    if runner == 0 {
        become_runner(order, control, files, libraries, &program, own_ids);
    }
    if runner < 0 {
        return Err(talk(io::Error::last_os_error()));
    }
    let handle = confine::process_descriptor(runner).map_err(talk)?;
    control.send(&Report::RunnerStarted { own_ids }, &[handle.as_fd()]).map_err(talk)?;
    confine::clear_capabilities().map_err(fault)?;
    let mut status = 0;
    // SAFETY: waits for our own child.
    while unsafe { libc::waitpid(runner, &raw mut status, 0) } < 0 {
        let error = io::Error::last_os_error();
        if error.kind() != io::ErrorKind::Interrupted {
            return Err(talk(error));
        }
    }
    Ok(Report::RunnerEnded { status })
}

/// Gives up its remaining privileges and becomes `PROGRAM run`.
fn become_runner(
    order: &Order,
    control: &Control,
    files: &Files,
    libraries: &[root::Library],
    program: &File,
    own_ids: bool,
) -> ! {
    // First, because the limit on open files would be in its way.
    let kept: [BorrowedFd<'_>; 5] =
        [files.trial.as_fd(), files.request.as_fd(), files.answer.as_fd(), control.as_fd(), program.as_fd()];
    let error = match confine::arrange_descriptors(&kept) {
        Err(error) => error,
        Ok(()) => {
            let steps = || -> Result<std::convert::Infallible, ConfineError> {
                // The runner, and init where the runner has no id of its own.
                let tasks = 1 + order.startable_threads as u64 + u64::from(!own_ids);
                let tasks = order.namespaces.then_some(tasks);
                confine::set_limits(order.address_space_bytes, order.cpu_seconds, tasks)?;
                confine::drop_capabilities()?;
                if own_ids {
                    confine::take_ids(RUNNER_ID)?;
                }
                confine::no_new_privileges()?;
                confine::die_with_parent()?;
                exec(&arguments(order, libraries, own_ids), &search_path(order))
            };
            match steps() {
                Err(error) => error,
            }
        }
    };
    // The control socket has moved with the rest.
    let _ = Control::from_fd(inherited(CONTROL)).send(&fault(error), &[]);
    std::process::exit(FAULT);
}

fn arguments(order: &Order, libraries: &[root::Library], own_ids: bool) -> Vec<String> {
    let mode = [
        if order.namespaces { "jail" } else { "bare" },
        if own_ids { "own" } else { "same" },
        if order.futex { "futex" } else { "spin" },
        if order.startable_threads > 0 { "threads" } else { "single" },
    ];
    let plugin = if order.namespaces { root::PLUGIN } else { &order.plugin_path };
    let libraries = libraries.iter().map(|l| match order.namespaces {
        true => format!("{}/{}", root::LIBRARIES, l.name),
        false => l.path.to_string_lossy().into_owned(),
    });
    [&super::program(), "run", &mode.join(","), plugin].map(str::to_string).into_iter().chain(libraries).collect()
}

/// Where the loader looks: in the jail's own folder, or, where there is no own root, beside the libraries that are brought.
fn search_path(order: &Order) -> String {
    let brought = order.libraries.iter().filter_map(|path| path.rsplit_once('/'));
    let folders = match order.namespaces {
        true => vec![root::LIBRARIES],
        false => brought.map(|(folder, _)| folder).collect(),
    };
    format!("LD_LIBRARY_PATH={}", folders.join(":"))
}

/// Executes the program behind descriptor 7, which closes on the way.
fn exec(arguments: &[String], search_path: &str) -> Result<std::convert::Infallible, ConfineError> {
    use std::ffi::CString;
    const PROGRAM: i32 = 7;
    let c_string = |text: &str| CString::new(text).map_err(|e| ConfineError::EnterRoot(e.into()));
    let c_strings = arguments.iter().map(|a| c_string(a)).collect::<Result<Vec<_>, _>>()?;
    let pointers = |list: &[CString]| {
        list.iter().map(|a| a.as_ptr()).chain([std::ptr::null()]).collect::<Vec<*const libc::c_char>>()
    };
    let environment = [c"LC_ALL=C".to_owned(), c_string(search_path)?];
    let (argv, envp) = (pointers(&c_strings), pointers(&environment));
    // SAFETY: integers only.
    unsafe { libc::fcntl(PROGRAM, libc::F_SETFD, libc::FD_CLOEXEC) };
    // SAFETY: null-terminated arrays of live C strings.
    unsafe {
        libc::syscall(libc::SYS_execveat, PROGRAM, c"".as_ptr(), argv.as_ptr(), envp.as_ptr(), libc::AT_EMPTY_PATH)
    };
    let error = io::Error::last_os_error();
    Err(ConfineError::EnterRoot(io::Error::other(format!(
        "{} cannot be executed inside the jail ({error}); its file must be readable and executable by all users",
        super::program()
    ))))
}

// The descriptors that `become_runner` keeps, as `serve` finds them.
pub(crate) const TRIAL: i32 = 3;
pub(crate) const REQUEST: i32 = 4;
pub(crate) const ANSWER: i32 = 5;
pub(crate) const CONTROL: i32 = 6;
const _: () = assert!(CONTROL + 1 == 7);

/// The inherited descriptor, owned from now on.
pub(crate) fn inherited(number: i32) -> OwnedFd {
    // SAFETY: `become_runner` has put it there, and each is taken once.
    let fd = unsafe { OwnedFd::from_raw_fd(number) };
    debug_assert!(fd.as_raw_fd() == number);
    fd
}
