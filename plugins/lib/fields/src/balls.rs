//! A hierarchy of balls.

use ocb_triangles::vector::{Vector, add_scaled, dot, sub};

use crate::Bounds;

/// A ball, or with radius 0 a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its middle.
    pub center: Vector,
    /// Its radius.
    pub radius: f64,
}

/// A ball around balls.
#[derive(Clone, Copy, Debug)]
pub struct BallNode {
    /// Encloses all balls below; a leaf of one ball is that ball.
    pub ball: Ball,
    /// Leaf: its first ball. Inner node: its first child; the second one follows it.
    pub first: u32,
    /// Leaf: how many balls. Inner node: 0.
    pub count: u32,
}

/// Balls in a binary tree.
#[derive(Debug)]
pub struct BallTree {
    /// The root is the first.
    pub nodes: Vec<BallNode>,
    /// In the order of the leaves.
    pub balls: Vec<Ball>,
}

/// Steps to the smallest enclosing ball; the radius is then a few per cent too large.
const STEPS: u32 = 12;

impl BallTree {
    /// Halves the balls along the longest side of the box of their middles until a leaf holds at most `leaf` of them.
    /// There must be a ball.
    pub fn new(mut balls: Vec<Ball>, leaf: usize) -> Self {
        let none = Ball { center: [0.0; 3], radius: 0.0 };
        let (mut nodes, mut open) = (vec![BallNode { ball: none, first: 0, count: balls.len() as u32 }], vec![0]);
        while let Some(at) = open.pop() {
            let (first, count) = (nodes[at].first as usize, nodes[at].count as usize);
            let here = &mut balls[first..first + count];
            nodes[at].ball = enclose(here);
            if count <= leaf {
                continue;
            }
            let axis = here.iter().fold(Bounds::NONE, |all, ball| all.with(ball.center)).longest_axis();
            here.select_nth_unstable_by(count / 2, |a, b| a.center[axis].total_cmp(&b.center[axis]));
            let child = nodes.len();
            let half = |first: usize, count: usize| BallNode { ball: none, first: first as u32, count: count as u32 };
            nodes.extend([half(first, count / 2), half(first + count / 2, count - count / 2)]);
            (nodes[at].first, nodes[at].count) = (child as u32, 0);
            open.extend([child, child + 1]);
        }
        Self { nodes, balls }
    }
}

/// A small ball around balls: from the middle of their box towards the farthest one, by shorter and shorter steps
/// (Badoiu and Clarkson 2003).
fn enclose(balls: &[Ball]) -> Ball {
    if let [one] = balls {
        return *one;
    }
    let box_of = balls.iter().fold(Bounds::NONE, |all, ball| all.with(ball.center));
    let mut center: Vector = core::array::from_fn(|i| 0.5 * (box_of.min[i] + box_of.max[i]));
    let reach = |center: Vector, ball: &Ball| length(sub(ball.center, center)) + ball.radius;
    let mut best = Ball { center, radius: f64::INFINITY };
    for step in 1..=STEPS {
        let (far, radius) = balls
            .iter()
            .map(|ball| (ball, reach(center, ball)))
            .fold((&balls[0], 0.0), |farthest, next| if next.1 > farthest.1 { next } else { farthest });
        if radius < best.radius {
            best = Ball { center, radius };
        }
        center = add_scaled(center, 1.0 / f64::from(step + 1), sub(far.center, center));
    }
    // Rounding must not leave a ball outside.
    best.radius *= 1.0 + 8.0 * f64::EPSILON;
    best
}

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}
