//! Content-addressed files: meshes, configuration sets, records.

use std::path::Path;
use std::sync::Arc;

use object_store::local::LocalFileSystem;
use object_store::path::Path as Key;
use object_store::{ObjectStore, ObjectStoreExt, PutMode, PutOptions, PutPayload};
use ocb_lab::sha256_hex;

use crate::{EngineError, Result};

/// Immutable files under `blobs/<first two digits>/<sha256>`, in a folder or in an S3 bucket.
#[derive(Clone)]
pub struct Blobs {
    store: Arc<dyn ObjectStore>,
}

impl Blobs {
    /// `s3://bucket/prefix?endpoint=http://host:port`, with keys in front of the bucket or from `AWS_*`; without a URL the data
    /// folder.
    pub fn open(data: &Path, url: Option<&str>) -> Result<Self> {
        let store: Arc<dyn ObjectStore> = match url {
            None => Arc::new(
                // On the disk before the database speaks of it, synced, not only written.
                LocalFileSystem::new_with_prefix(data)
                    .map_err(|e| fault("Opening the blob folder failed", e))?
                    .with_fsync(true),
            ),
            Some(url) => s3(url)?,
        };
        Ok(Self { store })
    }

    /// Keeps the bytes and gives their SHA-256. The same bytes are kept once.
    pub async fn put(&self, bytes: Vec<u8>) -> Result<String> {
        let sha256 = sha256_hex(&bytes);
        // Create-if-absent: what is there under this name is already these bytes, and a reader never sees half a file.
        let options = PutOptions { mode: PutMode::Create, ..PutOptions::default() };
        match self.store.put_opts(&key(&sha256)?, PutPayload::from(bytes), options).await {
            Ok(_) | Err(object_store::Error::AlreadyExists { .. }) => Ok(sha256),
            Err(e) => Err(fault("Storing a blob failed", e)),
        }
    }

    /// Removes a blob; one that is gone already is gone.
    pub async fn remove(&self, sha256: &str) -> Result<()> {
        match self.store.delete(&key(sha256)?).await {
            Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
            Err(e) => Err(fault("Removing a blob failed", e)),
        }
    }

    /// The bytes of a blob, checked against their name.
    pub async fn get(&self, sha256: &str) -> Result<Vec<u8>> {
        let found = self.store.get(&key(sha256)?).await.map_err(|e| fault("Reading a blob failed", e))?;
        let bytes = found.bytes().await.map_err(|e| fault("Reading a blob failed", e))?;
        if sha256_hex(&bytes) != sha256 {
            return Err(EngineError::Fault(format!(
                "The stored file {sha256} is damaged: its content does not match its name; restore it from a backup."
            )));
        }
        Ok(bytes.to_vec())
    }
}

fn key(sha256: &str) -> Result<Key> {
    if sha256.len() != 64 || !sha256.bytes().all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b)) {
        return Err(EngineError::Invalid(format!("{sha256:?} is not a SHA-256 in lower-case hexadecimal.")));
    }
    Ok(Key::from(format!("blobs/{}/{sha256}", &sha256[..2])))
}

#[cfg(not(feature = "s3"))]
fn s3(_: &str) -> Result<Arc<dyn ObjectStore>> {
    Err(EngineError::left_out("S3"))
}

#[cfg(feature = "s3")]
fn s3(url: &str) -> Result<Arc<dyn ObjectStore>> {
    use object_store::aws::AmazonS3Builder;
    use object_store::prefix::PrefixStore;
    // Not quoted: it may hold a secret key.
    let form = "s3://[key:secret@]bucket/prefix?endpoint=http://host:port";
    let bad = || EngineError::Invalid(format!("The address of the blob storage is not valid; write {form}."));
    let rest = url.strip_prefix("s3://").ok_or_else(bad)?;
    let (place, query) = rest.split_once('?').unwrap_or((rest, ""));
    let (keys, place) = place.rsplit_once('@').map_or((None, place), |(keys, place)| (Some(keys), place));
    let (bucket, prefix) = place.split_once('/').unwrap_or((place, ""));
    if bucket.is_empty() {
        return Err(bad());
    }
    let mut builder = AmazonS3Builder::from_env().with_bucket_name(bucket);
    if let Some(keys) = keys {
        let plain = |text| percent_encoding::percent_decode_str(text).decode_utf8().map_err(|_| bad());
        let (key, secret) = keys.split_once(':').ok_or_else(bad)?;
        builder = builder.with_access_key_id(plain(key)?).with_secret_access_key(plain(secret)?);
    }
    for pair in query.split('&').filter(|pair| !pair.is_empty()) {
        builder = match pair.split_once('=') {
            // A server of one's own (SeaweedFS, Ceph, a test server) is often reached without TLS, inside one machine.
            Some(("endpoint", value)) => builder.with_endpoint(value).with_allow_http(value.starts_with("http://")),
            Some(("region", value)) => builder.with_region(value),
            _ => return Err(bad()),
        };
    }
    let store = builder.build().map_err(|e| fault("Opening the blob storage failed", e))?;
    let prefix = prefix.trim_matches('/');
    Ok(if prefix.is_empty() { Arc::new(store) } else { Arc::new(PrefixStore::new(store, prefix)) })
}

fn fault(step: &str, e: object_store::Error) -> EngineError {
    EngineError::fault(step, e)
}

pub mod sql;
#[cfg(test)]
pub(crate) mod tests;
