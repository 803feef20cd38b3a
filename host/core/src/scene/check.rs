//! What must hold of a scene.

use std::collections::{HashMap, HashSet};

use super::{Geometry, Scene, SceneObject};
use crate::mesh::MAX_COORDINATE;
use crate::pose::AS_IT_IS;

/// Most objects of a scene.
pub const MOST_OBJECTS: usize = 100_000;
/// Most disabled pairs of a scene.
pub const MOST_DISABLED: usize = 5_000_000;
/// Numbers nearer to 0 than this, and not 0, are refused: exact arithmetic would pay for every digit.
const SMALLEST: f64 = 1e-100;
/// Bytes of a name, of a link, of a reason; of a source and of a licence.
const LONGEST_NAME: usize = 500;
const LONGEST_SOURCE: usize = 5_000;

/// Why something is no scene. Objects and pairs are numbered from 0; long names are cut.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// There is nothing in it.
    #[error("the scene has no objects; it needs at least one")]
    NoObjects,
    /// More objects than [`MOST_OBJECTS`].
    #[error("the scene has {0} objects, but at most {MOST_OBJECTS} are read; split it")]
    TooManyObjects(usize),
    /// More pairs than [`MOST_DISABLED`].
    #[error("the scene has {0} disabled pairs, but at most {MOST_DISABLED} are read; split it")]
    TooManyDisabled(usize),
    /// A text is empty, too long, or has control characters.
    #[error("the {what} of {of} must be 1 to {most} bytes without control characters")]
    Text {
        /// Which text.
        what: &'static str,
        /// Whose.
        of: String,
        /// Its longest form.
        most: usize,
    },
    /// Two objects have one name.
    #[error("the objects {first} and {second} are both named {name:?}; rename one of them")]
    SameName {
        /// The one.
        first: usize,
        /// The other.
        second: usize,
        /// Their name.
        name: String,
    },
    /// A hash is not written as SHA-256.
    #[error("the mesh of object {0} must be named by 64 lower-case hexadecimal digits, its SHA-256")]
    Hash(usize),
    /// A length that cannot be computed with.
    #[error("the {what} of object {object} is {value:e}, but it must be between {SMALLEST:e} and {MAX_COORDINATE:e}")]
    Size {
        /// The object.
        object: usize,
        /// Which length.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A scale that flattens, or cannot be computed with.
    #[error(
        "a scale of object {object} is {value:e}; its magnitude must be between {SMALLEST:e} and {MAX_COORDINATE:e}"
    )]
    Scale {
        /// The object.
        object: usize,
        /// The factor.
        value: f64,
    },
    /// A number of a pose that cannot be computed with.
    #[error(
        "the pose of object {object} has the number {value:e}; it must be 0 or between {SMALLEST:e} and {MAX_COORDINATE:e}"
    )]
    PoseNumber {
        /// The object.
        object: usize,
        /// The number.
        value: f64,
    },
    /// A pose that is not rigid.
    #[error(
        "the pose of object {object} must be a rotation and a translation, and its matrix R is off (R^T R by {off:.1e}, at \
         most {AS_IT_IS:.0e}, without a mirror); use the nearest rotation, and apply scale to the mesh"
    )]
    NotRigid {
        /// The object.
        object: usize,
        /// [`Pose::off_rotation`](crate::pose::Pose::off_rotation).
        off: f64,
    },
    /// A pair that is no pair of the scene's objects.
    #[error("the disabled pair {pair} is {a} and {b}; it must name two objects, the smaller number first, of 0 to {}", objects - 1)]
    Pair {
        /// Number of the pair.
        pair: usize,
        /// The one.
        a: u32,
        /// The other.
        b: u32,
        /// How many objects there are.
        objects: usize,
    },
    /// A pair stands there twice.
    #[error("the objects {a} and {b} are a disabled pair twice; keep one of the two")]
    SamePair {
        /// The one.
        a: u32,
        /// The other.
        b: u32,
    },
}

/// See [`Scene::check`].
pub fn check(scene: &Scene) -> Result<(), SceneError> {
    text("name", LONGEST_NAME, &scene.name, || "the scene".to_owned())?;
    let objects = scene.objects.len();
    if objects == 0 {
        return Err(SceneError::NoObjects);
    }
    if objects > MOST_OBJECTS {
        return Err(SceneError::TooManyObjects(objects));
    }
    let mut named = HashMap::with_capacity(objects);
    for (index, object) in scene.objects.iter().enumerate() {
        check_object(index, object)?;
        if let Some(first) = named.insert(object.name.as_str(), index) {
            return Err(SceneError::SameName { first, second: index, name: shown(&object.name) });
        }
    }
    if scene.disabled.len() > MOST_DISABLED {
        return Err(SceneError::TooManyDisabled(scene.disabled.len()));
    }
    let mut pairs = HashSet::with_capacity(scene.disabled.len());
    for (pair, disabled) in scene.disabled.iter().enumerate() {
        let (a, b) = (disabled.a, disabled.b);
        if a >= b || b as usize >= objects {
            return Err(SceneError::Pair { pair, a, b, objects });
        }
        if !pairs.insert((a, b)) {
            return Err(SceneError::SamePair { a, b });
        }
        text("reason", LONGEST_NAME, &disabled.reason, || format!("disabled pair {pair}"))?;
    }
    Ok(())
}

fn check_object(index: usize, object: &SceneObject) -> Result<(), SceneError> {
    let of = || format!("object {index}");
    text("name", LONGEST_NAME, &object.name, of)?;
    if let Some(link) = &object.link {
        text("link", LONGEST_NAME, link, of)?;
    }
    if !object.source.is_empty() {
        text("source", LONGEST_SOURCE, &object.source, of)?;
    }
    if let Some(licence) = &object.licence {
        text("licence", LONGEST_SOURCE, licence, of)?;
    }
    let lengths: &[(&'static str, f64)] = match &object.geometry {
        Geometry::Mesh { sha256, .. } => {
            if sha256.len() != 64 || !sha256.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f')) {
                return Err(SceneError::Hash(index));
            }
            &[]
        }
        Geometry::Box { size: [x, y, z] } => &[("length in x", *x), ("length in y", *y), ("length in z", *z)],
        Geometry::Sphere { radius } => &[("radius", *radius)],
        Geometry::Cylinder { radius, length } => &[("radius", *radius), ("length", *length)],
        // A capsule may be a ball.
        Geometry::Capsule { radius, length: 0.0 } => &[("radius", *radius)],
        Geometry::Capsule { radius, length } => &[("radius", *radius), ("length", *length)],
    };
    let in_range = |x: f64| (SMALLEST..=MAX_COORDINATE).contains(&x);
    if let Some(&(what, value)) = lengths.iter().find(|(_, value)| !in_range(*value)) {
        return Err(SceneError::Size { object: index, what, value });
    }
    if let Some(&value) = object.scale.iter().find(|x| !in_range(x.abs())) {
        return Err(SceneError::Scale { object: index, value });
    }
    let pose = &object.pose;
    let mut numbers = pose.linear.iter().chain(pose.translation.iter());
    if let Some(&value) = numbers.find(|&&x| x != 0.0 && !in_range(x.abs())) {
        return Err(SceneError::PoseNumber { object: index, value });
    }
    let off = pose.off_rotation();
    if off > AS_IT_IS {
        return Err(SceneError::NotRigid { object: index, off });
    }
    Ok(())
}

fn text(what: &'static str, most: usize, text: &str, of: impl FnOnce() -> String) -> Result<(), SceneError> {
    if text.is_empty() || text.len() > most || text.contains(char::is_control) {
        return Err(SceneError::Text { what, of: of(), most });
    }
    Ok(())
}

/// A name, short enough for a message.
fn shown(name: &str) -> String {
    name.chars().take(60).collect()
}
