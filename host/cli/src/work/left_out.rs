//! In the place of `work.rs` where no service elsewhere can be asked.

use std::process::ExitCode;

use ocb_service::EngineError;

use crate::args::{Store, WorkArgs};
use crate::failure::Result;

/// Refuses.
pub async fn work(_: &Store, _: &WorkArgs) -> Result<ExitCode> {
    Err(EngineError::left_out("a client for services elsewhere").into())
}
