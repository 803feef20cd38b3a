//! What the advisor's program is asked by the service or the command, and what it sends back.
//!
//! The program calls libraries of others on visitors' meshes, so whatever comes back is read as hostile input: [`Rung::read`] and
//! [`Advice::check`] say what must hold before anything else looks at it.

use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::mesh::{Mesh, MeshError};
use serde::{Deserialize, Serialize};

use crate::advice::{Advice, Levels};
use crate::certificate::{Certificate, VERSION};
use crate::question::Question;

/// The steps of the work, as the program numbers them.
pub const STEPS: [&str; 6] =
    ["levels", "configurations", "held-out configurations", "other methods", "measuring", "checking"];

/// What the program is started for.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Order {
    /// CPUs to work on.
    pub threads: usize,
    /// The task.
    pub task: Task,
}

/// One piece of work.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Task {
    /// The levels of an object: [`Reply::Ladder`]. No other object is in the process, so what an object does to the libraries can
    /// only spoil its own levels.
    Ladder {
        /// The object.
        object: Parts,
        /// Certificates of its levels that were found before.
        known: Vec<Certificate>,
    },
    /// What may stand for an object, without certificates: [`Reply::Simpler`].
    Simplify(Parts),
    /// Advice about a scene: [`Reply::Advice`].
    Advise(Box<Scene>),
}

/// A scene, whose objects have their levels.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Scene {
    /// Object A.
    pub a: Object,
    /// Object B; the same object as A when absent.
    pub b: Option<Object>,
    /// What is asked.
    pub question: Question,
    /// Relative distances of the configurations.
    pub distances: Vec<f64>,
    /// How many configurations to choose by, and how many others to check by.
    pub counts: [u32; 2],
    /// Of the first ones; the others have the next.
    pub seed: u64,
}

/// An object and its levels, the finest first.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Object {
    /// The object.
    pub mesh: Parts,
    /// Its levels.
    pub levels: Vec<Rung>,
}

/// What the program sends back.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Reply {
    /// The levels of an object, the finest first.
    Ladder(Vec<Rung>),
    /// What may stand for an object.
    Simpler(Simpler),
    /// Advice about a scene.
    Advice(Box<Advice>),
    /// The second object never comes that close.
    NeverThatClose,
    /// There are no such configurations, and why.
    Impossible(String),
}

/// What may stand for an object. Nothing is known of how well it does.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Simpler {
    /// Levels with fewer and fewer triangles.
    pub levels: Vec<Parts>,
    /// The convex hull; absent for a flat object.
    pub hull: Option<Parts>,
    /// Convex hulls of parts, the object being cut in several ways.
    pub parts: Vec<Vec<Parts>>,
}

/// A level of an object.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Rung {
    /// Its mesh.
    pub mesh: Parts,
    /// What is known of it.
    pub certificate: Certificate,
}

/// A mesh as numbers.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Parts {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Parts {
    /// Those of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        Self {
            positions: mesh.positions().iter().map(|p| [p.x, p.y, p.z]).collect(),
            triangles: mesh.triangles().to_vec(),
        }
    }

    /// The mesh, if it is one.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn mesh(self) -> Result<Mesh, MeshError> {
        Mesh::new(self.positions.into_iter().map(Point3::from).collect(), self.triangles)
    }
}

impl Rung {
    /// The level as it may stand for this object, whose hash is `object`: a mesh with fewer triangles than `before`, and a
    /// certificate of these two with lengths that are some.
    ///
    /// # Errors
    /// What does not fit.
    pub fn read(self, object: &str, before: usize) -> Result<(Arc<Mesh>, Certificate), String> {
        let Self { mesh, certificate } = self;
        let mesh = Arc::new(mesh.mesh().map_err(|e| e.to_string())?);
        if mesh.triangles().len() >= before {
            return Err("a level has more triangles than the one before".to_owned());
        }
        if certificate.version != VERSION || certificate.object != object || certificate.reduced != mesh.sha256() {
            return Err("a certificate speaks of something else".to_owned());
        }
        let fits = |lengths: &Vec<f64>| {
            lengths.len() == mesh.triangles().len() && lengths.iter().all(|length| length.is_finite() && *length >= 0.0)
        };
        if !fits(&certificate.thickness) || !fits(&certificate.deviation) {
            return Err("a certificate has lengths that are none".to_owned());
        }
        Ok((mesh, certificate))
    }
}

impl Advice {
    /// Does this answer a question about objects whose levels have so many triangles, and so many vertices at their finest? All
    /// that is used to find a level or a vertex is looked at; no other number can do harm.
    ///
    /// # Errors
    /// What does not fit.
    pub fn check(&self, question: Question, levels: [&[usize]; 2], vertices: [usize; 2]) -> Result<(), String> {
        let lists = [&self.levels_a, &self.levels_b];
        let same =
            |side: usize| lists[side].iter().map(|level| level.triangles as usize).eq(levels[side].iter().copied());
        if self.question != question || !same(0) || !same(1) {
            return Err("the advice is about something else".to_owned());
        }
        let is_level = |[a, b]: &Levels| *a < levels[0].len() && *b < levels[1].len();
        if !self.stages.iter().chain(self.points.iter().flat_map(|point| &point.stages)).all(is_level) {
            return Err("the advice names a level that is none".to_owned());
        }
        let fits =
            |side: usize| [self.detail[side].triangles.len(), self.detail[side].counts.len()] == [vertices[side]; 2];
        if !fits(0) || !fits(1) {
            return Err("the advice does not speak of each vertex".to_owned());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soup(triangles: u32) -> Mesh {
        let corner = |i: u32| Point3::new(f64::from(i), f64::from(i * i % 7), f64::from(i % 3));
        let corners = (0..3 * triangles).map(corner).collect();
        Mesh::new(corners, (0..triangles).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect()).expect("a mesh")
    }

    #[test]
    fn a_level_that_does_not_fit_is_refused() {
        let (object, reduced) = (soup(9), soup(4));
        let certificate = Certificate {
            version: VERSION,
            object: object.sha256(),
            reduced: reduced.sha256(),
            thickness: vec![0.5; 4],
            deviation: vec![0.0; 4],
        };
        let good = Rung { mesh: Parts::of(&reduced), certificate };
        let read = |change: fn(&mut Rung), before| {
            let mut rung = good.clone();
            change(&mut rung);
            rung.read(&object.sha256(), before).err()
        };
        assert_eq!(read(|_| {}, 5), None);
        assert!(read(|_| {}, 4).is_some_and(|why| why.contains("more triangles")));
        for change in [
            (|rung| rung.mesh.triangles[3][1] = 12) as fn(&mut Rung),
            |rung| rung.mesh.positions[2][0] = f64::NAN,
            |rung| rung.mesh.positions[2][0] = 0.25,
            |rung| rung.certificate.object.push('0'),
            |rung| rung.certificate.version += 1,
            |rung| rung.certificate.thickness.truncate(3),
            |rung| rung.certificate.deviation[1] = -1e-9,
            |rung| rung.certificate.deviation[1] = f64::INFINITY,
        ] {
            assert!(read(change, 5).is_some());
        }
    }
    #[test]
    fn advice_that_names_what_is_not_there_is_refused() {
        let number = serde_json::json!({ "value": 1.0, "lo": 1.0, "hi": 1.0 });
        let share = serde_json::json!({ "seen": 0, "of": 1, "lo": 0.0, "hi": 1.0 });
        let level = |triangles| serde_json::json!({ "triangles": triangles, "thickness": 0.0, "deviation": 0.0 });
        let good: Advice = serde_json::from_value(serde_json::json!({
            "question": { "kind": "clearance", "clearance": 0.5 }, "distances": [0.1], "configurations": 1,
            "longest_side": 1.0, "levels_a": [level(9), level(4)], "levels_b": [level(8)], "stages": [[1, 0]],
            "triangles_before": 17, "triangles_after": 12, "faster": number, "faster_than_same_question": number,
            "held_out": { "violations": share, "wrong": share, "falls_back": share },
            "points": [{
                "kind": "levels", "stages": [[1, 0]], "elements": 12, "micros": number, "faster": number,
                "certified": true, "advised": true,
            }],
            "detail": [{ "triangles": [null, 4.0], "counts": [0, 1] }, { "triangles": [8.0], "counts": [1] }],
            "seconds": 1.0,
        }))
        .expect("advice");
        let check = |change: fn(&mut Advice)| {
            let mut advice = good.clone();
            change(&mut advice);
            advice.check(Question::Clearance { clearance: 0.5 }, [&[9, 4], &[8]], [2, 1]).err()
        };
        assert_eq!(check(|_| {}), None);
        for change in [
            (|advice| advice.stages[0] = [2, 0]) as fn(&mut Advice),
            |advice| advice.points[0].stages[0] = [0, 1],
            |advice| advice.levels_a.truncate(1),
            |advice| advice.levels_b[0].triangles = 7,
            |advice| advice.detail[0].counts.push(0),
            |advice| advice.detail[1].triangles.clear(),
            |advice| advice.question = Question::Clearance { clearance: 0.25 },
        ] {
            assert!(check(change).is_some());
        }
    }
}
