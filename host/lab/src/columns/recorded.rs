//! Recorded queries, one row each.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, BooleanArray, Float64Array, RecordBatch, StringArray, UInt32Array, UInt64Array};
use ocb_core::configuration::Configuration;
use ocb_core::workload::{Answered, Kind, Recorded};

use super::lists::{Poses, lists};
use super::{SCHEMA_VERSION, batch, column, from_parquet, to_parquet};
use crate::Result;

/// The queries as Parquet. Poses are the first three rows of the 4x4 matrix, row-major, bit for bit.
pub fn recorded_parquet(rows: &[Recorded]) -> Result<Vec<u8>> {
    let metadata = HashMap::from([("opencollbench.schema".to_owned(), SCHEMA_VERSION.to_owned())]);
    let numbers = |of: fn(&Recorded) -> u64| Arc::new(rows.iter().map(of).collect::<UInt64Array>()) as ArrayRef;
    let places = |of: fn(&Recorded) -> u32| Arc::new(rows.iter().map(of).collect::<UInt32Array>()) as ArrayRef;
    let lengths =
        |of: fn(&Recorded) -> Option<f64>| Arc::new(rows.iter().map(of).collect::<Float64Array>()) as ArrayRef;
    let columns = vec![
        ("sequence", numbers(|row| row.sequence)),
        ("group", numbers(|row| row.group)),
        ("object_a", places(|row| row.objects[0])),
        ("object_b", places(|row| row.objects[1])),
        ("pose_a", lists(rows, 12, |row| row.configuration.pose_a.to_row_major()[..12].to_vec())?),
        ("pose_b", lists(rows, 12, |row| row.configuration.pose_b.to_row_major()[..12].to_vec())?),
        ("kind", Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.kind.name()))) as ArrayRef),
        ("limit", lengths(|row| Some(row.limit))),
        ("hit", Arc::new(rows.iter().map(|row| row.answered.hit).collect::<BooleanArray>()) as ArrayRef),
        ("distance", lengths(|row| row.answered.distance)),
        ("seconds", lengths(|row| row.seconds)),
        ("library", places(|row| row.library)),
    ];
    to_parquet(&batch(metadata, columns)?)
}

/// Reads them back; the file may be anybody's, and `objects` is how many there are in its scene.
pub fn read_recorded(bytes: &[u8], objects: usize) -> std::result::Result<Vec<Recorded>, String> {
    let mut all = Vec::new();
    for batch in &from_parquet(bytes)?.1 {
        let before = all.len();
        rows(batch, objects, &mut all).map_err(|(row, why)| format!("row {}: {why}", before + row + 1))?;
    }
    Ok(all)
}

fn rows(batch: &RecordBatch, objects: usize, all: &mut Vec<Recorded>) -> std::result::Result<(), (usize, String)> {
    let whole = |why| (0, why);
    let numbers = |name| column::<UInt64Array>(batch, name).map_err(whole);
    let places = |name| column::<UInt32Array>(batch, name).map_err(whole);
    let lengths = |name| column::<Float64Array>(batch, name).map_err(whole);
    let (sequence, group, library) = (numbers("sequence")?, numbers("group")?, places("library")?);
    let (a, b) = (places("object_a")?, places("object_b")?);
    let (limit, distance, seconds) = (lengths("limit")?, lengths("distance")?, lengths("seconds")?);
    let kind = column::<StringArray>(batch, "kind").map_err(whole)?;
    let hit = column::<BooleanArray>(batch, "hit").map_err(whole)?;
    let poses = |name| Poses::of(batch, name).map_err(whole);
    let (pose_a, pose_b) = (poses("pose_a")?, poses("pose_b")?);
    let known = |column: &Float64Array, row| column.is_valid(row).then(|| column.value(row));
    for row in 0..batch.num_rows() {
        let at = |why: String| (row, why);
        let objects_of = [a.value(row), b.value(row)];
        if let Some(place) = objects_of.into_iter().find(|&place| place as usize >= objects) {
            return Err(at(format!("there is no object {place}, the scene has {objects}")));
        }
        let kind = kind.value(row);
        let kind = Kind::named(kind).ok_or_else(|| at(format!("{kind:?} is no kind of query")))?;
        all.push(Recorded {
            sequence: sequence.value(row),
            group: group.value(row),
            objects: objects_of,
            configuration: Configuration { pose_a: pose_a.row(row).map_err(at)?, pose_b: pose_b.row(row).map_err(at)? },
            kind,
            limit: limit.value(row),
            answered: Answered { hit: hit.is_valid(row).then(|| hit.value(row)), distance: known(distance, row) },
            seconds: known(seconds, row),
            library: library.value(row),
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use ocb_core::pose::Pose;

    use super::*;

    fn row(number: u64) -> Recorded {
        let pose_b = Pose { translation: Vector3::new(1.0 / 3.0, number as f64, -0.0), ..Pose::identity() };
        Recorded {
            sequence: number << 40,
            group: number / 2,
            objects: [0, 1],
            configuration: Configuration { pose_a: Pose::identity(), pose_b },
            kind: Kind::NAMES[number as usize % 4].0,
            limit: 0.1 * number as f64,
            answered: Answered { hit: (number > 0).then_some(number == 1), distance: (number == 2).then_some(0.1) },
            seconds: (number == 3).then_some(1e-6),
            library: number as u32,
        }
    }

    #[test]
    fn queries_come_back_bit_for_bit() {
        let all: Vec<Recorded> = (0..9).map(row).collect();
        let file = recorded_parquet(&all).unwrap();
        assert_eq!(read_recorded(&file, 2).unwrap(), all);
    }

    #[test]
    fn what_is_no_query_of_the_scene_is_refused_with_its_row() {
        let mut all: Vec<Recorded> = (0..3).map(row).collect();
        all[2].objects = [1, 7];
        let told = read_recorded(&recorded_parquet(&all).unwrap(), 2).unwrap_err();
        assert_eq!(told, "row 3: there is no object 7, the scene has 2");
        assert!(read_recorded(b"PAR1", 2).is_err());
    }
}
