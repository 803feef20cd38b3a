//! An algorithm with its objects, ready for queries.

use opencollbench_plugin::{
    Algorithm, Collision, ContactList, Contacts, Count, Distance, Placed, Pose, Separation, Uncounted, raw,
};

use super::Soup;

/// One object against itself, or two objects.
pub struct Loaded<A: Algorithm> {
    pub algorithm: A,
    pub a: A::Object,
    /// None: A itself.
    b: Option<A::Object>,
}

impl<A: Algorithm> Loaded<A> {
    pub fn new(soup: &Soup) -> Self {
        Self::with(A::default(), soup)
    }

    pub fn with(mut algorithm: A, soup: &Soup) -> Self {
        let a = algorithm.load_mesh(soup.view()).expect("the mesh loads");
        Self { algorithm, a, b: None }
    }

    pub fn two(algorithm: A, a: &Soup, b: &Soup) -> Self {
        let mut one = Self::with(algorithm, a);
        one.b = Some(one.algorithm.load_mesh(b.view()).expect("the mesh loads"));
        one
    }

    pub fn collide(&mut self, pose_a: &Pose, pose_b: &Pose) -> Collision {
        self.collide_counting(pose_a, pose_b, &mut Uncounted)
    }

    pub fn collide_counting(&mut self, pose_a: &Pose, pose_b: &Pose, work: &mut impl Count) -> Collision {
        let b = self.b.as_ref().unwrap_or(&self.a);
        let (a, b) = (Placed { object: &self.a, pose: pose_a }, Placed { object: b, pose: pose_b });
        self.algorithm.collide(a, b, work).expect("an answer")
    }
}

impl<A: Distance> Loaded<A> {
    pub fn distance(&mut self, pose_a: &Pose, pose_b: &Pose) -> Separation {
        self.distance_counting(pose_a, pose_b, &mut Uncounted)
    }

    pub fn distance_counting(&mut self, pose_a: &Pose, pose_b: &Pose, work: &mut impl Count) -> Separation {
        let b = self.b.as_ref().unwrap_or(&self.a);
        let (a, b) = (Placed { object: &self.a, pose: pose_a }, Placed { object: b, pose: pose_b });
        self.algorithm.distance(a, b, work).expect("an answer")
    }
}

impl<A: Contacts> Loaded<A> {
    pub fn contacts_into(&mut self, pose_a: &Pose, pose_b: &Pose, found: &mut ContactList<'_>) {
        let b = self.b.as_ref().unwrap_or(&self.a);
        let (a, b) = (Placed { object: &self.a, pose: pose_a }, Placed { object: b, pose: pose_b });
        self.algorithm.contacts(a, b, found, &mut Uncounted).expect("an answer");
    }

    /// All contacts in ascending order.
    pub fn contacts(&mut self, pose_a: &Pose, pose_b: &Pose) -> Vec<(u32, u32)> {
        let mut room: Vec<raw::contacts::Contact> = Vec::with_capacity(1 << 17);
        let mut found = ContactList::new(room.spare_capacity_mut());
        self.contacts_into(pose_a, pose_b, &mut found);
        let total = found.total() as usize;
        assert!(total <= room.capacity(), "{total} contacts");
        // SAFETY: the list has written its first `total` places.
        unsafe { room.set_len(total) };
        let mut pairs: Vec<(u32, u32)> = room.iter().map(|contact| (contact.a, contact.b)).collect();
        pairs.sort_unstable();
        pairs
    }
}
