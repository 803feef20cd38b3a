//! Memory that supervisor and runner share: sealed memory files and their mappings.
//!
//! Every access goes through atomics: the other side may write at any time, and a word that is read once is a value.

use std::io;
use std::os::fd::{AsRawFd, BorrowedFd, FromRawFd, OwnedFd};
use std::ptr::NonNull;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

/// A mapping of a whole memory file.
#[derive(Debug)]
pub struct Segment {
    start: NonNull<u8>,
    len: usize,
}

// SAFETY: a mapping belongs to the process, not to a thread, and all access to it is atomic.
unsafe impl Send for Segment {}
// SAFETY: as for `Send`.
unsafe impl Sync for Segment {}

impl Segment {
    /// Maps the first `len` bytes of `file`.
    pub fn map(file: BorrowedFd<'_>, len: usize, writable: bool) -> io::Result<Self> {
        let protection = libc::PROT_READ | if writable { libc::PROT_WRITE } else { 0 };
        let map = |flags| {
            // SAFETY: a fresh mapping at an address of the kernel's choice; no existing memory is touched.
            unsafe { libc::mmap(std::ptr::null_mut(), len, protection, flags, file.as_raw_fd(), 0) }
        };
        let mut address = map(libc::MAP_SHARED);
        if address == libc::MAP_FAILED && !writable {
            // Before Linux 6.7 a file sealed against writing has no shared mapping, not even a read-only one.
            address = map(libc::MAP_PRIVATE);
        }
        match NonNull::new(address.cast()) {
            Some(start) if address != libc::MAP_FAILED => Ok(Self { start, len }),
            _ => Err(io::Error::last_os_error()),
        }
    }

    /// Maps all of `file`.
    pub fn whole(file: BorrowedFd<'_>, writable: bool) -> io::Result<Self> {
        // SAFETY: asks where a borrowed file ends.
        let len = unsafe { libc::lseek(file.as_raw_fd(), 0, libc::SEEK_END) };
        Self::map(file, usize::try_from(len).map_err(|_| io::Error::last_os_error())?, writable)
    }

    /// Its size in bytes.
    #[expect(clippy::len_without_is_empty, reason = "an empty mapping does not exist")]
    pub fn len(&self) -> usize {
        self.len
    }

    /// The 32-bit word at a byte offset.
    pub fn u32(&self, offset: usize) -> &AtomicU32 {
        assert!(offset.is_multiple_of(4) && offset + 4 <= self.len);
        // SAFETY: in bounds and aligned (mappings begin on a page); the mapping lives as long as `self`; whoever maps
        // read-only only loads, which the standard library allows for words of up to 64 bits.
        unsafe { self.start.add(offset).cast().as_ref() }
    }

    /// The 64-bit word at a byte offset.
    pub fn u64(&self, offset: usize) -> &AtomicU64 {
        assert!(offset.is_multiple_of(8) && offset + 8 <= self.len);
        // SAFETY: as in `u32`.
        unsafe { self.start.add(offset).cast().as_ref() }
    }

    /// Writes 64-bit words from a byte offset on.
    pub fn store(&self, offset: usize, words: &[u64]) {
        for (i, word) in words.iter().enumerate() {
            self.u64(offset + 8 * i).store(*word, Ordering::Relaxed);
        }
    }

    /// Reads 64-bit words from a byte offset on, each once.
    pub fn load(&self, offset: usize, words: &mut [u64]) {
        for (i, word) in words.iter_mut().enumerate() {
            *word = self.u64(offset + 8 * i).load(Ordering::Relaxed);
        }
    }

    /// Writes bytes; `offset` is a multiple of 8, and up to 7 bytes after the end are zeroed.
    pub fn store_bytes(&self, offset: usize, bytes: &[u8]) {
        for (i, chunk) in bytes.chunks(8).enumerate() {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.u64(offset + 8 * i).store(u64::from_le_bytes(word), Ordering::Relaxed);
        }
    }

    /// Copies bytes out, each word read once; `offset` is a multiple of 8.
    pub fn load_bytes(&self, offset: usize, len: usize) -> Vec<u8> {
        let mut words = vec![0; len.div_ceil(8)];
        self.load(offset, &mut words);
        let mut bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
        bytes.truncate(len);
        bytes
    }

    /// Address of a byte offset, for handing the memory to the plugin.
    pub fn address(&self, offset: usize) -> *mut u8 {
        assert!(offset <= self.len);
        // SAFETY: in bounds of the mapping.
        unsafe { self.start.add(offset).as_ptr() }
    }
}

impl Drop for Segment {
    fn drop(&mut self) {
        // SAFETY: our own mapping, and nothing borrows from it any more.
        unsafe { libc::munmap(self.start.as_ptr().cast(), self.len) };
    }
}

/// A memory file of `len` bytes that no program can be started from.
pub fn memory_file(name: &std::ffi::CStr, len: usize) -> io::Result<OwnedFd> {
    let flags = libc::MFD_CLOEXEC | libc::MFD_ALLOW_SEALING;
    // SAFETY: a valid C string and flags; the result is checked.
    let mut fd = unsafe { libc::memfd_create(name.as_ptr(), flags | libc::MFD_NOEXEC_SEAL) };
    if fd < 0 {
        // Before Linux 6.3 there is no such flag.
        // SAFETY: as above.
        fd = unsafe { libc::memfd_create(name.as_ptr(), flags) };
    }
    if fd < 0 {
        return Err(io::Error::last_os_error());
    }
    // SAFETY: just made, and owned by nobody else.
    let file = unsafe { OwnedFd::from_raw_fd(fd) };
    // SAFETY: our own descriptor.
    if unsafe { libc::ftruncate(fd, len as libc::off_t) } < 0 {
        return Err(io::Error::last_os_error());
    }
    Ok(file)
}

/// Adds seals: `F_SEAL_*`.
pub fn seal(file: BorrowedFd<'_>, seals: i32) -> io::Result<()> {
    // SAFETY: a command on a borrowed descriptor that takes an integer.
    match unsafe { libc::fcntl(file.as_raw_fd(), libc::F_ADD_SEALS, seals) } {
        0 => Ok(()),
        _ => Err(io::Error::last_os_error()),
    }
}
