//! In the place of `remote.rs` where no service elsewhere can be asked.

use std::path::Path;

use ocb_service::EngineError;
use serde_json::Value;

use super::{Service, Upload};
use crate::failure::Result;

impl Service<'_> {
    /// Refuses.
    pub async fn get<T>(&self, _: &str) -> Result<T> {
        left_out()
    }

    /// Refuses.
    pub async fn post<T>(&self, _: &str, _: &Value) -> Result<T> {
        left_out()
    }

    /// Refuses.
    pub async fn put<T>(&self, _: &str, _: &Value) -> Result<T> {
        left_out()
    }

    /// Refuses.
    pub async fn delete<T>(&self, _: &str) -> Result<T> {
        left_out()
    }

    /// Refuses.
    pub async fn upload<T>(&self, _: &str, _: Upload) -> Result<T> {
        left_out()
    }

    /// Refuses.
    pub async fn save(&self, _: &str, _: &Path) -> Result<u64> {
        left_out()
    }
}

fn left_out<T>() -> Result<T> {
    Err(EngineError::left_out("a client for services elsewhere").into())
}
