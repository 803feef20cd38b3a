//! A group of a recording as it stands in space.

use std::collections::BTreeMap;

use ocb_core::mesh::Mesh;

use crate::model::{PosedGroup, PosedObject, WhichGroup};
use crate::recording::Recording;
use crate::{LabError, Result};

use super::shapes::solid;

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
    let mut places = BTreeMap::new();
    for query in &queries[from..to] {
        let poses = [query.configuration.pose_a, query.configuration.pose_b];
        for (object, pose) in query.objects.into_iter().zip(poses) {
            places.entry(object).or_insert(pose);
        }
    }
    Ok(PosedGroup {
        group,
        from: queries[from].sequence,
        to: queries[to - 1].sequence + 1,
        queries: (to - from) as u64,
        objects: places.into_iter().map(|(object, pose)| PosedObject { object, pose: pose.to_row_major() }).collect(),
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
