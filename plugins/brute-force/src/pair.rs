//! Both objects of a query in one frame, and the loop over all pairs of their triangles.

use core::ops::ControlFlow;

use ocb_triangles::vector::Vector;
use ocb_triangles::{Frame, Triangle};
use opencollbench_plugin::{Count, Placed};

use crate::BruteForce;

/// Triangles of A and B in one frame, each with its box.
pub struct Pair {
    pub frame: Frame,
    pub a: Vec<Boxed>,
    pub b: Vec<Boxed>,
}

/// A triangle, its id, and its axis-aligned box.
#[derive(Clone, Copy)]
pub struct Boxed {
    pub id: u32,
    pub triangle: Triangle,
    bounds: Aabb,
}

#[derive(Clone, Copy)]
struct Aabb {
    min: Vector,
    max: Vector,
}

impl Pair {
    pub fn new(a: Placed<'_, BruteForce>, b: Placed<'_, BruteForce>) -> Self {
        let frame = Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation());
        let boxed = |(id, triangle): (usize, Triangle)| Boxed { id: id as u32, triangle, bounds: Aabb::of(&triangle) };
        let a = a.object.triangles.iter().map(|triangle| frame.place_a(triangle)).enumerate().map(boxed).collect();
        let b = b.object.triangles.iter().map(|triangle| frame.place_b(triangle)).enumerate().map(boxed).collect();
        Self { frame, a, b }
    }

    /// Visits every pair of triangles whose boxes are at most `reach` (squared) apart, until the visitor breaks. What
    /// the visitor returns is the reach from there on.
    pub fn each_pair<'p, C: Count>(
        &'p self,
        mut reach: f64,
        work: &mut C,
        mut visit: impl FnMut(&'p Boxed, &'p Boxed, &mut C) -> ControlFlow<(), f64>,
    ) {
        // What is out of reach of all of the other object need not meet its triangles one by one.
        let (bounds_a, bounds_b) = (Aabb::around(&self.a), Aabb::around(&self.b));
        work.bv_tests((self.a.len() + self.b.len()) as u64);
        let near_b: Vec<&Boxed> = self.b.iter().filter(|b| b.bounds.squared_gap(&bounds_a) <= reach).collect();
        let boxes_b: Vec<Aabb> = near_b.iter().map(|b| b.bounds).collect();
        for a in &self.a {
            if a.bounds.squared_gap(&bounds_b) > reach {
                continue;
            }
            work.bv_tests(boxes_b.len() as u64);
            for (&b, bounds) in near_b.iter().zip(&boxes_b) {
                if a.bounds.squared_gap(bounds) <= reach {
                    match visit(a, b, work) {
                        ControlFlow::Continue(next) => reach = next,
                        ControlFlow::Break(()) => return,
                    }
                }
            }
        }
    }
}

impl Aabb {
    fn of(triangle: &Triangle) -> Self {
        let of = |pick: fn(f64, f64) -> f64| {
            core::array::from_fn(|axis| triangle.iter().map(|corner| corner[axis]).reduce(pick).unwrap_or(0.0))
        };
        Self { min: of(f64::min), max: of(f64::max) }
    }

    fn around(triangles: &[Boxed]) -> Self {
        let nothing = Self { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
        triangles.iter().fold(nothing, |all, t| Self {
            min: core::array::from_fn(|axis| all.min[axis].min(t.bounds.min[axis])),
            max: core::array::from_fn(|axis| all.max[axis].max(t.bounds.max[axis])),
        })
    }

    /// Square of the distance of two boxes; 0 when they meet.
    #[inline(always)]
    fn squared_gap(&self, other: &Self) -> f64 {
        let gap = |axis: usize| (self.min[axis] - other.max[axis]).max(other.min[axis] - self.max[axis]).max(0.0);
        let [x, y, z] = [gap(0), gap(1), gap(2)];
        x * x + y * y + z * z
    }
}
