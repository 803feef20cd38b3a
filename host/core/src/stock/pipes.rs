//! A maze of pipes.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::builder::{Detail, Point, Soup, Vector};
use super::solids::tube;

/// Side of the lattice on whose points the pipes run.
const SIDE: i32 = 6;
const RADIUS: f64 = 0.24;
/// Radius of the elbows' center line.
const BEND: f64 = 0.42;

type Cell = [i32; 3];

/// Pipes that wind through a cube without meeting, with flanges at their ends; few in a coarse object.
pub fn pipes(mut detail: Detail) -> Soup {
    let mut soup = Soup::default();
    let wanted = (detail.triangles / 250).clamp(2, 14) as usize;
    let longest = (detail.triangles / 100).clamp(7, 18) as usize;
    for path in walks(wanted, longest) {
        let detail = detail.part();
        let centers = center_line(&path, detail);
        let sides = detail.steps(TAU * RADIUS, 4);
        soup.add(tube(&centers, |_| RADIUS, sides));
        for (end, next) in [(path[0], path[1]), (path[path.len() - 1], path[path.len() - 2])] {
            let along = (point(next) - point(end)).normalize();
            // Set back a little, so that pipe and flange do not end in one plane.
            let rim = [point(end) - 0.04 * along, point(end) + 0.14 * along];
            soup.add(tube(&rim, |_| 1.5 * RADIUS, detail.steps(TAU * 1.5 * RADIUS, 5)));
        }
    }
    soup
}

/// Self-avoiding walks on the lattice of at most so many points, none meeting another; always the same ones.
fn walks(wanted: usize, longest: usize) -> Vec<Vec<Cell>> {
    let mut random = Random(0x5eed);
    let mut taken = [false; (SIDE * SIDE * SIDE) as usize];
    let index = |c: Cell| ((c[0] * SIDE + c[1]) * SIDE + c[2]) as usize;
    let mut walks = Vec::new();
    while walks.len() < wanted {
        let start = [0; 3].map(|_: i32| random.below(SIDE as u32) as i32);
        if taken[index(start)] {
            continue;
        }
        let mut path = vec![start];
        let mut mine = taken;
        mine[index(start)] = true;
        let mut direction = [0; 3];
        while path.len() < longest {
            let here = path[path.len() - 1];
            let free: Vec<Cell> = DIRECTIONS
                .into_iter()
                .filter(|d| {
                    let to = [0, 1, 2].map(|k| here[k] + d[k]);
                    to.iter().all(|&x| (0..SIDE).contains(&x)) && !mine[index(to)]
                })
                .collect();
            if free.is_empty() {
                break;
            }
            // Two times in five straight on, where that is possible.
            if !(free.contains(&direction) && random.below(5) < 2) {
                direction = free[random.below(free.len() as u32) as usize];
            }
            let to = [0, 1, 2].map(|k| here[k] + direction[k]);
            mine[index(to)] = true;
            path.push(to);
        }
        // Short stubs late in a full lattice are given up rather than shown.
        if path.len() >= 5 || walks.len() >= 10 && path.len() >= 3 {
            taken = mine;
            walks.push(path);
        }
    }
    walks
}

const DIRECTIONS: [Cell; 6] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];

/// Straight stretches and quarter circles along a path.
fn center_line(path: &[Cell], detail: Detail) -> Vec<Point> {
    let mut line = vec![point(path[0])];
    for i in 1..path.len() {
        let here = point(path[i]);
        let arriving: Vector = here - point(path[i - 1]);
        let Some(&next) = path.get(i + 1) else {
            stretch(&mut line, here, detail);
            break;
        };
        let leaving: Vector = point(next) - here;
        if arriving == leaving {
            continue;
        }
        stretch(&mut line, here - BEND * arriving, detail);
        let hub = here - BEND * arriving + BEND * leaving;
        let n = detail.steps(FRAC_PI_2 * BEND, 2);
        line.extend((1..=n).map(|k| {
            let (sin, cos) = libm::sincos(FRAC_PI_2 * k as f64 / n as f64);
            hub - BEND * cos * leaving + BEND * sin * arriving
        }));
    }
    line
}

/// Goes on to a point in steps of the wished length.
fn stretch(line: &mut Vec<Point>, to: Point, detail: Detail) {
    let from = line[line.len() - 1];
    let n = detail.steps((to - from).norm(), 1);
    line.extend((1..=n).map(|k| from + k as f64 / n as f64 * (to - from)));
}

fn point(cell: Cell) -> Point {
    Point::from(Vector::from(cell.map(f64::from)))
}

/// A small generator of our own: the pipes must be the same in every version of every library.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u32) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (((self.0 >> 33) * u64::from(n)) >> 31) as u32
    }
}
