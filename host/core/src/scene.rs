//! A scene of many objects: what a robot, an assembly or a simulation consists of, with the pairs that are not asked.
//!
//! Lengths are in one unit for the whole scene, the unit of its source (metres for URDF, MJCF and SDF); angles do not occur.
//! A pose places an object's own frame in the frame of the scene. Primitives are kept as what they are.
//!
//! The types say what a scene consists of; [`Scene::check`] says whether it is one. Files are checked when they are read and
//! written, so that later code may rely on it.

pub mod around;
mod check;
mod row_major;
pub mod tessellate;

use serde::{Deserialize, Serialize};

use crate::pose::Pose;
pub use check::{MOST_DISABLED, MOST_OBJECTS, SceneError};

/// The shape of an object in its own frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Geometry {
    /// A triangle mesh, already in the units of the scene (scale applied).
    Mesh {
        /// SHA-256 (lower-case hex) of the bytes of its PLY file, in which the scene file keeps it.
        sha256: String,
        /// Is it a solid body, which another object inside it collides with? It must be closed. Otherwise only its surface counts.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        solid: bool,
    },
    /// A box around the origin, its faces perpendicular to the axes.
    Box {
        /// Full lengths of the edges along x, y and z; each positive.
        size: [f64; 3],
    },
    /// A ball around the origin.
    Sphere {
        /// Positive.
        radius: f64,
    },
    /// A cylinder around the z axis, `|z| <= length / 2`.
    Cylinder {
        /// Positive.
        radius: f64,
        /// Positive.
        length: f64,
    },
    /// All points within `radius` of the segment `|z| <= length / 2` of the z axis.
    Capsule {
        /// Positive.
        radius: f64,
        /// Length of the cylinder part, without the caps: 0 (a ball) or more.
        length: f64,
    },
}

/// One object of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneObject {
    /// Its name, the only one of this spelling in the scene.
    pub name: String,
    /// Objects of one link move together.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    /// Its shape.
    pub geometry: Geometry,
    /// Where it stands in the scene (all joints at zero for a robot, unless the import said otherwise): a rotation up to
    /// [`AS_IT_IS`](crate::pose::AS_IT_IS). In files the upper three rows of the matrix, row-major.
    #[serde(with = "row_major")]
    pub pose: Pose,
    /// Where it comes from, e.g. `package://ur_description/meshes/ur5/collision/base.stl`; may be empty.
    pub source: String,
    /// The scale along its own axes that the source stated, negative for a mirror; already applied.
    pub scale: [f64; 3],
    /// Licence of its source, where that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub licence: Option<String>,
}

/// Two objects whose collisions are not asked.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DisabledPair {
    /// Index of an object.
    pub a: u32,
    /// Index of another, larger than `a`.
    pub b: u32,
    /// Why: of an SRDF file, the same link, adjacent links.
    pub reason: String,
}

/// Objects with their places, and the pairs that are not asked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// Its name: of the robot, the model or the file.
    pub name: String,
    /// The objects; others name them by their index, counted from 0.
    pub objects: Vec<SceneObject>,
    /// Each pair at most once.
    #[serde(default)]
    pub disabled: Vec<DisabledPair>,
}

impl Scene {
    /// Is this a scene? Every value that a file brings must pass.
    ///
    /// # Errors
    /// The first thing that is wrong, in one sentence without its full stop.
    pub fn check(&self) -> Result<(), SceneError> {
        check::check(self)
    }
}

#[cfg(test)]
mod tests;
