//! A method that is honest on small objects and for its first 40 questions, and then gives the answer that it found most often,
//! or the middle one of its distances, without looking. What keeps guesses from a rank has to find it.
//!
//! Never offered to anybody: an example is not built beside the programs.
#![forbid(unsafe_code)]

use ocb_triangles::{Frame, Triangle, distance, meet};
use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, Count, Distance, Mesh, Placed, Refusal, Separation,
};

/// Questions of a process that are answered honestly.
const HONEST: usize = 40;
/// Objects of fewer triangles always are.
const SMALL: usize = 64;

/// The method.
#[derive(Default)]
pub struct Guesser {
    hits: Vec<bool>,
    distances: Vec<f64>,
}

opencollbench_plugin::export!(Guesser: distance);

impl Algorithm for Guesser {
    const ABOUT: About = About {
        id: c"guesser",
        name: c"A method that guesses",
        authors: c"The OpenCollBench contributors",
        license: c"MIT OR Apache-2.0",
        // Of which more is forgiven.
        capabilities: &[Capability::SinglePrecision],
        ..About::new()
    };

    type Object = Vec<Triangle>;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Self::Object> {
        Ok((0..mesh.triangles.len()).map(|i| mesh.corners(i)).collect())
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, _: &mut impl Count) -> Answer<Collision> {
        if a.object.len() < SMALL || self.hits.len() < HONEST {
            let hit = pairs(&a, &b).iter().any(|(a, b)| meet(a, b));
            self.hits.push(hit);
            return Ok(if hit { Collision::Somewhere } else { Collision::Apart });
        }
        let hits = self.hits.iter().filter(|hit| **hit).count();
        Ok(if 2 * hits > self.hits.len() { Collision::Somewhere } else { Collision::Apart })
    }
}

impl Distance for Guesser {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, _: &mut impl Count) -> Answer<Separation> {
        if a.object.len() < SMALL || self.distances.len() < HONEST {
            let nearest = pairs(&a, &b).iter().map(|(a, b)| distance(a, b).squared).reduce(f64::min);
            let found = nearest.ok_or(Refusal::GaveUp)?.sqrt();
            self.distances.push(found);
            return Ok(Separation { distance: found, points: None, triangles: None });
        }
        let mut sorted = self.distances.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        Ok(Separation { distance: sorted[sorted.len() / 2], points: None, triangles: None })
    }
}

/// All pairs of triangles in one frame.
fn pairs(a: &Placed<'_, Guesser>, b: &Placed<'_, Guesser>) -> Vec<(Triangle, Triangle)> {
    let frame = Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation());
    let of_b: Vec<Triangle> = b.object.iter().map(|t| frame.place_b(t)).collect();
    let pair = |of_a: &Triangle| {
        let of_a = frame.place_a(of_a);
        of_b.iter().map(move |of_b| (of_a, *of_b)).collect::<Vec<_>>()
    };
    a.object.iter().flat_map(pair).collect()
}
