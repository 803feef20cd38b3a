//! The seed of a run: drawn after the plugins are fixed, and provably so.
//!
//! When a run is asked for, a secret is drawn and its hash published with the run; the plugin files are named by their
//! hashes from then on. The seed follows from the secret, the configuration set and the plugins, and the secret is
//! published with the result. So nobody can fit a plugin to a seed or a seed to a plugin, and everybody can check it.

use std::sync::Arc;

use ocb_lab::algorithm::Algorithm;

use crate::model::Draw;
use crate::runs::sql::RunRow;
use crate::sha256_hex;

/// Seeds are below this: a JavaScript reader keeps them exactly.
const BITS: u32 = 53;

/// A new secret: 32 random bytes as text.
pub fn secret() -> String {
    [uuid::Uuid::new_v4(), uuid::Uuid::new_v4()].map(|id| id.simple().to_string()).concat()
}

/// What is published of a secret.
pub fn commitment(secret: &str) -> String {
    sha256_hex(secret.as_bytes())
}

/// The seed that the run's owner chose, or the one that follows from the run's secret.
pub fn seed(row: &RunRow, set_sha256: &str, algorithms: &[Arc<Algorithm>]) -> u64 {
    let plugins = algorithms.iter().map(|c| c.info.plugin_sha256.as_str());
    row.spec.seed.unwrap_or_else(|| follow(row.secret.as_deref().unwrap_or_default(), set_sha256, plugins))
}

/// The seed of the configurations of a run whose suite names none.
pub fn configurations(row: &RunRow, algorithms: &[Arc<Algorithm>]) -> u64 {
    let plugins = algorithms.iter().map(|c| c.info.plugin_sha256.as_str());
    follow(row.secret.as_deref().unwrap_or_default(), "configurations", plugins)
}

fn follow<'a>(secret: &'a str, set_sha256: &'a str, plugins: impl Iterator<Item = &'a str>) -> u64 {
    let text: String = [secret, set_sha256].into_iter().chain(plugins).collect();
    u64::from_str_radix(&sha256_hex(text.as_bytes())[..16], 16).unwrap_or(0) >> (64 - BITS)
}

/// For the result.
pub fn drawn(row: &RunRow, seed: u64) -> Draw {
    let secret = row.secret.clone().filter(|_| row.spec.seed.is_none());
    Draw { seed, commitment: secret.as_deref().map(commitment), secret }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_depends_on_everything_that_was_fixed_before_and_is_checkable() {
        let secret = secret();
        assert_eq!((secret.len(), commitment(&secret).len()), (64, 64));
        assert_ne!(secret, super::secret());
        let seed = follow(&secret, "set", ["a", "b"].into_iter());
        assert_eq!(
            seed,
            u64::from_str_radix(&sha256_hex(format!("{secret}setab").as_bytes())[..16], 16).unwrap() >> 11
        );
        assert!(seed < 1 << 53 && seed == follow(&secret, "set", ["a", "b"].into_iter()));
        assert!(
            seed != follow(&secret, "set", ["a", "c"].into_iter())
                && seed != follow("x", "set", ["a", "b"].into_iter())
        );
    }
}
