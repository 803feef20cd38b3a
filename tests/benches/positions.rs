//! How long one configuration takes to find: the sphere method against conservative advancement, ray by ray in turn.
//!
//! `cargo bench --bench positions -- FILE.obj [RAYS] [RELATIVE_DISTANCE...]`. Each ray of the sphere method is walked three
//! times on one core: by our search (certified), by conservative advancement on box-tree's distance, and by the same on
//! FCL's when its development files are there (neither certified).

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::sync::Arc;
use std::time::Instant;

use nalgebra::Vector3;
use ocb_box_tree::BoxTree;
use ocb_core::configuration::{Method, Placed, Sampling, Separation};
use ocb_core::mesh::{Mesh, obj};
use ocb_core::oracle::{Pair, Shape, U32};
use ocb_core::sampling::Plan;
use ocb_tests::process::command;
use opencollbench_plugin as plugin;
use plugin::{Algorithm, Distance, Uncounted};

/// A ray as the peers get it: B's rotation, start, direction, wanted distance, tolerance, length.
struct Ray {
    rotation: [f64; 9],
    from: [f64; 3],
    direction: [f64; 3],
    wanted: f64,
    tolerance: f64,
    length: f64,
}

/// What one walk took.
#[derive(Default)]
struct Walks {
    us: Vec<f64>,
    queries: f64,
    missed: u32,
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let Some(file) = arguments.first() else {
        println!("positions: no object given; cargo bench --bench positions -- FILE.obj [RAYS] [RELATIVE_DISTANCE...]");
        return;
    };
    let rays: u32 = arguments.get(1).map_or(300, |x| x.parse().expect("a number of rays"));
    let distances: Vec<f64> = arguments.iter().skip(2).map(|x| x.parse().expect("a relative distance")).collect();
    let read = obj::read(&std::fs::read(file).expect("a readable OBJ file")).expect("a valid mesh");
    let mesh = Arc::new(read.mesh.to_f32_representable().expect("fits into f32"));
    let mut fcl = Fcl::start(&mesh);
    for distance in if distances.is_empty() { vec![0.0, 0.2] } else { distances } {
        compare(&mesh, rays, distance, fcl.as_mut());
    }
}

fn compare(mesh: &Arc<Mesh>, rays: u32, distance: f64, mut fcl: Option<&mut Fcl>) {
    let shape = Shape::new(mesh.clone());
    let pair = Pair::new(&shape, &shape);
    let method = Method::Sphere { sampling: Sampling::Count { count: rays }, seed: 0 };
    let plan = Plan::new(&shape, &shape, &method, Separation::Relative { distance }).expect("a plan");
    let mut tree = BoxTree::default();
    let positions: Vec<[f64; 3]> = mesh.positions().iter().map(|p| p.coords.into()).collect();
    let object = tree
        .load_mesh(plugin::Mesh { positions: &positions, triangles: mesh.triangles() })
        .expect("box-tree takes every mesh");
    let (mut ours, mut boxes, mut theirs) = (Walks::default(), Walks::default(), Walks::default());
    let mut exact = 0;
    for index in 0..plan.units() {
        let clock = Instant::now();
        let placed = plan.place(index).placed.pop();
        ours.add(clock, 1.0, placed.is_some());
        let Some(placed) = placed else { continue };
        exact += u32::from(placed.truth.exact_used);
        let ray = Ray::to(&placed, &pair, mesh);
        let clock = Instant::now();
        let (queries, way) = advance(&ray, |pose| {
            let a = plugin::Placed { object: &object, pose: &plugin::Pose::IDENTITY };
            tree.distance(a, plugin::Placed { object: &object, pose }, &mut Uncounted).expect("an answer").distance
        });
        boxes.add(clock, queries, way.is_some());
        if let Some(fcl) = &mut fcl {
            let [nanoseconds, queries, way] = fcl.walk(&ray);
            theirs.us.push(nanoseconds / 1e3);
            theirs.queries += queries;
            theirs.missed += u32::from(way.is_nan());
        }
    }
    println!("relative distance {distance}, {rays} rays, {exact} by exact arithmetic; one core, us per configuration:");
    ours.print("directional search, certified", None);
    boxes.print("advancement on box-tree", Some(&ours));
    if fcl.is_some() {
        theirs.print("advancement on FCL OBBRSS", Some(&ours));
    }
}

impl Ray {
    /// The ray on which a configuration was found: it runs through both centres.
    fn to(placed: &Placed, pair: &Pair, mesh: &Mesh) -> Self {
        let pose = placed.configuration.pose_b;
        let centre = mesh.bounds().center();
        let between = pose.apply(&centre) - centre;
        let direction = between.normalize();
        let tau = pair.tau(&placed.configuration, U32);
        let radius = mesh.positions().iter().map(|p| (p - centre).norm()).fold(0.0, f64::max);
        // Every ray has a place of its own in the window.
        let wanted = f64::midpoint(placed.truth.distance_lo, placed.truth.distance_hi);
        let start = 2.02 * radius + wanted;
        let from: Vector3<f64> = pose.translation + direction * (start - between.norm());
        let row_major = pose.linear.transpose();
        Self {
            rotation: std::array::from_fn(|i| row_major.as_slice()[i]),
            from: from.into(),
            direction: direction.into(),
            wanted,
            tolerance: tau,
            length: 2.0 * start,
        }
    }

    fn pose(&self, way: f64) -> plugin::Pose {
        let r = &self.rotation;
        let t: [f64; 3] = std::array::from_fn(|k| self.from[k] - self.direction[k] * way);
        plugin::Pose([r[0], r[1], r[2], t[0], r[3], r[4], r[5], t[1], r[6], r[7], r[8], t[2], 0.0, 0.0, 0.0, 1.0])
    }
}

/// As far as the distance allows, again and again; the number of queries, and the way when it arrived.
fn advance(ray: &Ray, mut distance: impl FnMut(&plugin::Pose) -> f64) -> (f64, Option<f64>) {
    let mut way = 0.0;
    for queries in 1..=2000 {
        let now = distance(&ray.pose(way));
        if (now - ray.wanted).abs() <= ray.tolerance {
            return (f64::from(queries), Some(way));
        }
        way += now - ray.wanted;
        if way > ray.length {
            return (f64::from(queries), None);
        }
    }
    (2000.0, None)
}

impl Walks {
    fn add(&mut self, clock: Instant, queries: f64, arrived: bool) {
        self.us.push(clock.elapsed().as_secs_f64() * 1e6);
        self.queries += queries;
        self.missed += u32::from(!arrived);
    }

    fn print(&mut self, name: &str, against: Option<&Walks>) {
        self.us.sort_by(f64::total_cmp);
        let n = self.us.len();
        let at = |q: f64| self.us[((n - 1) as f64 * q) as usize];
        let mean = |w: &Walks| w.us.iter().sum::<f64>() / w.us.len() as f64;
        let ratio = against.map_or(String::new(), |ours| format!(", {:.1} times ours", mean(self) / mean(ours)));
        println!(
            "  {name:30} n {n}: median {:.0}, mean {:.0}, p95 {:.0}; {:.1} queries each, {} did not arrive{ratio}",
            at(0.5),
            mean(self),
            at(0.95),
            self.queries / n as f64,
            self.missed
        );
    }
}

/// The program in `fcl_advance.cpp`, compiled and started.
struct Fcl {
    child: Child,
    files: PathBuf,
}

impl Fcl {
    /// `None`, with the reason printed, when it cannot be built.
    fn start(mesh: &Mesh) -> Option<Self> {
        let files = std::env::temp_dir().join(format!("ocb-positions-{}", std::process::id()));
        std::fs::create_dir_all(&files).expect("a temporary folder");
        let program = files.join("fcl_advance");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/fcl_advance.cpp");
        let built = command("c++")
            .args(["-std=c++17", "-O3", "-w", "-I/usr/include/eigen3", "-o"])
            .arg(&program)
            .arg(source)
            .args(["-lfcl", "-lccd"])
            .output();
        if !built.is_ok_and(|b| b.status.success()) {
            println!("FCL is left out: its program cannot be built (apt-get install libfcl-dev)");
            return None;
        }
        let numbers = [mesh.positions().len() as u64, mesh.triangles().len() as u64];
        let mut bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        bytes.extend(
            mesh.positions().iter().flat_map(|p| p.coords.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>()),
        );
        bytes.extend(mesh.triangles().iter().flatten().flat_map(|i| i.to_le_bytes()));
        std::fs::write(files.join("mesh"), bytes).expect("room for a mesh");
        let child = command(program)
            .arg(files.join("mesh"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the program starts");
        Some(Self { child, files })
    }

    /// Nanoseconds, queries, way.
    fn walk(&mut self, ray: &Ray) -> [f64; 3] {
        let numbers = ray.rotation.iter().chain(&ray.from).chain(&ray.direction);
        let numbers = numbers.chain([&ray.wanted, &ray.tolerance, &ray.length]);
        let bytes: Vec<u8> = 1u64.to_le_bytes().into_iter().chain(numbers.flat_map(|x| x.to_le_bytes())).collect();
        let stdin = self.child.stdin.as_mut().expect("piped");
        stdin.write_all(&bytes).and_then(|()| stdin.flush()).expect("the program listens");
        let mut answer = [0; 24];
        self.child.stdout.as_mut().expect("piped").read_exact(&mut answer).expect("the program answers");
        std::array::from_fn(|i| f64::from_le_bytes(answer[8 * i..8 * i + 8].try_into().expect("eight bytes")))
    }
}

impl Drop for Fcl {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
        let _ = std::fs::remove_dir_all(&self.files);
    }
}
