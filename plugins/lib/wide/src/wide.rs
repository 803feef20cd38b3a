//! The plugin around a wide hierarchy.

use core::fmt;

use ocb_lanes::Path;
use ocb_triangles::Frame;
use opencollbench_plugin::{
    About, Algorithm, Answer, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter, Parameters, Placed,
    Refusal, Scene, Separation,
};

/// A method: its own settings, and what it does with them. Its queries are not generic: many registers wide and with and
/// without counting, they take long to compile, which is done once for all plugins and tests.
pub trait Method: Default + 'static {
    /// Who made it.
    const ABOUT: About;
    /// [`WIDTH`], and what [`Method::set`] knows.
    const PARAMETERS: &'static [&'static Parameter];
    /// A mesh as the method keeps it.
    type Tree: 'static;
    /// What is still to be done, kept from query to query for its memory.
    type Open: Default;

    /// The tree of a mesh that has triangles.
    fn build(&self, mesh: &Mesh<'_>) -> Self::Tree;

    /// Sets one of its own parameters.
    fn set(&mut self, _name: &str, _value: f64) -> Answer<()> {
        Err(Refusal::Unsupported)
    }

    /// Visits pairs of triangles that meet, until the visitor says false.
    fn each_contact(
        path: Path,
        pair: &Pair<'_, Self::Tree>,
        open: &mut Self::Open,
        listener: Option<&mut dyn Count>,
        visit: &mut dyn FnMut(u32, u32) -> bool,
    );

    /// The closest pair of points.
    fn nearest(
        path: Path,
        pair: &Pair<'_, Self::Tree>,
        open: &mut Self::Open,
        listener: Option<&mut dyn Count>,
    ) -> Separation;
}

/// Two objects in one query.
#[derive(Debug)]
pub struct Pair<'a, T> {
    /// Object A.
    pub a: &'a T,
    /// Object B.
    pub b: &'a T,
    /// Both in their poses.
    pub frame: Frame,
}

impl<'a, T> Pair<'a, T> {
    fn new<M: Method<Tree = T>>(a: Placed<'a, Wide<M>>, b: Placed<'a, Wide<M>>) -> Self {
        let frame = Frame::new(a.pose.rotation(), a.pose.translation(), b.pose.rotation(), b.pose.translation());
        Self { a: a.object, b: b.object, frame }
    }
}

/// A method as an algorithm: collision, all contacts and distance, exact.
pub struct Wide<M: Method> {
    path: Path,
    method: M,
    open: M::Open,
}

const LANES: i32 = 16;

/// The parameter that every method has.
pub const WIDTH: Parameter =
    Parameter::integer(c"width", c"Most numbers in a register: 16 (AVX-512), 8 (AVX2) or 1", 1, LANES, LANES);

impl<M: Method> Default for Wide<M> {
    fn default() -> Self {
        Self { path: Path::widest(LANES as usize), method: M::default(), open: M::Open::default() }
    }
}

impl<M: Method> fmt::Debug for Wide<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {:?}", M::ABOUT.id, self.path)
    }
}

impl<M: Method> Algorithm for Wide<M> {
    const ABOUT: About = M::ABOUT;

    type Object = M::Tree;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<M::Tree> {
        if mesh.triangles.is_empty() { Err(Refusal::Unsupported) } else { Ok(self.method.build(&mesh)) }
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        let mut found = Collision::Apart;
        M::each_contact(self.path, &Pair::new(a, b), &mut self.open, work.listener(), &mut |a, b| {
            found = Collision::Pair(a, b);
            false
        });
        Ok(found)
    }
}

impl<M: Method> Contacts for Wide<M> {
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        M::each_contact(self.path, &Pair::new(a, b), &mut self.open, work.listener(), &mut |a, b| {
            found.push(a, b);
            true
        });
        Ok(())
    }
}

impl<M: Method> Distance for Wide<M> {
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        Ok(M::nearest(self.path, &Pair::new(a, b), &mut self.open, work.listener()))
    }
}

/// A tree knows nothing of other objects.
impl<M: Method> Scene for Wide<M> {}

impl<M: Method> Parameters for Wide<M> {
    const PARAMETERS: &'static [&'static Parameter] = M::PARAMETERS;

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name == "width" {
            self.path = Path::widest(value as usize);
            return Ok(());
        }
        self.method.set(name, value)
    }
}
