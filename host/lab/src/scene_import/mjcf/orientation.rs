//! How MJCF states where something is: a place, and one of several forms of an orientation.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use ocb_core::pose::Pose;

use crate::scene_import::Found;
use crate::scene_import::element::Element;
use crate::scene_import::kinematics::{about, within};

/// The attributes of which an element has one at most.
pub const FORMS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

/// What a model says of its angles.
#[derive(Clone, Debug)]
pub struct Angles {
    /// One unit of an angle in radians.
    pub unit: f64,
    /// The axes of Euler angles: x, y, z about the turned frame, X, Y, Z about the fixed one.
    pub sequence: [char; 3],
}

impl Angles {
    /// The frame of an element in the one around it.
    pub fn pose(&self, element: &Element) -> Found<Pose> {
        let translation = Vector3::from(element.numbers::<3>("pos")?.unwrap_or_default());
        Ok(Pose { linear: self.orientation(element)?, translation })
    }

    fn orientation(&self, element: &Element) -> Found<Matrix3<f64>> {
        let axis = |name: &str, xyz: [f64; 3]| {
            let axis = Vector3::from(xyz).try_normalize(0.0);
            axis.ok_or_else(|| element.fault(&format!("an axis of {name} is 0 0 0")))
        };
        if let Some([w, x, y, z]) = element.numbers("quat")? {
            let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0);
            let turn = turn.ok_or_else(|| element.fault("quat is 0 0 0 0"))?;
            return Ok(Rotation3::from(turn).into_inner());
        }
        if let Some([x, y, z, angle]) = element.numbers("axisangle")? {
            return Ok(about(&axis("axisangle", [x, y, z])?, angle * self.unit));
        }
        if let Some(angles) = element.numbers::<3>("euler")? {
            let turn = |turned: Matrix3<f64>, (letter, angle): (&char, f64)| {
                let axis = match letter.to_ascii_lowercase() {
                    'x' => Vector3::x(),
                    'y' => Vector3::y(),
                    _ => Vector3::z(),
                };
                let next = about(&axis, angle * self.unit);
                if letter.is_ascii_lowercase() { turned * next } else { next * turned }
            };
            return Ok(self.sequence.iter().zip(angles).fold(Matrix3::identity(), turn));
        }
        if let Some([a, b, c, d, e, f]) = element.numbers("xyaxes")? {
            let x = axis("xyaxes", [a, b, c])?;
            let y = Vector3::new(d, e, f);
            let y = axis("xyaxes", (y - x * x.dot(&y)).into())?;
            return Ok(Matrix3::from_columns(&[x, y, x.cross(&y)]));
        }
        match element.numbers::<3>("zaxis")? {
            Some(z) => Ok(z_to(&axis("zaxis", z)?)),
            None => Ok(Matrix3::identity()),
        }
    }
}

/// The shortest turn of the z axis to a direction of length 1; half a turn about x, if that is opposite.
pub fn z_to(direction: &Vector3<f64>) -> Matrix3<f64> {
    let axis = Vector3::z().cross(direction);
    let sin = axis.norm();
    let axis = axis.try_normalize(1e-10).unwrap_or_else(Vector3::x);
    about(&axis, libm::atan2(sin, direction.z))
}

/// By how much a joint that turns about a place moves its body.
pub fn turned_about(place: &Vector3<f64>, axis: &Vector3<f64>, angle: f64) -> Pose {
    let there = |translation: Vector3<f64>| Pose { linear: Matrix3::identity(), translation };
    let turn = Pose { linear: about(axis, angle), translation: Vector3::zeros() };
    within(&within(&there(*place), &turn), &there(-place))
}
