//! A service elsewhere, as the commands that talk to one see it.
#![cfg_attr(not(feature = "remote"), allow(dead_code))]

#[cfg(feature = "remote")]
#[path = "service/remote.rs"]
mod asking;
#[cfg(not(feature = "remote"))]
#[path = "service/no_remote.rs"]
mod asking;
#[cfg(feature = "remote")]
mod client;

#[cfg(feature = "remote")]
pub use client::client;

use crate::args::{LookArgs, ServiceArgs};

/// Where it is, and as whom one speaks to it. How it is asked stands in `service/remote.rs`.
pub struct Service<'a> {
    server: &'a str,
    token: Option<&'a str>,
}

impl Service<'_> {
    /// Where this path is there.
    pub fn address(&self, path: &str) -> String {
        format!("{}{path}", self.server.trim_end_matches('/'))
    }
}

impl ServiceArgs {
    /// The service that is meant.
    pub fn service(&self) -> Service<'_> {
        Service { server: &self.server, token: Some(&self.token) }
    }
}

impl LookArgs {
    /// The service that is meant.
    pub fn service(&self) -> Service<'_> {
        Service { server: &self.server, token: self.token.as_deref() }
    }
}

/// What is sent beside a file.
pub struct Upload {
    /// Fields of the form, by name.
    pub fields: Vec<(&'static str, String)>,
    /// The file's name and bytes.
    pub file: (String, Vec<u8>),
}
