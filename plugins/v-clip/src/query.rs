//! One query: a walk, and GJK where the walk cannot be trusted.

use ocb_bodies::{Found, Pair};
use ocb_triangles::vector::{norm_1, transposed};
use ocb_triangles::{Closest, Frame, skew};
use opencollbench_plugin::{Count, Placed};

use crate::polyhedron::Feature;
use crate::walk::{Ending, Walk};
use crate::{Object, VClip, Work};

/// Below so many roundings at the size of the scene the direction of a distance is uncertain, and with it the regions that
/// the features lie in.
const UNCERTAIN: f64 = 256.0 * 0.5 * f64::EPSILON;
/// What rounding may move a vertex by in its place, as a share of the scene.
const ROUNDING: f64 = 4.0 * 0.5 * f64::EPSILON;
/// Rotations may be off by so much: the walk compares features in the frames of the objects, and what it misses in the
/// distance is of the order of the square.
const SKEW: f64 = 1e-9;
/// Where a walk begins that knows nothing.
const FIRST: [Feature; 2] = [Feature::Vertex(0); 2];

/// How two bodies lie.
pub enum Relation {
    /// They have no point in common, and this is where they are nearest.
    Apart(Closest),
    /// Their surfaces meet.
    Crossing,
    /// They have a point in common; their surfaces need not.
    Meeting,
}

/// Two objects in their poses.
pub struct Query<'a> {
    a: &'a Object,
    b: &'a Object,
    pub frame: Frame,
}

impl<'a> Query<'a> {
    pub fn new(a: &Placed<'a, VClip>, b: &Placed<'a, VClip>) -> Self {
        let (from, to) = (a.pose, b.pose);
        let frame = Frame::new(from.rotation(), from.translation(), to.rotation(), to.translation());
        Self { a: a.object, b: b.object, frame }
    }

    /// What tells the objects from others.
    pub fn objects(&self) -> [u32; 2] {
        [self.a.id, self.b.id]
    }

    /// How the bodies lie, the pair of features at the end of the walk from `start`, and what it took. Where rounding may have
    /// misled the walk, only GJK can tell.
    pub fn ask(&self, start: Option<[Feature; 2]>, count: &mut impl Count) -> (Option<Relation>, [Feature; 2], Work) {
        let (found, at, steps) = self.walk(start.unwrap_or(FIRST));
        count.bv_tests(steps);
        let fallbacks = u64::from(found.is_none());
        (found, at, Work { steps, fallbacks })
    }

    /// None if rounding may have misled the walk.
    fn walk(&self, start: [Feature; 2]) -> (Option<Relation>, [Feature; 2], u64) {
        let (Some(a), Some(b)) = (&self.a.polyhedron, &self.b.polyhedron) else { return (None, start, 0) };
        let skewed = [self.frame.rotation_a, self.frame.rotation_b].iter().any(|m| skew(&transposed(m)) > SKEW);
        if skewed {
            return (None, start, 0);
        }
        let mut walk = Walk::new([a, b], self.frame, start);
        let found = match walk.run() {
            Ending::Nearest => {
                let scene = self.a.body.size + self.b.body.size + norm_1(self.frame.offset);
                let uncertain = UNCERTAIN * scene;
                let certain = |closest: &Closest| closest.squared > uncertain * uncertain;
                walk.closest(ROUNDING * scene).filter(certain).map(Relation::Apart)
            }
            Ending::Crossing => Some(Relation::Crossing),
            Ending::Inside => Some(Relation::Meeting),
            Ending::Circle => None,
        };
        (found, walk.at, walk.steps)
    }

    /// Whether the bodies meet, by GJK. Cheaper than where they are nearest: it ends with the first plane between them.
    pub fn meet(&self, count: &mut impl Count) -> bool {
        Pair::new(&self.a.body, &self.b.body, self.frame, count).meet()
    }

    /// How the bodies lie, by GJK.
    pub fn nearest(&self, count: &mut impl Count) -> Relation {
        match Pair::new(&self.a.body, &self.b.body, self.frame, count).nearest() {
            Found::Apart(closest) => Relation::Apart(closest),
            Found::Meeting => Relation::Meeting,
        }
    }

    /// How far the one body is from the surface of the other that holds it; 0 or less when neither holds the other.
    pub fn room(&self, count: &mut impl Count) -> f64 {
        Pair::new(&self.a.body, &self.b.body, self.frame, count).room()
    }
}
