//! What hangs together in a mesh, and whether it encloses anything; found once per object.
//!
//! Corners with the same coordinates are one vertex here, whatever their numbers: files split vertices along texture
//! seams, and whoever rounds or moves one of them moves the others likewise.

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};

/// Components and closedness of the triangles of one object.
#[derive(Clone, Debug)]
pub(crate) struct Topology {
    /// Every edge belongs to an even number of triangles, so that each point off the surface is inside or outside.
    pub(crate) closed: bool,
    /// The vertices (by number) of each part that hangs together. The first of a part is the one farthest from the
    /// object's centre.
    pub(crate) components: Vec<Vec<u32>>,
    /// The component of each vertex; meaningless for one that no triangle uses.
    pub(crate) component_of: Vec<u32>,
    /// Centre of the bounding box.
    pub(crate) centre: Point3<f64>,
    /// Half its sides.
    pub(crate) half: Vector3<f64>,
}

impl Topology {
    /// Reads it off the triangles; there is at least one.
    pub(crate) fn new(positions: &[Point3<f64>], triangles: &[[u32; 3]]) -> Self {
        let place = places(positions);
        let (centre, half) = bounds(positions, triangles);
        let (mut components, component_of) = components(positions.len(), triangles, &place);
        for component in &mut components {
            let distance = |v: u32| (positions[v as usize] - centre).norm_squared();
            let farthest =
                (0..component.len()).max_by(|&x, &y| distance(component[x]).total_cmp(&distance(component[y])));
            component.swap(0, farthest.unwrap_or(0));
        }
        Self { closed: is_closed(triangles, &place), components, component_of, centre, half }
    }
}

/// The first vertex with the coordinates of each.
fn places(positions: &[Point3<f64>]) -> Vec<u32> {
    let mut first = HashMap::with_capacity(positions.len());
    // Adding 0 makes -0 and 0 one key.
    let key = |p: &Point3<f64>| [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
    (0..).zip(positions).map(|(i, p)| *first.entry(key(p)).or_insert(i)).collect()
}

fn bounds(positions: &[Point3<f64>], triangles: &[[u32; 3]]) -> (Point3<f64>, Vector3<f64>) {
    let nothing = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    let used = triangles.iter().flatten().map(|&v| positions[v as usize].coords);
    let (lo, hi) = used.fold(nothing, |(lo, hi), p| (lo.inf(&p), hi.sup(&p)));
    ((lo * 0.5 + hi * 0.5).into(), hi * 0.5 - lo * 0.5)
}

/// Triangles two of whose corners coincide enclose nothing and are left out.
fn is_closed(triangles: &[[u32; 3]], place: &[u32]) -> bool {
    let mut edges = Vec::with_capacity(3 * triangles.len());
    for t in triangles {
        let [a, b, c] = t.map(|v| place[v as usize]);
        if a != b && b != c && c != a {
            edges.extend([(a, b), (b, c), (c, a)].map(|(i, j)| (i.min(j), i.max(j))));
        }
    }
    edges.sort_unstable();
    !edges.is_empty() && edges.chunk_by(|x, y| x == y).all(|same| same.len() % 2 == 0)
}

fn components(vertices: usize, triangles: &[[u32; 3]], place: &[u32]) -> (Vec<Vec<u32>>, Vec<u32>) {
    let mut parent: Vec<u32> = place.to_vec();
    fn root(parent: &mut [u32], mut v: u32) -> u32 {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    }
    for t in triangles {
        for &v in &t[1..] {
            let (x, y) = (root(&mut parent, t[0]), root(&mut parent, v));
            parent[x as usize] = y;
        }
    }
    let mut used = vec![false; vertices];
    triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let mut components: Vec<Vec<u32>> = Vec::new();
    let mut number = HashMap::new();
    let mut component_of = vec![0; vertices];
    for v in (0..vertices as u32).filter(|&v| used[v as usize]) {
        let component = *number.entry(root(&mut parent, v)).or_insert_with(|| {
            components.push(Vec::new());
            components.len() as u32 - 1
        });
        components[component as usize].push(v);
        component_of[v as usize] = component;
    }
    (components, component_of)
}
