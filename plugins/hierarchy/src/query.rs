//! Both trees at once: from the pair of roots down to pairs of leaves.

use ocb_triangles::{Frame, meet};
use opencollbench_plugin::{Collision, ContactList, Count, Pose};

use crate::nearest::Pending;
use crate::{Node, Relative, Tree, Volume};

/// Pairs of volumes that are still to be opened; memory that is kept from query to query.
#[derive(Debug, Default)]
pub struct Open {
    /// Nodes of A and B that are not apart; the next one last.
    overlapping: Vec<[u32; 2]>,
    pub(crate) pending: Pending,
}

/// One query.
pub struct Query<'a, V: Volume, C> {
    pub(crate) a: &'a Tree<V>,
    pub(crate) b: &'a Tree<V>,
    pub(crate) frame: Frame,
    pub(crate) relative: Relative,
    pub(crate) shared: V::Shared,
    pub(crate) work: &'a mut C,
}

impl<'a, V: Volume, C: Count> Query<'a, V, C> {
    /// Two objects in their poses.
    pub fn new([a, b]: [&'a Tree<V>; 2], [pose_a, pose_b]: [&Pose; 2], work: &'a mut C) -> Self {
        let frame = Frame::new(pose_a.rotation(), pose_a.translation(), pose_b.rotation(), pose_b.translation());
        let relative = Relative::new(&frame, a.radius, b.radius);
        Self { a, b, frame, relative, shared: V::share(&relative), work }
    }

    /// Any pair of triangles that meet.
    pub fn first_contact(&mut self, open: &mut Open) -> Collision {
        let mut found = Collision::Apart;
        self.each_contact(open, |a, b| {
            found = Collision::Pair(a, b);
            false
        });
        found
    }

    /// All pairs of triangles that meet.
    pub fn all_contacts(&mut self, open: &mut Open, found: &mut ContactList<'_>) {
        self.each_contact(open, |a, b| {
            found.push(a, b);
            true
        });
    }

    /// Visits every pair of triangles that meet, until the visitor says false.
    fn each_contact(&mut self, open: &mut Open, mut visit: impl FnMut(u32, u32) -> bool) {
        let slack = self.relative.slack;
        let open = &mut open.overlapping;
        open.clear();
        self.work.bv_tests(1);
        let (a, b) = (&self.a.nodes[0].volume, self.b.nodes[0].volume.place(&self.shared));
        if !a.apart(&b, &self.shared, slack) {
            open.push([0, 0]);
        }
        while let Some(pair) = open.pop() {
            let opened = self.open(pair, |child, a, b, shared| {
                if !a.apart(b, shared, slack) {
                    open.push(child);
                }
            });
            if !opened && !self.contact_of_leaves(pair, &mut visit) {
                return;
            }
        }
    }

    fn contact_of_leaves(&mut self, pair: [u32; 2], visit: &mut impl FnMut(u32, u32) -> bool) -> bool {
        let [i, j] = self.triangles(pair);
        let (a, b) = (self.frame.place_a(&self.a.triangles[i]), self.frame.place_b(&self.b.triangles[j]));
        let (id_a, id_b) = (self.a.ids[i], self.b.ids[j]);
        self.work.primitive_test(id_a, id_b);
        !meet(&a, &b) || visit(id_a, id_b)
    }

    /// Opens the larger volume of a pair, a leaf never, and calls `test` for both new pairs. False for two leaves.
    #[inline(always)]
    pub(crate) fn open(&mut self, pair: [u32; 2], mut test: impl FnMut([u32; 2], &V, &V::Placed, &V::Shared)) -> bool {
        let (a, b) = (self.node(self.a, pair[0]), self.node(self.b, pair[1]));
        let shared = &self.shared;
        if !a.leaf && (b.leaf || a.volume.size() >= b.volume.size()) {
            let placed = b.volume.place(shared);
            for child in [a.first, a.first + 1] {
                test([child, pair[1]], &self.node(self.a, child).volume, &placed, shared);
            }
        } else if !b.leaf {
            for child in [b.first, b.first + 1] {
                test([pair[0], child], &a.volume, &self.node(self.b, child).volume.place(shared), shared);
            }
        } else {
            return false;
        }
        self.work.bv_tests(2);
        true
    }

    #[inline(always)]
    fn node(&self, tree: &'a Tree<V>, at: u32) -> &'a Node<V> {
        &tree.nodes[at as usize]
    }

    /// Where the triangles of two leaves stand.
    #[inline(always)]
    pub(crate) fn triangles(&self, pair: [u32; 2]) -> [usize; 2] {
        [self.node(self.a, pair[0]).first as usize, self.node(self.b, pair[1]).first as usize]
    }
}
