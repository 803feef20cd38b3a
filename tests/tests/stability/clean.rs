//! Our own fast method has no failure within what the interface promises.

use ocb_tests::place::built;

use super::{engine, found, tried};

/// Families in which it may fail, each with the reason.
const EXPLAINED: [(&str, &str); 0] = [];

#[tokio::test]
async fn ocb_fast_fails_nowhere_within_the_promise() {
    let (engine, _folder) = engine(vec![built("libocb_fast.so")]).await;
    let all = tried(&engine, "ocb-fast", &[]).await;
    assert_eq!((all.families.len(), all.relations.len()), (28, 17));
    let table = engine.stability().await.expect("a table");
    assert_eq!(table.methods.len(), 1, "the whole run is kept");
    let beyond = |id: &str| table.families.iter().any(|family| family.id == id && family.beyond);
    let explained = |id: &str| beyond(id) || EXPLAINED.iter().any(|(known, _)| *known == id);
    // On a busy machine a question may take long without a fault of its own.
    let unexplained: Vec<_> = found(&all).into_iter().filter(|(id, slow)| !slow && !explained(id)).collect();
    let first = |id: &str| all.families.iter().find(|f| f.family == id).and_then(|f| f.first.clone());
    assert!(unexplained.is_empty(), "{:#?}", unexplained.iter().map(|(id, _)| (id, first(id))).collect::<Vec<_>>());
    assert!(all.families.iter().all(|family| family.tally.broken == 0));
    assert!(
        all.failures.iter().all(|failure| failure.state == ocb_service::model::CellState::Agrees),
        "{:?}",
        all.failures
    );
    assert_eq!(all.unit_safe, Some([-40, 20]));
    assert_eq!(all.offset_safe, Some(1_048_576.0));
    engine.shutdown().await;
}
