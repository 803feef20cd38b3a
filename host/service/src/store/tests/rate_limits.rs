//! Rate limits, on both databases.

use std::time::Duration;

use super::super::*;
use super::attempts::{pass, stopped_clock};
use crate::rate_limits::RateLimit;

const TWO_A_MINUTE: RateLimit = RateLimit { name: "try", of: "name", times: 2, per: Duration::from_secs(60) };

pub async fn too_many_attempts_wait_until_the_bucket_has_drained(store: Store) {
    stopped_clock(&store).await;
    let tried =
        async |who: &str, many| store.count_against(TWO_A_MINUTE, who, many).await.unwrap().map(|wait| wait.as_secs());
    assert_eq!([tried("a", 1).await, tried("A", 1).await], [None, None]);
    assert_eq!([tried("a", 1).await, tried("a", 2).await], [Some(30), Some(60)], "and what is refused does not count");
    assert_eq!(tried("b", 2).await, None, "each alone");
    let other = RateLimit { of: "address", ..TWO_A_MINUTE };
    assert_eq!(store.count_against(other, "a", 1).await.unwrap(), None);
    pass(&store, 29_000_000).await;
    assert_eq!(tried("a", 1).await, Some(1));
    pass(&store, 1_000_000).await;
    assert_eq!([tried("a", 1).await, tried("a", 1).await], [None, Some(30)]);
    assert_eq!(tried("c", 900).await, None, "more than ever fit count as those that do");

    pass(&store, 1_000_000).await;
    assert_eq!(store.forget_empty_buckets().await.unwrap(), 1, "the other thing is over");
    pass(&store, 61_000_000).await;
    assert_eq!(store.forget_empty_buckets().await.unwrap(), 3);
    assert_eq!(tried("a", 2).await, None);
}
