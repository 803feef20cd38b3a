//! The control socket: what supervisor, launcher and init say to each other while the jail is built.
//!
//! The plugin's process never holds it: the runner closes its end before it may load anything. Messages are JSON in
//! sequenced packets, with descriptors beside them.

use std::io::{self, IoSlice, IoSliceMut};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd, FromRawFd, OwnedFd, RawFd};

use nix::sys::socket::{
    AddressFamily, ControlMessage, ControlMessageOwned, MsgFlags, SockFlag, SockType, recvmsg, sendmsg, socketpair,
};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// No message is longer.
const MESSAGE_BYTES: usize = 16 << 10;

/// One end.
#[derive(Debug)]
pub struct Control(OwnedFd);

/// Supervisor to launcher, first message; comes with four descriptors, trial, request, answer and plugin file, and with the
/// memory group's entrances when there is a group.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Order {
    /// Process id of the supervisor, to notice that it died before the parent-death signal was set.
    pub supervisor: i32,
    /// Build namespaces and an own root; without, only the layers inside the process.
    pub namespaces: bool,
    /// Where the plugin file lies, for a jail that has no root of its own.
    pub plugin_path: String,
    /// Size of the plugin file, bytes.
    pub plugin_bytes: u64,
    /// Files of libraries that the plugin brings beside the system's own.
    pub libraries: Vec<String>,
    /// CPUs to stay on; the scheduler's choice when empty.
    pub cpus: Vec<usize>,
    /// Threads that the plugin may start.
    pub startable_threads: usize,
    /// Address space limit of the runner, bytes.
    pub address_space_bytes: u64,
    /// Processor time limit of the runner, seconds.
    pub cpu_seconds: u64,
    /// Sleep at once instead of watching memory.
    pub futex: bool,
}

/// Child side to supervisor.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Report {
    /// The jail's first process exists; comes with its pidfd.
    InitStarted,
    /// The runner exists; comes with its pidfd.
    RunnerStarted {
        /// It has user and group ids of its own.
        own_ids: bool,
    },
    /// The runner has ended, with this wait status.
    RunnerEnded {
        /// As waitpid gives it.
        status: i32,
    },
    /// A step of the recipe failed.
    Fault {
        /// Which.
        step: String,
        /// Why.
        reason: String,
    },
}

impl Control {
    /// Two connected ends, both closed on exec.
    pub fn pair() -> io::Result<(Control, Control)> {
        let (a, b) = socketpair(AddressFamily::Unix, SockType::SeqPacket, None, SockFlag::SOCK_CLOEXEC)?;
        Ok((Control(a), Control(b)))
    }

    /// Takes over a descriptor.
    pub fn from_fd(fd: OwnedFd) -> Self {
        Control(fd)
    }

    /// Gives the descriptor away.
    pub fn into_fd(self) -> OwnedFd {
        self.0
    }

    /// Sends one message.
    pub fn send(&self, message: &impl Serialize, descriptors: &[BorrowedFd<'_>]) -> io::Result<()> {
        let bytes = serde_json::to_vec(message)?;
        let raw: Vec<RawFd> = descriptors.iter().map(AsRawFd::as_raw_fd).collect();
        let rights = [ControlMessage::ScmRights(&raw)];
        let rights = if raw.is_empty() { &[][..] } else { &rights[..] };
        sendmsg::<()>(self.0.as_raw_fd(), &[IoSlice::new(&bytes)], rights, MsgFlags::MSG_NOSIGNAL, None)?;
        Ok(())
    }

    /// Waits for one message; `None` when every other end is closed.
    pub fn receive<T: DeserializeOwned>(&self) -> io::Result<Option<(T, Vec<OwnedFd>)>> {
        let mut bytes = vec![0; MESSAGE_BYTES];
        let mut space = nix::cmsg_space!([RawFd; 8]);
        let mut slices = [IoSliceMut::new(&mut bytes)];
        let message = recvmsg::<()>(self.0.as_raw_fd(), &mut slices, Some(&mut space), MsgFlags::MSG_CMSG_CLOEXEC)?;
        let mut descriptors = Vec::new();
        for part in message.cmsgs()? {
            if let ControlMessageOwned::ScmRights(raw) = part {
                // SAFETY: the kernel has just installed these descriptors for us; nobody else knows them.
                descriptors.extend(raw.into_iter().map(|fd| unsafe { OwnedFd::from_raw_fd(fd) }));
            }
        }
        let len = message.bytes;
        if len == 0 {
            return Ok(None);
        }
        Ok(Some((serde_json::from_slice(&bytes[..len])?, descriptors)))
    }
}

impl AsFd for Control {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.0.as_fd()
    }
}
