//! Do boxes overlap? For processors on which sixteen pairs take many registers: what can end early does.

use ocb_lanes::{Bits, Four, Numbers, Points, dot, sub, three};

use super::boxes::{Boxes, SURE, not_separated};
use super::relative::Relative;
use super::tree::{Link, Node, row};

/// Pairs of the children of two nodes, of which one at most is a leaf, that may have a point in common, and the one of those
/// whose middles are nearest.
///
/// Spheres around the boxes tell most pairs apart, and often all. Of the rest, each box of B is compared with four of A.
#[inline(always)]
pub fn overlap([a, b]: [Link; 2], node_a: &Node, node_b: &Node, relative: &Relative, live: Bits) -> (Bits, usize) {
    let (center_a, half_a) = (vector(a, node_a, 0), half(a, node_a));
    let (center_b, half_b) = (vector(b, node_b, 0), half(b, node_b));
    let center_b = relative.place_points(&center_b);
    let half_b = three!(k => relative.enlarge(half_b[k]));
    let (radius_a, radius_b) = (dot(&half_a, &half_a).sqrt(), dot(&half_b, &half_b).sqrt());
    let mut squares = [[0.0; 4]; 4];
    let mut left = 0;
    for j in 0..4 {
        let between = sub(&lane(&center_b, j), &center_a);
        let square = dot(&between, &between);
        let reach = radius_a + Four::splat(radius_b.as_array()[j]);
        let near =
            Four::unless_above(Four::lanes(0xf), square * Four::splat(SURE), reach.mul_add(reach, Four::splat(TINY)));
        left |= Four::bits(near) << (4 * j);
        squares[j] = square.to_array();
    }
    left &= live;
    if left == 0 {
        return (0, 0);
    }
    let boxes_a = Boxes { center: center_a, axes: three!(k => vector(a, node_a, k + 1)), half: half_a };
    let axes_b = three!(k => relative.turn(&vector(b, node_b, k + 1)));
    let mut rest = left;
    while rest != 0 {
        let j = rest.trailing_zeros() as usize / 4 % 4;
        let four = 0xf << (4 * j);
        let box_b =
            Boxes { center: lane(&center_b, j), axes: three!(k => lane(&axes_b[k], j)), half: lane(&half_b, j) };
        let between = sub(&box_b.center, &boxes_a.center);
        left &= !four | not_separated(&boxes_a, &box_b, &between, 0xf) << (4 * j);
        rest &= !four;
    }
    (left, least(&squares, left))
}

/// Vector `k` of the children of an inner node, or of the box of a leaf in all lanes.
#[inline(always)]
fn vector(link: Link, node: &Node, k: usize) -> Points<Four> {
    three!(i => if link.is_leaf() { Four::splat(node.vectors[i][12 + k]) } else { Four::new(*row(&node.vectors, i, k)) })
}

/// Half sides of the same.
#[inline(always)]
fn half(link: Link, node: &Node) -> Points<Four> {
    three!(k => if link.is_leaf() { Four::splat(node.half[0][k]) } else { Four::new(node.half[k]) })
}

/// One of four in all lanes.
#[inline(always)]
fn lane(of: &Points<Four>, lane: usize) -> Points<Four> {
    three!(i => Four::splat(of[i].as_array()[lane]))
}

/// The lane of the smallest number among these lanes.
#[inline(always)]
fn least(numbers: &[[f32; 4]; 4], mut among: Bits) -> usize {
    let (mut least, mut found) = (f32::INFINITY, 0);
    while among != 0 {
        let lane = among.trailing_zeros() as usize % 16;
        among &= among - 1;
        if numbers[lane / 4][lane % 4] < least {
            (least, found) = (numbers[lane / 4][lane % 4], lane);
        }
    }
    found
}

/// More than squares can lose because they are too small for single precision.
const TINY: f32 = 1e-36;
