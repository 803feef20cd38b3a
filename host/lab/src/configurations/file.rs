//! Poses that somebody brings: a Parquet set of ours, JSON, CSV, or raw f64. Each is checked; an error names the row.
//!
//! Matrices are row-major and place an object in the world. Where only B is placed, A stands where its file puts it.

use ocb_core::configuration::Configuration;
use ocb_core::pose::{AS_IT_IS, Pose, STRAIGHTENED};
use ocb_core::sampling::MAX_CONFIGURATIONS;
use serde::Deserialize;

use crate::columns;
use crate::{LabError, Result};

/// Numbers of a matrix larger than this are refused: beyond it f64 overflows, and all is left to slow integers.
const LARGEST: f64 = 1e60;
/// Numbers nearer to 0 than this, and not 0, are refused: exact arithmetic would pay for every digit.
const SMALLEST: f64 = 1e-100;
/// Bytes of one raw matrix.
const MATRIX_BYTES: usize = 16 * 8;

/// How a Parquet file begins.
const PARQUET: &[u8] = b"PAR1";

/// The content of a configuration file.
#[derive(Debug, PartialEq)]
pub struct ConfigurationFile {
    /// Every linear part is a rotation.
    pub poses: Vec<Configuration>,
    /// Number of configurations in which a single-precision rotation was replaced by the nearest rotation.
    pub straightened: usize,
}

impl ConfigurationFile {
    /// The note on the run, if any matrix was replaced.
    pub fn note(&self) -> Option<String> {
        let (some, all) = (self.straightened, self.poses.len());
        (some > 0).then(|| {
            format!("In {some} of {all} configurations a matrix is a rotation in single precision only; the nearest rotation is used.")
        })
    }
}

/// Reads a configuration file for a run, in which plugins are promised rotations.
pub fn read_file(bytes: &[u8]) -> Result<ConfigurationFile> {
    read(bytes).and_then(rotations).map_err(invalid)
}

/// The same of a stranger's file: all formats but Parquet, whose pages may claim to hold any amount.
pub fn read_text(bytes: &[u8]) -> Result<ConfigurationFile> {
    if bytes.starts_with(PARQUET) {
        return Err(invalid("Parquet files are read by the command only; send JSON, CSV or raw f64 matrices".into()));
    }
    read_file(bytes)
}

/// Reads a configuration file for the oracle alone, which accepts any matrix.
pub fn read_matrices(bytes: &[u8]) -> Result<Vec<Configuration>> {
    read(bytes).and_then(checked).map_err(invalid)
}

/// Rotations as they are or the nearest to them; numbers of rows in errors count from one.
pub(crate) fn rotations(poses: Vec<Configuration>) -> std::result::Result<ConfigurationFile, String> {
    checked(poses).and_then(straightened)
}

fn invalid(why: String) -> LabError {
    LabError::Invalid(format!("Not a configuration file: {why}."))
}

fn straightened(mut poses: Vec<Configuration>) -> std::result::Result<ConfigurationFile, String> {
    let mut straightened = 0;
    for (row, configuration) in (1..).zip(&mut poses) {
        let mut bent = false;
        for pose in [&mut configuration.pose_a, &mut configuration.pose_b] {
            let off = pose.off_rotation();
            if off > AS_IT_IS {
                *pose = pose.straightened().ok_or_else(|| no_rotation(row, off))?;
                bent = true;
            }
        }
        straightened += usize::from(bent);
    }
    Ok(ConfigurationFile { poses, straightened })
}

fn no_rotation(row: u32, off: f64) -> String {
    if off.is_infinite() {
        return format!("row {row}: the 3x3 part of a matrix must be a rotation, and this one mirrors or flattens");
    }
    format!(
        "row {row}: the 3x3 part R of a matrix must be a rotation, and R^T R is off by {off:.1e} (at most {STRAIGHTENED:.0e}); \
         apply scale and shear to the object instead"
    )
}

fn read(bytes: &[u8]) -> std::result::Result<Vec<Configuration>, String> {
    if bytes.starts_with(PARQUET) {
        return columns::read_poses(bytes);
    }
    // Text has no bytes below tab and is valid UTF-8; a raw matrix has a last row of seven zero bytes and more.
    match std::str::from_utf8(bytes) {
        Ok(text) if !text.is_empty() && !text.contains(|c: char| c < '\t') => {
            let text = text.trim_start_matches('\u{feff}');
            if text.trim_start().starts_with('[') { read_json(text) } else { read_csv(text) }
        }
        _ => read_raw(bytes),
    }
}

/// What costs without limit is stopped here, before the oracle meets it.
fn checked(poses: Vec<Configuration>) -> std::result::Result<Vec<Configuration>, String> {
    match poses.len() as u64 {
        0 => return Err("it has no configurations".into()),
        n if n > MAX_CONFIGURATIONS => {
            return Err(format!("it has {n} configurations, but at most {MAX_CONFIGURATIONS} are measured"));
        }
        _ => {}
    }
    for (row, configuration) in (1..).zip(&poses) {
        for pose in [&configuration.pose_a, &configuration.pose_b] {
            let bad = |x: &&f64| x.abs() > LARGEST || (**x != 0.0 && x.abs() < SMALLEST);
            if let Some(x) = pose.linear.iter().chain(pose.translation.iter()).find(bad) {
                return Err(format!(
                    "row {row}: the number {x:e} is out of range; it must be 0 or between {SMALLEST:e} and {LARGEST:e}"
                ));
            }
        }
    }
    Ok(poses)
}

/// B in A's frame.
fn placing_b(numbers: &[f64]) -> std::result::Result<Configuration, String> {
    Ok(Configuration { pose_a: Pose::identity(), pose_b: pose(numbers)? })
}

/// 16 numbers, or 12 without the last row.
fn pose(numbers: &[f64]) -> std::result::Result<Pose, String> {
    let mut matrix = Pose::identity().to_row_major();
    match numbers.len() {
        12 | 16 => matrix[..numbers.len()].copy_from_slice(numbers),
        n => return Err(format!("a matrix has 16 numbers, or 12 without its last row, not {n}")),
    }
    Pose::from_row_major(&matrix).map_err(|e| e.to_string())
}

fn read_raw(bytes: &[u8]) -> std::result::Result<Vec<Configuration>, String> {
    if !bytes.len().is_multiple_of(MATRIX_BYTES) {
        return Err(format!(
            "it is neither Parquet nor JSON nor CSV, and its {} bytes are not a whole number of 4x4 matrices of 8-byte \
             numbers (128 bytes each)",
            bytes.len()
        ));
    }
    let matrix = |(i, chunk): (usize, &[u8])| {
        let mut numbers = [0.0; 16];
        for (number, raw) in numbers.iter_mut().zip(chunk.as_chunks::<8>().0) {
            *number = f64::from_le_bytes(*raw);
        }
        placing_b(&numbers).map_err(|e| format!("matrix {}: {e}", i + 1))
    };
    bytes.chunks_exact(MATRIX_BYTES).enumerate().map(matrix).collect()
}

/// One matrix a line: 16 or 12 numbers separated by commas, semicolons, tabs or spaces. Empty lines and those that begin
/// with `#` are skipped, and so is a first line without any number.
fn read_csv(text: &str) -> std::result::Result<Vec<Configuration>, String> {
    let mut all = Vec::new();
    let mut first = true;
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let fields = || line.split([',', ';', '\t', ' ']).map(str::trim).filter(|field| !field.is_empty());
        let header = first && fields().all(|field| field.parse::<f64>().is_err());
        first = false;
        if !header {
            let number_of =
                |field: &str| field.parse().map_err(|_| format!("line {number}: {} is not a number", shown(field)));
            let numbers: Vec<f64> = fields().map(number_of).collect::<std::result::Result<_, _>>()?;
            all.push(placing_b(&numbers).map_err(|e| format!("line {number}: {e}"))?);
        }
    }
    Ok(all)
}

/// The beginning of what stands in a file, in quotes.
fn shown(text: &str) -> String {
    format!("{:?}", text.chars().take(40).collect::<String>())
}

/// One configuration of a JSON file.
#[derive(Deserialize)]
#[serde(untagged)]
enum Row {
    /// Four rows of four numbers.
    Rows(Vec<Vec<f64>>),
    /// 16 or 12 numbers.
    Numbers(Vec<f64>),
    /// Both objects are placed.
    Poses { pose_a: Matrix, pose_b: Matrix },
    /// Only B is.
    PoseB { pose_b: Matrix },
}

/// A row-major matrix.
#[derive(Deserialize)]
#[serde(untagged)]
pub(crate) enum Matrix {
    /// Four rows of four numbers.
    Rows(Vec<Vec<f64>>),
    /// 16 or 12 numbers.
    Numbers(Vec<f64>),
}

impl Matrix {
    /// The pose, if it has as many numbers as a matrix.
    pub(crate) fn pose(self) -> std::result::Result<Pose, String> {
        match self {
            Self::Numbers(numbers) => pose(&numbers),
            Self::Rows(rows) if rows.iter().any(|row| row.len() != 4) => {
                Err("every row of a matrix has 4 numbers".into())
            }
            Self::Rows(rows) => pose(&rows.concat()),
        }
    }
}

/// An array of matrices (4 rows of 4, or 16 or 12 numbers), or of objects `{"pose_a": ..., "pose_b": ...}` with such
/// matrices, of which `pose_a` may be missing.
fn read_json(text: &str) -> std::result::Result<Vec<Configuration>, String> {
    let rows: Vec<serde_json::Value> =
        serde_json::from_str(text).map_err(|e| format!("it is not a JSON array: {e}"))?;
    let configuration = |(number, row): (usize, serde_json::Value)| {
        let read = serde_json::from_value(row)
            .map_err(|_| "it is neither a matrix nor an object with pose_a and pose_b".to_owned())
            .and_then(|row| {
                let (pose_a, pose_b) = match row {
                    Row::Rows(rows) => (None, Matrix::Rows(rows)),
                    Row::Numbers(numbers) => (None, Matrix::Numbers(numbers)),
                    Row::Poses { pose_a, pose_b } => (Some(pose_a), pose_b),
                    Row::PoseB { pose_b } => (None, pose_b),
                };
                let pose_a = pose_a.map_or(Ok(Pose::identity()), Matrix::pose)?;
                Ok(Configuration { pose_a, pose_b: pose_b.pose()? })
            });
        read.map_err(|e| format!("row {}: {e}", number + 1))
    };
    rows.into_iter().enumerate().map(configuration).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHIFT: [f64; 16] = [1.0, 0.0, 0.0, 0.5, 0.0, 1.0, 0.0, -2.0, 0.0, 0.0, 1.0, 3.0, 0.0, 0.0, 0.0, 1.0];

    fn raw(entries: [f64; 16]) -> Vec<u8> {
        entries.iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    fn line(entries: &[f64], separator: &str) -> String {
        entries.iter().map(f64::to_string).collect::<Vec<_>>().join(separator)
    }

    fn shift() -> Configuration {
        Configuration { pose_a: Pose::identity(), pose_b: Pose::from_row_major(&SHIFT).expect("a pose") }
    }

    fn refused(bytes: &[u8]) -> String {
        read_file(bytes).expect_err("a bad file").to_string()
    }

    #[test]
    fn every_format_gives_the_same_poses() {
        let rows = format!(
            "[[{}],[{}],[{}],[{}]]",
            line(&SHIFT[..4], ","),
            line(&SHIFT[4..8], ","),
            line(&SHIFT[8..12], ","),
            line(&SHIFT[12..], ",")
        );
        let twelve = line(&SHIFT[..12], ",");
        let files = [
            raw(SHIFT),
            format!("# poses\n\n{}\n", line(&SHIFT, ",")).into_bytes(),
            format!("\u{feff}r00,r01,x,y\r\n{}\r\n", line(&SHIFT[..12], " ; ")).into_bytes(),
            line(&SHIFT[..12], "\t").into_bytes(),
            format!("[{rows}]").into_bytes(),
            format!(" [[{twelve}]]").into_bytes(),
            format!("[{{\"pose_b\": [{twelve}]}}]").into_bytes(),
            format!("[{{\"pose_a\": [1,0,0,0,0,1,0,0,0,0,1,0], \"pose_b\": {rows}}}]").into_bytes(),
        ];
        for file in files {
            let brought = read_file(&file).expect("a good file");
            assert_eq!(
                (brought.poses, brought.straightened),
                (vec![shift()], 0),
                "{:?}",
                String::from_utf8_lossy(&file)
            );
        }
        // A number that a hasty reader would round to its neighbour.
        let exact = 0.516_213_402_387_451_1_f64;
        let moved = format!("[[1,0,0,{exact},0,1,0,-2.5e0,0,0,1,3]]");
        assert_eq!(read_file(moved.as_bytes()).expect("a good file").poses[0].pose_b.translation.x, exact);
        let both = format!("[{{\"pose_a\": [{twelve}], \"pose_b\": [{twelve}]}}]");
        assert_eq!(read_file(both.as_bytes()).expect("a good file").poses[0].pose_a, shift().pose_b);
    }

    #[test]
    fn a_bad_file_is_refused_with_the_place() {
        assert_eq!(refused(&[]), "Not a configuration file: it has no configurations.");
        assert_eq!(refused(b"# nothing\n"), "Not a configuration file: it has no configurations.");
        assert!(refused(&[0; 5]).contains("5 bytes are not a whole number"));
        let with = |i: usize, x: f64| {
            let mut m = SHIFT;
            m[i] = x;
            m
        };
        let two = [raw(SHIFT), raw(with(3, f64::NAN))].concat();
        assert!(refused(&two).contains("matrix 2: matrix entry 3"), "{}", refused(&two));
        assert!(refused(&raw(with(12, 1.0))).contains("last row"));
        assert!(refused(b"PAR1 but no more").starts_with("Not a configuration file: "));
        let good = line(&SHIFT, ",");
        let text = |s: String| refused(s.as_bytes());
        assert!(text(format!("{good}\n1,2,x")).contains("line 2: \"x\" is not a number"));
        assert!(text(format!("{good}\n1,2,3")).contains("line 2: a matrix has 16 numbers, or 12"));
        assert!(text("a,b\nc,d".to_owned()).contains("line 2: \"c\" is not a number"));
        assert!(text(format!("{good}\n{}", line(&with(0, f64::INFINITY), ","))).contains("line 2: matrix entry 0"));
        assert!(text("[1, 2]".to_owned()).contains("row 1: it is neither a matrix"));
        assert!(text("[[1,2,3-4,5,6,7,8,9,10,11,12,13]]".to_owned()).contains("not a JSON array: expected"));
        assert!(text("[[1,2,3],".to_owned()).contains("not a JSON array"));
        assert!(text("[[[1,2],[3,4]]]".to_owned()).contains("row 1: every row of a matrix has 4 numbers"));
    }

    #[test]
    fn numbers_beyond_all_objects_are_refused() {
        for x in [1e61, -1e300, 1e-101, 5e-324] {
            let mut far = SHIFT;
            far[3] = x;
            let file = [raw(SHIFT), raw(far)].concat();
            assert!(refused(&file).contains("row 2: the number"), "{}", refused(&file));
        }
    }

    /// A turn about z by so much, whose first column is longer by this share.
    fn turned(angle: f64, longer: f64) -> [f64; 16] {
        let (s, c) = angle.sin_cos();
        let (x, y) = (c * (1.0 + longer), s * (1.0 + longer));
        [x, -s, 0.0, 0.5, y, c, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    }

    #[test]
    fn near_rotations_are_straightened_and_other_matrices_refused() {
        let read = |longer: f64| read_file(&[raw(SHIFT), raw(turned(0.7, longer))].concat());
        for as_it_is in [0.0, 1e-13] {
            let brought = read(as_it_is).expect("a good file");
            assert_eq!(brought.straightened, 0);
            assert_eq!(brought.poses[1].pose_b.to_row_major(), turned(0.7, as_it_is), "taken as it is");
        }
        let brought = read(1e-7).expect("a good file");
        assert_eq!(brought.straightened, 1);
        let [exact, mended] = [turned(0.7, 0.0), brought.poses[1].pose_b.to_row_major()];
        assert!(exact.iter().zip(mended).all(|(a, b)| (a - b).abs() < 2e-7), "{mended:?}");
        assert!(brought.poses[1].pose_b.off_rotation() < 1e-15);
        assert!(brought.note().is_some_and(|note| note.contains("1 of 2 configurations")));
        // As a program in single precision writes it.
        let single = turned(0.7, 0.0).map(|x| f64::from(x as f32));
        assert_eq!(read_file(&raw(single)).expect("a good file").straightened, 1);

        let told = read(0.01).expect_err("it scales").to_string();
        assert!(told.contains("row 2") && told.contains("off by 2.0e-2"), "{told}");
        let mut mirror = SHIFT;
        mirror[0] = -1.0;
        assert!(refused(&raw(mirror)).contains("row 1: the 3x3 part of a matrix must be a rotation"));
        let mut flat = SHIFT;
        flat[0] = 0.0;
        assert!(refused(&raw(flat)).contains("flattens"));
    }
}
