//! Priorities in the queue: smaller is served first.

/// Of what somebody waits for.
pub const INTERACTIVE: i64 = 1;
/// Of the service's own runs.
pub const BACKGROUND: i64 = 5;
/// Of what the service does when nobody asks for anything.
pub const IDLE: i64 = 9;
