//! One configuration made ready for questions.

use nalgebra::Point3;

use super::exact::ExactPair;
use super::triangle::Triangle;
use super::{Pair, Shape, U64};
use crate::bvh::{Frame, Tree, power_of_two_above};
use crate::configuration::Configuration;
use crate::pose::Pose;

/// Coordinates above this could overflow in f64; such scenes are answered in integers alone.
pub(crate) const LARGEST: f64 = 1e150;

/// Two shapes in one configuration.
///
/// All f64 numbers in here are in the scene's `unit`, a power of two: scaling a whole scene by a power of two changes
/// nothing but the unit, so the answers scale bit for bit.
pub(crate) struct Scene<'p> {
    pub(super) pair: &'p Pair<'p>,
    pub(super) configuration: &'p Configuration,
    /// `None`: every pair of triangles is asked exactly.
    pub(super) frame: Option<Frame<'p>>,
    /// One unit in the objects' lengths.
    pub(super) unit: f64,
    /// `u S` of f64 in units.
    pub(super) epsilon: f64,
}

impl Scene<'_> {
    /// Prepares a configuration and hands it to `ask`.
    ///
    /// Poses that are no rotations get hierarchies of their own, over the mapped vertices.
    pub(super) fn with<R>(pair: &Pair, configuration: &Configuration, ask: impl FnOnce(&Scene) -> R) -> R {
        let (a, b) = (pair.a, pair.b);
        let size = reach(&configuration.pose_a, a).max(reach(&configuration.pose_b, b));
        let scene = |frame: Option<Frame<'_>>, ask: &mut dyn FnMut(&Scene)| {
            let unit = frame.as_ref().map_or(power_of_two_above(size), |f| f.unit);
            let epsilon = U64 * pair.scene_size(configuration) / unit;
            ask(&Scene { pair, configuration, frame, unit, epsilon });
        };
        let mut ask = Some(ask);
        let mut answer = None;
        let mut once = |s: &Scene| {
            if let Some(ask) = ask.take() {
                answer = Some(ask(s));
            }
        };
        if size.is_nan() || size > LARGEST {
            scene(None, &mut once);
        } else if let Some(frame) = Frame::new(&a.tree, &configuration.pose_a, &b.tree, &configuration.pose_b, size) {
            scene(Some(frame), &mut once);
        } else {
            let (tree_a, tree_b) = (mapped_tree(&configuration.pose_a, a), mapped_tree(&configuration.pose_b, b));
            let still = Pose::identity();
            scene(Frame::new(&tree_a, &still, &tree_b, &still, size), &mut once);
        }
        answer.expect("every branch asks once")
    }

    pub(super) fn triangles(&self, [i, j]: [u32; 2]) -> (Triangle, Triangle) {
        let inverse = 1.0 / self.unit;
        (
            Triangle::mapped(&self.configuration.pose_a, &self.pair.a.corners(i), inverse),
            Triangle::mapped(&self.configuration.pose_b, &self.pair.b.corners(j), inverse),
        )
    }

    pub(super) fn exact(&self, [i, j]: [u32; 2]) -> ExactPair {
        let Configuration { pose_a, pose_b } = self.configuration;
        ExactPair::new(pose_a, &self.pair.a.corners(i), pose_b, &self.pair.b.corners(j))
    }

    /// Every pair of triangles (A, B).
    pub(super) fn all_pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        let count = |s: &Shape| s.triangles().len() as u32;
        let (n, m) = (count(self.pair.a), count(self.pair.b));
        (0..n).flat_map(move |i| (0..m).map(move |j| [i, j]))
    }
}

/// A bound of the mapped object's absolute coordinates.
pub(crate) fn reach(pose: &Pose, shape: &Shape) -> f64 {
    (0..3)
        .map(|row| {
            let turned: f64 = pose.linear.row(row).iter().map(|x| x.abs()).sum();
            turned * shape.largest + pose.translation[row].abs()
        })
        // Not `f64::max`, which would swallow a NaN.
        .fold(0.0, |most, x| if x > most || x.is_nan() { x } else { most })
}

fn mapped_tree(pose: &Pose, shape: &Shape) -> Tree {
    let positions: Vec<Point3<f64>> = shape.positions().iter().map(|p| pose.apply(p)).collect();
    Tree::new(&positions, shape.triangles())
}
