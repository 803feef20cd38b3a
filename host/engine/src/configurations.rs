//! Finding or reading the configurations of a run, each with its certified truth, on all CPUs.

use std::collections::HashSet;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use ocb_core::configuration::{Class, Configuration, ConfigurationSet, Method, Placed, Separation};
use ocb_core::oracle::{Pair, Shape};
use ocb_core::pose::Pose;
use ocb_core::sampling::sphere::{MAX_CONFIGURATIONS, Plan};
use rayon::prelude::*;

use crate::blobs::sha256_hex;
use crate::columns;
use crate::model::{ClassCount, RunSpec, SetInfo};
use crate::{EngineError, Result};

/// Changes whenever the same request would give another set or another truth; stored sets of older versions stay
/// readable but are not reused.
const GENERATOR: &str = "2";

/// What determines a set: the meshes, the method and the distance.
pub fn set_key(mesh_a: &str, mesh_b: &str, spec: &RunSpec) -> Result<String> {
    let method = serde_json::to_string(&spec.method).map_err(|e| EngineError::fault("Naming the method failed", e))?;
    let distance = spec.relative_distance;
    Ok(sha256_hex(format!("{GENERATOR}|{mesh_a}|{mesh_b}|{method}|{distance:?}").as_bytes()))
}

/// How far the work is, and whether it is still wanted. Shared between the workers and whoever reports.
#[derive(Default)]
pub struct Gauge {
    /// Configurations done.
    pub done: AtomicU64,
    /// Nobody wants the rest.
    pub stop: AtomicBool,
}

/// Finds the set, or certifies the given poses. `None` when it was stopped. `longest_side` is that of A's bounding box.
pub fn make(
    a: &Shape,
    b: &Shape,
    longest_side: f64,
    spec: &RunSpec,
    poses: Option<&[Configuration]>,
    gauge: &Gauge,
) -> Result<Option<ConfigurationSet>> {
    let found: Vec<Option<Placed>> = match (&spec.method, poses) {
        (Method::Sphere { sampling, seed }, _) => {
            let plan = Plan::new(a, b, sampling, spec.relative_distance, *seed)
                .map_err(|e| EngineError::Invalid(format!("These configurations cannot be found: {e}.")))?;
            on_all_cpus(plan.len(), gauge, |i| plan.place(i))
        }
        (Method::File { .. }, Some(poses)) => {
            let pair = Pair::new(a, b);
            on_all_cpus(poses.len() as u64, gauge, |i| {
                let configuration = poses[i as usize];
                Some(Placed { configuration, truth: pair.truth(&configuration), root_index: 0, wanted: None })
            })
        }
        (Method::File { .. }, None) => return Err(EngineError::Fault("The file of configurations is missing.".into())),
    };
    if gauge.stop.load(Ordering::Relaxed) {
        return Ok(None);
    }
    let missed_rays = found.iter().filter(|placed| placed.is_none()).count() as u32;
    let set = ConfigurationSet {
        method: spec.method.clone(),
        separation: match spec.method {
            Method::Sphere { .. } => Some(Separation::Relative { distance: spec.relative_distance }),
            Method::File { .. } => None,
        },
        longest_side,
        placed: found.into_iter().flatten().collect(),
        missed_rays,
    };
    if set.placed.is_empty() {
        return Err(EngineError::Invalid(format!(
            "On none of the {missed_rays} rays do the objects come to relative distance {}; choose another distance.",
            spec.relative_distance
        )));
    }
    Ok(Some(set))
}

fn on_all_cpus(len: u64, gauge: &Gauge, place: impl Fn(u64) -> Option<Placed> + Sync) -> Vec<Option<Placed>> {
    (0..len)
        .into_par_iter()
        .map(|i| {
            if gauge.stop.load(Ordering::Relaxed) {
                return None;
            }
            let placed = place(i);
            gauge.done.fetch_add(1, Ordering::Relaxed);
            placed
        })
        .collect()
}

/// The numbers of a set that pages and tables show.
pub fn describe(set: &ConfigurationSet, sha256: &str, triangles: [usize; 2]) -> SetInfo {
    let classes = [Class::Clear, Class::Colliding, Class::Grazing].map(|class| ClassCount {
        class,
        count: set.placed.iter().filter(|p| p.truth.class64 == class).count() as u32,
    });
    let coverage = |of: fn(&Placed) -> u32, all: usize| {
        set.placed.iter().map(of).collect::<HashSet<u32>>().len() as f64 / all as f64
    };
    SetInfo {
        sha256: sha256.to_owned(),
        configurations: set.placed.len() as u32,
        missed_rays: set.missed_rays,
        longest_side: set.longest_side,
        classes: classes.into_iter().filter(|c| c.count > 0).collect(),
        coverage_a: coverage(|p| p.truth.witness.triangle_a, triangles[0]),
        coverage_b: coverage(|p| p.truth.witness.triangle_b, triangles[1]),
    }
}

/// Reads a file of configurations: a Parquet set of ours, or raw little-endian f64 4x4 row-major matrices that place B
/// in A's frame.
pub fn read_file(bytes: &[u8]) -> Result<Vec<Configuration>> {
    let bad = |why: String| EngineError::Invalid(format!("This is no file of configurations: {why}."));
    let poses = if bytes.starts_with(b"PAR1") { columns::read_poses(bytes).map_err(bad)? } else { read_raw(bytes)? };
    match poses.len() as u64 {
        0 => Err(bad("it holds none".into())),
        n if n > MAX_CONFIGURATIONS => Err(bad(format!("it holds {n}, but at most {MAX_CONFIGURATIONS} are measured"))),
        _ => Ok(poses),
    }
}

const MATRIX_BYTES: usize = 16 * 8;

fn read_raw(bytes: &[u8]) -> Result<Vec<Configuration>> {
    let bad = |why: String| EngineError::Invalid(format!("This is no file of configurations: {why}."));
    if !bytes.len().is_multiple_of(MATRIX_BYTES) {
        return Err(bad(format!(
            "it is no Parquet file, and its {} bytes are no whole number of 4x4 matrices of 8-byte numbers (128 bytes each)",
            bytes.len()
        )));
    }
    let matrix = |(i, chunk): (usize, &[u8])| {
        let mut numbers = [0.0; 16];
        for (number, raw) in numbers.iter_mut().zip(chunk.as_chunks::<8>().0) {
            *number = f64::from_le_bytes(*raw);
        }
        let pose_b = Pose::from_row_major(&numbers).map_err(|e| bad(format!("matrix {}: {e}", i + 1)))?;
        Ok(Configuration { pose_a: Pose::identity(), pose_b })
    };
    bytes.chunks_exact(MATRIX_BYTES).enumerate().map(matrix).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(entries: [f64; 16]) -> Vec<u8> {
        entries.iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    const SHIFT: [f64; 16] = [1.0, 0.0, 0.0, 0.5, 0.0, 1.0, 0.0, -2.0, 0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0];

    #[test]
    fn raw_matrices_place_b_in_the_frame_of_a() {
        let read = read_file(&matrix(SHIFT)).unwrap();
        assert_eq!(read.len(), 1);
        assert_eq!(read[0].pose_a, Pose::identity());
        assert_eq!(read[0].pose_b.to_row_major(), SHIFT);
    }

    #[test]
    fn a_bad_file_is_refused_with_the_place() {
        let refused = |bytes: &[u8]| read_file(bytes).unwrap_err().to_string();
        assert_eq!(refused(&[]), "This is no file of configurations: it holds none.");
        assert!(refused(b"hello").contains("5 bytes are no whole number"));
        let mut nan = SHIFT;
        nan[3] = f64::NAN;
        let two = [matrix(SHIFT), matrix(nan)].concat();
        assert!(refused(&two).contains("matrix 2: matrix entry 3"), "{}", refused(&two));
        let mut last = SHIFT;
        last[12] = 1.0;
        assert!(refused(&matrix(last)).contains("last row"));
        assert!(refused(b"PAR1 but no more").starts_with("This is no file of configurations: "));
    }

    #[test]
    fn the_key_changes_with_everything_that_changes_the_set() {
        let spec = |distance: f64, count: u32| -> RunSpec {
            serde_json::from_value(serde_json::json!({
                "object_a": "x", "query": "proximity", "relative_distance": distance,
                "method": {"kind": "sphere", "sampling": {"kind": "count", "count": count}},
            }))
            .unwrap()
        };
        let key = |a: &str, distance, count| set_key(a, "b", &spec(distance, count)).unwrap();
        assert_eq!(key("a", 0.0, 5), key("a", 0.0, 5));
        let keys = HashSet::from([key("a", 0.0, 5), key("c", 0.0, 5), key("a", 0.1, 5), key("a", 0.0, 6)]);
        assert_eq!(keys.len(), 4);
    }
}
