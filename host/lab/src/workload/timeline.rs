//! A recording in its own order, in parts.

use ocb_core::workload::Recorded;

use crate::model::{Timeline, TimelineSeries, Track};

use super::tally::Tally;

/// So many parts at most.
const PARTS: usize = 400;

/// Which query belongs to which part.
pub struct Parts {
    part_of: Vec<u32>,
    /// The first query of each part.
    from: Vec<u64>,
}

impl Parts {
    /// Cuts between groups, the queries being in the order of the recording.
    pub fn of(queries: &[Recorded]) -> Self {
        let length = queries.len().div_ceil(PARTS).max(1);
        let (mut part_of, mut from, mut within) = (Vec::with_capacity(queries.len()), Vec::new(), 0);
        for (i, query) in queries.iter().enumerate() {
            let begins = i == 0 || queries[i - 1].group != query.group;
            if i == 0 || begins && within >= length {
                from.push(query.sequence);
                within = 0;
            }
            within += 1;
            part_of.push(from.len() as u32 - 1);
        }
        Self { part_of, from }
    }

    /// Adds up the queries that were replayed, of which it is known whether the objects collide, and each algorithm's times.
    pub fn timeline(&self, hits: &[Option<bool>], tallies: &[(Track, &[Tally])]) -> Timeline {
        let count = |of: fn(bool) -> bool| {
            let mut counts = vec![0; self.from.len()];
            for (part, _) in self.part_of.iter().zip(hits).filter(|(_, hit)| hit.is_some_and(of)) {
                counts[*part as usize] += 1;
            }
            counts
        };
        let each = |(track, tallies): &(Track, &[Tally])| {
            let track = *track;
            tallies.iter().map(move |tally| self.series(tally, track)).collect::<Vec<_>>()
        };
        Timeline {
            from: self.from.clone(),
            queries: count(|_| true),
            hits: count(|hit| hit),
            series: tallies.iter().flat_map(each).collect(),
        }
    }

    fn series(&self, tally: &Tally, track: Track) -> TimelineSeries {
        let zero = vec![0; self.from.len()];
        let algorithm = tally.algorithm().to_owned();
        let mut series =
            TimelineSeries { algorithm, track, n: zero.clone(), ns: vec![0.0; self.from.len()], wrong: zero };
        for (row, ns, verdict) in tally.answered() {
            let part = self.part_of[*row as usize] as usize;
            series.n[part] += 1;
            series.ns[part] += ns;
            series.wrong[part] += u64::from(verdict.is_wrong());
        }
        series
    }
}

#[cfg(test)]
mod tests {
    use ocb_core::configuration::Configuration;
    use ocb_core::pose::Pose;
    use ocb_core::workload::{Answered, Kind};

    use super::*;

    fn queries(groups: impl Iterator<Item = u64>) -> Vec<Recorded> {
        let pose = Pose::identity();
        let query = |(sequence, group)| Recorded {
            sequence,
            group,
            objects: [0, 1],
            configuration: Configuration { pose_a: pose, pose_b: pose },
            kind: Kind::NAMES[0].0,
            limit: 0.0,
            answered: Answered { hit: None, distance: None },
            seconds: None,
            library: 0,
        };
        (10..).zip(groups).map(query).collect()
    }

    #[test]
    fn parts_are_cut_between_groups() {
        // One group of 1,000 among those of 3: parts of 10 queries at least, which it joins where one is still shorter.
        let groups = (0..1000).map(|i| i / 3).chain((0..1000).map(|_| 5000)).chain((0..2000).map(|i| 6000 + i / 3));
        let parts = Parts::of(&queries(groups));
        assert_eq!(parts.from[..3], [10, 22, 34]);
        let lengths: Vec<usize> =
            (0..parts.from.len()).map(|part| parts.part_of.iter().filter(|of| **of as usize == part).count()).collect();
        assert_eq!((lengths.iter().sum::<usize>(), *lengths.iter().max().unwrap()), (4000, 1004));
        assert!(lengths.len() < PARTS && lengths[..80].iter().all(|length| *length == 12));
    }

    #[test]
    fn what_was_not_replayed_is_not_counted() {
        let parts = Parts::of(&queries(0..4));
        let timeline = parts.timeline(&[Some(true), None, Some(false), Some(true)], &[]);
        assert_eq!(
            (timeline.from, timeline.queries, timeline.hits),
            (vec![10, 11, 12, 13], vec![1, 0, 1, 1], vec![1, 0, 0, 1])
        );
    }
}
