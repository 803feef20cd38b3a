//! Each part against the definition, over all triangles.

#[path = "../../triangles/tests/support/mod.rs"]
mod support;

use ocb_fields::{Ball, BallTree, Bounds, Lattice, Nearest, cover, inside, odd_edges};
use ocb_triangles::vector::{Vector, cross, dot, sub};
use support::{Dice, Soup};

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

fn distance(soup: &Soup, p: Vector) -> f64 {
    let triangles = 0..soup.triangles.len();
    let all = triangles.map(|i| ocb_triangles::distance(&[p; 3], &soup.view().corners(i)).squared.sqrt());
    all.fold(f64::INFINITY, f64::min)
}

/// How often the surface goes around a point: the sum of the solid angles (van Oosterom and Strackee 1983).
fn winding(soup: &Soup, p: Vector) -> f64 {
    let angle = |i: usize| {
        let [a, b, c] = soup.view().corners(i).map(|corner| sub(corner, p));
        let (la, lb, lc) = (length(a), length(b), length(c));
        let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        2.0 * dot(a, cross(b, c)).atan2(below)
    };
    (0..soup.triangles.len()).map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn somewhere(dice: &mut Dice, reach: f64) -> Vector {
    [(); 3].map(|()| reach * (2.0 * dice.roll() - 1.0))
}

#[test]
fn a_closed_mesh_is_told_from_an_open_one() {
    let mut soup = Soup::torus(16, 8);
    assert_eq!(odd_edges(&soup.view()), 0);
    soup.triangles.pop();
    assert_eq!(odd_edges(&soup.view()), 3);
    // The triangle comes back with vertices of its own in the same places.
    let whole = Soup::torus(16, 8);
    let last = whole.view().corners(whole.triangles.len() - 1);
    let first = soup.positions.len() as u32;
    soup.positions.extend(last);
    soup.triangles.push([first, first + 1, first + 2]);
    assert_eq!(odd_edges(&soup.view()), 0);
}

#[test]
fn inside_is_right_where_lines_run_along_faces_and_through_edges() {
    let sides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    // The sides of the boxes are sums of spacings, with and without rounding.
    for side in [1.0, 0.3, 0.7] {
        let soup = Soup {
            positions: (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|x| side * f64::from(x))).collect(),
            triangles: sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
        };
        let spacing = side / 7.0;
        for lattice in [
            Lattice { origin: [-2.0 * spacing; 3], spacing, nodes: [12; 3] },
            Lattice::around(&Bounds::of(&soup.view()), 2.0 * spacing, spacing),
        ] {
            for (at, within) in lattice.each().zip(inside(&soup.view(), &lattice)) {
                // Nodes on the surface are on either side.
                let deepest = lattice.node(at).map(|x| x.min(side - x)).into_iter().fold(f64::INFINITY, f64::min);
                assert!(within == (deepest > 0.0) || deepest.abs() < 1e-12, "{at:?} of {lattice:?}");
            }
        }
    }
}

#[test]
fn inside_is_where_the_surface_goes_around() {
    let soup = Soup::torus(24, 12);
    let lattice = Lattice::around(&Bounds::of(&soup.view()), 0.05, 0.11);
    let within = inside(&soup.view(), &lattice);
    assert_eq!(within.len(), lattice.count());
    for (at, &within) in lattice.each().zip(&within) {
        let turns = winding(&soup, lattice.node(at)).abs();
        assert_eq!(within, turns > 0.5, "{at:?}: {turns}");
    }
    assert!(within.iter().filter(|w| **w).count() > 100);
}

#[test]
fn the_nearest_distance_is_right_and_never_more_than_the_slack_too_large() {
    for soup in [Soup::torus(24, 12), Soup::scraps()] {
        let (nearest, mut dice, mut near) = (Nearest::new(&soup.view()), Dice(5), 0);
        for _ in 0..200 {
            let p = somewhere(&mut dice, 2.0);
            let truth = distance(&soup, p);
            let exact = nearest.distance(p, 0.0, &mut near);
            assert!((exact - truth).abs() <= 1e-14, "{exact} and {truth}");
            let lax = nearest.distance(p, 0.1, &mut near);
            assert!(lax >= truth - 1e-14 && lax <= truth + 0.1, "{lax} and {truth}");
        }
    }
}

#[test]
fn a_node_holds_every_ball_below_it() {
    let mut dice = Dice(8);
    let balls = (0..500).map(|_| Ball { center: somewhere(&mut dice, 1.0), radius: 0.1 * dice.roll() }).collect();
    let tree = BallTree::new(balls, 3);
    let mut open = vec![(0, 0..500)];
    let mut seen = 0;
    while let Some((at, range)) = open.pop() {
        let node = tree.nodes[at];
        for ball in &tree.balls[range.clone()] {
            assert!(length(sub(ball.center, node.ball.center)) + ball.radius <= node.ball.radius + 1e-15);
        }
        if node.count > 0 {
            seen += node.count;
            assert!(node.count <= 3 && range == (node.first as usize..(node.first + node.count) as usize));
        } else {
            let middle = range.start + range.len() / 2;
            let child = node.first as usize;
            open.extend([(child, range.start..middle), (child + 1, middle..range.end)]);
        }
    }
    assert_eq!(seen, 500);
}

#[test]
fn samples_are_everywhere_on_the_surface() {
    let soup = Soup::torus(10, 6);
    let samples = cover(&soup.view(), 0.05);
    assert!(samples.len() > soup.positions.len());
    let mut dice = Dice(2);
    for i in 0..soup.triangles.len() {
        let [a, b, c] = soup.view().corners(i);
        let (s, t) = (dice.roll(), dice.roll());
        let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (s, t) };
        let p: Vector = std::array::from_fn(|i| a[i] + s * (b[i] - a[i]) + t * (c[i] - a[i]));
        let gap = samples.iter().map(|&q| length(sub(p, q))).fold(f64::INFINITY, f64::min);
        assert!(gap <= 0.05, "{gap}");
    }
}
