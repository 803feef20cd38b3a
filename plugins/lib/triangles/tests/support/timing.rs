//! Times of a plugin on the known sets, for the benches of the plugins.
//!
//! Passes over a whole set, not repeats of one query: the caches are as cold as in use. Per query the minimum of three
//! passes after one to warm up, then the median (and the 95th percentile) over the queries of a set. Of slow queries as many
//! are asked as fit into a third of a second; the poses of a set are in no order.

use std::hint::black_box;
use std::time::{Duration, Instant};

use opencollbench_plugin::{Collision, Distance, Pose};

use super::{Dice, Loaded, Soup, known_mesh, known_poses};

const LONGEST_PASS: Duration = Duration::from_millis(300);
const SETS: [&str; 3] = ["W1", "W2", "W3"];
/// Objects of about the same shape and growing size; the last one is made of the one before.
const LADDER: [&str; 5] = ["bunny1k", "bunny4k", "bunny16k", "bunny65k", "bunny65k*4"];
const MESHES: [&str; 3] = ["bunny65k", "dragon65k", "knot65k"];

/// A name, and how to make the algorithm.
pub type Variant<'a, A> = (&'a str, fn() -> A);

/// The bench of a plugin: each variant on the meshes that the arguments name; `ladder` stands for objects of growing size.
pub fn bench<A: Distance>(variants: &[Variant<'_, A>], bytes: impl Fn(&A::Object) -> Option<usize>) {
    let asked: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    let asked: Vec<&str> = asked.iter().map(String::as_str).collect();
    let meshes: &[&str] = match asked[..] {
        [] => &MESHES,
        ["ladder"] => &LADDER,
        _ => &asked,
    };
    for (name, make) in variants {
        table(name, meshes, make, &bytes);
    }
}

/// Prints one line per mesh: build and memory, then collision and distance on each set, in microseconds.
fn table<A: Distance>(name: &str, meshes: &[&str], make: impl Fn() -> A, bytes: impl Fn(&A::Object) -> Option<usize>) {
    for mesh in meshes {
        let soup = mesh.strip_suffix("*4").map_or_else(|| known_mesh(mesh), |coarse| quarters(&known_mesh(coarse)));
        let builds = (0..3).map(|_| {
            let start = Instant::now();
            black_box(Loaded::with(make(), &soup));
            start.elapsed().as_secs_f64() * 1e3
        });
        let build = builds.fold(f64::INFINITY, f64::min);
        let mut loaded = Loaded::with(make(), &soup);
        let size = bytes(&loaded.a).map_or(String::new(), |bytes| format!("{:.1} MB", bytes as f64 / 1e6));
        print!("{name:<18} {mesh:<11} build {build:6.1} ms {size:>8} |");
        for set in SETS {
            let poses = known_poses(mesh, set).map_or_else(|| find(&mut loaded, set), |(poses, _)| poses);
            let collision = times(&poses, |pose| {
                black_box(loaded.collide(&Pose::IDENTITY, pose));
            });
            print!(" {set} cd {collision}");
            if set != "W3" {
                let distance = times(&poses, |pose| {
                    black_box(loaded.distance(&Pose::IDENTITY, pose));
                });
                print!(" pq {distance} |");
            }
        }
        println!();
    }
}

/// "median (95th percentile)" of the minimum of three passes.
fn times(poses: &[Pose], mut query: impl FnMut(&Pose)) -> String {
    let mut least = vec![f64::INFINITY; poses.len()];
    let begin = Instant::now();
    for (i, pose) in poses.iter().enumerate() {
        query(pose);
        if begin.elapsed() > LONGEST_PASS {
            least.truncate(i + 1);
            break;
        }
    }
    for _ in 0..3 {
        for (pose, least) in poses.iter().zip(&mut least) {
            let start = Instant::now();
            query(pose);
            *least = least.min(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    least.sort_by(f64::total_cmp);
    format!("{:7.2} ({:7.2})", least[least.len() / 2], least[least.len() * 95 / 100])
}

/// Poses like those of the known sets, for objects that have none: random rotation and direction, then along the line
/// through the middle of A until the distance is that of the set; W3 is W1 and on in steps of a thousandth until they meet.
fn find<A: Distance>(loaded: &mut Loaded<A>, set: &str) -> Vec<Pose> {
    let mut dice = Dice(42);
    let wanted = if set == "W2" { 0.1 } else { 1e-4 };
    (0..300)
        .map(|_| {
            let start = dice.pose(1.5);
            let at = |way: f64| {
                let mut pose = start;
                for axis in [3, 7, 11] {
                    pose.0[axis] *= 1.0 - way / 1.5;
                }
                pose
            };
            let mut way = 0.0;
            loop {
                let left = loaded.distance(&Pose::IDENTITY, &at(way)).distance - wanted;
                if left <= 1e-3 * wanted || way > 1.5 {
                    break;
                }
                way += left;
            }
            while set == "W3" && loaded.collide(&Pose::IDENTITY, &at(way)) == Collision::Apart {
                way += 1e-3;
            }
            at(way)
        })
        .collect()
}

/// Each triangle as four.
fn quarters(soup: &Soup) -> Soup {
    let mut finer = Soup { positions: soup.positions.clone(), triangles: Vec::new() };
    let mut middles = std::collections::HashMap::new();
    for &[a, b, c] in &soup.triangles {
        let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[i, j]| {
            *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                let (p, q) = (soup.positions[i as usize], soup.positions[j as usize]);
                finer.positions.push([0, 1, 2].map(|k| f64::from((0.5 * (p[k] + q[k])) as f32)));
                finer.positions.len() as u32 - 1
            })
        });
        finer.triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
    }
    finer
}
