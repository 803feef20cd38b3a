//! Simple bodies around a set of points: ball, box, capsule. Each contains every point, whatever f64 rounds.

use nalgebra::{Matrix3, Point3, SymmetricEigen, Vector3};

use super::Geometry;
use crate::pose::Pose;

/// Steps of the search for the smallest ball; its radius is then at most a few percent too large.
const STEPS: u32 = 300;
/// A body is larger by this share of the points' extent, which is far more than rounding.
const SLACK: f64 = 1e-9;

/// A body, and where its own frame lies in the frame of the points.
pub type Placed = (Geometry, Pose);

/// A ball, by the iteration of Badoiu and Clarkson, *Smaller Core-Sets for Balls* (2003): a step towards the farthest point.
pub fn ball(points: &[Point3<f64>]) -> Option<Placed> {
    let mut centre = Point3::from(mean(points)?);
    let farthest = |centre: &Point3<f64>| {
        let far = |p: &&Point3<f64>| (**p - centre).norm_squared();
        points.iter().max_by(|p, q| far(p).total_cmp(&far(q)))
    };
    let mut best = (centre, f64::INFINITY);
    for step in 0..=STEPS {
        let far = *farthest(&centre)?;
        let radius = (far - centre).norm();
        if radius < best.1 {
            best = (centre, radius);
        }
        centre += (far - centre) / f64::from(step + 2);
    }
    let (centre, radius) = best;
    let pose = Pose { linear: Matrix3::identity(), translation: centre.coords };
    Some((Geometry::Sphere { radius: radius + slack(points) }, pose))
}

/// A box: along the axes of the frame or along the principal axes of the points, whichever is smaller.
pub fn cuboid(points: &[Point3<f64>]) -> Option<Placed> {
    let of = |axes: Matrix3<f64>| {
        let [min, max] = extent(points, &axes)?;
        let (size, middle) = (max - min, (min + max) / 2.0);
        Some((size, Pose { linear: axes, translation: axes * middle }))
    };
    let (straight, turned) = (of(Matrix3::identity())?, of(principal(points)?)?);
    let (size, pose) = if turned.0.product() < straight.0.product() { turned } else { straight };
    let size = size.map(|x| x + 2.0 * slack(points));
    Some((Geometry::Box { size: size.into() }, pose))
}

/// A capsule along the longest principal axis, its segment as short as the points allow.
pub fn capsule(points: &[Point3<f64>]) -> Option<Placed> {
    let axes = principal(points)?;
    let [min, max] = extent(points, &axes)?;
    let middle = (min + max) / 2.0;
    // The longest axis becomes z, the other two follow in their turn.
    let longest = (max - min).imax();
    let order = [1, 2, 0].map(|step| (longest + step) % 3);
    let linear = Matrix3::from_columns(&order.map(|i| axes.column(i).into_owned()));
    let centre = axes * middle;
    let local = |p: &Point3<f64>| linear.transpose() * (p.coords - centre);
    let radius = points.iter().map(|p| local(p).xy().norm()).fold(0.0, f64::max) + slack(points);
    let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
    for p in points.iter().map(local) {
        let cap = (radius * radius - p.xy().norm_squared()).max(0.0).sqrt();
        (from, to) = (from.min(p.z + cap), to.max(p.z - cap));
    }
    let (at, length) = if from < to { ((from + to) / 2.0, to - from) } else { ((from + to) / 2.0, 0.0) };
    // Between caps that overlap, the points' own ends decide.
    let end = points.iter().map(|p| (local(p) - Vector3::new(0.0, 0.0, at)).norm()).fold(0.0, f64::max);
    let radius = if length == 0.0 { end.max(radius) } else { radius };
    let translation = centre + linear * Vector3::new(0.0, 0.0, at);
    Some((Geometry::Capsule { radius: radius + slack(points), length }, Pose { linear, translation }))
}

/// The mean of some points, which is in their convex hull.
pub fn mean(points: &[Point3<f64>]) -> Option<Vector3<f64>> {
    let sum: Vector3<f64> = points.iter().map(|p| p.coords).sum();
    (!points.is_empty()).then(|| sum / points.len() as f64)
}

fn slack(points: &[Point3<f64>]) -> f64 {
    SLACK * points.iter().map(|p| p.coords.amax()).fold(f64::MIN_POSITIVE, f64::max)
}

/// The smallest and largest coordinates along these axes.
fn extent(points: &[Point3<f64>], axes: &Matrix3<f64>) -> Option<[Vector3<f64>; 2]> {
    let mut along = points.iter().map(|p| axes.transpose() * p.coords);
    let first = along.next()?;
    Some(along.fold([first; 2], |[min, max], p| [min.inf(&p), max.sup(&p)]))
}

/// Orthonormal and right-handed.
fn principal(points: &[Point3<f64>]) -> Option<Matrix3<f64>> {
    let mean = mean(points)?;
    let spread: Matrix3<f64> = points.iter().map(|p| (p.coords - mean) * (p.coords - mean).transpose()).sum();
    let axes = SymmetricEigen::try_new(spread, 1e-14, 1000)?.eigenvectors;
    // Orthonormal up to rounding, as every pose of a scene.
    let x: Vector3<f64> = axes.column(0).normalize();
    let y = (axes.column(1) - x * x.dot(&axes.column(1))).normalize();
    let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
    axes.iter().all(|x| x.is_finite()).then_some(axes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock;

    /// How far outside of the body a point is; 0 or less inside.
    fn outside((geometry, pose): &Placed, p: &Point3<f64>) -> f64 {
        let p = pose.linear.transpose() * (p.coords - pose.translation);
        match *geometry {
            Geometry::Sphere { radius } => p.norm() - radius,
            Geometry::Box { size } => (0..3).map(|i| p[i].abs() - size[i] / 2.0).fold(f64::NEG_INFINITY, f64::max),
            Geometry::Capsule { radius, length } => {
                (p - Vector3::z() * p.z.clamp(-length / 2.0, length / 2.0)).norm() - radius
            }
            _ => panic!("another body"),
        }
    }

    #[test]
    fn every_point_is_inside_and_some_point_is_on_the_surface() {
        let turn = *nalgebra::Rotation3::from_euler_angles(0.3, 1.1, -0.7).matrix();
        let turned =
            |p: &Point3<f64>| Point3::from(turn * Vector3::new(4.0 * p.x, p.y, 0.2 * p.z) + Vector3::repeat(9.0));
        for name in ["torus-knot", "castle", "sphere"] {
            let mesh = stock::generate(name, 2000).unwrap();
            for points in [mesh.positions().to_vec(), mesh.positions().iter().map(turned).collect()] {
                let scale = points.iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
                for body in [ball(&points), cuboid(&points), capsule(&points)].map(|body| body.unwrap()) {
                    let off: Vec<f64> = points.iter().map(|p| outside(&body, p)).collect();
                    let most = off.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    assert!((-1e-8 * scale..0.0).contains(&most), "{name} {body:?}: {most}");
                    assert!(body.1.off_rotation() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn a_long_object_gets_a_small_capsule_and_a_box_that_is_turned_with_it() {
        let turn = *nalgebra::Rotation3::from_euler_angles(0.3, 1.1, -0.7).matrix();
        let corners = (0..8).map(|i: i32| {
            let sign = |bit: i32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
            Point3::from(turn * Vector3::new(5.0 * sign(0), 0.5 * sign(1), 0.25 * sign(2)))
        });
        let points: Vec<Point3<f64>> = corners.collect();
        let Some((Geometry::Box { size }, _)) = cuboid(&points) else { panic!("a box") };
        assert!((size.iter().product::<f64>() - 10.0 * 1.0 * 0.5).abs() < 1e-6, "{size:?}");
        let Some((Geometry::Capsule { radius, length }, _)) = capsule(&points) else { panic!("a capsule") };
        assert!((radius - 0.5f64.hypot(0.25)).abs() < 1e-6 && (length - 10.0).abs() < 1e-3, "{radius} {length}");
        let Some((Geometry::Sphere { radius }, _)) = ball(&points) else { panic!("a ball") };
        assert!((radius - 25.3125f64.sqrt()).abs() < 0.02 * radius, "{radius}");
    }
}
