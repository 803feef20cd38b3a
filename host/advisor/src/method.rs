//! Methods of the plugins, asked in this process: an object is loaded once, and a configuration gets an answer.

use std::sync::Arc;

use ocb_advice::Question;
use ocb_core::configuration::Configuration;
use ocb_core::lod::Interval;
use ocb_core::mesh::Mesh;
use ocb_methods::convex_parts::ConvexParts;
use ocb_methods::inner_spheres::InnerSpheres;
use ocb_methods::parry::{double, single};
use ocb_methods::voxmap_pointshell::VoxmapPointshell;
use opencollbench_plugin::{Algorithm, Answer, Collision, Distance, Placed, Pose, Refusal, Uncounted};

use crate::question::Told;

/// Asks a method about a configuration.
pub(crate) type Ask = Box<dyn FnMut(&Configuration) -> Result<Told, String> + Send>;

/// A method that can be asked the advisor's questions.
pub(crate) trait Method: Algorithm<Object: Send + Sync> + Send {
    /// The answer; to a distance that is not there, whether it is more than the tolerance.
    fn told(&mut self, a: Placed<Self>, b: Placed<Self>, question: Question) -> Answer<Told>;

    /// How many elements a model consists of.
    fn elements(object: &Self::Object) -> usize;
}

/// One object, as a method keeps it.
pub(crate) fn load<M: Method>(method: &mut M, mesh: &Mesh) -> Result<Arc<M::Object>, String> {
    let positions: Vec<[f64; 3]> = mesh.positions().iter().map(|p| [p.x, p.y, p.z]).collect();
    let view = opencollbench_plugin::Mesh { positions: &positions, triangles: mesh.triangles() };
    method.load_mesh(view).map(Arc::new).map_err(words)
}

/// Both objects, ready to be asked.
pub(crate) fn ask<M: Method>(mut method: M, [a, b]: [Arc<M::Object>; 2], question: Question) -> Ask {
    Box::new(move |configuration: &Configuration| {
        let [pose_a, pose_b] = [configuration.pose_a, configuration.pose_b].map(|pose| Pose(pose.to_row_major()));
        let (a, b) = (Placed { object: &*a, pose: &pose_a }, Placed { object: &*b, pose: &pose_b });
        method.told(a, b, question).map_err(words)
    })
}

/// Why there is no answer.
fn words(refusal: Refusal) -> String {
    match refusal {
        Refusal::GaveUp => "it gave up on a configuration".to_owned(),
        Refusal::Unsupported => "it does not answer this question".to_owned(),
        // For the host of plugins, which tells by it that the mesh is the reason.
        Refusal::Error(why) => why.strip_prefix("unsupported mesh: ").unwrap_or(&why).to_owned(),
    }
}

/// The distance, or only whether it is more than the clearance: whatever the method has for either.
fn either<M: Method + Distance>(
    method: &mut M,
    [a, b]: [Placed<M>; 2],
    question: Question,
    within: impl FnOnce(&mut M, f64) -> Answer<bool>,
) -> Answer<Told> {
    Ok(match question {
        Question::Distance { .. } => {
            let distance = method.distance(a, b, &mut Uncounted)?.distance;
            Told::Distance(Interval { lo: distance, hi: distance })
        }
        Question::Clearance { clearance } => Told::Clear(!within(method, clearance)?),
    })
}

impl Method for ConvexParts {
    fn told(&mut self, a: Placed<Self>, b: Placed<Self>, question: Question) -> Answer<Told> {
        either(self, [a, b], question, |parts, reach| Ok(parts.within(a, b, reach, &mut Uncounted)))
    }

    /// Triangles of the hulls.
    fn elements(parts: &Self::Object) -> usize {
        parts.iter().map(|part| part.triangles).sum()
    }
}

impl Method for InnerSpheres {
    fn told(&mut self, a: Placed<Self>, b: Placed<Self>, question: Question) -> Answer<Told> {
        either(self, [a, b], question, |spheres, reach| Ok(spheres.within(a, b, reach, &mut Uncounted)))
    }

    /// Spheres.
    fn elements(tree: &Self::Object) -> usize {
        tree.balls.len()
    }
}

impl Method for VoxmapPointshell {
    fn told(&mut self, a: Placed<Self>, b: Placed<Self>, _: Question) -> Answer<Told> {
        // The maps were made for the clearance.
        Ok(Told::Clear(self.collide(a, b, &mut Uncounted)? == Collision::Apart))
    }

    /// Voxels that the surface passes through, each also a point.
    fn elements(voxels: &Self::Object) -> usize {
        voxels.points.len()
    }
}

impl Method for double::Parry {
    fn told(&mut self, a: Placed<Self>, b: Placed<Self>, question: Question) -> Answer<Told> {
        either(self, [a, b], question, |parry, reach| parry.within(a, b, reach, &mut Uncounted))
    }

    /// Triangles of the object.
    fn elements(mesh: &Self::Object) -> usize {
        mesh.num_triangles()
    }
}

impl Method for single::Parry {
    fn told(&mut self, a: Placed<Self>, b: Placed<Self>, question: Question) -> Answer<Told> {
        either(self, [a, b], question, |parry, reach| parry.within(a, b, reach, &mut Uncounted))
    }

    /// Triangles of the object.
    fn elements(mesh: &Self::Object) -> usize {
        mesh.num_triangles()
    }
}
