//! The jail's file system: an empty read-only tree with the plugin and the system libraries it may link.

use std::ffi::{CStr, CString};
use std::fs::File;
use std::io::{self, Read};
use std::os::fd::{AsRawFd, BorrowedFd, FromRawFd, OwnedFd};
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use nix::fcntl::AT_FDCWD;
use nix::mount::{MntFlags, MsFlags, mount, umount2};
use nix::sys::stat::{UtimensatFlags, utimensat};
use nix::sys::time::TimeSpec;

use super::{ConfineError, checked};

/// Where the plugin lies inside.
pub const PLUGIN: &str = "/plugin.so";
/// Where the libraries lie inside.
pub const LIBRARIES: &str = "/lib";
/// The loader's path in every dynamic x86-64 program of glibc.
pub const LOADER: &str = "/lib64/ld-linux-x86-64.so.2";

/// What a plugin may link. All but the first three are optional: empty shells of glibc 2.34 and newer, libstdc++, which a
/// machine without C++ programs lacks, and OpenMP.
const NAMES: [&str; 8] = [
    "libc.so.6",
    "libm.so.6",
    "libgcc_s.so.1",
    "libstdc++.so.6",
    "libpthread.so.0",
    "libdl.so.2",
    "librt.so.1",
    OPENMP,
];
const REQUIRED: usize = 3;
/// The library that is for plugins with threads alone.
pub const OPENMP: &str = "libgomp.so.1";

/// A library of this machine.
#[derive(Clone, Debug)]
pub struct Library {
    /// Its name as plugins ask for it.
    pub name: String,
    /// Where it lies on this machine.
    pub path: PathBuf,
}

/// Finds the libraries on this machine: where this very program's libc came from, then the usual places.
pub fn find_libraries(threads: bool) -> Result<Vec<Library>, ConfineError> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    let libc = maps.lines().filter_map(|line| line.find('/').map(|at| Path::new(&line[at..])));
    let own = libc.filter(|path| path.file_name().is_some_and(|name| name == "libc.so.6")).find_map(Path::parent);
    let usual = ["/lib/x86_64-linux-gnu", "/usr/lib/x86_64-linux-gnu", "/lib64", "/usr/lib64", "/usr/lib"];
    let places: Vec<&Path> = own.into_iter().chain(usual.iter().map(Path::new)).collect();
    let mut found = Vec::new();
    let names = NAMES.into_iter().filter(|name| threads || *name != OPENMP);
    for (i, name) in names.enumerate() {
        match places.iter().map(|place| place.join(name)).find(|path| path.exists()) {
            Some(path) => found.push(Library { name: name.into(), path }),
            None if i < REQUIRED => {
                return Err(ConfineError::Library(name.into(), io::Error::from(io::ErrorKind::NotFound)));
            }
            None => {}
        }
    }
    Ok(found)
}

impl Library {
    /// One that a plugin of ours brings (`brought.rs`): its file is named as plugins ask for it.
    pub fn brought(path: &str) -> Self {
        Library { name: path.rsplit('/').next().unwrap_or(path).to_owned(), path: path.into() }
    }
}

/// Is this a file of the system's own libraries, which every jail holds?
pub fn is_system(path: &str) -> bool {
    NAMES.contains(&Library::brought(path).name.as_str())
}

/// Mounts made here stay here.
pub fn private_mounts() -> Result<(), ConfineError> {
    mount(None::<&str>, "/", None::<&str>, MsFlags::MS_REC | MsFlags::MS_PRIVATE, None::<&str>)
        .map_err(|e| ConfineError::PrivateMounts(e.into()))
}

/// A file for the new root: where it will lie, and its mount.
type Tree = (String, OwnedFd);

/// Takes libraries and loader from this machine, before the new root hides what lies under /tmp, and with ids that may
/// enter the folder of a library that lies beside a plugin of ours.
pub fn take(libraries: &[Library]) -> Result<Vec<Tree>, ConfineError> {
    let inside = libraries.iter().map(|library| (format!("{LIBRARIES}/{}", library.name), library.path.as_path()));
    inside
        .chain([(LOADER.to_string(), Path::new(LOADER))])
        .map(|(inside, path)| match take_tree(path) {
            Ok(tree) => Ok((inside, tree)),
            Err(error) => Err(ConfineError::Library(path.display().to_string(), error)),
        })
        .collect()
}

/// Builds the new root on /tmp of this mount namespace: libraries mounted, the plugin copied (so that what runs is what
/// was opened, whatever happens to the file).
pub fn build(libraries: &[Tree], plugin: BorrowedFd<'_>, plugin_bytes: u64) -> Result<(), ConfineError> {
    let size = format!("size={},nr_inodes=64,mode=0755", plugin_bytes.next_multiple_of(4096) + (64 << 10));
    mount(Some("none"), "/tmp", Some("tmpfs"), MsFlags::MS_NOSUID | MsFlags::MS_NODEV, Some(size.as_str()))
        .map_err(|e| ConfineError::EmptyRoot(e.into()))?;
    for directory in [LIBRARIES, "/lib64"] {
        std::fs::create_dir(under_tmp(directory)).map_err(ConfineError::EmptyRoot)?;
    }
    copy_plugin(plugin, plugin_bytes).map_err(ConfineError::PluginCopy)?;
    for (inside, tree) in libraries {
        let target = under_tmp(inside);
        File::create(&target)
            .and_then(|_| put_tree(tree, &target))
            .map_err(|e| ConfineError::Library(inside.clone(), e))?;
    }
    [PLUGIN, LIBRARIES, "/lib64", "/"].into_iter().try_for_each(age).map_err(ConfineError::EmptyRoot)
}

/// Gives a file of the root the same times in every trial. When it was changed last, the kernel notes by itself.
fn age(inside: &str) -> io::Result<()> {
    let then = TimeSpec::new(0, 0);
    utimensat(AT_FDCWD, &under_tmp(inside), &then, &then, UtimensatFlags::NoFollowSymlink)?;
    Ok(())
}

/// Makes /tmp the root and lets go of the old one.
pub fn enter() -> Result<(), ConfineError> {
    let enter = || -> io::Result<()> {
        nix::unistd::chdir("/tmp")?;
        // The old root ends up on top of the new one and is taken off at once: no directory for it is needed.
        nix::unistd::pivot_root(".", ".")?;
        umount2(".", MntFlags::MNT_DETACH)?;
        nix::unistd::chdir("/")?;
        Ok(())
    };
    enter().map_err(ConfineError::EnterRoot)
}

/// Nothing can be written any more.
pub fn make_read_only() -> Result<(), ConfineError> {
    let flags = MsFlags::MS_REMOUNT | MsFlags::MS_BIND | MsFlags::MS_RDONLY | MsFlags::MS_NOSUID | MsFlags::MS_NODEV;
    mount(None::<&str>, "/", None::<&str>, flags, None::<&str>).map_err(|e| ConfineError::ReadOnlyRoot(e.into()))
}

fn under_tmp(inside: &str) -> PathBuf {
    PathBuf::from(format!("/tmp{inside}"))
}

/// `mount_attr` of mount_setattr(2).
#[repr(C)]
struct MountAttributes {
    set: u64,
    clear: u64,
    propagation: u64,
    userns: u64,
}

/// A detached, read-only copy of the mount of one file.
fn take_tree(path: &Path) -> io::Result<OwnedFd> {
    const OPEN_TREE_CLONE: u32 = 1;
    const READ_ONLY_NOSUID_NODEV: u64 = 1 | 2 | 4;
    const EMPTY: &CStr = c"";
    let path = CString::new(path.as_os_str().as_bytes())?;
    // SAFETY: a live C string; the result is checked.
    let fd = unsafe {
        libc::syscall(libc::SYS_open_tree, libc::AT_FDCWD, path.as_ptr(), OPEN_TREE_CLONE | libc::O_CLOEXEC as u32)
    } as i32;
    checked(fd)?;
    // SAFETY: just made, owned by nobody else.
    let tree = unsafe { OwnedFd::from_raw_fd(fd) };
    let attributes = MountAttributes { set: READ_ONLY_NOSUID_NODEV, clear: 0, propagation: 0, userns: 0 };
    // SAFETY: a live C string and a live struct of the given size.
    let result = unsafe {
        libc::syscall(
            libc::SYS_mount_setattr,
            fd,
            EMPTY.as_ptr(),
            libc::AT_EMPTY_PATH,
            &raw const attributes,
            size_of::<MountAttributes>(),
        )
    };
    checked(result as i32).map(|()| tree)
}

fn put_tree(tree: &OwnedFd, target: &Path) -> io::Result<()> {
    const FROM_EMPTY_PATH: u32 = 4;
    let target = CString::new(target.as_os_str().as_bytes())?;
    // SAFETY: live C strings; the descriptor is borrowed.
    let result = unsafe {
        libc::syscall(
            libc::SYS_move_mount,
            tree.as_raw_fd(),
            c"".as_ptr(),
            libc::AT_FDCWD,
            target.as_ptr(),
            FROM_EMPTY_PATH,
        )
    };
    checked(result as i32)
}

fn copy_plugin(plugin: BorrowedFd<'_>, bytes: u64) -> io::Result<()> {
    let source = File::from(plugin.try_clone_to_owned()?);
    let mut target = File::create(under_tmp(PLUGIN))?;
    let copied = io::copy(&mut source.take(bytes), &mut target)?;
    if copied != bytes {
        return Err(io::Error::other("the file has become shorter meanwhile"));
    }
    Ok(())
}
