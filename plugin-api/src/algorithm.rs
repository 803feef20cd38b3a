//! What the author of a Rust plugin implements: [`Algorithm`] with two functions, and a trait per extension.

use core::ffi::CStr;

use crate::count::Count;
use crate::raw;

/// Who made an algorithm. C string literals (`c"box-tree"`), because the C side reads them as they are.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// Unique and stable: a-z 0-9 - . _ beginning with a letter.
    pub id: &'static CStr,
    /// Name for people.
    pub name: &'static CStr,
    /// Version of the algorithm; a new version is a new competitor.
    pub version: &'static CStr,
    /// Authors, separated by commas.
    pub authors: &'static CStr,
    /// SPDX licence expression.
    pub license: &'static CStr,
    /// Home page or source.
    pub url: &'static CStr,
    /// The paper that the method comes from.
    pub paper: &'static CStr,
    /// What the host has to know before it asks; nothing for most.
    pub capabilities: &'static [Capability],
}

/// What an algorithm declares beside its extensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Capability {
    /// It computes in 32-bit floating point somewhere between pose and answer, and is judged so.
    SinglePrecision = raw::CAPABILITY_SINGLE_PRECISION,
    /// Earlier queries speed up later ones (temporal coherence): their order matters.
    Coherent = raw::CAPABILITY_COHERENT,
    /// It answers for solid bodies, too: [`Algorithm::inside`].
    Solid = raw::CAPABILITY_SOLID,
    /// It can use several threads, in the multi-threaded track.
    Threads = raw::CAPABILITY_THREADS,
}

/// A kind of query, for [`Algorithm::answers`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Query {
    /// [`Distance::distance`].
    Distance,
    /// [`Contacts::contacts`].
    Contacts,
}

impl About {
    /// Nothing said but a version; set the rest with `..About::new()`.
    pub const fn new() -> Self {
        Self {
            id: c"",
            name: c"",
            version: c"0.1.0",
            authors: c"",
            license: c"",
            url: c"",
            paper: c"",
            capabilities: &[],
        }
    }
}

impl Default for About {
    fn default() -> Self {
        Self::new()
    }
}

/// A collision detection algorithm. A value of the type is one run: its parameters and its scratch memory.
///
/// Everything is called from one thread. A panic is caught and ends the run with an error; prefer [`Refusal`].
pub trait Algorithm: Default + 'static {
    /// Who made it.
    const ABOUT: About;
    /// One mesh, as the algorithm keeps it for the queries.
    type Object: 'static;

    /// Builds an object; timed as the build.
    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Self::Object>;

    /// Do the surfaces of a and b meet? Stops at the first pair. Touching counts.
    ///
    /// `a` and `b` may be one and the same object in two poses. Work is reported to `work`, which costs nothing in
    /// timed passes; an algorithm that does not count ignores it (and does not name `counts` in `export!`).
    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision>;

    /// For solid bodies, when the surfaces do not meet: is a part of one object inside the other? Both are closed. Asked
    /// only of algorithms that declare [`Capability::Solid`], as the second half of a collision or distance query.
    fn inside(&mut self, _a: Placed<'_, Self>, _b: Placed<'_, Self>, _work: &mut impl Count) -> Answer<bool> {
        Err(Refusal::Unsupported)
    }

    /// Does it answer this kind of query with the parameters that are set? What it says no to is not asked. Only kinds that
    /// are exported are asked for.
    fn answers(&self, _query: Query) -> bool {
        true
    }
}

/// `ocb.distance/1`.
pub trait Distance: Algorithm {
    /// How far apart are the surfaces, and where? 0 when they meet.
    fn distance(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation>;
}

/// `ocb.contacts/1`.
pub trait Contacts: Algorithm {
    /// Which pairs of triangles meet? Each pair is pushed once.
    fn contacts(
        &mut self,
        a: Placed<'_, Self>,
        b: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()>;
}

/// `ocb.parameters/1`.
pub trait Parameters: Algorithm {
    /// The knobs; at most 64.
    const PARAMETERS: &'static [&'static Parameter];

    /// Sets one, before the first mesh is loaded. Name, type and range have been checked by the host.
    fn set(&mut self, name: &str, value: f64) -> Answer<()>;
}

/// `ocb.scene/1`: the author's promise that [`Algorithm::load_mesh`] may be called for any number of objects and that the queries
/// may be about any two of them, in any order of pairs.
pub trait Scene: Algorithm {}

/// What a function answers.
pub type Answer<T> = Result<T, Refusal>;

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The algorithm could not decide; counted, not an error.
    GaveUp,
    /// The algorithm does not answer this question, or not for this mesh.
    Unsupported,
    /// Something is broken, in one sentence; ends the run.
    Error(String),
}

/// A triangle mesh as the host passes it: a polygon soup, borrowed for the call.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Vertices, finite, in the object's frame and in the length unit of the mesh file.
    pub positions: &'a [[f64; 3]],
    /// Vertex numbers of each triangle, all within `positions`. A triangle's id is its place here.
    pub triangles: &'a [[u32; 3]],
}

impl Mesh<'_> {
    /// The corners of a triangle, object frame.
    pub fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }
}

/// A rigid placement: object frame to world frame, row-major 4x4 as in plugin.h.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Pose(pub [f64; 16]);

impl Pose {
    /// The object where its file puts it.
    pub const IDENTITY: Self = Self([1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);

    /// Rows of the rotation.
    pub fn rotation(&self) -> [[f64; 3]; 3] {
        let m = &self.0;
        [[m[0], m[1], m[2]], [m[4], m[5], m[6]], [m[8], m[9], m[10]]]
    }

    /// Translation.
    pub fn translation(&self) -> [f64; 3] {
        [self.0[3], self.0[7], self.0[11]]
    }
}

/// An object where a query puts it.
#[derive(Debug)]
pub struct Placed<'a, A: Algorithm> {
    /// The object.
    pub object: &'a A::Object,
    /// Where.
    pub pose: &'a Pose,
}

impl<A: Algorithm> Clone for Placed<'_, A> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Algorithm> Copy for Placed<'_, A> {}

/// The answer of [`Algorithm::collide`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Collision {
    /// The surfaces have no point in common.
    Apart,
    /// These triangles, one of A and one of B, have a point in common.
    Pair(u32, u32),
    /// The surfaces meet; the algorithm does not know where.
    Somewhere,
}

/// The answer of [`Distance::distance`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// Minimum distance, 0 when the surfaces meet.
    pub distance: f64,
    /// Witness points on A and on B, world frame; a common point twice when the surfaces meet.
    pub points: Option<[[f64; 3]; 2]>,
    /// The triangles of A and of B that hold them.
    pub triangles: Option<[u32; 2]>,
}

/// Where [`Contacts::contacts`] puts what it finds: the host's buffer. Pairs beyond its end are counted only.
#[derive(Debug)]
pub struct ContactList<'a> {
    buffer: &'a mut [core::mem::MaybeUninit<raw::contacts::Contact>],
    total: u64,
}

impl<'a> ContactList<'a> {
    /// An empty list in a buffer.
    pub fn new(buffer: &'a mut [core::mem::MaybeUninit<raw::contacts::Contact>]) -> Self {
        Self { buffer, total: 0 }
    }

    /// Adds the pair of triangle `a` of A and triangle `b` of B.
    #[inline]
    pub fn push(&mut self, a: u32, b: u32) {
        if let Some(place) = self.buffer.get_mut(self.total as usize) {
            place.write(raw::contacts::Contact { a, b });
        }
        self.total += 1;
    }

    /// How many were pushed.
    pub fn total(&self) -> u64 {
        self.total
    }
}

/// A knob.
#[repr(transparent)]
pub struct Parameter(raw::parameters::Parameter);

impl Parameter {
    /// A whole number.
    pub const fn integer(
        name: &'static CStr,
        description: &'static CStr,
        minimum: i32,
        maximum: i32,
        default: i32,
    ) -> Self {
        let kind = raw::parameters::INTEGER;
        Self::new(kind, name, description, [minimum as f64, maximum as f64, default as f64])
    }

    /// A real number.
    pub const fn real(
        name: &'static CStr,
        description: &'static CStr,
        minimum: f64,
        maximum: f64,
        default: f64,
    ) -> Self {
        Self::new(raw::parameters::REAL, name, description, [minimum, maximum, default])
    }

    const fn new(
        kind: u32,
        name: &'static CStr,
        description: &'static CStr,
        [minimum, maximum, default_value]: [f64; 3],
    ) -> Self {
        assert!(minimum <= default_value && default_value <= maximum, "the default must lie in the range");
        Self(raw::parameters::Parameter {
            struct_size: size_of::<raw::parameters::Parameter>() as u32,
            kind,
            name: name.as_ptr(),
            description: description.as_ptr(),
            minimum,
            maximum,
            default_value,
        })
    }
}
