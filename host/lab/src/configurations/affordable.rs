//! What given poses would cost, before the oracle meets them.
//!
//! Sampled poses are rotations near by; given ones may be anything finite. Two kinds cost without limit: objects so far
//! apart that the hierarchy cannot tell their near sides from their far ones, and linear parts that are no rotations,
//! each of which needs a hierarchy of its own.

use nalgebra::{Matrix3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::oracle::Shape;
use ocb_core::pose::Pose;

/// Objects further apart than so many of their sizes are specks to each other; relative distances end there, too.
const FARTHEST: f64 = 2000.0;
/// Linear parts further than this from a rotation (largest entry of `M^T M - 1`) need a hierarchy of their own.
const ROTATION: f64 = 1e-6;
/// Triangles that may be put into hierarchies of single poses: some minutes.
const MOST_TRIANGLES: u64 = 200_000_000;

/// One sentence on the first row that costs too much.
pub fn check(a: &Shape, b: &Shape, poses: &[Configuration]) -> Result<(), String> {
    let (ball_a, ball_b) = (Ball::around(a), Ball::around(b));
    let each = (a.triangles().len() + b.triangles().len()) as u64;
    let mut triangles = 0;
    for (row, configuration) in (1..).zip(poses) {
        let apart = apart([&ball_a, &ball_b], configuration);
        if apart > FARTHEST {
            return Err(format!(
                "in row {row} the objects are {apart:.0} times their size apart; at most {FARTHEST} times are measured"
            ));
        }
        if [&configuration.pose_a, &configuration.pose_b].iter().any(|pose| !is_rotation(pose)) {
            triangles += each;
        }
        if triangles > MOST_TRIANGLES {
            return Err(format!(
                "up to row {row} there are {} matrices that are not rotations; so many are too expensive with {each} \
                 triangles",
                triangles / each
            ));
        }
    }
    Ok(())
}

/// Tells the configurations in which the objects are specks to each other.
pub fn specks(a: &Shape, b: &Shape) -> impl Fn(&Configuration) -> bool + Sync + use<> {
    let balls = [a, b].map(Ball::around);
    move |configuration| apart([&balls[0], &balls[1]], configuration) > FARTHEST
}

/// Distance of the centres in sizes of the objects.
fn apart([a, b]: [&Ball; 2], configuration: &Configuration) -> f64 {
    let (a, b) = (a.placed(&configuration.pose_a), b.placed(&configuration.pose_b));
    (b.centre - a.centre).norm() / (a.radius + b.radius)
}

fn is_rotation(pose: &Pose) -> bool {
    (pose.linear.transpose() * pose.linear - Matrix3::identity()).amax() <= ROTATION
}

struct Ball {
    centre: Vector3<f64>,
    radius: f64,
}

impl Ball {
    fn around(shape: &Shape) -> Self {
        let all = || shape.triangles().iter().flatten().map(|&v| shape.positions()[v as usize].coords);
        let lo = all().reduce(|x, y| x.inf(&y)).unwrap_or_default();
        let hi = all().reduce(|x, y| x.sup(&y)).unwrap_or_default();
        Self { centre: (lo + hi) / 2.0, radius: (hi - lo).norm() / 2.0 }
    }

    fn placed(&self, pose: &Pose) -> Self {
        Self { centre: pose.linear * self.centre + pose.translation, radius: pose.linear.norm() * self.radius }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    fn refused(poses: &[Configuration]) -> Option<String> {
        let shape = Shape::new(Arc::new(ocb_core::stock::generate("box", 500).expect("a stock object")));
        check(&shape, &shape, poses).err()
    }

    fn placing(linear: Matrix3<f64>, x: f64) -> Configuration {
        let pose_b = Pose { linear, translation: Vector3::new(x, 0.0, 0.0) };
        Configuration { pose_a: Pose::identity(), pose_b }
    }

    #[test]
    fn specks_are_refused() {
        let near = placing(Matrix3::identity(), 10.0);
        assert_eq!(refused(&[near]), None);
        let reason = refused(&[near, placing(Matrix3::identity(), 1e7)]).expect("a reason");
        assert!(reason.starts_with("in row 2 the objects are"), "{reason}");
        // A giant next to it is no speck.
        assert_eq!(refused(&[placing(Matrix3::identity() * 1e9, 1e7)]), None);
    }

    #[test]
    fn some_shears_are_taken_and_many_are_not() {
        let shear = placing(Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), 1.0);
        assert_eq!(refused(&vec![shear; 1000]), None);
        let reason = refused(&vec![shear; 250_000]).expect("a reason");
        assert!(reason.contains("not rotations"), "{reason}");
    }
}
