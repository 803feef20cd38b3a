//! From what a recorder writes to what each algorithm does with it, in real processes.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use nalgebra::Vector3;
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;
use ocb_core::query::Query;
use ocb_core::stock;
use ocb_core::workload::Claim;
use ocb_sandbox::{Launcher, Objects, Outcome, Policy, Profile, Question, Trial};
use ocb_service::model::{AlgorithmOnWorkload, OutcomeName, Track, WorkloadSpec};
use ocb_service::recording::pack;
use ocb_service::workload::{Progress, workload_parquet};
use ocb_service::{Engine, EngineError, Recording, Stop, sha256_hex};
use serde_json::json;

/// A spool, as a recorder writes it.
struct Spool {
    objects: Vec<String>,
    rows: Vec<u8>,
    sequence: u64,
}

impl Spool {
    fn mesh(&mut self, folder: &Path, mesh: &Mesh) {
        let mut ply = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
             element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
            mesh.positions().len(),
            mesh.triangles().len()
        )
        .into_bytes();
        ply.extend(mesh.positions().iter().flat_map(|p| [p.x, p.y, p.z]).flat_map(f64::to_le_bytes));
        for triangle in mesh.triangles() {
            ply.push(3);
            ply.extend(triangle.iter().flat_map(|corner| corner.to_le_bytes()));
        }
        let sha256 = sha256_hex(&ply);
        fs::create_dir_all(folder.join("objects")).unwrap();
        fs::write(folder.join(format!("objects/{sha256}.ply")), ply).unwrap();
        self.object(&json!({ "kind": "mesh", "sha256": sha256 }));
    }

    fn object(&mut self, geometry: &serde_json::Value) {
        let line = json!({ "id": self.objects.len(), "name": "part", "geometry": geometry, "source": "test",
                           "library": "fcl", "version": "0.7.0" });
        self.objects.push(line.to_string());
    }

    /// A stands at the origin, B at `x` on the first axis, stretched by so much.
    fn query(&mut self, [a, b]: [u32; 2], kind: u32, x: f64, answer: (u32, f64), stretched: f64) {
        let pose = |x: f64, s: f64| [s, 0.0, 0.0, x, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let mut row = [self.sequence, self.sequence / 3].map(u64::to_le_bytes).concat();
        row.extend([a, b].map(u32::to_le_bytes).concat());
        row.extend(pose(0.0, 1.0).iter().chain(&pose(x, stretched)).flat_map(|x| x.to_le_bytes()));
        row.extend([kind, answer.0].map(u32::to_le_bytes).concat());
        row.extend([0.0, answer.1, 1e-6].map(f64::to_le_bytes).concat());
        row.resize(256, 0);
        self.rows.extend(row);
        self.sequence += 1;
    }

    /// The last object and the last query were being written when the program was killed.
    fn write(&self, folder: &Path) {
        fs::write(
            folder.join("about.json"),
            json!({ "format": "opencollbench-spool/1", "program": "robot" }).to_string(),
        )
        .unwrap();
        fs::write(folder.join("objects.jsonl"), self.objects.join("\n") + "\n{\"id\": 3, \"na").unwrap();
        fs::write(folder.join("queries.bin"), [&self.rows[..], &[7; 100]].concat()).unwrap();
        let dropped = [3, 5].map(|count| json!({ "reason": "sampled", "count": count }).to_string());
        fs::write(folder.join("dropped.jsonl"), dropped.join("\n") + "\n").unwrap();
    }
}

const HIT: (u32, f64) = (3, 0.0);
const APART: (u32, f64) = (1, 0.0);
const UNKNOWN: (u32, f64) = (0, 0.0);

fn by(distance: f64) -> (u32, f64) {
    (4, distance)
}

/// A knot, a cube and a ball.
fn spool(folder: &Path) -> Spool {
    let mut spool = Spool { objects: Vec::new(), rows: Vec::new(), sequence: 0 };
    spool.mesh(folder, &stock::generate("torus-knot", 600).unwrap());
    spool.mesh(folder, &stock::generate("box", 500).unwrap());
    spool.object(&json!({ "kind": "sphere", "radius": 0.5 }));
    // Of the knot against the cube only the claim that they collide, far apart, is known, and it is false.
    for i in 0..60 {
        spool.query([0, 1], 0, 0.05 * f64::from(i), UNKNOWN, 1.0);
    }
    spool.query([1, 0], 0, 50.0, HIT, 1.0);
    spool
}

fn spec(algorithms: &[&str]) -> WorkloadSpec {
    WorkloadSpec {
        algorithms: algorithms.iter().map(ToString::to_string).collect(),
        tracks: vec![Track::Shuffled, Track::Recorded],
        passes: 2,
        budget_seconds: 60.0,
        seed: Some(5),
        reduce: None,
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_recording_is_replayed_and_its_own_answers_are_judged() {
    let data = tempfile::tempdir().unwrap();
    let folder = data.path().join("spool");
    let mut spool = spool(&folder);
    let side = stock::generate("box", 500).unwrap().longest_side();
    let gap = |x: f64| x - side / 2.0 - 0.5;
    for i in 0..30 {
        let x = 2.0 * side + 0.1 * f64::from(i);
        spool.query([1, 2], 2, x, by(gap(x)), 1.0);
    }
    // Too far, crossing and called apart, no rotation.
    spool.query([1, 2], 2, 3.0 * side, by(gap(3.0 * side) + 0.01), 1.0);
    spool.query([1, 2], 0, side / 2.0, APART, 1.0);
    spool.query([1, 2], 0, side, UNKNOWN, 2.0);
    spool.write(&folder);

    let file = data.path().join("robot.ocbrec");
    let packed = pack(&folder, &file).unwrap();
    assert_eq!((packed.objects, packed.queries, packed.seen), (3, 94, 99));
    let recording = Arc::new(Recording::read(&file).unwrap());
    assert_eq!(recording.queries.len(), 94);
    assert_eq!(recording.scene.scene.objects[2].name, "part #2");

    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let wanted = spec(&["brute-force", "box-tree"]);
    let replayed = engine.replay_workload(recording.clone(), wanted, Stop::default(), |_| {}, || {}).await.unwrap();
    let result = &replayed.result;
    assert_eq!((result.seen, result.queries, result.groups), (99, 93, 32));
    let left_out: Vec<(&str, u64)> = result.left_out.iter().map(|it| (it.reason.as_str(), it.count)).collect();
    assert_eq!(left_out, [("sampled", 5), ("a pose is no rotation", 1)]);
    let claims: Vec<(Claim, u64)> = result.recorded.claims.iter().map(|it| (it.claim, it.count)).collect();
    let expected = [Claim::Right, Claim::MissedCollision, Claim::FalseCollision, Claim::DistanceOver];
    assert_eq!(claims, expected.into_iter().zip([30, 1, 1, 1]).collect::<Vec<_>>());
    let first = &result.recorded.false_answers[0];
    assert_eq!((first.claim, first.objects, first.sequence), (Claim::MissedCollision, [1, 2], 92));
    assert!((result.recorded.largest_error - 0.01).abs() < 1e-3, "{}", result.recorded.largest_error);
    assert!(result.objects[2].bound.is_some_and(|bound| bound > 0.0) && result.objects[1].bound.is_none());

    assert_eq!(result.tracks.iter().map(|it| it.track).collect::<Vec<_>>(), [Track::Shuffled, Track::Recorded]);
    for track in &result.tracks {
        let [brute, tree] = &track.algorithms[..] else { panic!("{:?}", track.algorithms) };
        for it in [brute, tree] {
            assert!(it.is_fair() && (it.n, it.wrong) == (93, 0), "{it:?}");
            let total = it.total.unwrap();
            assert!(total.lowest_ns <= total.highest_ns && total.ns > 0.0 && it.build_ns > 0.0, "{it:?}");
            // The last group holds nothing but the row that was left out.
            assert_eq!(it.groups.unwrap().n, 31);
            assert_eq!(it.pairs.iter().map(|pair| pair.n).sum::<u64>(), 93);
            assert_eq!(it.pairs.iter().map(|pair| pair.hits).sum::<u64>(), result.hits);
        }
        // The ratio is in the hundreds, so that no disturbance turns it round.
        assert!(tree.total.unwrap().ns < brute.total.unwrap().ns);
    }
    let mut gains: Vec<&str> = result.order_gains.iter().map(|it| it.algorithm.as_str()).collect();
    gains.sort_unstable();
    assert_eq!(gains, ["box-tree", "brute-force"]);
    assert!(
        result.order_gains.iter().all(|it| it.lowest <= it.ratio && it.ratio <= it.highest),
        "{:?}",
        result.order_gains
    );
    assert_eq!(replayed.rows.len(), 2 * 2 * 93);
    assert!(!workload_parquet(&replayed.rows, &recording.queries).unwrap().is_empty());
    engine.shutdown().await;
}

/// With a gear: every pair of four objects, in an order that jumps between them.
fn scene(folder: &Path) -> Spool {
    let mut spool = spool(folder);
    spool.mesh(folder, &stock::generate("gear", 500).unwrap());
    for i in 0..60 {
        let [a, b] = [[0, 1], [3, 2], [1, 3], [2, 0], [0, 3], [1, 2]][i as usize % 6];
        let (kind, x) = (if i % 4 == 3 { 2 } else { 0 }, 0.04 * f64::from(i * 7 % 60));
        spool.query([a, b], kind, x, UNKNOWN, 1.0);
    }
    spool.write(folder);
    spool
}

/// The C template that offers scenes, with this fault.
#[expect(clippy::disallowed_methods, reason = "the test compiles a plugin")]
fn lying(folder: &Path, fault: &str) -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = folder.join(format!("{}.so", fault.to_lowercase()));
    let mut cc = std::process::Command::new("cc");
    cc.args(["-std=gnu11", "-O1", "-fPIC", "-shared", "-fvisibility=hidden", &format!("-D{fault}")]);
    cc.arg("-I").arg(here.join("../../plugin-api/include")).arg("-I").arg(here.join("../../plugin-api/templates/c"));
    assert!(cc.arg(here.join("tests/fixtures/scene.c")).arg("-o").arg(&file).status().unwrap().success());
    file
}

#[tokio::test(flavor = "multi_thread")]
async fn a_whole_scene_is_answered_by_one_process_as_pair_by_pair() {
    let data = tempfile::tempdir().unwrap();
    let (folder, file) = (data.path().join("spool"), data.path().join("r.ocbrec"));
    scene(&folder);
    pack(&folder, &file).unwrap();
    let recording = Arc::new(Recording::read(&file).unwrap());
    let faults = ["CRASHES", "REFUSES", "OTHER_OBJECT", "NO_SUCH_TRIANGLE"];
    let mut config = common::config(data.path());
    config.plugins.extend(faults.map(|fault| lying(data.path(), fault)));
    config.profile = Profile::Dev;
    let engine = Engine::open(config).await.unwrap();
    let names =
        ["brute-force", "box-tree", "box-tree:leaf_size=4", "crashes", "refuses", "other-object", "no-such-triangle"];
    let wanted = WorkloadSpec { tracks: vec![Track::Recorded, Track::Scene], ..spec(&names) };
    let told = Arc::new(Mutex::new(Vec::new()));
    let telling = told.clone();
    let tell = move |progress| telling.lock().unwrap().push(progress);
    let replayed = engine.replay_workload(recording.clone(), wanted, Stop::default(), tell, || {}).await.unwrap();
    let told = std::mem::take(&mut *told.lock().unwrap());
    let at = |it: &str, process| Progress::Scene { algorithm: it.to_owned(), process, of: 2 };
    let first: Vec<_> = names[1..].iter().map(|it| at(it, 1)).collect();
    assert_eq!((&told[1..7], &told[7..9]), (&first[..], &[at("box-tree", 2), at("box-tree:leaf_size=4", 2)][..]));
    assert!(
        matches!(told.last(), Some(Progress::Pairs { done, of }) if done == of && *done == recording.queries.len() as u64)
    );
    let [pairs, whole] = &replayed.result.tracks[..] else { panic!("{:?}", replayed.result.tracks) };
    assert_eq!((pairs.track, whole.track), (Track::Recorded, Track::Scene));
    // Who does not offer scenes is asked pair by pair alone.
    let asked: Vec<&str> = whole.algorithms.iter().map(|it| it.algorithm.as_str()).collect();
    assert_eq!((pairs.algorithms.len(), &asked[..]), (7, &names[1..]));

    for (it, pair_by_pair) in whole.algorithms.iter().zip(&pairs.algorithms[1..]).take(2) {
        assert!(it.is_fair() && it.n == replayed.result.queries, "{it:?}");
        let told = |it: &AlgorithmOnWorkload| {
            let mut pairs: Vec<_> = it.pairs.iter().map(|pair| (pair.objects, pair.n, pair.hits)).collect();
            pairs.sort_unstable();
            pairs
        };
        assert_eq!((told(it).len(), told(it)), (6, told(pair_by_pair)));
        assert!(
            it.build_ns > 0.0 && it.total.unwrap().ns > 0.0 && it.groups.unwrap().n == pair_by_pair.groups.unwrap().n
        );
        let verdicts = |track: Track| -> Vec<_> {
            let rows = replayed.rows.iter().filter(|row| row.track == track && *row.algorithm == *it.algorithm);
            rows.map(|row| (row.row, row.verdict, row.hit)).collect()
        };
        assert_eq!((verdicts(Track::Scene).len() as u64, verdicts(Track::Scene)), (it.n, verdicts(Track::Recorded)));
    }
    // A fault at the third object ends the scene before the first query; in a process of two objects there is no third.
    for (i, name) in [(2, OutcomeName::Signaled), (3, OutcomeName::Failed)] {
        let [ended] = &whole.algorithms[i].ended[..] else { panic!("{:?}", whole.algorithms[i]) };
        assert_eq!((ended.outcome.name, ended.objects, whole.algorithms[i].n), (name, None, 0), "{ended:?}");
        assert!(!ended.outcome.ours && pairs.algorithms[i + 1].ended.is_empty());
    }
    // Answers about an object that was not asked about, or about none, are wrong answers.
    for it in &whole.algorithms[4..] {
        assert!(it.wrong > 0 && it.ended.is_empty() && !it.is_fair(), "{it:?}");
    }
    assert_eq!(pairs.algorithms[5].wrong, 0);
    engine.shutdown().await;
}

/// Answer by answer, with their triangles: each mesh as it is, in one process of four objects and in processes of two.
#[test]
fn a_tree_that_all_pairs_share_answers_as_trees_of_one_pair_do() {
    let data = tempfile::tempdir().unwrap();
    let config = common::config(data.path());
    let meshes = [("torus-knot", 600), ("box", 500), ("gear", 500), ("sphere", 500)];
    let meshes = meshes.map(|(name, triangles)| stock::generate(name, triangles).unwrap());
    let all: Vec<&Mesh> = meshes.iter().collect();
    let launcher = Launcher::new(config.runner, Policy { trusted: true, ..Policy::default() });
    let start = |objects| launcher.start(&Trial::of(&config.plugins[1], "box-tree", objects)).expect("it starts");
    let mut scene = start(Objects::Scene(&all));
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let mut pair = start(Objects::Pair(all[i], (i != j).then_some(all[j])));
        for (query, x) in [(Query::CollisionFirst, 0.4), (Query::Proximity, 6.0), (Query::CollisionAll, 0.7)] {
            let pose_b = Pose { translation: Vector3::new(x, 0.1, 0.2), ..Pose::identity() };
            let configuration = Configuration { pose_a: Pose::identity(), pose_b };
            let question = Question { query, objects: [i as u32, j as u32], configuration };
            let [one, other] =
                [scene.question(&question), pair.query(query, &configuration)].map(|it| it.unwrap().answer);
            assert_eq!(one, other, "{i} {j} {query:?}");
        }
        assert_eq!(pair.finish().outcome, Outcome::Completed);
    }
    assert_eq!(scene.finish().outcome, Outcome::Completed);
}

#[test]
fn spools_of_several_processes_become_one_recording() {
    let data = tempfile::tempdir().unwrap();
    let (folder, file) = (data.path().join("all"), data.path().join("r.ocbrec"));
    let first = spool(&folder.join("1-a"));
    first.write(&folder.join("1-a"));
    // The second process knows another object, and asks about it first.
    let mut second = Spool { objects: Vec::new(), rows: Vec::new(), sequence: 0 };
    second.object(&json!({ "kind": "box", "size": [1.0, 2.0, 3.0] }));
    second.object(&json!({ "kind": "sphere", "radius": 0.5 }));
    second.query([0, 1], 2, 9.0, by(7.5), 1.0);
    fs::create_dir(folder.join("2-a")).unwrap();
    second.write(&folder.join("2-a"));

    let packed = pack(&folder, &file).unwrap();
    assert_eq!((packed.objects, packed.queries, packed.seen), (4, 62, 62 + 2 * 5));
    let recording = Recording::read(&file).unwrap();
    let [.., before, last] = &recording.queries[..] else { panic!("{}", recording.queries.len()) };
    assert_eq!((last.objects, last.sequence, last.answered.distance), ([3, 2], before.sequence + 1, Some(7.5)));
    assert!(last.group > before.group);
    assert_eq!(
        (recording.about.libraries, recording.about.program),
        (vec!["fcl 0.7.0".to_owned()], "robot".to_owned())
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn what_cannot_be_replayed_is_refused_in_a_sentence() {
    let data = tempfile::tempdir().unwrap();
    let (folder, file) = (data.path().join("spool"), data.path().join("r.ocbrec"));
    let told = || pack(&folder, &file).unwrap_err().to_string();
    fs::create_dir(&folder).unwrap();
    assert!(told().contains("its about.json cannot be read"), "{}", told());
    let made = spool(&folder);
    Spool { rows: Vec::new(), ..spool(&folder) }.write(&folder);
    assert_eq!(told(), "\"spool\" holds no recording: no query was recorded (left out: sampled).");
    made.write(&folder);
    let mesh = fs::read_dir(folder.join("objects")).unwrap().next().unwrap().unwrap().path();
    let whole = fs::read(&mesh).unwrap();
    fs::write(&mesh, &whole[..whole.len() - 1]).unwrap();
    assert!(told().contains("is missing or damaged"), "{}", told());
    assert!(!file.exists());
    fs::write(&mesh, whole).unwrap();
    pack(&folder, &file).unwrap();

    let recording = Arc::new(Recording::read(&file).unwrap());
    let engine = Engine::open(common::config(data.path())).await.unwrap();
    let replay = |spec, stop| engine.replay_workload(recording.clone(), spec, stop, |_| {}, || {});
    let unknown = replay(spec(&["no-such"]), Stop::default()).await.map(drop).unwrap_err();
    assert!(matches!(&unknown, EngineError::Invalid(why) if why.contains("no algorithm \"no-such\"")), "{unknown}");
    let stop = Stop::default();
    stop.stop();
    let stopped = replay(spec(&["box-tree"]), stop).await.map(drop).unwrap_err();
    assert!(stopped.to_string().contains("Stopped"), "{stopped}");
    engine.shutdown().await;
}
