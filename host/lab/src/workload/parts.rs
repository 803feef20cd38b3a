//! The queries of a recording by pair of objects and query: one part is asked of one process.

use std::collections::BTreeMap;

use ocb_core::configuration::Configuration;
use ocb_core::pose::{AS_IT_IS, Pose};
use ocb_core::query::Query;
use ocb_core::workload::Recorded;

/// The queries of one kind about one pair of objects.
pub struct Part {
    /// The objects by their place in the scene, the smaller first.
    pub objects: [u32; 2],
    /// What is asked.
    pub query: Query,
    /// The places of the queries in the recording, in their order there.
    pub rows: Vec<u32>,
    /// Their poses, with rotations up to rounding.
    pub configurations: Vec<Configuration>,
}

/// All parts, and how many queries cannot be replayed because a pose is no rotation.
pub fn parts(queries: &[Recorded]) -> (Vec<Part>, u64) {
    let mut parts: BTreeMap<([u32; 2], usize), Part> = BTreeMap::new();
    let mut bent = 0;
    for (row, recorded) in (0..).zip(queries) {
        let Some(configuration) = straightened(&recorded.configuration) else {
            bent += 1;
            continue;
        };
        let [a, b] = recorded.objects;
        let (objects, configuration) = if a <= b { ([a, b], configuration) } else { ([b, a], swapped(configuration)) };
        let query = recorded.kind.query();
        let part = parts.entry((objects, query as usize)).or_insert_with(|| Part {
            objects,
            query,
            rows: Vec::new(),
            configurations: Vec::new(),
        });
        part.rows.push(row);
        part.configurations.push(configuration);
    }
    (parts.into_values().collect(), bent)
}

fn swapped(Configuration { pose_a, pose_b }: Configuration) -> Configuration {
    Configuration { pose_a: pose_b, pose_b: pose_a }
}

/// Plugins are promised rotations. A rotation in single precision becomes the nearest one; what is further off is none.
fn straightened(configuration: &Configuration) -> Option<Configuration> {
    let one = |pose: &Pose| if pose.off_rotation() <= AS_IT_IS { Some(*pose) } else { pose.straightened() };
    Some(Configuration { pose_a: one(&configuration.pose_a)?, pose_b: one(&configuration.pose_b)? })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use ocb_core::workload::{Answered, Kind};

    use super::*;

    fn asked(sequence: u64, objects: [u32; 2], kind: Kind) -> Recorded {
        let pose_a = Pose { translation: Vector3::new(sequence as f64, 0.0, 0.0), ..Pose::identity() };
        Recorded {
            sequence,
            group: 0,
            objects,
            configuration: Configuration { pose_a, pose_b: Pose::identity() },
            kind,
            limit: 0.0,
            answered: Answered::default(),
            seconds: None,
            library: 0,
        }
    }

    #[test]
    fn a_pair_is_one_part_whichever_object_came_first() {
        let mut queries = vec![
            asked(1, [0, 1], Kind::Collide),
            asked(2, [1, 0], Kind::Collide),
            asked(3, [0, 1], Kind::Tolerance),
            asked(4, [1, 0], Kind::Distance),
            asked(5, [0, 1], Kind::Collide),
        ];
        queries[4].configuration.pose_b.linear *= 2.0;
        let (parts, bent) = parts(&queries);
        let rows: Vec<_> = parts.iter().map(|part| (part.objects, part.query, part.rows.clone())).collect();
        assert_eq!(rows, [([0, 1], Query::CollisionFirst, vec![0, 1]), ([0, 1], Query::Proximity, vec![2, 3])]);
        assert_eq!(bent, 1);
        let [first, second] = [0, 1].map(|i| parts[0].configurations[i]);
        assert_eq!([first.pose_a.translation.x, second.pose_b.translation.x], [1.0, 2.0]);
    }
}
