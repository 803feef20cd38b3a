//! A robot's URDF with the simpler bodies in place of its collision geometry; everything else stays as it was written.
//!
//! URDF has no capsule, so that one becomes a cylinder and two balls, which together are the same body.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};
use ocb_core::mesh::{Mesh, obj};
use ocb_core::pose::Pose;
use ocb_core::scene::Geometry;
use ocb_core::xml;
use ocb_sandbox::given;
use roxmltree::Node;

use super::{Reduced, within};
use crate::recording::Recording;
use crate::scene_import::{self, Wanted, kinematics};
use crate::{LabError, Result};

/// Most bytes of a description.
const MOST_BYTES: u64 = 64 << 20;
/// Two readers of one mesh may round each number to single precision.
const SINGLE: f64 = 1e-6;

/// A robot with simpler collision geometry.
pub struct Urdf {
    /// The description.
    pub text: String,
    /// The files that it names, by their names relative to the description.
    pub meshes: Vec<(String, Vec<u8>)>,
    /// How many collision elements were replaced.
    pub replaced: u64,
}

/// Replaces the collision geometry of a robot by what stands for it. An object of the recording is the robot's when it has the name
/// that `ocb scene import` gives it (link, underscore, number) and the same shape.
///
/// # Errors
/// `Invalid` for a file that cannot be read, when an object of that name has another shape, and when no object is the robot's.
pub fn urdf(robot: &Path, wanted: &Wanted, recording: &Recording, reduced: &Reduced) -> Result<Urdf> {
    let name = robot.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let bad = |why: String| LabError::Invalid(format!("{name:?} cannot be rewritten: {why}."));
    let imported = scene_import::import(robot, wanted)?.file;
    let bytes = given::read(robot, MOST_BYTES).map_err(|e| bad(e.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| bad("it is not UTF-8".into()))?;
    let document = xml::parse(&text).map_err(|e| bad(e.to_string()))?;
    let recorded: HashMap<&str, usize> =
        recording.scene.scene.objects.iter().enumerate().map(|(at, object)| (object.name.as_str(), at)).collect();
    let (mut cuts, mut meshes, mut known) = (Vec::new(), Vec::new(), false);
    for link in document.root_element().children().filter(|node| node.has_tag_name("link")) {
        let collisions = link.children().filter(|node| node.has_tag_name("collision"));
        for (number, collision) in collisions.enumerate() {
            let name = format!("{}_{number}", link.attribute("name").unwrap_or_default());
            let own = imported.scene.objects.iter().find(|object| object.name == name);
            let (Some(&at), Some(own)) = (recorded.get(name.as_str()), own) else { continue };
            known = true;
            let object = &recording.scene.scene.objects[at];
            let mesh = |of: &crate::scene_file::SceneFile, geometry: &Geometry| match geometry {
                Geometry::Mesh { sha256, .. } => of.meshes.get(sha256).cloned(),
                _ => None,
            };
            let same = match (mesh(&imported, &own.geometry), mesh(&recording.scene, &object.geometry)) {
                (Some(own), Some(recorded)) => alike(&own, &recorded),
                (None, None) => own.geometry == object.geometry,
                _ => false,
            };
            if !same {
                return Err(bad(format!("its collision geometry {name:?} has another shape than the recorded object")));
            }
            let stand_in = &reduced.stand_ins[at];
            if stand_in.kind != super::BodyKind::Object {
                let place = within(&origin(collision), &stand_in.place);
                let shown = collision.attribute("name").unwrap_or(&name);
                let body = written(shown, &stand_in.geometry, &place, &name);
                if let Some(mesh) = &stand_in.mesh {
                    meshes.push((file(&name), obj::write(mesh).into_bytes()));
                }
                cuts.push((collision.range(), body));
            }
        }
    }
    if !known {
        return Err(bad(
            "no object of the recording has the name of one of its links, an underscore and a number".into()
        ));
    }
    let (mut out, mut from) = (String::with_capacity(text.len()), 0);
    for (range, body) in &cuts {
        out.push_str(&text[from..range.start]);
        out.push_str(body);
        from = range.end;
    }
    out.push_str(&text[from..]);
    Ok(Urdf { text: out, meshes, replaced: cuts.len() as u64 })
}

fn file(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '_' || c == '-' { c } else { '_' };
    format!("collision/{}.obj", name.chars().map(plain).collect::<String>())
}

/// The same triangles, but for rounding to single precision.
fn alike(a: &Arc<Mesh>, b: &Arc<Mesh>) -> bool {
    let near = |[p, q]: [nalgebra::Point3<f64>; 2]| (p - q).amax() <= SINGLE * a.longest_side();
    a.triangles().len() == b.triangles().len()
        && near([a.bounds().min, b.bounds().min])
        && near([a.bounds().max, b.bounds().max])
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
                length => [middle, ball("lower", -length / 2.0), ball("upper", length / 2.0)].join("\n    "),
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
