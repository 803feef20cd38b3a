//! Lists part by part, on both databases.

use super::super::*;
use super::{add, object, run};
use crate::model::{Cursor, ObjectInfo};

pub async fn lists_go_on_where_they_were_left(store: Store) {
    store.add_blob("m", 1, "x").await.unwrap();
    // Some of the same moment, some of others.
    for (id, created_us) in [("a", 5), ("b", 5), ("c", 5), ("d", 4), ("e", 6)] {
        add(&store, run(id, Some("me"), 1, created_us)).await;
        add(&store, run(&format!("not {id}"), Some("other"), 1, created_us)).await;
        let info = ObjectInfo { created_us, ..object(id) };
        store.add_object(&info, Some("me"), "m").await.unwrap();
    }
    let expected = ["e", "c", "b", "a", "d"];
    for most in 1..=6 {
        let (mut runs, mut objects) = (Vec::new(), Vec::new());
        let (mut of_runs, mut of_objects) = (Cursor::start(), Cursor::start());
        loop {
            let rows = store.runs_of("me", &of_runs, most).await.unwrap();
            let infos = store.objects_for(Some("me"), &of_objects, most).await.unwrap();
            let (Some(run), Some(object)) = (rows.last(), infos.last()) else { break };
            of_runs = Cursor::behind(run.created_us, &run.id);
            of_objects = Cursor::behind(object.info.created_us, &object.info.id);
            runs.extend(rows.into_iter().map(|row| row.id));
            objects.extend(infos.into_iter().map(|row| row.info.id));
        }
        assert_eq!((&runs[..], &objects[..]), (&expected.map(str::to_owned)[..], &expected.map(str::to_owned)[..]));
    }
}
