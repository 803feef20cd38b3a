//! V-Clip on every pair of convex stock objects, judged by the certified truth.

#[path = "../../lib/triangles/tests/support/mod.rs"]
mod support;

use std::sync::Arc;

use ocb_core::configuration::{Configuration, Placed};
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape, U64};
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::stock;
use ocb_core::validation::{Precision, Terms, judge};
use ocb_v_clip::VClip;
use opencollbench_plugin::{Algorithm, Collision, Pose};
use support::{Dice, Loaded, Soup, TRANSLATION};

/// Distances of the surfaces in tolerances; from 0 on, B goes into A.
const GAPS: [f64; 12] = [1e14, 1e9, 1e4, 300.0, 3.0, 0.5, 0.0, -3.0, -300.0, -1e4, -1e9, -1e14];

struct Object {
    soup: Soup,
    shape: Shape,
}

fn soup(mesh: &Mesh) -> Soup {
    let positions = mesh.positions().iter().map(|p| [p.x, p.y, p.z]).collect();
    Soup { positions, triangles: mesh.triangles().to_vec() }
}

/// The stock objects that V-Clip accepts: boxes, and spheres of some numbers of triangles, which single precision does not dent.
fn convex() -> Vec<Object> {
    let made = stock::list()
        .iter()
        .flat_map(|object| [500, 700, 1000].into_iter().filter_map(|count| stock::generate(object.name, count)));
    made.map(|mesh| Object { soup: soup(&mesh), shape: Shape::new(Arc::new(mesh)) })
        .filter(|object| VClip::default().load_mesh(object.soup.view()).is_ok())
        .collect()
}

/// Whether the objects meet. Asserts that both answers are right.
fn judged(loaded: &mut Loaded<VClip>, pair: &Pair<'_>, pose_a: &Pose, pose_b: &Pose) -> bool {
    let [a, b] = [pose_a, pose_b].map(|pose| ocb_core::pose::Pose::from_row_major(&pose.0).expect("a pose"));
    let configuration = Configuration { pose_a: a, pose_b: b };
    let truth = pair.truth(&configuration);
    let placed = Placed { configuration, truth, rounded: None, root_index: 0, wanted: None };
    let hit = loaded.collide(pose_a, pose_b) != Collision::Apart;
    let near = loaded.distance(pose_a, pose_b);
    let answers = [
        (Query::CollisionFirst, Answer::Collision { hit, pair: None }),
        (
            Query::Proximity,
            Answer::Distance {
                distance: near.distance,
                points: near.points.map(|points| points.map(Into::into)),
                triangles: None,
            },
        ),
    ];
    for (query, answer) in answers {
        let terms = Terms { query, semantics: Semantics::Surface, precision: Precision::Double };
        let verdict = judge(pair, &placed, terms, &answer).verdict;
        assert!(!verdict.is_wrong(), "{verdict:?}: {answer:?}, {truth:?} at {pose_a:?} {pose_b:?}");
    }
    truth.hit
}

#[test]
fn every_pair_of_convex_stock_objects_is_answered_rightly() {
    let objects = convex();
    assert_eq!(objects.len(), 5, "{} stock objects are accepted", objects.len());
    let (mut dice, mut hits, mut all) = (Dice(8), 0, 0);
    for a in &objects {
        for b in &objects {
            let mut loaded = Loaded::two(VClip::default(), &a.soup, &b.soup);
            let pair = Pair::new(&a.shape, &b.shape);
            for _ in 0..8 {
                let (pose_a, far) = (dice.pose(0.1), dice.pose(1.2));
                let near = loaded.distance(&pose_a, &far);
                let [p, q] = near.points.expect("they are apart");
                let tau = 32.0 * U64 * 3.0;
                for gap in GAPS {
                    let mut pose_b = far;
                    let share = 1.0 - (gap * tau / near.distance).max(-1.0);
                    TRANSLATION.iter().enumerate().for_each(|(k, &at)| pose_b.0[at] += share * (p[k] - q[k]));
                    hits += usize::from(judged(&mut loaded, &pair, &pose_a, &pose_b));
                    all += 1;
                }
            }
        }
    }
    assert!(hits > all / 4 && hits < 3 * all / 4, "{hits} of {all} collide");
}
