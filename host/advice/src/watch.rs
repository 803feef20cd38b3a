//! Long work that somebody looks at and may stop.

/// Who looks on.
pub trait Watch: Sync {
    /// `done` of `total` steps of something are done.
    fn step(&self, what: &str, done: u64, total: u64);
    /// Shall the work end? It is asked often.
    fn stopped(&self) -> bool;
}

/// Nobody looks on, nothing is stopped.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn step(&self, _: &str, _: u64, _: u64) {}

    fn stopped(&self) -> bool {
        false
    }
}
