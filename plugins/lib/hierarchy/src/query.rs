//! Both trees at once: from the pair of roots down to pairs of leaves.

use ocb_triangles::{Frame, Triangle, meet};
use opencollbench_plugin::{Collision, ContactList, Count, Pose};

use crate::nearest::Pending;
use crate::{Hierarchy, Relative, Volume};

/// A node of A and one of B.
pub(crate) type Pair<At> = (At, At);

/// Pairs of volumes that are still to be opened; memory that is kept from query to query.
#[derive(Debug)]
pub struct Open<At> {
    /// Those that are not apart; the next one last.
    overlapping: Vec<Pair<At>>,
    pub(crate) pending: Pending<At>,
}

impl<At> Default for Open<At> {
    fn default() -> Self {
        Self { overlapping: Vec::new(), pending: Pending::default() }
    }
}

/// One query.
pub struct Query<'a, H: Hierarchy, C> {
    pub(crate) a: &'a H,
    pub(crate) b: &'a H,
    pub(crate) frame: Frame,
    pub(crate) relative: Relative,
    shared: <H::Volume as Volume>::Shared,
    pub(crate) work: &'a mut C,
}

impl<'a, H: Hierarchy, C: Count> Query<'a, H, C> {
    /// Two objects in their poses.
    pub fn new([a, b]: [&'a H; 2], [pose_a, pose_b]: [&Pose; 2], work: &'a mut C) -> Self {
        let frame = Frame::new(pose_a.rotation(), pose_a.translation(), pose_b.rotation(), pose_b.translation());
        let relative = Relative::new(&frame, a.leaves().radius, b.leaves().radius);
        Self { a, b, frame, relative, shared: H::Volume::share(&relative), work }
    }

    /// Any pair of triangles that meet.
    pub fn first_contact(&mut self, open: &mut Open<H::At>) -> Collision {
        let mut found = Collision::Apart;
        self.each_contact(open, |a, b| {
            found = Collision::Pair(a, b);
            false
        });
        found
    }

    /// All pairs of triangles that meet.
    pub fn all_contacts(&mut self, open: &mut Open<H::At>, found: &mut ContactList<'_>) {
        self.each_contact(open, |a, b| {
            found.push(a, b);
            true
        });
    }

    /// Visits every pair of triangles that meet, until the visitor says false.
    fn each_contact(&mut self, open: &mut Open<H::At>, mut visit: impl FnMut(u32, u32) -> bool) {
        let slack = self.relative.slack;
        let open = &mut open.overlapping;
        open.clear();
        self.work.bv_tests(1);
        let (a, b) = (self.a.root(), self.b.root());
        if !self.a.volume(&a).apart(&self.b.volume(&b).place(&self.shared), &self.shared, slack) {
            open.push((a, b));
        }
        while let Some(pair) = open.pop() {
            let opened = self.open(&pair, |child, a, b, shared| {
                if !a.apart(b, shared, slack) {
                    open.push(child);
                }
            });
            if !opened {
                let (triangles, ids) = self.leaves(&pair);
                self.work.primitive_test(ids[0], ids[1]);
                if meet(&triangles[0], &triangles[1]) && !visit(ids[0], ids[1]) {
                    return;
                }
            }
        }
    }

    /// Opens the larger volume of a pair, a leaf never, and calls `test` for both new pairs. False for two leaves.
    #[inline(always)]
    pub(crate) fn open(
        &mut self,
        pair: &Pair<H::At>,
        mut test: impl FnMut(Pair<H::At>, &H::Volume, &<H::Volume as Volume>::Placed, &<H::Volume as Volume>::Shared),
    ) -> bool {
        let (a, b, shared) = (self.a.volume(&pair.0), self.b.volume(&pair.1), &self.shared);
        let (leaf_a, leaf_b) = (self.a.is_leaf(&pair.0), self.b.is_leaf(&pair.1));
        if !leaf_a && (leaf_b || a.size() >= b.size()) {
            let placed = b.place(shared);
            for child in self.a.children(&pair.0) {
                test((child, pair.1), self.a.volume(&child), &placed, shared);
            }
        } else if !leaf_b {
            for child in self.b.children(&pair.1) {
                test((pair.0, child), a, &self.b.volume(&child).place(shared), shared);
            }
        } else {
            return false;
        }
        self.work.bv_tests(2);
        true
    }

    /// The triangles of two leaves in the frame of the query, and their ids.
    #[inline(always)]
    pub(crate) fn leaves(&self, pair: &Pair<H::At>) -> ([Triangle; 2], [u32; 2]) {
        let (i, j) = (self.a.triangle(&pair.0), self.b.triangle(&pair.1));
        let (of_a, of_b) = (self.a.leaves(), self.b.leaves());
        let triangles = [self.frame.place_a(&of_a.triangles[i]), self.frame.place_b(&of_b.triangles[j])];
        (triangles, [of_a.ids[i], of_b.ids[j]])
    }
}
