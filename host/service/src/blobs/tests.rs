//! The contract of the blob storage, on a folder and on an S3 server.

use futures::TryStreamExt;

use super::*;

/// A setting that the test harness makes.
pub(crate) fn from_harness(name: &str) -> String {
    std::env::var(name)
        .unwrap_or_else(|_| panic!("{name} is not set: run `make test`, which starts the server that this test needs"))
}

/// How many blobs are there.
pub(crate) async fn count(blobs: &Blobs) -> usize {
    blobs.store.list(Some(&Key::from("blobs"))).try_fold(0, async |n, _| Ok(n + 1)).await.unwrap()
}

async fn contract(blobs: Blobs) {
    let before = count(&blobs).await;
    // Different bytes on every run: the server may outlive this test.
    let fresh = uuid::Uuid::new_v4().as_bytes().to_vec();
    let sha256 = blobs.put(fresh.clone()).await.unwrap();
    assert_eq!(sha256, sha256_hex(&fresh));
    assert_eq!(blobs.put(fresh.clone()).await.unwrap(), sha256, "the same bytes are welcome again");
    assert_eq!(blobs.get(&sha256).await.unwrap(), fresh);
    let large = [fresh.as_slice(), &vec![7; 12 << 20]].concat();
    let large_sha256 = blobs.put(large.clone()).await.unwrap();
    assert_eq!(blobs.get(&large_sha256).await.unwrap(), large);
    assert_eq!(count(&blobs).await, before + 2, "the same bytes are kept once");
    let absent = blobs.get(&"0".repeat(64)).await.unwrap_err().to_string();
    assert!(absent.starts_with("Reading a blob failed"), "{absent}");
    for foreign in ["../../etc/passwd", "", "ABCDEF"] {
        assert!(matches!(blobs.get(foreign).await, Err(EngineError::Invalid(_))), "{foreign:?} is no key");
    }
    // A file that rots on the disk is noticed when it is read.
    blobs.store.put(&key(&sha256).unwrap(), PutPayload::from_static(b"rotten")).await.unwrap();
    let damaged = blobs.get(&sha256).await.unwrap_err().to_string();
    assert!(damaged.contains("is damaged"), "{damaged}");
}

#[tokio::test]
async fn a_folder_keeps_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    contract(Blobs::open(folder.path(), None).unwrap()).await;
}

#[tokio::test]
async fn an_s3_server_keeps_the_contract() {
    // Others use the same bucket meanwhile.
    let own = format!("s3://ocb-test/{}", uuid::Uuid::new_v4());
    let url = from_harness("OCB_TEST_S3").replacen("s3://ocb-test", &own, 1);
    assert!(url.starts_with(&own));
    contract(Blobs::open(Path::new("/nonexistent"), Some(&url)).unwrap()).await;
    // Keys in the address are used instead of those of the environment, which sign requests visibly.
    let keyed = url.replacen("s3://", "s3://another%2Bkey:s3cret@", 1);
    let store = format!("{:?}", Blobs::open(Path::new("/nonexistent"), Some(&keyed)).unwrap().store);
    assert!(store.contains("another+key") && !store.contains("s3cret"), "{store}");
    contract(Blobs::open(Path::new("/nonexistent"), Some(&keyed)).unwrap()).await;
}

#[test]
fn a_url_that_is_none_is_refused() {
    for url in ["http://host/bucket", "s3://", "s3://b?endpont=x", "s3://key:s3cret@", "s3://s3cret@b"] {
        match Blobs::open(Path::new("/nonexistent"), Some(url)) {
            Err(EngineError::Invalid(reason)) => assert!(!reason.contains("s3cret"), "{reason}"),
            other => panic!("{url}: {:?}", other.map(drop)),
        }
    }
}
