//! Priorities in the queue: smaller is served first.

/// Of work that a visitor waits for.
pub const INTERACTIVE: i64 = 1;
/// Of the service's own runs.
pub const BACKGROUND: i64 = 5;
/// Of idle work.
pub const IDLE: i64 = 9;
