//! Passwords and secrets: what is stored of them opens nothing.

use std::sync::LazyLock;

use argon2::Argon2;
use argon2::password_hash::phc::PasswordHash;
use argon2::password_hash::{PasswordHasher, PasswordVerifier};
use rayon::{ThreadPool, ThreadPoolBuilder};
use tokio::sync::oneshot;

use crate::{EngineError, Result};

/// Characters of a password: fewer are guessed, and more only keep the processor busy.
const LENGTH: std::ops::RangeInclusive<usize> = 10..=200;

/// Passwords are hashed so many at a time: each needs 19 MiB and a processor.
const AT_A_TIME: usize = 2;

/// Does the work on a thread for passwords, when it is its turn.
async fn in_turn<T: Send + 'static>(work: impl FnOnce() -> Result<T> + Send + 'static) -> Result<T> {
    static THREADS: LazyLock<Result<ThreadPool>> = LazyLock::new(|| {
        let threads = ThreadPoolBuilder::new().num_threads(AT_A_TIME).thread_name(|_| "password".into());
        // A panic has been logged, and whoever waits is told.
        let threads = threads.panic_handler(drop).build();
        threads.map_err(|e| EngineError::fault("Starting the threads for passwords failed", e))
    });
    let (sender, done) = oneshot::channel();
    let threads = THREADS.as_ref().map_err(|e| EngineError::Fault(e.to_string()))?;
    threads.spawn_fifo(move || drop(sender.send(work())));
    done.await.map_err(|e| EngineError::fault("Hashing a password failed", e))?
}

/// Argon2id with the crate's parameters (19 MiB, two passes), as OWASP recommends them.
pub async fn hashed(password: &str) -> Result<String> {
    if !LENGTH.contains(&password.chars().count()) {
        return Err(EngineError::Invalid(format!("A password has {} to {} characters.", LENGTH.start(), LENGTH.end())));
    }
    let password = password.to_owned();
    in_turn(move || hash(&password)).await
}

fn hash(password: &str) -> Result<String> {
    let hashed = Argon2::default().hash_password(password.as_bytes());
    Ok(hashed.map_err(|e| EngineError::fault("Hashing a password failed", e))?.to_string())
}

/// Is it this password? Without a stored one it takes as long to say no: the time must not tell which names there are.
pub async fn fits(password: &str, stored: Option<String>) -> Result<bool> {
    static NOBODYS: LazyLock<Result<String>> = LazyLock::new(|| hash("no password fits this hash"));
    // A password that could never have been set is still compared, but not at any length.
    let password: String = password.chars().take(*LENGTH.end() + 1).collect();
    in_turn(move || {
        let nobodys = || NOBODYS.as_ref().map_err(|e| EngineError::Fault(e.to_string())).cloned();
        let known = stored.is_some();
        let text = stored.map_or_else(nobodys, Ok)?;
        let parsed = PasswordHash::new(&text).map_err(|e| EngineError::fault("A stored password is damaged", e))?;
        Ok(Argon2::default().verify_password(password.as_bytes(), &parsed).is_ok() && known)
    })
    .await
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn only_the_password_fits_and_its_hash_is_salted() {
        let stored = hashed("correct horse battery").await.unwrap();
        assert!(stored.starts_with("$argon2id$"), "{stored}");
        assert_ne!(stored, hashed("correct horse battery").await.unwrap());
        assert!(fits("correct horse battery", Some(stored.clone())).await.unwrap());
        assert!(!fits("correct horse batterY", Some(stored)).await.unwrap());
        assert!(!fits("no password fits this hash", None).await.unwrap());
        assert!(hashed("too short").await.is_err() && hashed(&"x".repeat(201)).await.is_err());
    }
}
