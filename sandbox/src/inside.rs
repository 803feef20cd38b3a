//! The jail's own processes, for the programs that the sandbox starts: the runner of plugins, and programs of ours whose work
//! calls libraries of others ([`task`]).

mod closed;
mod jail;
pub mod task;

pub use closed::{Closed, Shared, Slot, close_off};
pub use jail::launch;

/// The name of this program's file, as it was started.
pub fn program() -> String {
    let path = std::env::args().next().unwrap_or_default();
    path.rsplit('/').next().unwrap_or_default().to_owned()
}
