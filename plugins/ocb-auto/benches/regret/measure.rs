//! Times of each method in each configuration.

use std::hint::black_box;
use std::time::Instant;

use ocb_auto::Auto;
use ocb_auto::features::{Ball, Features};
use ocb_auto::rules::Query;
use ocb_triangles::Frame;
use opencollbench_plugin::{ContactList, Pose, raw};

use super::scenes::Setting;
use super::support::Loaded;
use super::support::algorithm::with;

/// By the value of the parameter `method`.
pub const METHODS: [&str; 4] = ["ocb-auto", "ocb-fast", "simdop", "collision first"];
pub const QUERIES: [(Query, &str); 3] =
    [(Query::Collision, "collision"), (Query::Contacts, "all contacts"), (Query::Distance, "distance")];

/// One configuration.
pub struct Row {
    pub setting: usize,
    pub query: Query,
    pub features: Features,
    /// For each run, the microseconds of each method.
    pub runs: [[f64; METHODS.len()]; 2],
}

const PASSES: usize = 3;

/// All configurations of a setting, all queries: for each run and method the minimum of three passes over the whole set
/// after one to warm up, the methods in turn.
pub fn rows(number: usize, setting: &Setting, room: &mut Vec<raw::contacts::Contact>) -> Vec<Row> {
    let [a, b] = [&setting.a, &setting.b].map(|soup| Ball::around(&soup.view()));
    let methods: Vec<Loaded<Auto>> = (0..METHODS.len())
        .map(|method| Loaded::two(with(&[("method", method as f64)]), &setting.a, &setting.b))
        .collect();
    let mut methods = methods;
    let mut rows = Vec::new();
    for (query, _) in QUERIES {
        let first = rows.len();
        rows.extend(setting.poses.iter().map(|pose| Row {
            setting: number,
            query,
            features: Features::new(&frame(pose), &a, &b),
            runs: [[f64::INFINITY; METHODS.len()]; 2],
        }));
        for run in 0..2 {
            for pass in 0..=PASSES {
                for (method, loaded) in methods.iter_mut().enumerate() {
                    for (pose, row) in setting.poses.iter().zip(&mut rows[first..]) {
                        let start = Instant::now();
                        ask(loaded, query, pose, room);
                        let time = start.elapsed().as_secs_f64() * 1e6;
                        let least = &mut row.runs[run][method];
                        *least = if pass == 0 { *least } else { least.min(time) };
                    }
                }
            }
        }
    }
    rows
}

fn ask(loaded: &mut Loaded<Auto>, query: Query, pose: &Pose, room: &mut Vec<raw::contacts::Contact>) {
    match query {
        Query::Collision => {
            black_box(loaded.collide(&Pose::IDENTITY, pose));
        }
        Query::Contacts => {
            let mut found = ContactList::new(room.spare_capacity_mut());
            loaded.contacts_into(&Pose::IDENTITY, pose, &mut found);
            black_box(found.total());
        }
        Query::Distance => {
            black_box(loaded.distance(&Pose::IDENTITY, pose));
        }
    }
}

/// Microseconds that the features of a configuration take.
pub fn feature_cost(setting: &Setting) -> f64 {
    let [a, b] = [&setting.a, &setting.b].map(|soup| Ball::around(&soup.view()));
    let rounds = 100;
    let start = Instant::now();
    for _ in 0..rounds {
        for pose in &setting.poses {
            black_box(Features::new(black_box(&frame(pose)), &a, &b));
        }
    }
    start.elapsed().as_secs_f64() * 1e6 / (rounds * setting.poses.len()) as f64
}

fn frame(pose: &Pose) -> Frame {
    let fixed = Pose::IDENTITY;
    Frame::new(fixed.rotation(), fixed.translation(), pose.rotation(), pose.translation())
}
