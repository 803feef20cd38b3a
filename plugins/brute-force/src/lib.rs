#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod inside;
mod pair;

use core::ops::ControlFlow;

use ocb_triangles::{Closest, Triangle, distance, distance_below, meet};
use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, ContactList, Contacts, Count, Distance, Mesh, Placed, Separation,
};
use pair::{Boxed, Pair};

/// One object: its triangles in its own frame, and one of them for each part that hangs together.
pub struct Body {
    triangles: Vec<Triangle>,
    parts: Vec<usize>,
}

/// Every triangle of A against every triangle of B.
#[derive(Debug, Default)]
pub struct BruteForce;

opencollbench_plugin::export!(BruteForce: distance contacts counts);

impl Algorithm for BruteForce {
    const ABOUT: About = About {
        id: c"brute-force",
        name: c"Brute force",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        capabilities: &[Capability::Solid],
        ..About::new()
    };

    type Object = Body;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Body> {
        let triangles = (0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle)).collect();
        Ok(Body { triangles, parts: inside::one_of_each_part(&mesh) })
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let mut found = Collision::Apart;
        Pair::new(a, b).each_pair(0.0, work, |a, b, work| {
            work.primitive_test(a.id, b.id);
            if meet(&a.triangle, &b.triangle) {
                found = Collision::Pair(a.id, b.id);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(0.0)
        });
        Ok(found)
    }

    fn inside(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, _: &mut impl Count) -> Answer<bool> {
        let pair = Pair::new(a, b);
        // Where one corner of a part is, all of it is: the surfaces do not meet.
        let holds = |whole: &[Boxed], other: &[Boxed], parts: &[usize]| {
            let corners = parts.iter().map(|&triangle| other[triangle].triangle[0]);
            any(corners.map(|corner| inside::encloses(whole.iter().map(|t| &t.triangle), corner)))
        };
        Ok(holds(&pair.a, &pair.b, &b.object.parts)? || holds(&pair.b, &pair.a, &a.object.parts)?)
    }
}

/// Is one of the answers yes? Those after the first yes, or the first refusal, are not asked for.
fn any(mut answers: impl Iterator<Item = Answer<bool>>) -> Answer<bool> {
    answers.find(|answer| !matches!(answer, Ok(false))).unwrap_or(Ok(false))
}

impl Contacts for BruteForce {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        Pair::new(a, b).each_pair(0.0, work, |a, b, work| {
            work.primitive_test(a.id, b.id);
            if meet(&a.triangle, &b.triangle) {
                found.push(a.id, b.id);
            }
            ControlFlow::Continue(0.0)
        });
        Ok(())
    }
}

impl Distance for BruteForce {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        let pair = Pair::new(a, b);
        let mut best = first_guess(&pair, work);
        pair.each_pair(best.closest.squared, work, |a, b, work| {
            best.improve(a, b, work);
            if best.closest.squared == 0.0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(best.closest.squared)
            }
        });
        Ok(Separation {
            distance: best.closest.squared.sqrt(),
            points: Some([pair.frame.to_world(best.closest.a), pair.frame.to_world(best.closest.b)]),
            triangles: Some([best.a.id, best.b.id]),
        })
    }
}

/// The closest pair of triangles so far.
struct Best<'a> {
    closest: Closest,
    a: &'a Boxed,
    b: &'a Boxed,
}

impl<'a> Best<'a> {
    fn improve(&mut self, a: &'a Boxed, b: &'a Boxed, work: &mut impl Count) {
        work.primitive_test(a.id, b.id);
        if let Some(closest) = distance_below(&a.triangle, &b.triangle, self.closest.squared) {
            *self = Self { closest, a, b };
        }
    }
}

/// An upper bound, so that the boxes reject nearly every pair: from any pair on, the nearest triangle of B, from there
/// the nearest of A, and so on while that helps. Three rounds are close enough.
fn first_guess<'a>(pair: &'a Pair, work: &mut impl Count) -> Best<'a> {
    let (a, b) = (&pair.a[0], &pair.b[0]);
    work.primitive_test(a.id, b.id);
    let mut best = Best { closest: distance(&a.triangle, &b.triangle), a, b };
    for _ in 0..3 {
        let a = best.a;
        pair.b.iter().for_each(|b| best.improve(a, b, work));
        let b = best.b;
        pair.a.iter().for_each(|a| best.improve(a, b, work));
    }
    best
}
