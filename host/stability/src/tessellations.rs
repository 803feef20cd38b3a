//! The same surface cut into other triangles: what a method's time and answers may owe to the cutting.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::{Point3, Vector3};
use ocb_core::mesh::Mesh;

use crate::draw::Draw;
use crate::shapes::Soup;

/// How a surface is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// As it is.
    Original,
    /// Every triangle in four.
    Subdivided,
    /// The other diagonal wherever two triangles lie in one plane.
    Flipped,
    /// Corners left out where the surface stays within a millionth of the object's size.
    Decimated,
    /// The same triangles in another order, from another corner.
    Shuffled,
}

impl Cut {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Original, Self::Subdivided, Self::Flipped, Self::Decimated, Self::Shuffled];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Original => "original",
            Self::Subdivided => "subdivided",
            Self::Flipped => "flipped",
            Self::Decimated => "decimated",
            Self::Shuffled => "shuffled",
        }
    }

    /// The surface, cut this way; coordinates stay as they are, or are the middles of two.
    pub fn of(self, mesh: &Arc<Mesh>) -> Arc<Mesh> {
        let soup = Soup::from_mesh(mesh);
        let near = 1e-6 * mesh.longest_side();
        let cut = match self {
            Self::Original => return mesh.clone(),
            Self::Subdivided => soup.subdivided(),
            Self::Flipped => flipped(soup, near),
            Self::Decimated => decimated(soup, near),
            Self::Shuffled => shuffled(soup),
        };
        cut.exact().unwrap_or_else(|_| mesh.clone())
    }
}

fn shuffled(mut soup: Soup) -> Soup {
    let mut draw = Draw::new(1);
    soup.triangles.iter_mut().for_each(|t| t.rotate_left(draw.below(3)));
    draw.shuffle(&mut soup.triangles);
    soup
}

fn area([p, q, r]: [Point3<f64>; 3]) -> Vector3<f64> {
    (q - p).cross(&(r - p))
}

/// The first triangle's diagonal to its neighbour is turned where the four corners lie in one plane and the quadrilateral is
/// convex; every triangle is turned once at most.
fn flipped(mut soup: Soup, near: f64) -> Soup {
    let mut edges: HashMap<(u32, u32), usize> = HashMap::new();
    for (i, t) in soup.triangles.iter().enumerate() {
        edges.extend((0..3).map(|k| ((t[k], t[(k + 1) % 3]), i)));
    }
    let mut done = vec![false; soup.triangles.len()];
    for i in 0..soup.triangles.len() {
        for k in 0..3 {
            let t = soup.triangles[i];
            let (a, b, c) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
            let Some(&j) = edges.get(&(b, a)) else { continue };
            if done[i] || done[j] || i == j {
                continue;
            }
            let Some(d) = soup.triangles[j].into_iter().find(|v| *v != a && *v != b) else { continue };
            let at = |v: u32| soup.positions[v as usize];
            let up = area([at(a), at(b), at(c)]);
            let new = [[c, a, d], [d, b, c]];
            let flat = up.norm() > 0.0 && (up.normalize().dot(&(at(d) - at(a)))).abs() <= near;
            if flat && new.iter().all(|t| area(t.map(at)).dot(&up) > 0.0) {
                (soup.triangles[i], soup.triangles[j]) = (new[0], new[1]);
                (done[i], done[j]) = (true, true);
            }
        }
    }
    soup
}

/// Corners whose triangles lie in one plane are drawn into a neighbour, if no triangle is turned over by it.
fn decimated(soup: Soup, near: f64) -> Soup {
    let Soup { positions, mut triangles } = soup;
    let at = |v: u32| positions[v as usize];
    // What was moved once stays, so that errors do not add up.
    let mut fixed = vec![false; positions.len()];
    for v in 0..positions.len() as u32 {
        let around: Vec<usize> = (0..triangles.len()).filter(|&i| triangles[i].contains(&v)).collect();
        let Some(&first) = around.first() else { continue };
        let up = area(triangles[first].map(at));
        let corners = || around.iter().flat_map(|&i| triangles[i]);
        let flat = up.norm() > 0.0 && corners().all(|w| up.normalize().dot(&(at(w) - at(v))).abs() <= near);
        // Every neighbour stands in two triangles, or this corner lies on a border.
        let inner = corners().filter(|w| *w != v).all(|w| corners().filter(|x| *x == w).count() == 2);
        if fixed[v as usize] || !flat || !inner {
            continue;
        }
        let target = corners().filter(|w| *w != v).find(|&w| {
            let kept = around.iter().filter(|&&i| !triangles[i].contains(&w));
            kept.clone().all(|&i| area(triangles[i].map(|x| at(if x == v { w } else { x }))).dot(&up) > 0.0)
        });
        if let Some(w) = target {
            corners().for_each(|x| fixed[x as usize] = true);
            triangles.retain(|t| !(t.contains(&v) && t.contains(&w)));
            triangles.iter_mut().flatten().filter(|x| **x == v).for_each(|x| *x = w);
        }
    }
    Soup { positions, triangles }
}

#[cfg(test)]
mod tests {
    use ocb_core::configuration::Configuration;
    use ocb_core::oracle::{Pair, Shape};
    use ocb_core::pose::Pose;
    use ocb_core::stock;

    use super::*;

    #[test]
    fn every_cut_is_the_same_surface() {
        for name in ["box", "torus-knot"] {
            let mesh = Arc::new(stock::generate(name, 500).expect("a stock object"));
            let whole = Shape::new(mesh.clone());
            for cut in Cut::ALL {
                let other = cut.of(&mesh);
                let counts = (mesh.triangles().len(), other.triangles().len());
                match cut {
                    Cut::Subdivided => assert_eq!(4 * counts.0, counts.1),
                    Cut::Decimated if name == "box" => assert!(counts.1 < counts.0, "{counts:?}"),
                    Cut::Decimated => assert!(counts.1 <= counts.0),
                    _ => assert_eq!(counts.0, counts.1, "{cut:?}"),
                }
                assert!(
                    cut == Cut::Original || name == "torus-knot" || other.triangles() != mesh.triangles(),
                    "{cut:?}"
                );
                assert_eq!(other.is_closed(), mesh.is_closed(), "{name} {cut:?}");
                // Distances from outside are the same within what decimation may do.
                let shape = Shape::new(other);
                let mut draw = Draw::new(5);
                for _ in 0..10 {
                    let pose = Pose { linear: draw.rotation(), translation: draw.direction() * 1.5 };
                    let c = Configuration { pose_a: Pose::identity(), pose_b: pose };
                    let [one, two] = [&whole, &shape].map(|s| Pair::new(s, &whole).truth(&c).distance_lo);
                    assert!((one - two).abs() <= 2e-6, "{name} {cut:?}: {one} and {two}");
                }
            }
        }
    }
}
