//! Where the links of a robot are: a tree of frames, and its joints at given values.

use std::collections::HashMap;

use nalgebra::{Matrix3, Vector3};
use ocb_core::pose::Pose;

use super::{Found, shown};

/// How a joint moves its child, about or along an axis of length 1 in its own frame.
#[derive(Clone, Copy, Debug)]
pub enum Motion {
    /// Not by one number: fixed, or of several degrees of freedom, which are at zero.
    None,
    /// About the axis, in radians.
    Turn(Vector3<f64>),
    /// Along the axis.
    Slide(Vector3<f64>),
}

/// The value of a joint as that of another: `factor * value + offset`.
#[derive(Clone, Debug)]
pub struct Mimic {
    /// The name of the other joint, which is there.
    pub of: String,
    /// Of its value.
    pub factor: f64,
    /// Added to that.
    pub offset: f64,
}

/// A joint between two links.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Index of the link above.
    pub parent: usize,
    /// Index of the link below.
    pub child: usize,
    /// The frame of the joint in that of the parent, which at value 0 is the frame of the child.
    pub origin: Pose,
    /// How it moves.
    pub motion: Motion,
    /// Whether it follows another.
    pub mimic: Option<Mimic>,
}

/// The poses of all links in the frame of the root.
pub fn place(links: &[String], joints: &[Joint], given: &[(String, f64)]) -> Found<Vec<Pose>> {
    let values = values(joints, given)?;
    let mut above = vec![None; links.len()];
    let mut below = vec![Vec::new(); links.len()];
    for (index, joint) in joints.iter().enumerate() {
        if let Some(first) = above[joint.child].replace(index) {
            let (first, link) = (&joints[first].name, &links[joint.child]);
            return Err(format!(
                "the link {} is the child of two joints, {} and {}",
                shown(link),
                shown(first),
                shown(&joint.name)
            ));
        }
        below[joint.parent].push(index);
    }
    let mut roots = (0..links.len()).filter(|&link| above[link].is_none());
    let root = roots.next().ok_or_else(|| format!("its joints form a cycle through the link {}", shown(&links[0])))?;
    if let Some(other) = roots.next() {
        return Err(format!(
            "the links {} and {} are both no joint's child; connect the parts, one root is needed",
            shown(&links[root]),
            shown(&links[other])
        ));
    }
    let mut poses = vec![None; links.len()];
    poses[root] = Some(Pose::identity());
    let mut open = vec![(root, Pose::identity())];
    while let Some((link, pose)) = open.pop() {
        for &index in &below[link] {
            let joint = &joints[index];
            let child = within(&within(&pose, &joint.origin), &moved(joint.motion, values[index]));
            poses[joint.child] = Some(child);
            open.push((joint.child, child));
        }
    }
    let lost = poses.iter().position(Option::is_none);
    let cycle = |link: usize| format!("its joints form a cycle through the link {}", shown(&links[link]));
    lost.map_or_else(|| Ok(poses.into_iter().flatten().collect()), |link| Err(cycle(link)))
}

/// The value of each joint: as given, as that of the one it follows, or 0.
fn values(joints: &[Joint], given: &[(String, f64)]) -> Found<Vec<f64>> {
    let mut by_name = HashMap::with_capacity(joints.len());
    for (index, joint) in joints.iter().enumerate() {
        if by_name.insert(joint.name.as_str(), index).is_some() {
            return Err(format!("two joints are named {}; rename one of them", shown(&joint.name)));
        }
    }
    let mut values = vec![None; joints.len()];
    for (name, value) in given {
        let index = *by_name.get(name.as_str()).ok_or_else(|| format!("it has no joint {}", shown(name)))?;
        if matches!(joints[index].motion, Motion::None) {
            return Err(format!("the joint {} has not one value; only turning and sliding joints have", shown(name)));
        }
        if values[index].replace(*value).is_some() {
            return Err(format!("the joint {} is given two values", shown(name)));
        }
    }
    for start in 0..joints.len() {
        // The joints that follow each other, up to one that is known.
        let (mut chain, mut at) = (Vec::new(), start);
        while values[at].is_none() {
            let Some(mimic) = &joints[at].mimic else {
                values[at] = Some(0.0);
                break;
            };
            chain.push(at);
            at = by_name[mimic.of.as_str()];
            if chain.len() > joints.len() {
                return Err(format!("the joint {} follows itself", shown(&joints[at].name)));
            }
        }
        for at in chain.into_iter().rev() {
            if let Some(mimic) = &joints[at].mimic {
                let value = values[by_name[mimic.of.as_str()]].unwrap_or_default();
                values[at] = Some(mimic.factor * value + mimic.offset);
            }
        }
    }
    Ok(values.into_iter().map(Option::unwrap_or_default).collect())
}

/// By how much a joint of this value moves its child.
pub fn moved(motion: Motion, value: f64) -> Pose {
    match motion {
        Motion::None => Pose::identity(),
        Motion::Turn(axis) => Pose { linear: about(&axis, value), translation: Vector3::zeros() },
        Motion::Slide(axis) => Pose { linear: Matrix3::identity(), translation: value * axis },
    }
}

/// A pose in a frame that has a pose itself.
pub fn within(frame: &Pose, pose: &Pose) -> Pose {
    Pose { linear: frame.linear * pose.linear, translation: frame.linear * pose.translation + frame.translation }
}

/// The rotation about an axis of length 1, in radians.
pub fn about(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let (sin, cos) = libm::sincos(angle);
    let cross = axis.cross_matrix();
    Matrix3::identity() + sin * cross + (1.0 - cos) * cross * cross
}

/// Roll, pitch and yaw in radians, about the fixed axes x, y and z in this order: the rotation of URDF and SDF.
pub fn roll_pitch_yaw([roll, pitch, yaw]: [f64; 3]) -> Matrix3<f64> {
    let [x, y, z] = [roll, pitch, yaw].map(libm::sincos);
    #[rustfmt::skip]
    let rotation = Matrix3::new(
        z.1 * y.1, z.1 * y.0 * x.0 - z.0 * x.1, z.1 * y.0 * x.1 + z.0 * x.0,
        z.0 * y.1, z.0 * y.0 * x.0 + z.1 * x.1, z.0 * y.0 * x.1 - z.1 * x.0,
        -y.0,      y.1 * x.0,                   y.1 * x.1,
    );
    rotation
}
