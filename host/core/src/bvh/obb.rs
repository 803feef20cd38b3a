//! An oriented box around triangles.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Centre, orthonormal axes (up to f32 rounding) and half extents; contains what it was fitted to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Obb {
    pub(crate) centre: [f32; 3],
    /// `axes[i]` is the i-th axis.
    pub(crate) axes: [[f32; 3]; 3],
    pub(crate) half: [f32; 3],
}

/// Fits a box in the frame that fits best of few: principal axes, a face's own frame, the coordinate axes.
pub(super) fn fit(triangles: &[[Vector3<f64>; 3]], ids: &[u32]) -> Obb {
    let candidates: Vec<Matrix3<f64>> = match ids {
        [only] => vec![face_frame(&triangles[*only as usize])],
        [first, ..] if ids.len() <= 8 => {
            vec![principal_axes(triangles, ids), face_frame(&triangles[*first as usize]), Matrix3::identity()]
        }
        _ => vec![principal_axes(triangles, ids), Matrix3::identity()],
    };
    let boxes = candidates.iter().map(|axes| around(triangles, ids, axes));
    boxes.min_by(|x, y| area(x).total_cmp(&area(y))).expect("there is at least one frame")
}

fn area(b: &Obb) -> f32 {
    let [x, y, z] = b.half;
    x * y + y * z + z * x
}

/// Rows: the longest edge, the direction across in the plane, the normal.
fn face_frame(t: &[Vector3<f64>; 3]) -> Matrix3<f64> {
    let edges = [t[1] - t[0], t[2] - t[1], t[0] - t[2]];
    let longest = edges.iter().max_by(|x, y| x.norm_squared().total_cmp(&y.norm_squared())).expect("three edges");
    let normal = edges[0].cross(&edges[1]);
    let Some(u) = longest.try_normalize(0.0) else { return Matrix3::identity() };
    let w = normal.try_normalize(0.0).unwrap_or_else(|| {
        // No area: any direction across will do.
        let axis = Vector3::ith(u.iamin(), 1.0);
        u.cross(&axis).normalize()
    });
    orthonormal_rows(u, w)
}

/// Rows: eigenvectors of the vertices' covariance.
pub(super) fn principal_axes(triangles: &[[Vector3<f64>; 3]], ids: &[u32]) -> Matrix3<f64> {
    let vertices = || ids.iter().flat_map(|&t| triangles[t as usize]);
    let count = (3 * ids.len()) as f64;
    let mean = vertices().sum::<Vector3<f64>>() / count;
    let covariance = vertices().map(|v| (v - mean) * (v - mean).transpose()).sum::<Matrix3<f64>>() / count;
    let eigen = SymmetricEigen::new(covariance).eigenvectors;
    orthonormal_rows(eigen.column(0).into(), eigen.column(2).into())
}

/// A frame whose first row is `u` and whose third is near `w`; the coordinate axes when the two do not span a plane.
fn orthonormal_rows(u: Vector3<f64>, w: Vector3<f64>) -> Matrix3<f64> {
    let frame = u.try_normalize(0.0).and_then(|u| {
        let w = (w - u * u.dot(&w)).try_normalize(1e-9)?;
        Some(Matrix3::from_rows(&[u.transpose(), w.cross(&u).transpose(), w.transpose()]))
    });
    match frame {
        Some(f) if (f * f.transpose() - Matrix3::identity()).amax() < 1e-12 => f,
        _ => Matrix3::identity(),
    }
}

/// The box along the given axes, after these and the centre have been rounded to f32.
fn around(triangles: &[[Vector3<f64>; 3]], ids: &[u32], frame: &Matrix3<f64>) -> Obb {
    let axes: [[f32; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|k| frame[(i, k)] as f32));
    let rounded = axes.map(|a| Vector3::from(a.map(f64::from)));
    let vertices = || ids.iter().flat_map(|&t| triangles[t as usize]);
    let mut middle = Vector3::zeros();
    for axis in &rounded {
        let (lo, hi) = range(vertices().map(|v| axis.dot(&v)));
        middle += axis * ((lo + hi) / 2.0);
    }
    let centre = [middle.x as f32, middle.y as f32, middle.z as f32];
    let c = Vector3::from(centre.map(f64::from));
    let reach = rounded.map(|axis| {
        let (lo, hi) = range(vertices().map(|v| axis.dot(&(v - c))));
        hi.max(-lo)
    });
    // The axes are orthonormal up to 2e-7, so a point's components along them may exceed its projections by that share.
    let spare = 2e-6 * reach.iter().sum::<f64>();
    let half = reach.map(|r| round_up(r + spare));
    Obb { centre, axes, half }
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)))
}

/// An f32 not below `x`.
fn round_up(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}
