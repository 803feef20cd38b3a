//! The faces of a convex body: its triangles, joined where they lie in one plane.

use std::collections::HashMap;

use ocb_bodies::Surface;
use ocb_triangles::vector::{Vector, cross, dot, sub};

/// A face of the body.
pub struct Facet {
    /// Outwards, of length 1.
    pub normal: Vector,
    /// A point of its plane.
    pub anchor: Vector,
    /// Its corners by their numbers in the surface, counter-clockwise as seen from outside. Each belongs to three facets or more.
    pub corners: Vec<u32>,
}

/// A triangle that looks outwards.
struct Tile {
    corners: [u32; 3],
    normal: Vector,
    area: f64,
}

/// The facets of a surface around `middle`. Vertices within `reach` of a plane lie in it.
///
/// None if they are not the faces of a polyhedron: a facet with a hole or with fewer than three corners.
pub fn facets(surface: &Surface, middle: Vector, reach: f64) -> Option<Vec<Facet>> {
    let tiles: Vec<Tile> = (0..surface.triangles.len()).map(|triangle| tile(surface, triangle, middle)).collect();
    let mut across = HashMap::new();
    for (number, tile) in tiles.iter().enumerate() {
        for edge in edges(tile.corners) {
            if across.insert(edge, number).is_some() {
                return None;
            }
        }
    }
    let (of_tile, seeds) = grow(surface, &tiles, &across, reach);
    // Where each border of a facet goes on.
    let mut borders: Vec<HashMap<u32, u32>> = vec![HashMap::new(); seeds.len()];
    let mut meeting = vec![0u32; surface.points.len()];
    for (number, tile) in tiles.iter().enumerate() {
        for (from, to) in edges(tile.corners) {
            let facet = of_tile[number];
            if of_tile[*across.get(&(to, from))?] != facet {
                meeting[from as usize] += 1;
                if borders[facet].insert(from, to).is_some() {
                    return None;
                }
            }
        }
    }
    let facet = |(seed, border): (usize, HashMap<u32, u32>)| {
        let mut corners = around(&border)?;
        corners.retain(|&corner| meeting[corner as usize] >= 3);
        let Tile { normal, corners: [anchor, ..], .. } = tiles[seed];
        (corners.len() >= 3).then(|| Facet { normal, anchor: surface.points[anchor as usize], corners })
    };
    seeds.into_iter().zip(borders).map(facet).collect()
}

fn tile(surface: &Surface, triangle: usize, middle: Vector) -> Tile {
    let ([p, q, r], mut corners) = (surface.corners(triangle), surface.triangles[triangle]);
    let normal = cross(sub(q, p), sub(r, p));
    let area = dot(normal, normal).sqrt();
    let outwards = dot(normal, sub(p, middle)) > 0.0;
    if !outwards {
        corners.swap(1, 2);
    }
    Tile { corners, normal: normal.map(|x| if outwards { x / area } else { -x / area }), area }
}

fn edges([a, b, c]: [u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// The facet of each tile, and the tile that each facet began with. The largest tiles begin, because their planes are the most
/// certain.
fn grow(
    surface: &Surface,
    tiles: &[Tile],
    across: &HashMap<(u32, u32), usize>,
    reach: f64,
) -> (Vec<usize>, Vec<usize>) {
    let mut order: Vec<usize> = (0..tiles.len()).collect();
    order.sort_by(|&i, &j| tiles[j].area.total_cmp(&tiles[i].area));
    let (mut of_tile, mut seeds) = (vec![usize::MAX; tiles.len()], Vec::new());
    for seed in order {
        if of_tile[seed] != usize::MAX {
            continue;
        }
        let Tile { normal, corners: [anchor, ..], .. } = tiles[seed];
        let anchor = surface.points[anchor as usize];
        let flat = |tile: &Tile| {
            tile.corners.iter().all(|&c| dot(normal, sub(surface.points[c as usize], anchor)).abs() <= reach)
        };
        of_tile[seed] = seeds.len();
        let mut open = vec![seed];
        while let Some(at) = open.pop() {
            for (from, to) in edges(tiles[at].corners) {
                let Some(&next) = across.get(&(to, from)) else { continue };
                if of_tile[next] == usize::MAX && flat(&tiles[next]) {
                    of_tile[next] = seeds.len();
                    open.push(next);
                }
            }
        }
        seeds.push(seed);
    }
    (of_tile, seeds)
}

/// The one loop that a border is, from the same corner every time.
fn around(border: &HashMap<u32, u32>) -> Option<Vec<u32>> {
    let first = *border.keys().min()?;
    let mut corners = vec![first];
    let mut at = border[&first];
    while at != first {
        corners.push(at);
        at = *border.get(&at)?;
        if corners.len() > border.len() {
            return None;
        }
    }
    (corners.len() == border.len()).then_some(corners)
}
