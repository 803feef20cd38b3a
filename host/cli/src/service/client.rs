//! The HTTP client of the commands that speak to a service elsewhere.

use std::error::Error;
use std::time::Duration;

use reqwest::{Client, Url};

use crate::failure::{Failure, Result};

/// For the service at this URL. A machine that has no certificates of authorities, e.g. a small container, reaches it over plain
/// HTTP all the same.
pub fn client(server: &str) -> Result<Client> {
    let builder = || Client::builder().connect_timeout(Duration::from_secs(10));
    let secure = Url::parse(server).is_ok_and(|url| url.scheme() == "https");
    let built = match builder().build() {
        Err(_) if !secure => builder().tls_certs_only([]).build(),
        built => built,
    };
    built.map_err(|error| {
        let mut reason: &dyn Error = &error;
        while let Some(source) = reason.source() {
            reason = source;
        }
        Failure::Input(format!(
            "Cannot set up HTTPS to {server}: {reason}; install the certificates of authorities (Debian: ca-certificates)."
        ))
    })
}
