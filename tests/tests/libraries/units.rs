//! How many answers are wrong about whole objects in another unit of length.

use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;

use super::support::{Algorithm, configurations, hit, mesh};

const OBJECT: &str = "bunny65k";
/// The powers of two by which the scene is multiplied, which rounds nothing.
const SCALES: [i32; 5] = [10, 0, -3, -4, -5];
/// Configurations of each set.
const COUNT: usize = 20;

fn scaled(mesh: &Mesh, by: f64) -> Mesh {
    let positions = mesh.positions().iter().map(|p| p * by).collect();
    Mesh::new(positions, mesh.triangles().to_vec()).expect("as valid as before")
}

fn moved(pose: &Pose, by: f64) -> Pose {
    Pose { translation: pose.translation * by, ..*pose }
}

/// False collisions among configurations that are 1e-4 apart, and missed ones among such that meet.
fn wrong(algorithm: &Algorithm, mesh: &Mesh, power: i32) -> [usize; 2] {
    let by = 2f64.powi(power);
    let mut session = algorithm.start(&scaled(mesh, by), None);
    [("W1", false), ("W3", true)].map(|(set, meets)| {
        let all = configurations(&format!("{OBJECT}.{set}"), 1000 / COUNT);
        let wrong = |(_, c): &&(usize, Configuration)| {
            let there = Configuration { pose_a: moved(&c.pose_a, by), pose_b: moved(&c.pose_b, by) };
            hit(&mut session, &there) != meets
        };
        all.iter().filter(wrong).count()
    })
}

/// The table, as the document shows it.
pub fn table() -> String {
    let mut text = "\n## A whole object in another unit\n\n".to_owned();
    text += &format!(
        "{OBJECT} with itself, multiplied by a power of two, which rounds nothing; at 2^0 its bounding box has diagonal 1 and \
         half of its edges are shorter than 0.006. False collisions of {COUNT} that are 1e-4 of the diagonal apart / missed \
         ones of {COUNT} that meet.\n\n| algorithm |"
    );
    SCALES.iter().for_each(|power| text += &format!(" 2^{power} |"));
    text += &format!("\n| --- |{}\n", " ---: |".repeat(SCALES.len()));
    let mesh = mesh(OBJECT);
    for algorithm in ["box-tree", "bullet", "cgal", "coal", "embree", "fcl", "ode", "parry"].map(Algorithm::plain) {
        text += &format!("| `{}` |", algorithm.name());
        for power in SCALES {
            let [alarms, missed] = wrong(&algorithm, &mesh, power);
            text += &format!(" {alarms} / {missed} |");
        }
        text += "\n";
    }
    text
}
