//! How many answers are wrong when two objects almost touch, or just meet.

use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::{Pair, Shape};

use super::support::{Algorithm, configurations, hit, mesh};

/// Gaps, and as negative numbers depths; the objects' bounding boxes have diagonal 1.
const GAPS: [f64; 8] = [1e-6, -1e-6, 1e-8, -1e-8, 1e-10, -1e-10, 1e-12, -1e-12];
/// Configurations per gap.
const COUNT: usize = 20;

/// Configurations at a gap: those of the set W1, moved along the line between the nearest points. Moved by less than their
/// distance, objects cannot meet, so the gap is just that; moved further, the oracle says whether they do.
fn at_gap(pair: &Pair<'_>, name: &str, gap: f64) -> Vec<Configuration> {
    let mut found = Vec::new();
    for (_, mut configuration) in configurations(&format!("{name}.W1"), 1000 / (2 * COUNT)) {
        let near = pair.truth(&configuration).witness;
        let between = near.point_a - near.point_b;
        configuration.pose_b.translation += between * (1.0 - gap / between.norm());
        let truth = pair.truth(&configuration);
        if gap > 0.0 {
            let just = 0.9 * gap <= truth.distance_lo && truth.distance_hi <= 1.1 * gap;
            assert!(!truth.hit && just, "{name} at {gap:e}: {truth:?}");
        }
        if truth.hit == (gap < 0.0) && found.len() < COUNT {
            found.push(configuration);
        }
    }
    assert_eq!(found.len(), COUNT, "{name} at {gap:e}");
    found
}

fn wrong(algorithm: &Algorithm, mesh: &Mesh, gaps: &[(f64, Vec<Configuration>)]) -> Vec<usize> {
    let mut session = algorithm.start(mesh, None);
    let mut of = |gap: f64, all: &[Configuration]| all.iter().filter(|c| hit(&mut session, c) != (gap < 0.0)).count();
    gaps.iter().map(|(gap, all)| of(*gap, all)).collect()
}

/// Rows of the table for one object, by algorithm.
pub fn rows(name: &str) -> Vec<(String, Vec<usize>)> {
    let mesh = mesh(name);
    let shape = Shape::new(mesh.clone());
    let pair = Pair::new(&shape, &shape);
    let gaps: Vec<_> = GAPS.iter().map(|gap| (*gap, at_gap(&pair, name, *gap))).collect();
    let plain = ["box-tree", "bullet", "cgal", "coal"].map(Algorithm::plain);
    let others = ["embree", "fcl", "ode", "parry"].map(Algorithm::plain);
    let tolerances = [1e-6, 1e-12].map(|tolerance| Algorithm::with("coal", "gjk_tolerance", tolerance));
    let all = plain.into_iter().chain(tolerances).chain(others);
    all.map(|algorithm| (algorithm.name(), wrong(&algorithm, &mesh, &gaps))).collect()
}

/// False collisions of Bullet among the configurations of W1, as the file winds its triangles and the other way round.
pub fn winding(name: &str) -> [usize; 2] {
    let as_read = mesh(name);
    let turned = as_read.triangles().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let turned = Mesh::new(as_read.positions().to_vec(), turned).expect("as valid as before");
    [&*as_read, &turned].map(|mesh| {
        let mut session = Algorithm::plain("bullet").start(mesh, None);
        configurations(&format!("{name}.W1"), 1000 / COUNT).iter().filter(|(_, c)| hit(&mut session, c)).count()
    })
}

/// The tables, as the document shows them.
pub fn tables() -> String {
    let mut text = String::new();
    for (name, what) in
        [("bunny65k", "the bunny of 65,536 triangles"), ("knot65k", "a knot of 65,520 triangles, wound inside out")]
    {
        text += &format!("\n### {name}: {what}\n\n| algorithm |");
        GAPS.iter()
            .for_each(|gap| text += &format!(" {} {:.0e} |", if *gap > 0.0 { "apart" } else { "meeting" }, gap.abs()));
        text += &format!("\n| --- |{}\n", " ---: |".repeat(GAPS.len()));
        for (algorithm, counts) in rows(name) {
            text += &format!("| `{algorithm}` |");
            counts.iter().for_each(|count| text += &format!(" {count} |"));
            text += "\n";
        }
    }
    text += "\n## Bullet and the winding\n\n";
    text += &format!("False collisions among {COUNT} configurations that are 1e-4 apart.\n\n");
    text += "| object | wound as in the file | wound the other way |\n| --- | ---: | ---: |\n";
    for name in ["bunny65k", "knot65k"] {
        let [as_read, turned] = winding(name);
        text += &format!("| {name} | {as_read} | {turned} |\n");
    }
    text
}
