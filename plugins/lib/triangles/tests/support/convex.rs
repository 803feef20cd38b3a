//! Convex objects.

use std::collections::HashMap;

use super::Soup;

/// An ellipsoid: an octahedron cut into n * n triangles a side, blown up.
pub fn ellipsoid(n: usize, axes: [f64; 3]) -> Soup {
    let mut soup = Soup { positions: Vec::new(), triangles: Vec::new() };
    for octant in 0..8 {
        let sign = [octant & 1, octant >> 1 & 1, octant >> 2].map(|bit| f64::from(2 * bit - 1));
        let first = soup.positions.len() as u32;
        let mut at = HashMap::new();
        for i in 0..=n {
            for j in 0..=n - i {
                at.insert((i, j), first + at.len() as u32);
                let p = [i, j, n - i - j].map(|x| x as f64);
                let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
                soup.positions.push(std::array::from_fn(|k| sign[k] * axes[k] * p[k] / length));
            }
        }
        for i in 0..n {
            for j in 0..n - i {
                soup.triangles.push([at[&(i, j)], at[&(i + 1, j)], at[&(i, j + 1)]]);
                if i + j + 2 <= n {
                    soup.triangles.push([at[&(i + 1, j)], at[&(i + 1, j + 1)], at[&(i, j + 1)]]);
                }
            }
        }
    }
    soup
}

/// A box with these half sides, its sides cut into n * n squares.
pub fn cut_box(n: usize, half: [f64; 3]) -> Soup {
    let mut soup = Soup { positions: Vec::new(), triangles: Vec::new() };
    for (axis, end) in [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0), (2, -1.0), (2, 1.0)] {
        let first = soup.positions.len() as u32;
        let number = |i: usize, j: usize| first + (i * (n + 1) + j) as u32;
        for i in 0..=n {
            for j in 0..=n {
                let mut p = [0.0; 3];
                p[axis] = end * half[axis];
                for (k, step) in [((axis + 1) % 3, i), ((axis + 2) % 3, j)] {
                    p[k] = half[k] * (2.0 * step as f64 / n as f64 - 1.0);
                }
                soup.positions.push(p);
            }
        }
        for i in 0..n {
            for j in 0..n {
                soup.triangles.push([number(i, j), number(i + 1, j), number(i, j + 1)]);
                soup.triangles.push([number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]);
            }
        }
    }
    soup
}

/// A prism over a regular polygon of n corners, and with `top` 0 a pyramid: its ends are cut into a fan.
pub fn prism(n: usize, radius: f64, half: f64, top: f64) -> Soup {
    let mut soup = Soup { positions: Vec::new(), triangles: Vec::new() };
    for (z, scale) in [(-half, 1.0), (half, top)] {
        for i in 0..n {
            let (sin, cos) = (i as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
            soup.positions.push([radius * scale * cos, radius * scale * sin, z]);
        }
    }
    let n = n as u32;
    for i in 0..n {
        let next = (i + 1) % n;
        soup.triangles.push([i, next, n + next]);
        if top > 0.0 {
            soup.triangles.push([i, n + next, n + i]);
        }
        if i > 0 && next > 0 {
            soup.triangles.push([0, next, i]);
            soup.triangles.push([n, n + i, n + next]);
        }
    }
    if top == 0.0 {
        // All corners of the upper end are the apex.
        soup.triangles.retain(|t| t.iter().filter(|&&corner| corner >= n).count() < 2);
    }
    soup
}
