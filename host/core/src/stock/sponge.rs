//! A sponge: an implicit surface, cut by marching tetrahedra.

use std::collections::HashMap;

use super::builder::{Detail, Point, Soup, Vector};

/// Half sides of the block.
const HALF: [f64; 3] = [1.0, 0.68, 0.45];
/// Radius of the block's rounded edges.
const ROUND: f64 = 0.12;

/// A rounded block full of pores that run into each other: one closed surface with very much inside.
pub fn sponge(detail: Detail) -> Soup {
    let step = detail.density().recip();
    // Distance between neighbouring pores: a coarse sponge has fewer and larger ones.
    let pitch = match detail.triangles {
        ..3_000 => 0.8,
        3_000..12_000 => 0.62,
        12_000..50_000 => 0.48,
        _ => 0.37,
    };
    // The grid reaches at least a step beyond the block on all sides, so the surface is closed. It is shifted by a
    // fraction of a step that changes fast with the density: coarse grids jump in their triangle count, and this lets
    // nearly equal densities give different counts.
    let cells = HALF.map(|h| (2.0 * h / step).ceil() as usize + 3);
    let shift = (97.0 * detail.density()).fract() - 0.5;
    let origin = Vector::from([0, 1, 2].map(|k| step * (shift - 0.5 * cells[k] as f64)));
    let place = |at: [usize; 3]| Point::from(origin + step * Vector::from(at.map(|i| i as f64)));
    let points = cells.map(|n| n + 1);
    let number = |[x, y, z]: [usize; 3]| (z * points[1] + y) * points[0] + x;
    let mut field = Vec::with_capacity(points.iter().product());
    for z in 0..points[2] {
        for y in 0..points[1] {
            field.extend((0..points[0]).map(|x| inside(place([x, y, z]), pitch)));
        }
    }

    let mut soup = Soup::default();
    let mut cut = HashMap::new();
    for z in 0..cells[2] {
        for y in 0..cells[1] {
            for x in 0..cells[0] {
                let corner = |k: usize| [x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)];
                // Most cells are wholly inside or outside.
                let sign = field[number([x, y, z])] < 0.0;
                if (1..8).all(|k| (field[number(corner(k))] < 0.0) == sign) {
                    continue;
                }
                for path in TETRAHEDRA {
                    let tetrahedron = path.map(corner);
                    march(
                        tetrahedron,
                        &mut soup,
                        |soup, a, b| {
                            let (i, j) = (number(a), number(b));
                            *cut.entry((i.min(j), i.max(j))).or_insert_with(|| {
                                let (fa, fb) = (field[i], field[j]);
                                // Kept off the grid points: there, several cuts would meet in triangles without area.
                                let t = (fa / (fa - fb)).clamp(0.04, 0.96);
                                soup.positions.push(place(a) + t * (place(b) - place(a)));
                                soup.positions.len() as u32 - 1
                            })
                        },
                        |at| field[number(at)] < 0.0,
                    );
                }
            }
        }
    }
    soup
}

/// The six tetrahedra of a cell, each along a path of three edges from corner 0 to corner 7; odd paths are mirrored.
/// Neighbouring cells agree on the diagonals of their common face.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

/// The surface within one tetrahedron: nothing, a triangle around one corner, or a quadrilateral between two and two.
fn march(
    corners: [[usize; 3]; 4],
    soup: &mut Soup,
    mut vertex: impl FnMut(&mut Soup, [usize; 3], [usize; 3]) -> u32,
    is_inside: impl Fn([usize; 3]) -> bool,
) {
    let (mut inner, mut outer) = (Vec::with_capacity(4), Vec::with_capacity(4));
    for (k, corner) in corners.into_iter().enumerate() {
        if is_inside(corner) { inner.push(k) } else { outer.push(k) }
    }
    // Whether the order (inner.., outer..) is an even permutation of the corners decides how the triangle faces.
    let order: Vec<usize> = inner.iter().chain(&outer).copied().collect();
    let inversions = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j))).filter(|&(i, j)| order[i] > order[j]).count();
    let mut v = |i: usize, j: usize| vertex(soup, corners[order[i]], corners[order[j]]);
    let mut faces = match inner.len() {
        1 => vec![[v(0, 1), v(0, 2), v(0, 3)]],
        2 => {
            let [a, b, c, d] = [v(0, 2), v(0, 3), v(1, 3), v(1, 2)];
            vec![[a, b, c], [a, c, d]]
        }
        3 => vec![[v(0, 3), v(1, 3), v(2, 3)]],
        _ => return,
    };
    if inversions % 2 == 1 {
        faces.iter_mut().for_each(|t| t.swap(1, 2));
    }
    soup.triangles.extend(faces);
}

/// Negative inside the sponge: in the block, and in no pore.
fn inside(p: Point, pitch: f64) -> f64 {
    let beyond = Vector::from([0, 1, 2].map(|k| p[k].abs() - (HALF[k] - ROUND)));
    let block = beyond.sup(&Vector::zeros()).norm() + beyond.max().min(0.0) - ROUND;
    if block > pitch {
        return block;
    }
    let cell = [0, 1, 2].map(|k| (p[k] / pitch).floor() as i32);
    let mut pore = f64::INFINITY;
    for offset in 0..27 {
        let c = [cell[0] + offset % 3 - 1, cell[1] + offset / 3 % 3 - 1, cell[2] + offset / 9 - 1];
        let (center, radius) = hole(c, pitch);
        pore = pore.min((p - center).norm() - radius);
    }
    block.max(-pore)
}

/// The pore of a lattice cell: its place and size are shaken by a hash of the cell.
fn hole(cell: [i32; 3], pitch: f64) -> (Point, f64) {
    let mut hash = cell.iter().fold(0x9e37_79b9_u32, |h, &c| (h ^ c as u32).wrapping_mul(0x85eb_ca6b).rotate_left(13));
    let mut next = || {
        hash ^= hash >> 16;
        hash = hash.wrapping_mul(0xc2b2_ae35).rotate_left(7) ^ (hash >> 13);
        f64::from(hash) / f64::from(u32::MAX)
    };
    let center = cell.map(|c| pitch * (f64::from(c) + 0.3 + 0.4 * next()));
    (Point::from(Vector::from(center)), pitch * (0.38 + 0.2 * next()))
}
