//! Signatures of plugins, as minisign makes them.

use minisign_verify::{PublicKey, Signature};

use crate::{EngineError, Result};

/// The key in a `minisign.pub` file or its last line, in its one form.
pub fn public_key(text: &str) -> Result<String> {
    let line = text.trim().lines().last().unwrap_or_default().trim();
    PublicKey::from_base64(line).map(|_| line.to_owned()).map_err(|_| {
        let mend = "paste the content of minisign.pub, or its last line, which begins with RW";
        EngineError::Invalid(format!("This is not a minisign public key; {mend}."))
    })
}

/// Is this the file that the holder of the key has signed?
pub fn check(file: &[u8], signature: &str, key: &str) -> Result<()> {
    let signature = Signature::decode(signature.trim()).map_err(|_| {
        let mend = "send the content of the .minisig file that minisign -S writes";
        EngineError::Invalid(format!("The signature cannot be read; {mend}."))
    })?;
    let key = PublicKey::from_base64(key).map_err(|e| EngineError::fault("Reading a registered key failed", e))?;
    key.verify(file, &signature, false).map_err(|e| {
        let e = e.to_string().trim_end_matches('.').to_owned();
        EngineError::Invalid(format!(
            "The signature does not match this file and your registered key ({e}); sign the file again, or register \
             your signing key on the account page."
        ))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: &str = include_str!("signature/minisign.pub");
    const SIGNED: &str = include_str!("signature/elf.minisig");
    const FILE: &[u8] = b"\x7fELF and nothing behind it";

    #[test]
    fn only_the_signed_file_by_the_registered_key_passes() {
        let key = public_key(KEY).unwrap();
        assert!(key.starts_with("RW") && public_key(&key).unwrap() == key);
        check(FILE, SIGNED, &key).unwrap();
        let told = |result: Result<()>| result.unwrap_err().to_string();
        assert!(told(check(b"\x7fELF and something behind it", SIGNED, &key)).contains("does not match this file"));
        assert!(told(check(FILE, "signed, me", &key)).contains("cannot be read"));
        // The same key but for one bit of its id, and a comment that nobody has signed.
        let other = key.replacen("RW", "RX", 1);
        assert!(public_key(&other).is_err() || check(FILE, SIGNED, &other).is_err());
        assert!(check(FILE, &SIGNED.replace("trusted comment: ", "trusted comment: not "), &key).is_err());
        assert!(public_key("ssh-ed25519 AAAA").is_err());
    }
}
