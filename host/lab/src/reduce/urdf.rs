//! A robot's URDF with the simpler bodies in place of its collision geometry; everything else stays as it was written.
//!
//! URDF has no capsule, so that one becomes a cylinder and two balls, which together are the same body. Of several hulls each becomes an
//! element.

use std::collections::HashMap;
use std::ops::Range;
use std::path::Path;

use nalgebra::{Matrix3, Point3, Vector3};
use ocb_core::mesh::obj;
use ocb_core::pose::Pose;
use ocb_core::scene::{Geometry, SceneObject};
use ocb_core::xml;
use ocb_sandbox::given;
use roxmltree::Node;

use super::{Reduced, within};
use crate::model::BodyKind;
use crate::recording::Recording;
use crate::scene_file::SceneFile;
use crate::scene_import::{self, Wanted, kinematics};
use crate::{LabError, Result};

/// Most bytes of a description.
const MOST_BYTES: u64 = 64 << 20;
/// Between two elements.
const BETWEEN: &str = "\n    ";
/// Two readers of one mesh may round each number to single precision.
const SINGLE: f64 = 1e-6;

/// A robot whose collision geometry is in a recording.
pub struct Robot {
    text: String,
    parts: Vec<Part>,
}

/// A collision element that was recorded.
struct Part {
    /// Where it is in the text.
    range: Range<usize>,
    /// The object, by its place in the recording.
    object: usize,
    /// As `ocb scene import` names it.
    name: String,
    /// As the file names it.
    shown: String,
    /// Its frame in that of its link.
    origin: Pose,
}

/// A robot with simpler collision geometry.
pub struct Urdf {
    /// The description.
    pub text: String,
    /// The files that it names, by their names relative to the description.
    pub meshes: Vec<(String, Vec<u8>)>,
}

impl Robot {
    /// Reads a robot. An object of the recording is one of its parts when it has the name that `ocb scene import` gives the part (link,
    /// underscore, number) and the same shape.
    ///
    /// # Errors
    /// `Invalid` for a file that cannot be read, when an object of that name has another shape, and when no object is the robot's.
    pub fn read(robot: &Path, wanted: &Wanted, recording: &Recording) -> Result<Self> {
        let name = robot.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bad = |why: String| LabError::Invalid(format!("{name:?} cannot be rewritten: {why}."));
        let imported = scene_import::import(robot, wanted)?.file;
        let bytes = given::read(robot, MOST_BYTES).map_err(|e| bad(e.to_string()))?;
        let text = String::from_utf8(bytes).map_err(|_| bad("it is not UTF-8".into()))?;
        let document = xml::parse(&text).map_err(|e| bad(e.to_string()))?;
        let own: HashMap<&str, &SceneObject> =
            imported.scene.objects.iter().map(|object| (object.name.as_str(), object)).collect();
        let objects = &recording.scene.scene.objects;
        let recorded: HashMap<&str, usize> =
            objects.iter().enumerate().map(|(at, object)| (object.name.as_str(), at)).collect();
        let mut parts = Vec::new();
        for link in document.root_element().children().filter(|node| node.has_tag_name("link")) {
            let collisions = link.children().filter(|node| node.has_tag_name("collision"));
            for (number, collision) in collisions.enumerate() {
                let name = format!("{}_{number}", link.attribute("name").unwrap_or_default());
                let (Some(own), Some(&object)) = (own.get(name.as_str()), recorded.get(name.as_str())) else {
                    continue;
                };
                if !alike((&imported, &own.geometry), (&recording.scene, &objects[object].geometry)) {
                    return Err(bad(format!(
                        "its collision geometry {name:?} has another shape than the recorded object"
                    )));
                }
                let shown = collision.attribute("name").unwrap_or(&name).to_owned();
                parts.push(Part { range: collision.range(), object, shown, origin: origin(collision), name });
            }
        }
        if parts.is_empty() {
            let why = "no object of the recording has the name of one of its links, an underscore and a number";
            return Err(bad(why.into()));
        }
        Ok(Self { text, parts })
    }

    /// The robot with what stands for its collision geometry.
    pub fn with(&self, reduced: &Reduced) -> Urdf {
        let (mut text, mut from) = (String::with_capacity(self.text.len()), 0);
        let mut meshes = Vec::new();
        for Part { range, object, name, shown, origin } in &self.parts {
            let stand_in = &reduced.stand_ins[*object];
            if stand_in.kind == BodyKind::Object {
                continue;
            }
            text.push_str(&self.text[from..range.start]);
            let place = within(origin, &stand_in.place);
            // Readers of robots take each mesh of hulls for convex.
            let one = |number: usize| (format!("{name}_hull_{number}"), format!("{shown}_hull_{number}"));
            let several = (0..).zip(&stand_in.hulls).map(|(number, mesh)| (one(number), Some(mesh)));
            let whole = [((name.clone(), shown.clone()), stand_in.mesh.as_ref())];
            let bodies: Vec<_> = if stand_in.hulls.is_empty() { whole.into() } else { several.collect() };
            let elements = bodies.iter().map(|((name, shown), _)| written(shown, &stand_in.geometry, &place, name));
            text.push_str(&elements.collect::<Vec<_>>().join(BETWEEN));
            from = range.end;
            for ((name, _), mesh) in bodies {
                meshes.extend(mesh.map(|mesh| (file(&name), obj::write(mesh).into_bytes())));
            }
        }
        text.push_str(&self.text[from..]);
        Urdf { text, meshes }
    }
}

fn file(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
    format!("collision/{}.obj", name.chars().map(plain).collect::<String>())
}

/// The same shape; meshes but for rounding to single precision, which is seen in their boxes.
fn alike(a: (&SceneFile, &Geometry), b: (&SceneFile, &Geometry)) -> bool {
    let mesh = |(file, geometry): (&SceneFile, &Geometry)| match geometry {
        Geometry::Mesh { sha256, .. } => file.meshes.get(sha256).cloned(),
        _ => None,
    };
    match (mesh(a), mesh(b)) {
        (Some(a), Some(b)) => {
            let near = |p: Point3<f64>, q: Point3<f64>| (p - q).amax() <= SINGLE * a.longest_side();
            let [own, other] = [a.bounds(), b.bounds()];
            a.triangles().len() == b.triangles().len() && near(own.min, other.min) && near(own.max, other.max)
        }
        (None, None) => a.1 == b.1,
        _ => false,
    }
}

/// The import has read the file, so that its numbers are some.
fn origin(collision: Node) -> Pose {
    let origin = collision.children().find(|node| node.has_tag_name("origin"));
    let numbers = |name: &str| {
        let text = origin.and_then(|node| node.attribute(name)).unwrap_or_default();
        let mut numbers = text.split_whitespace().filter_map(|number| number.parse::<f64>().ok());
        [0; 3].map(|_| numbers.next().unwrap_or_default())
    };
    Pose { linear: kinematics::roll_pitch_yaw(numbers("rpy")), translation: Vector3::from(numbers("xyz")) }
}

fn written(shown: &str, geometry: &Geometry, place: &Pose, name: &str) -> String {
    let one = |shown: &str, place: &Pose, shape: String| {
        let [x, y, z] = place.translation.into();
        let [r, p, w] = angles(&place.linear);
        format!(
            "<collision name=\"{}\">\n      <origin xyz=\"{x} {y} {z}\" rpy=\"{r} {p} {w}\"/>\n      <geometry>{shape}</geometry>\n    \
             </collision>",
            quoted(shown)
        )
    };
    match geometry {
        Geometry::Mesh { .. } => one(shown, place, format!("<mesh filename=\"{}\"/>", file(name))),
        Geometry::Box { size: [x, y, z] } => one(shown, place, format!("<box size=\"{x} {y} {z}\"/>")),
        Geometry::Sphere { radius } => one(shown, place, format!("<sphere radius=\"{radius}\"/>")),
        Geometry::Cylinder { radius, length } => {
            one(shown, place, format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>"))
        }
        Geometry::Capsule { radius, length } => {
            let ball = |end: &str, up: f64| {
                let at = Pose { translation: place.translation + place.linear * Vector3::z() * up, ..*place };
                one(&format!("{shown}_{end}"), &at, format!("<sphere radius=\"{radius}\"/>"))
            };
            let middle = one(shown, place, format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>"));
            match *length {
                0.0 => ball("ball", 0.0),
                length => [middle, ball("lower", -length / 2.0), ball("upper", length / 2.0)].join(BETWEEN),
            }
        }
    }
}

fn quoted(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

/// Roll, pitch and yaw of a rotation, radians. The roll is found after the yaw, so that both fit where the pitch is a right angle.
fn angles(r: &Matrix3<f64>) -> [f64; 3] {
    let pitch = (-r.m31).atan2(r.m11.hypot(r.m21));
    let yaw = r.m21.atan2(r.m11);
    let (sin, cos) = yaw.sin_cos();
    [(sin * r.m13 - cos * r.m23).atan2(cos * r.m22 - sin * r.m12), pitch, yaw]
}
