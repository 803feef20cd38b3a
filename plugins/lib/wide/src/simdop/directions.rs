//! The k-DOPs' directions, and how any other direction is made of three of them.

use ocb_triangles::vector::{Vector, cross, dot};

/// Half of the k normals; the other half are their opposites. The coordinate axes come first.
///
/// Coordinates are -1, 0 and 1, so that projecting needs sums only. Lengths are up to the square root of 3.
#[derive(Clone, Debug)]
pub struct Directions {
    pub normals: Vec<Vector>,
    pub facets: Vec<Facet>,
}

/// Three normals whose tips span a facet of the convex hull of all unit normals: for a direction inside it, they bound a DOP
/// most tightly (linear programming: the facet is an optimal basis for a DOP around a sphere).
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    pub normals: [usize; 3],
    /// Times a direction, this gives its coefficients for the normals. By rows.
    pub inverse: [[f32; 3]; 3],
    /// The normals' lengths.
    pub lengths: [f32; 3],
}

/// Most directions.
pub const MOST: usize = 13;

const AXES: [Vector; 3] = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
const CORNERS: [Vector; 4] = [[1., 1., 1.], [1., 1., -1.], [1., -1., 1.], [-1., 1., 1.]];
const EDGES: [Vector; 6] = [[1., 1., 0.], [1., -1., 0.], [0., 1., 1.], [0., 1., -1.], [1., 0., 1.], [1., 0., -1.]];

impl Directions {
    /// The largest of the sets of 6, 14, 18 and 26 normals that has no more than `k`.
    pub fn new(k: usize) -> Self {
        let mut normals = AXES.to_vec();
        if k >= 18 {
            normals.extend(EDGES);
        }
        if (14..18).contains(&k) || k >= 26 {
            normals.extend(CORNERS);
        }
        let facets = facets(&normals);
        Self { normals, facets }
    }
}

fn facets(normals: &[Vector]) -> Vec<Facet> {
    let units: Vec<Vector> = normals.iter().map(|n| n.map(|x| x / dot(*n, *n).sqrt())).collect();
    let mut found = Vec::new();
    for i in 0..normals.len() {
        for j in i + 1..normals.len() {
            for l in j + 1..normals.len() {
                let spans = [[1., 1.], [1., -1.], [-1., 1.], [-1., -1.]].iter().any(|[s, t]| {
                    let tips = [units[i], units[j].map(|x| s * x), units[l].map(|x| t * x)];
                    // The plane through the tips, in the form plane . x = 1.
                    inverse(tips).is_some_and(|inverse| {
                        let plane: Vector = core::array::from_fn(|k| inverse[0][k] + inverse[1][k] + inverse[2][k]);
                        units.iter().all(|unit| dot(plane, *unit).abs() <= 1.0 + 1e-9)
                    })
                });
                if let (true, Some(inverse)) = (spans, inverse([normals[i], normals[j], normals[l]])) {
                    let lengths = [i, j, l].map(|n| dot(normals[n], normals[n]).sqrt() as f32);
                    let inverse = inverse.map(|row| row.map(|x| x as f32));
                    found.push(Facet { normals: [i, j, l], inverse, lengths });
                }
            }
        }
    }
    found
}

/// Rows that give the coefficients of a vector for three others; none when those lie in a plane.
fn inverse([x, y, z]: [Vector; 3]) -> Option<[Vector; 3]> {
    let volume = dot(x, cross(y, z));
    let row = |v: Vector| v.map(|coordinate| coordinate / volume);
    (volume.abs() > 1e-6).then(|| [row(cross(y, z)), row(cross(z, x)), row(cross(x, y))])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each direction lies in a facet: its coefficients there have the least weight, and rebuild it.
    #[test]
    fn facets_cover_all_directions() {
        for (k, count) in [(6, 1), (14, 12), (18, 16), (26, 24)] {
            let directions = Directions::new(k);
            assert_eq!(2 * directions.normals.len(), k);
            assert_eq!(directions.facets.len(), count, "k = {k}");
            for direction in [[0.3, -0.9, 0.1], [1.0, 1.0, 0.9], [-0.2, 0.1, 0.7], [0.0, -1.0, 0.0]] {
                let coefficients = |facet: &Facet| facet.inverse.map(|row| dot(row.map(f64::from), direction));
                for facet in &directions.facets {
                    let c = coefficients(facet);
                    let rebuilt: Vector =
                        core::array::from_fn(|i| (0..3).map(|t| c[t] * directions.normals[facet.normals[t]][i]).sum());
                    assert!((0..3).all(|i| (rebuilt[i] - direction[i]).abs() < 1e-6), "k = {k}: {rebuilt:?}");
                }
            }
        }
    }
}
