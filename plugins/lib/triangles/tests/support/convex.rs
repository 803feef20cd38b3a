//! Convex objects, and what plugins for them are put through.

use std::collections::HashMap;

use opencollbench_plugin::{Algorithm, Collision, Distance, Parameters, Placed, Pose, Refusal, Uncounted};

use super::{Dice, Scene, Soup, apply};

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

/// An object, as a plugin keeps it, and where it is.
pub type Posed<'a, A> = (&'a Soup, &'a <A as Algorithm>::Object, &'a Pose);

/// Asks about A and B in these poses and compares with all pairs of triangles; gives the distance.
pub fn check<A: Distance>(algorithm: &mut A, a: Posed<'_, A>, b: Posed<'_, A>) -> f64 {
    let (placed_a, placed_b) = (Placed { object: a.1, pose: a.2 }, Placed { object: b.1, pose: b.2 });
    let scene = Scene { a: a.0, b: b.0, pose_a: *a.2, pose_b: *b.2 };
    let (expected, tau) = (scene.truth().distance, scene.tau());
    let answer = algorithm.distance(placed_a, placed_b, &mut Uncounted).expect("an answer");
    let off = (answer.distance - expected).abs();
    assert!(off <= tau, "{} instead of {expected}, {:.0} tau, at {:?} {:?}", answer.distance, off / tau, a.2, b.2);
    let hit = algorithm.collide(placed_a, placed_b, &mut Uncounted).expect("an answer") != Collision::Apart;
    assert!(hit == (expected == 0.0) || expected <= tau, "{hit} at {expected}, {:?} {:?}", a.2, b.2);
    if let Some([p, q]) = answer.points {
        let gap = (0..3).map(|i| (p[i] - q[i]).powi(2)).sum::<f64>().sqrt();
        assert!((gap - answer.distance).abs() <= tau);
        for (point, (soup, _, pose)) in [(p, a), (q, b)] {
            let corners = |i: usize| soup.view().corners(i).map(|corner| apply(pose, corner));
            let off = |i: usize| ocb_triangles::distance(&[point; 3], &corners(i)).squared.sqrt();
            assert!((0..soup.triangles.len()).any(|i| off(i) <= tau), "{point:?} is on no triangle");
        }
    }
    expected
}

pub fn refuses_what_is_not_convex<A: Algorithm>() {
    let whole = cut_box(2, [1.0; 3]);
    let with = |change: &dyn Fn(&mut Soup)| {
        let mut soup = whole.clone();
        change(&mut soup);
        soup
    };
    let dented = with(&|soup| soup.positions.iter_mut().filter(|p| **p == [0.0, 0.0, 1.0]).for_each(|p| p[2] -= 1e-9));
    let open = with(&|soup| soup.triangles.truncate(soup.triangles.len() - 1));
    let doubled = with(&|soup| {
        soup.triangles.pop();
        soup.triangles.extend(soup.triangles.clone());
    });
    let needle = with(&|soup| soup.triangles.push([0, 0, 0]));
    let wall = with(&|soup| {
        // From both sides, with vertices of its own.
        soup.positions.extend([[0.5, 0.1, 0.0], [-0.5, 0.2, 0.0], [0.0, -0.5, 0.3]]);
        let first = soup.positions.len() as u32 - 3;
        soup.triangles.extend([[first, first + 1, first + 2], [first + 1, first, first + 2]]);
    });
    let flat = Soup { positions: whole.positions[..3].to_vec(), triangles: vec![[0, 1, 3], [1, 0, 3]] };
    let flat = Soup { positions: [&flat.positions[..], &[[-1.0, 1.0, 1.0]]].concat(), ..flat };
    for (soup, reason) in [
        (Soup::torus(8, 4), "in front of its triangle"),
        (dented, "in front of its triangle"),
        (open, "belongs to 1 triangles"),
        (doubled, "belongs to 4 triangles"),
        (needle, "belongs to"),
        (wall, "comes twice"),
        (flat, "comes twice"),
    ] {
        match A::default().load_mesh(soup.view()) {
            Err(Refusal::Error(sentence)) => assert!(sentence.contains(reason), "{sentence} is not {reason}"),
            _ => panic!("not refused: {reason}"),
        }
    }
    // A tetrahedron without height.
    let flat = Soup {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2], [1, 3, 2], [0, 1, 3], [0, 3, 2]],
    };
    assert!(matches!(A::default().load_mesh(flat.view()), Err(Refusal::Error(sentence)) if sentence.contains("flat")));
}

/// Coordinates in single precision dent round shapes; then the error is the dent's.
pub fn takes_a_shallow_dent_for_none<A: Distance + Parameters>() {
    let mut soup = cut_box(6, [0.5, 0.4, 0.3]);
    let (s, c) = 0.3f64.sin_cos();
    soup.positions.iter_mut().for_each(|p| {
        *p = [c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]].map(|x| f64::from(x as f32));
    });
    assert!(A::default().load_mesh(soup.view()).is_err(), "turned in single precision, its sides are not flat");
    let mut lax = A::default();
    lax.set("dent", 1e-6).expect("the parameter exists");
    let body = lax.load_mesh(soup.view()).expect("its dents are shallow");
    let (mut dice, mut worst) = (Dice(3), 0.0f64);
    for _ in 0..20 {
        let (pose_a, pose_b) = (dice.pose(0.0), dice.pose(1.6));
        let truth = Scene::of(&soup, pose_a, pose_b).truth().distance;
        let (a, b) = (Placed { object: &body, pose: &pose_a }, Placed { object: &body, pose: &pose_b });
        let answer = lax.distance(a, b, &mut Uncounted).expect("an answer").distance;
        assert!(answer > 0.0);
        worst = worst.max((answer - truth).abs());
    }
    assert!(worst <= 2e-6, "{worst}");
}
