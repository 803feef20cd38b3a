//! The margin of a crossing in exact integers; `margin` says what it is.

use dashu_int::IBig;

use super::exact::{ExactPair, signum};
use super::exact_vector::{Vector, cross, dot, norm2, sub};
use super::rational::Ratio;

impl ExactPair {
    /// The margin of the most robust of the six crossings of an edge with a triangle, rounded down; 0 when the triangles
    /// touch at most.
    pub(crate) fn margin(&self) -> f64 {
        let mut best: Option<Ratio> = None;
        for (edges, face) in [(&self.a, &self.b), (&self.b, &self.a)] {
            for i in 0..3 {
                if let Some(width) = squared_width(&edges[i], &edges[(i + 1) % 3], face)
                    && best.as_ref().is_none_or(|b| b.less_than(&width))
                {
                    best = Some(width);
                }
            }
        }
        best.map_or(0.0, |width| width.sqrt(self.exponent).0 / 2.0)
    }
}

/// Square of the smallest of the five widths, in grid units, when the segment crosses the triangle strictly.
fn squared_width(p: &Vector, q: &Vector, [a, b, c]: &[Vector; 3]) -> Option<Ratio> {
    let tetrahedra = [[a, b, c, p], [a, b, c, q], [p, q, a, b], [p, q, b, c], [p, q, c, a]];
    let volumes = tetrahedra.map(volume);
    let signs = volumes.each_ref().map(signum);
    if signs[0] * signs[1] >= 0 || signs[2] == 0 || signs[2] != signs[3] || signs[3] != signs[4] {
        return None;
    }
    let widths = volumes.iter().zip(tetrahedra).map(|(v, t)| Ratio::new(v * v, largest_product(t)));
    widths.reduce(|least, width| if width.less_than(&least) { width } else { least })
}

/// Six times the signed volume.
fn volume([a, b, c, d]: [&Vector; 4]) -> IBig {
    dot(&cross(&sub(b, a), &sub(c, a)), &sub(d, a))
}

/// Square of what the volume is divided by: twice the area of a face, or the product of two opposite edges.
fn largest_product([a, b, c, d]: [&Vector; 4]) -> IBig {
    let [ab, ac, ad] = [b, c, d].map(|v| sub(v, a));
    let (bc, bd, cd) = (sub(c, b), sub(d, b), sub(d, c));
    let pairs = [(&ab, &ac), (&ab, &ad), (&ac, &ad), (&bc, &bd), (&ab, &cd), (&ac, &bd), (&ad, &bc)];
    pairs.map(|(x, y)| norm2(&cross(x, y))).into_iter().max().unwrap_or(IBig::ONE)
}
