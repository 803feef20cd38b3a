//! A recording as it stands in space: a group of its queries, and its scene.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_core::scene::SceneObject;
use ocb_core::workload::Recorded;

use crate::model::{PosedGroup, PosedObject, PosedScene, ScenePair, WhichGroup};
use crate::recording::Recording;
use crate::{LabError, Result};

use super::shapes::{described, solid};

/// Pairs of a scene that are listed.
const MOST_PAIRS: usize = 10_000;

/// A group: each of its objects where its first query places it.
///
/// # Errors
/// `Invalid` for a recording without such a group.
pub fn posed_group(recording: &Recording, which: WhichGroup) -> Result<PosedGroup> {
    let queries = &recording.queries;
    let (at, named) = match (which.sequence, which.group) {
        (Some(sequence), _) => {
            (queries.binary_search_by_key(&sequence, |query| query.sequence).ok(), format!("query {sequence}"))
        }
        (None, Some(group)) => (queries.iter().position(|query| query.group == group), format!("group {group}")),
        (None, None) => (Some(0), "query".to_owned()),
    };
    let none = || LabError::Invalid(format!("The recording has no {named}."));
    let at = at.filter(|at| *at < queries.len()).ok_or_else(none)?;
    let group = queries[at].group;
    let apart = |i: &usize| queries[*i].group != group;
    let from = (0..at).rev().find(apart).map_or(0, |before| before + 1);
    let to = (at..queries.len()).find(apart).unwrap_or(queries.len());
    let places = first_places(&queries[from..to]);
    Ok(PosedGroup {
        group,
        from: queries[from].sequence,
        to: queries[to - 1].sequence + 1,
        queries: (to - from) as u64,
        objects: places.into_iter().map(|(object, pose)| PosedObject { object, pose: pose.to_row_major() }).collect(),
    })
}

/// Where the first query about each object places it.
fn first_places(queries: &[Recorded]) -> BTreeMap<u32, Pose> {
    let mut places = BTreeMap::new();
    for query in queries {
        let poses = [query.configuration.pose_a, query.configuration.pose_b];
        for (object, pose) in query.objects.into_iter().zip(poses) {
            places.entry(object).or_insert(pose);
        }
    }
    places
}

/// The scene with all its objects, and its pairs.
///
/// # Errors
/// `Invalid` for a primitive that has no triangles.
pub fn posed_scene(recording: &Recording) -> Result<PosedScene> {
    let scene = &recording.scene.scene;
    let mut pairs: BTreeMap<[u32; 2], (u64, Option<&str>)> = BTreeMap::new();
    for [a, b] in recording.queries.iter().map(|query| query.objects) {
        pairs.entry([a.min(b), a.max(b)]).or_default().0 += 1;
    }
    let asked = pairs.len() as u64;
    for pair in &scene.disabled {
        pairs.entry([pair.a, pair.b]).or_default().1 = Some(&pair.reason);
    }
    let asked_though_disabled = pairs.values().filter(|(queries, disabled)| *queries > 0 && disabled.is_some()).count();
    let mut pairs: Vec<_> = pairs.into_iter().collect();
    pairs.sort_by_key(|(objects, (queries, _))| (Reverse(*queries), *objects));
    pairs.truncate(MOST_PAIRS);
    let unplaced = scene.objects.iter().all(|object| object.pose == Pose::identity());
    let placed_by_queries = unplaced && !recording.queries.is_empty();
    let places = if placed_by_queries { first_places(&recording.queries) } else { BTreeMap::new() };
    let posed = |(object, it): (u32, &SceneObject)| PosedObject {
        object,
        pose: places.get(&object).unwrap_or(&it.pose).to_row_major(),
    };
    let pair = |(objects, (queries, disabled)): ([u32; 2], (u64, Option<&str>))| ScenePair {
        objects,
        queries,
        disabled: disabled.map(str::to_owned),
    };
    Ok(PosedScene {
        about: described(&recording.scene)?,
        objects: (0..).zip(&scene.objects).map(posed).collect(),
        placed_by_queries,
        pairs: pairs.into_iter().map(pair).collect(),
        asked,
        disabled: scene.disabled.len() as u64,
        asked_though_disabled: asked_though_disabled as u64,
    })
}

/// The triangles of an object as algorithms get them.
///
/// # Errors
/// `Invalid` for a scene without such an object.
pub fn mesh_of(recording: &Recording, object: usize) -> Result<std::sync::Arc<Mesh>> {
    let objects = &recording.scene.scene.objects;
    let none = || LabError::Invalid(format!("The scene has no object {object}; it has {}.", objects.len()));
    Ok(solid(&recording.scene, &objects.get(object).ok_or_else(none)?.geometry)?.outer)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use nalgebra::Vector3;
    use ocb_core::scene::DisabledPair;

    use super::*;
    use crate::recording::from_json;

    /// Three balls; the second one is asked twice about the first, and once about the third.
    fn recording() -> Recording {
        let written = r#"{
            "objects": [
                { "name": "a", "geometry": { "kind": "sphere", "radius": 1 } },
                { "name": "b", "geometry": { "kind": "sphere", "radius": 1 } },
                { "name": "c", "geometry": { "kind": "sphere", "radius": 1 } },
                { "name": "never", "geometry": { "kind": "sphere", "radius": 1 } }
            ],
            "queries": [
                { "objects": ["b", "a"], "query": "collide", "pose_a": [1,0,0,5, 0,1,0,0, 0,0,1,0] },
                { "objects": ["a", "b"], "query": "collide", "pose_b": [1,0,0,6, 0,1,0,0, 0,0,1,0] },
                { "objects": ["b", "c"], "query": "collide", "pose_b": [1,0,0,7, 0,1,0,0, 0,0,1,0] }
            ]
        }"#;
        from_json(written.as_bytes(), Path::new("")).expect("a recording")
    }

    #[test]
    fn a_scene_without_places_stands_as_first_asked_and_names_its_pairs() {
        let mut recording = recording();
        let disabled = |a, b, reason: &str| DisabledPair { a, b, reason: reason.to_owned() };
        recording.scene.scene.disabled = vec![disabled(0, 2, "same link"), disabled(1, 2, "adjacent")];
        let scene = posed_scene(&recording).expect("a scene");
        let x: Vec<f64> = scene.objects.iter().map(|it| it.pose[3]).collect();
        assert_eq!((scene.placed_by_queries, x), (true, vec![0.0, 5.0, 7.0, 0.0]));
        let pair = |objects, queries, disabled: Option<&str>| ScenePair {
            objects,
            queries,
            disabled: disabled.map(str::to_owned),
        };
        let expected = [pair([0, 1], 2, None), pair([1, 2], 1, Some("adjacent")), pair([0, 2], 0, Some("same link"))];
        assert_eq!(scene.pairs, expected);
        assert_eq!((scene.asked, scene.disabled, scene.asked_though_disabled), (2, 2, 1));
    }

    #[test]
    fn the_places_of_the_scene_come_first() {
        let mut recording = recording();
        let objects = &mut recording.scene.scene.objects;
        objects[3].pose = Pose { translation: Vector3::new(9.0, 0.0, 0.0), ..Pose::identity() };
        let scene = posed_scene(&recording).expect("a scene");
        let x: Vec<f64> = scene.objects.iter().map(|it| it.pose[3]).collect();
        assert_eq!((scene.placed_by_queries, x), (false, vec![0.0, 0.0, 0.0, 9.0]));
    }

    #[test]
    fn a_scene_that_was_never_asked_stands_where_it_is_placed() {
        let scene = posed_scene(&Recording { queries: Vec::new(), ..recording() }).expect("a scene");
        assert_eq!((scene.placed_by_queries, scene.asked, scene.pairs.len()), (false, 0, 0));
        let names: Vec<_> = scene.about.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["a", "b", "c", "never"]);
        assert!(scene.about.iter().all(|it| it.triangles > 100 && it.bound.is_some_and(|bound| bound > 0.0)));
    }
}
