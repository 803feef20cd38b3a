//! The machine that measures: its facts, its CPUs, and who may measure on it now.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use nix::sched::{CpuSet, sched_getaffinity, sched_setaffinity};
use nix::unistd::Pid;

use crate::sha256_hex;
use crate::{LabError, Result};

/// How often a lock is asked for.
const TICK: Duration = Duration::from_millis(100);
/// Locks of the machine: the right to measure, and that to be the next who has it.
const THE_RIGHT: &str = "measuring";
const NEXT: &str = "measuring-next";

/// What does not change while this process lives.
#[derive(Clone, Debug)]
pub struct Machine {
    /// CPUs this process may use, ascending.
    pub allowed: Vec<usize>,
    /// CPU model.
    pub cpu: String,
    /// Memory in bytes.
    pub memory_bytes: u64,
    /// Kernel release.
    pub kernel: String,
    /// Microcode of the CPU.
    pub microcode: String,
    /// Hash over what makes times comparable: CPU model, stepping and caches, number of CPUs, size of the memory.
    pub hardware_class: String,
}

impl Machine {
    /// Asks the kernel.
    pub fn observe() -> Result<Self> {
        let mask =
            sched_getaffinity(Pid::from_raw(0)).map_err(|e| LabError::fault("Reading the CPU mask failed", e))?;
        let allowed: Vec<usize> = (0..CpuSet::count()).filter(|&cpu| mask.is_set(cpu).unwrap_or(false)).collect();
        let cpuinfo = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let field = |name: &str| {
            let line = cpuinfo.lines().find(|line| line.split(':').next().is_some_and(|key| key.trim() == name));
            line.and_then(|line| line.split_once(':')).map_or("unknown", |(_, value)| value.trim()).to_owned()
        };
        let cpu = field("model name");
        let memory_bytes = memory_bytes();
        let class = format!(
            "{cpu}|{}|{}|{}|{}|{}|{}",
            field("cpu family"),
            field("model"),
            field("stepping"),
            field("cache size"),
            allowed.len(),
            // The kernel reserves a little of it at each boot; what is left differs by kilobytes.
            memory_bytes.div_ceil(1 << 30),
        );
        Ok(Self {
            microcode: field("microcode"),
            cpu,
            memory_bytes,
            kernel: fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default().trim().to_owned(),
            hardware_class: sha256_hex(class.as_bytes())[..16].to_owned(),
            allowed,
        })
    }

    /// Of another hardware class when its operator says what distinguishes it.
    pub fn noted(mut self, note: Option<&str>) -> Self {
        if let Some(note) = note.map(str::trim).filter(|note| !note.is_empty()) {
            self.hardware_class = sha256_hex(format!("{}|{note}", self.hardware_class).as_bytes())[..16].to_owned();
        }
        self
    }

    /// The CPU on which runners are measured: the last one, because the first usually serves the interrupts.
    pub fn measuring_cpu(&self) -> usize {
        self.allowed.last().copied().unwrap_or(0)
    }

    /// The CPU of the thread that holds the clock: beside the measuring CPU, or the same where there is only one.
    pub fn supervisor_cpu(&self) -> usize {
        self.allowed.iter().rev().nth(1).copied().unwrap_or_else(|| self.measuring_cpu())
    }

    /// Takes every thread of this process off the measuring CPU until the guard is dropped, and off the clock's CPU too
    /// where there are more than two (the sandbox puts the supervising thread itself there). Threads that are started
    /// meanwhile inherit the mask of the thread that starts them.
    pub fn keep_off(&self) -> KeptOff {
        let others = match self.allowed.len() {
            0 | 1 => &self.allowed[..],
            2 => &self.allowed[..1],
            n => &self.allowed[..n - 2],
        };
        set_all_threads(others);
        KeptOff { allowed: self.allowed.clone() }
    }
}

/// While it lives, the measuring CPU belongs to the runner.
pub struct KeptOff {
    allowed: Vec<usize>,
}

impl Drop for KeptOff {
    fn drop(&mut self) {
        set_all_threads(&self.allowed);
    }
}

/// Work on all CPUs that is no measurement: as long as another process measures, it keeps off that process's CPUs.
pub struct MakingWay<'m> {
    machine: &'m Machine,
    off: Option<KeptOff>,
}

impl<'m> MakingWay<'m> {
    /// Begins such work.
    pub fn begin(machine: &'m Machine) -> Self {
        let mut way = Self { machine, off: None };
        way.look();
        way
    }

    /// Looks whether somebody measures now; to be called now and then.
    pub fn look(&mut self) {
        match (measured_elsewhere(), self.off.is_some()) {
            (true, false) => self.off = Some(self.machine.keep_off()),
            (false, true) => self.off = None,
            _ => {}
        }
    }
}

/// Does another process have the right to measure? A lock that cannot be looked at is nobody's.
fn measured_elsewhere() -> bool {
    open_machine_lock(THE_RIGHT).is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
}

/// A thread that ends between listing and setting is no loss, so nothing here can fail.
fn set_all_threads(cpus: &[usize]) {
    let mut mask = CpuSet::new();
    for &cpu in cpus {
        let _ = mask.set(cpu);
    }
    let Ok(tasks) = fs::read_dir("/proc/self/task") else { return };
    for task in tasks.flatten() {
        if let Some(id) = task.file_name().to_str().and_then(|name| name.parse().ok()) {
            let _ = sched_setaffinity(Pid::from_raw(id), &mask);
        }
    }
}

fn memory_bytes() -> u64 {
    let meminfo = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    let kib = meminfo
        .lines()
        .find_map(|line| line.strip_prefix("MemTotal:"))
        .and_then(|rest| rest.trim().trim_end_matches("kB").trim().parse::<u64>().ok());
    kib.unwrap_or(0) * 1024
}

/// How long a process that ends may still keep the data folder: what a killed one had just begun to start shares its lock until
/// it has become the other program.
const ENDS_WITHIN: Duration = Duration::from_secs(2);

/// Locks the data folder for this process; the lock goes with the process, also when it is killed.
pub fn lock_data_folder(data: &Path) -> Result<File> {
    let fault = |what, e| LabError::Fault(format!("The data folder {} cannot be {what}: {e}.", data.display()));
    let mut options = File::options();
    let options = options.create(true).truncate(false).write(true).read(true);
    let file = options.open(data.join("lock")).map_err(|e| fault("used", e))?;
    let end = Instant::now() + ENDS_WITHIN;
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(file),
            Err(TryLockError::WouldBlock) if Instant::now() < end => thread::sleep(TICK),
            Err(TryLockError::WouldBlock) => {
                return Err(LabError::Busy(format!(
                    "The data folder {} is in use by another process of OpenCollBench; stop that process, or choose \
                     another folder.",
                    data.display()
                )));
            }
            Err(TryLockError::Error(e)) => return Err(fault("locked", e)),
        }
    }
}

/// The right to measure on this machine, held by at most one process of any user and any data folder.
pub struct MeasuringRight {
    _file: File,
}

impl MeasuringRight {
    /// Takes the right if nobody has it now.
    pub fn try_take() -> Result<Option<Self>> {
        Ok(try_lock(THE_RIGHT)?.map(|file| Self { _file: file }))
    }

    /// Waits until nobody has the right and takes it; `None` when stopped. `waits` is called once if it is not free at once.
    pub fn wait(stopped: impl Fn() -> bool, waits: impl FnOnce()) -> Result<Option<Self>> {
        let mut waits = Some(waits);
        // One of the waiting processes is next. A process that gives the right back and wants it again queues behind it;
        // otherwise it would take the right again long before the others look.
        let mut next = None;
        while !stopped() {
            if next.is_none() {
                next = try_lock(NEXT)?;
            }
            if next.is_some()
                && let Some(right) = Self::try_take()?
            {
                return Ok(Some(right));
            }
            if let Some(waits) = waits.take() {
                waits();
            }
            thread::sleep(TICK);
        }
        Ok(None)
    }
}

/// The lock of this name, if it is free.
fn try_lock(name: &str) -> Result<Option<File>> {
    let file =
        open_machine_lock(name).map_err(|e| LabError::fault("Opening the machine's measuring lock failed", e))?;
    match file.try_lock() {
        Ok(()) => Ok(Some(file)),
        Err(TryLockError::WouldBlock) => Ok(None),
        Err(TryLockError::Error(e)) => Err(LabError::fault("Taking the machine's measuring lock failed", e)),
    }
}

/// `/run/lock` belongs to everybody on Debian and is emptied at boot; `/tmp` is there where it is not.
fn open_machine_lock(name: &str) -> io::Result<File> {
    let folder = if Path::new("/run/lock").is_dir() { "/run/lock" } else { "/tmp" };
    let path = PathBuf::from(folder).join(format!("opencollbench-{name}.lock"));
    // Reading is enough to lock, so another user's file serves as well; the kernel may forbid O_CREAT on it.
    match File::open(&path) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => {
            match File::options().write(true).create_new(true).open(&path) {
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => File::open(&path),
                other => other,
            }
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
    use std::sync::{Mutex, PoisonError};

    /// Masks belong to the whole process, so only one test at a time may set them.
    static MASKS: Mutex<()> = Mutex::new(());

    #[test]
    fn what_the_operator_says_makes_another_class() {
        let machine = Machine::observe().unwrap();
        let class = |note| machine.clone().noted(note).hardware_class;
        assert_eq!((class(None), class(Some(" "))), (machine.hardware_class.clone(), machine.hardware_class.clone()));
        assert_eq!(class(Some("turbo off")), class(Some(" turbo off")));
        assert!(class(Some("turbo off")) != class(None) && class(Some("turbo off")) != class(Some("turbo on")));
    }

    #[test]
    fn a_second_process_is_told_to_use_another_folder() {
        let folder = tempfile::tempdir().unwrap();
        let _first = lock_data_folder(folder.path()).unwrap();
        let second = lock_data_folder(folder.path()).unwrap_err().to_string();
        assert!(second.contains("in use by another process"), "{second}");
    }

    #[test]
    fn a_folder_whose_process_is_just_ending_is_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let first = lock_data_folder(folder.path()).unwrap();
        let ends = std::thread::spawn(move || {
            std::thread::sleep(ENDS_WITHIN / 4);
            drop(first);
        });
        lock_data_folder(folder.path()).unwrap();
        ends.join().unwrap();
    }

    #[test]
    fn work_makes_way_while_somebody_measures() {
        let _alone = MASKS.lock().unwrap_or_else(PoisonError::into_inner);
        let machine = Machine::observe().unwrap();
        let on_it = || sched_getaffinity(Pid::from_raw(0)).unwrap().is_set(machine.measuring_cpu()).unwrap();
        // Whoever measures on this machine meanwhile ends; the lock is asked for like any other.
        let right = loop {
            match MeasuringRight::try_take().unwrap() {
                Some(right) => break right,
                None => std::thread::sleep(std::time::Duration::from_millis(50)),
            }
        };
        let mut way = MakingWay::begin(&machine);
        assert!(!on_it() || machine.allowed.len() == 1);
        drop(right);
        // Another process may take the right at this very moment; then the way stays made until it gives it back.
        while !on_it() {
            std::thread::sleep(std::time::Duration::from_millis(50));
            way.look();
        }
    }

    #[test]
    fn a_process_that_measures_again_queues_behind_the_waiting_one() {
        let wait = || MeasuringRight::wait(|| false, || {}).unwrap().unwrap();
        let (done, measured) = (AtomicBool::new(false), AtomicU32::new(0));
        std::thread::scope(|scope| {
            let first = wait();
            let second = scope.spawn(|| {
                let _right = wait();
                done.store(true, Ordering::Relaxed);
            });
            std::thread::sleep(5 * TICK);
            drop(first);
            // Measures over and over, without a pause in which a process that looks now and then would find the right free.
            while !done.load(Ordering::Relaxed) && measured.fetch_add(1, Ordering::Relaxed) < 50 {
                let _right = wait();
                std::thread::sleep(TICK);
            }
            second.join().unwrap();
        });
        // Other processes on this machine may wait, too, and chance decides which of them is next.
        assert!(measured.load(Ordering::Relaxed) < 20, "it was passed over {measured:?} times");
    }

    #[test]
    fn every_thread_leaves_the_measuring_cpu_and_comes_back() {
        let _alone = MASKS.lock().unwrap_or_else(PoisonError::into_inner);
        let machine = Machine::observe().unwrap();
        let here = || sched_getaffinity(Pid::from_raw(0)).unwrap();
        let other = std::thread::spawn({
            let cpu = machine.measuring_cpu();
            let alone = machine.allowed.len() == 1;
            move || {
                std::thread::park();
                let off = !here().is_set(cpu).unwrap();
                std::thread::park();
                (off || alone) && here().is_set(cpu).unwrap()
            }
        });
        let guard = machine.keep_off();
        other.thread().unpark();
        std::thread::sleep(std::time::Duration::from_millis(200));
        drop(guard);
        other.thread().unpark();
        assert!(other.join().unwrap());
    }
}
