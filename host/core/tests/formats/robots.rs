//! trimesh finds the same triangles in the meshes of real robots: 777 files of `example-robot-data` from PyPI.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};

use ocb_core::mesh::{FileFormat, read};

/// Where `tests/setup/tools.sh` installs both.
const INSTALLED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../.tools/robots");

/// Largest difference that single precision explains, as a share of the object's largest coordinate: trimesh reads COLLADA's
/// transforms in single precision.
const ROUNDING: f64 = 16.0 / (1 << 24) as f64;

/// The corners of each triangle.
type Soup = Vec<[[f64; 3]; 3]>;

/// How the triangles of two readers agree; the first that applies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Agreement {
    /// Bit by bit, in the same order.
    Identical,
    /// Bit by bit, but triangles come in another order or begin at another corner.
    AnotherOrder,
    /// In the same order, up to the rounding of transforms.
    Rounded,
    /// As many triangles over the same corners, up to rounding: a face of four or more corners was cut differently.
    DifferentlyCut,
    /// trimesh finds nothing: its reader drops a geometry whose material names a picture that the file does not declare.
    NothingThere,
    /// None of these.
    Different,
}

#[test]
fn trimesh_finds_the_same_triangles_in_the_files_of_robots() {
    use Agreement::{AnotherOrder, DifferentlyCut, Identical, NothingThere, Rounded};
    use FileFormat::{Collada, Obj, Stl};
    let files = files();
    let mut trimesh = Trimesh::start(&files);
    let mut found = BTreeMap::new();
    let mut different = Vec::new();
    for file in &files {
        let theirs = trimesh.next();
        let read = read(&std::fs::read(file).expect("the file")).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let ours = (0..read.mesh.triangles().len() as u32).map(|t| read.mesh.corners(t).map(Into::into)).collect();
        let how = agreement(&in_its_precision(ours, read.format), &in_its_precision(theirs, read.format));
        if how == Agreement::Different {
            different.push(file);
        }
        *found.entry((read.format.to_string(), how)).or_insert(0) += 1;
    }
    assert!(trimesh.process.wait().expect("it ends").success());
    assert!(different.is_empty(), "{different:?}");
    let expected = [
        (Stl, Identical, 410),
        (Obj, Identical, 51),
        (Obj, AnotherOrder, 19),
        (Obj, DifferentlyCut, 11),
        (Collada, Identical, 125),
        (Collada, AnotherOrder, 49),
        (Collada, Rounded, 107),
        (Collada, DifferentlyCut, 4),
        (Collada, NothingThere, 1),
    ];
    assert_eq!(found, expected.map(|(format, how, n)| ((format.to_string(), how), n)).into());
}

fn agreement(ours: &Soup, theirs: &Soup) -> Agreement {
    if ours == theirs {
        Agreement::Identical
    } else if theirs.is_empty() {
        Agreement::NothingThere
    } else if ours.len() != theirs.len() {
        Agreement::Different
    } else if sorted(ours) == sorted(theirs) {
        Agreement::AnotherOrder
    } else {
        let near = near(ours);
        let in_order = ours.iter().flatten().zip(theirs.iter().flatten()).all(|(x, y)| near(x, y));
        let (ours, theirs) = (places(ours), places(theirs));
        let all = |some: &[[f64; 3]], others: &[[f64; 3]]| some.iter().all(|x| others.iter().any(|y| near(x, y)));
        match in_order {
            true => Agreement::Rounded,
            false if all(&ours, &theirs) && all(&theirs, &ours) => Agreement::DifferentlyCut,
            false => Agreement::Different,
        }
    }
}

/// Are two corners the same, up to the rounding of transforms?
fn near(soup: &Soup) -> impl Fn(&[f64; 3], &[f64; 3]) -> bool + use<> {
    let size = soup.iter().flatten().flatten().fold(0f64, |most, x| most.max(x.abs()));
    move |x, y| x.iter().zip(y).all(|(x, y)| (x - y).abs() <= ROUNDING * size)
}

/// The triangles in a fixed order, each from its least corner on; their winding stays.
fn sorted(soup: &Soup) -> Vec<[[u64; 3]; 3]> {
    let first = |t: &[[f64; 3]; 3]| {
        let bits = t.map(|corner| corner.map(f64::to_bits));
        (0..3).map(|from| [0, 1, 2].map(|k| bits[(from + k) % 3])).min().expect("three corners")
    };
    let mut all: Vec<_> = soup.iter().map(first).collect();
    all.sort_unstable();
    all
}

/// Each corner once.
fn places(soup: &Soup) -> Vec<[f64; 3]> {
    let mut all = soup.concat();
    all.sort_unstable_by(|x, y| x.partial_cmp(y).expect("numbers"));
    all.dedup();
    all
}

/// trimesh keeps COLLADA's numbers in single precision, all others in double precision. Its zeros have no sign.
fn in_its_precision(soup: Soup, format: FileFormat) -> Soup {
    let same = |x: f64| if format == FileFormat::Collada { f64::from(x as f32) } else { x };
    soup.into_iter().map(|t| t.map(|corner| corner.map(|x| same(x) + 0.0))).collect()
}

/// The other reader: a process that answers file by file.
struct Trimesh {
    process: Child,
    answers: BufReader<ChildStdout>,
}

impl Trimesh {
    #[expect(clippy::disallowed_methods, reason = "the other reader is a program of its own")]
    fn start(files: &[PathBuf]) -> Self {
        let list = Path::new(env!("CARGO_TARGET_TMPDIR")).join("robots.txt");
        let names: Vec<_> = files.iter().map(|file| file.to_str().expect("a name in UTF-8")).collect();
        std::fs::write(&list, names.join("\n")).expect("the names are written");
        let mut process = Command::new(format!("{INSTALLED}/bin/python"))
            .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/formats/triangles.py"))
            .stdin(File::open(&list).expect("the names are read"))
            .stdout(Stdio::piped())
            .spawn()
            .expect("Python starts");
        let answers = BufReader::new(process.stdout.take().expect("a pipe"));
        Self { process, answers }
    }

    /// The triangles of the next file.
    fn next(&mut self) -> Soup {
        let mut count = [0; 8];
        self.answers.read_exact(&mut count).expect("an answer of trimesh");
        let mut bytes = vec![0; u64::from_le_bytes(count) as usize * 72];
        self.answers.read_exact(&mut bytes).expect("a whole answer of trimesh");
        let numbers: Vec<f64> =
            bytes.chunks_exact(8).map(|x| f64::from_le_bytes(x.try_into().expect("eight bytes"))).collect();
        numbers.chunks_exact(9).map(|t| [0, 3, 6].map(|k| [t[k], t[k + 1], t[k + 2]])).collect()
    }
}

/// The files in the formats that are read, in the order of their names.
fn files() -> Vec<PathBuf> {
    assert!(
        Path::new(INSTALLED).join("complete").is_file(),
        "not run: trimesh and the files of robots are not installed"
    );
    let mut folders = vec![PathBuf::from(INSTALLED)];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry")) {
            let (path, kind) = (entry.path(), entry.file_type().expect("a kind"));
            let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            if kind.is_dir() {
                folders.push(path);
            } else if kind.is_file() && ending.is_some_and(|e| ["stl", "dae", "obj"].contains(&e.as_str())) {
                files.push(path);
            }
        }
    }
    files.sort_unstable();
    files
}
