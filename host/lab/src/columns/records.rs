//! The records of one algorithm.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, RecordBatch, StringArray, UInt32Array, UInt64Array};
use ocb_core::agreement::Said;
use ocb_core::record::{ContactScore, Record, Verdict};
use serde::{Deserialize, Serialize};

use super::answers::{Flat, Pointers};
use super::{SCHEMA_VERSION, batch, column, from_parquet, to_parquet};
use crate::model::Claim;
use crate::{LabError, Result};

/// What the file says of itself.
pub struct RecordsOf<'a> {
    /// Id of the run.
    pub run: &'a str,
    /// Algorithm id.
    pub algorithm: &'a str,
    /// SHA-256 of the plugin file.
    pub plugin_sha256: &'a str,
    /// Hardware class of the machine.
    pub hardware_class: &'a str,
    /// SHA-256 of the stored configuration set.
    pub set_sha256: &'a str,
    /// The algorithm got coordinates rounded to single precision, or those of the files; absent where both are the same.
    pub rounded: Option<bool>,
}

impl RecordsOf<'_> {
    /// As the files say it.
    pub fn metadata(&self) -> HashMap<String, String> {
        HashMap::from(
            [
                ("opencollbench.schema", SCHEMA_VERSION),
                ("opencollbench.version", env!("CARGO_PKG_VERSION")),
                ("opencollbench.run", self.run),
                ("opencollbench.algorithm", self.algorithm),
                ("opencollbench.plugin_sha256", self.plugin_sha256),
                ("opencollbench.hardware_class", self.hardware_class),
                ("opencollbench.set_sha256", self.set_sha256),
            ]
            .map(|(key, value)| (key.to_owned(), value.to_owned())),
        )
    }
}

/// What the heatmap and the charts need of the records, in the file's order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RecordColumns {
    /// Index of the configuration in its set.
    pub configuration: Vec<u32>,
    /// Nanoseconds.
    pub time_ns: Vec<f64>,
    /// BV tests, where counted.
    pub bv_tests: Vec<Option<u64>>,
    /// Primitive tests, where counted.
    pub primitive_tests: Vec<Option<u64>>,
    /// Comparison with the truth.
    pub verdict: Vec<Verdict>,
    /// What the answer came down to.
    pub said: Vec<Said>,
    /// Answers that contradict the first one; nothing in files of versions that did not count them.
    pub flips: Vec<Option<u32>>,
    /// What the wrong answers point at, by row.
    pub claims: HashMap<usize, Claim>,
}

impl RecordColumns {
    /// Those of records that no file has.
    pub fn of(records: &[Record]) -> Self {
        let mut all = Self::default();
        for (row, record) in records.iter().enumerate() {
            let flat = Flat::from(&record.answer);
            all.configuration.push(record.configuration);
            all.time_ns.push(record.time_ns);
            all.bv_tests.push(record.counters.and_then(|c| c.bv_tests));
            all.primitive_tests.push(record.counters.and_then(|c| c.primitive_tests));
            all.verdict.push(record.verdict);
            all.said.push(said(flat.hit, flat.distance));
            all.flips.push(Some(record.flips));
            if record.verdict.is_wrong() {
                let points = flat.points.map(|both| both.map(|p| [p.x, p.y, p.z]));
                all.claims.extend(claim(flat.triangles, points).map(|claim| (row, claim)));
            }
        }
        all
    }

    /// Were tests counted for one of them?
    pub fn has_tests(&self) -> bool {
        self.bv_tests.iter().chain(&self.primitive_tests).any(Option::is_some)
    }

    /// Takes the tests that were counted for the same configurations before.
    pub fn take_tests(&mut self, from: &Self) {
        let rows: HashMap<u32, usize> = from.configuration.iter().copied().zip(0..).collect();
        for (row, number) in self.configuration.iter().enumerate() {
            if let Some(&of) = rows.get(number) {
                (self.bv_tests[row], self.primitive_tests[row]) = (from.bv_tests[of], from.primitive_tests[of]);
            }
        }
    }

    /// Do the columns belong together, and their rows to a set of so many configurations?
    pub fn fits(&self, configurations: u32) -> bool {
        let n = self.configuration.len();
        let lengths = [self.time_ns.len(), self.bv_tests.len(), self.primitive_tests.len(), self.verdict.len()];
        lengths.into_iter().chain([self.said.len(), self.flips.len()]).all(|length| length == n)
            && self.configuration.iter().all(|number| *number < configurations)
            && self.claims.keys().all(|row| *row < n)
    }

    /// All rows, or those of the configurations that are `chosen`.
    pub fn rows(&self, chosen: Option<&[bool]>) -> impl Iterator<Item = usize> {
        let is_chosen = move |row: &usize| chosen.is_none_or(|all| all[self.configuration[*row] as usize]);
        (0..self.configuration.len()).filter(is_chosen)
    }
}

fn claim(triangles: Option<[u32; 2]>, points: Option<[[f64; 3]; 2]>) -> Option<Claim> {
    (triangles.is_some() || points.is_some()).then_some(Claim { triangles, points })
}

fn said(hit: Option<bool>, distance: Option<f64>) -> Said {
    match (hit, distance) {
        (Some(hit), _) => Said::Decision(hit),
        (None, Some(distance)) if distance.is_finite() => Said::Distance(distance),
        _ => Said::Nothing,
    }
}

/// The records as Parquet, one row per measured configuration.
pub fn records_parquet(of: &RecordsOf, records: &[Record]) -> Result<Vec<u8>> {
    let answers: Vec<Flat> = records.iter().map(|r| Flat::from(&r.answer)).collect();
    let points = |side: usize, axis: usize| -> Arc<Float64Array> {
        Arc::new(answers.iter().map(|a| a.points.map(|p| p[side][axis])).collect())
    };
    let triangles =
        |side: usize| -> Arc<UInt32Array> { Arc::new(answers.iter().map(|a| a.triangles.map(|t| t[side])).collect()) };
    let score = |of: fn(&ContactScore) -> Option<f64>| -> Arc<Float64Array> {
        Arc::new(records.iter().map(|r| r.contacts.as_ref().and_then(of)).collect())
    };
    let mut columns: Vec<(&str, ArrayRef)> = vec![
        ("configuration", Arc::new(records.iter().map(|r| r.configuration).collect::<UInt32Array>())),
        ("time_ns", Arc::new(records.iter().map(|r| r.time_ns).collect::<Float64Array>())),
        ("below_resolution", Arc::new(records.iter().map(|r| Some(r.below_resolution)).collect::<BooleanArray>())),
        ("passes", Arc::new(records.iter().map(|r| r.passes).collect::<UInt32Array>())),
        ("bv_tests", Arc::new(records.iter().map(|r| r.counters.and_then(|c| c.bv_tests)).collect::<UInt64Array>())),
        (
            "primitive_tests",
            Arc::new(records.iter().map(|r| r.counters.and_then(|c| c.primitive_tests)).collect::<UInt64Array>()),
        ),
        ("verdict", Arc::new(records.iter().map(|r| Some(r.verdict.name())).collect::<StringArray>())),
        ("answer", Arc::new(answers.iter().map(|a| Some(a.kind)).collect::<StringArray>())),
        ("hit", Arc::new(answers.iter().map(|a| a.hit).collect::<BooleanArray>())),
        ("contacts", Arc::new(answers.iter().map(|a| a.contacts).collect::<UInt64Array>())),
        ("precision", score(ContactScore::precision)),
        ("recall", score(ContactScore::recall)),
        ("distance", Arc::new(answers.iter().map(|a| a.distance).collect::<Float64Array>())),
        ("triangle_a", triangles(0)),
        ("triangle_b", triangles(1)),
        ("point_a_x", points(0, 0)),
        ("point_a_y", points(0, 1)),
        ("point_a_z", points(0, 2)),
        ("point_b_x", points(1, 0)),
        ("point_b_y", points(1, 1)),
        ("point_b_z", points(1, 2)),
        ("flips", Arc::new(records.iter().map(|r| r.flips).collect::<UInt32Array>())),
        ("process", Arc::new(records.iter().map(|r| r.asked.process).collect::<UInt32Array>())),
        ("instance", Arc::new(records.iter().map(|r| r.asked.instance.number).collect::<UInt32Array>())),
        ("aside", Arc::new(records.iter().map(|r| Some(r.asked.instance.aside)).collect::<BooleanArray>())),
        ("contacts_sha256", Arc::new(answers.iter().map(|a| a.contacts_sha256.as_deref()).collect::<StringArray>())),
    ];
    if let Some(rounded) = of.rounded {
        columns.push(("rounded", Arc::new(BooleanArray::from(vec![rounded; records.len()]))));
    }
    to_parquet(&batch(of.metadata(), columns)?)
}

/// Reads back what [`records_parquet`] wrote.
pub fn read_records(bytes: &[u8]) -> Result<RecordColumns> {
    let damaged = |e: String| LabError::Fault(format!("A stored file of records cannot be read: {e}."));
    let (_, batches) = from_parquet(bytes).map_err(damaged)?;
    let mut all = RecordColumns::default();
    for batch in &batches {
        all.append(batch).map_err(damaged)?;
    }
    Ok(all)
}

impl RecordColumns {
    fn append(&mut self, batch: &RecordBatch) -> std::result::Result<(), String> {
        let before = self.configuration.len();
        self.configuration.extend_from_slice(column::<UInt32Array>(batch, "configuration")?.values());
        self.time_ns.extend_from_slice(column::<Float64Array>(batch, "time_ns")?.values());
        self.bv_tests.extend(column::<UInt64Array>(batch, "bv_tests")?.iter());
        self.primitive_tests.extend(column::<UInt64Array>(batch, "primitive_tests")?.iter());
        for name in column::<StringArray>(batch, "verdict")?.iter() {
            let known = name.and_then(Verdict::named);
            self.verdict.push(known.ok_or_else(|| format!("{name:?} is not a verdict"))?);
        }
        let hits = column::<BooleanArray>(batch, "hit")?.iter();
        let distances = column::<Float64Array>(batch, "distance")?.iter();
        self.said.extend(hits.zip(distances).map(|(hit, distance)| said(hit, distance)));
        match column::<UInt32Array>(batch, "flips") {
            Ok(flips) => self.flips.extend(flips.iter()),
            Err(_) => self.flips.extend(std::iter::repeat_n(None, batch.num_rows())),
        }
        let pointers = Pointers::of(batch)?;
        for row in (0..batch.num_rows()).filter(|row| self.verdict[before + row].is_wrong()) {
            let points = pointers.points(row).map(|both| both.map(|p| [p.x, p.y, p.z]));
            self.claims.extend(claim(pointers.triangles(row), points).map(|claim| (before + row, claim)));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{csv, read_answers};
    use ocb_core::instance::{AskedAs, Instance};
    use ocb_core::query::{Answer, Counters};

    fn asked(configuration: u32) -> AskedAs {
        let instance = Instance { number: 2 * configuration, aside: configuration == 7 };
        AskedAs { process: (configuration != 2).then_some(configuration), instance }
    }

    fn record(configuration: u32, answer: Answer, counters: Option<Counters>) -> Record {
        Record {
            configuration,
            time_ns: 120.5 + f64::from(configuration),
            below_resolution: configuration == 1,
            passes: 3,
            counters,
            verdict: Verdict::Correct,
            contacts: matches!(answer, Answer::Contacts { .. }).then_some(ContactScore {
                listed: 2,
                genuine: 1,
                robust: 4,
                found: Some(1),
            }),
            flips: configuration,
            answer,
            asked: asked(configuration),
        }
    }

    #[test]
    fn what_a_wrong_answer_points_at_comes_back_with_its_row() {
        let hit = |pair| Answer::Collision { hit: true, pair };
        let [a, b] = [nalgebra::Point3::new(1.0, 2.0, 3.0), nalgebra::Point3::new(4.0, 5.0, 6.0)];
        let near = Answer::Distance { distance: 0.25, points: Some([a, b]), triangles: None };
        let wrong =
            |configuration, answer| Record { verdict: Verdict::WrongWitness, ..record(configuration, answer, None) };
        let records =
            [record(0, hit(Some([1, 2])), None), wrong(1, hit(Some([3, 4]))), wrong(2, hit(None)), wrong(3, near)];
        let of = RecordsOf {
            run: "r",
            algorithm: "a",
            plugin_sha256: "p",
            hardware_class: "h",
            set_sha256: "s",
            rounded: None,
        };
        let read = read_records(&records_parquet(&of, &records).unwrap()).unwrap();
        assert_eq!(read, RecordColumns::of(&records));
        let sent: RecordColumns = serde_json::from_str(&serde_json::to_string(&read).unwrap()).unwrap();
        assert_eq!(sent, read, "as machines send it");
        let claims = read.claims;
        let points = Some([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        let expected = [(1, Claim { triangles: Some([3, 4]), points: None }), (3, Claim { triangles: None, points })];
        assert_eq!(claims, HashMap::from(expected));
    }

    #[test]
    fn records_come_back_from_parquet_and_read_well_as_csv() {
        let records = [
            record(
                7,
                Answer::Collision { hit: true, pair: Some([3, 4]) },
                Some(Counters { bv_tests: Some(9), primitive_tests: Some(2) }),
            ),
            record(1, Answer::Distance { distance: 0.25, points: None, triangles: None }, None),
            record(2, Answer::GaveUp, None),
            record(3, Answer::Contacts { total: 2, pairs: vec![[1, 1], [1, 2]] }, None),
        ];
        let of = RecordsOf {
            run: "r",
            algorithm: "a",
            plugin_sha256: "p",
            hardware_class: "h",
            set_sha256: "s",
            rounded: None,
        };
        let file = records_parquet(&of, &records).unwrap();
        let columns = read_records(&file).unwrap();
        assert_eq!(columns, RecordColumns::of(&records));
        assert_eq!(columns.configuration, [7, 1, 2, 3]);
        assert_eq!(columns.time_ns, [127.5, 121.5, 122.5, 123.5]);
        assert_eq!(columns.bv_tests, [Some(9), None, None, None]);
        assert_eq!(columns.primitive_tests, [Some(2), None, None, None]);
        assert_eq!(columns.flips, [7, 1, 2, 3].map(Some));
        assert_eq!(columns.said, [Said::Decision(true), Said::Distance(0.25), Said::Nothing, Said::Decision(true)]);
        assert_eq!(columns.verdict, [Verdict::Correct; 4]);
        assert!(columns.claims.is_empty());
        let two = crate::columns::select(&file, &[false, true, false, true, true, true, true, false]).unwrap();
        assert_eq!(read_records(&two).unwrap().configuration, [1, 3]);
        let csv = String::from_utf8(csv(&file).unwrap()).unwrap();
        let lines: Vec<&str> = csv.lines().collect();
        assert!(lines[0].starts_with("configuration,time_ns,below_resolution,passes,bv_tests"), "{}", lines[0]);
        assert_eq!(lines[1], "7,127.5,false,3,9,2,correct,collision,true,,,,,3,4,,,,,,,7,7,14,true,");
        assert_eq!(lines[2], "1,121.5,true,3,,,correct,distance,,,,,0.25,,,,,,,,,1,1,2,false,");
        assert_eq!(lines[3], "2,122.5,false,3,,,correct,gave_up,,,,,,,,,,,,,,2,,4,false,");
        let list = "3,123.5,false,3,,,correct,contacts,true,2,0.5,0.25,,,,,,,,,,3,3,6,false,";
        assert!(lines[4].strip_prefix(list).is_some_and(|hash| hash.len() == 64), "{}", lines[4]);
        assert_eq!(lines.len(), 5);
        let told = RecordsOf { rounded: Some(true), ..of };
        let told = String::from_utf8(crate::columns::csv(&records_parquet(&told, &records).unwrap()).unwrap()).unwrap();
        assert!(told.lines().next().is_some_and(|head| head.ends_with(",rounded")), "{told}");
        assert_eq!(told.lines().filter(|line| line.ends_with(",true")).count(), records.len(), "{told}");
        // For a replay: as what each was asked, and every bit of it.
        let answers = read_answers(&file).unwrap();
        for (read, record) in answers.iter().zip(&records) {
            assert_eq!((read.configuration, read.asked), (record.configuration, asked(record.configuration)));
            assert!(read.answer.is_same(&Flat::from(&record.answer)));
        }
        assert_eq!(answers.len(), 4);
        let (schema, _) = from_parquet(&file).unwrap();
        assert_eq!(schema.metadata().get("opencollbench.run").map(String::as_str), Some("r"));
    }
}
