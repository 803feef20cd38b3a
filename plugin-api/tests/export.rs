//! The C side of an exported Rust algorithm: refusals, panics, counters, contacts beyond the buffer, parameters.

use std::ffi::{CStr, c_char, c_void};
use std::ptr::null_mut;

use opencollbench_plugin::{
    About, Algorithm, Answer, Capability, Collision, ContactList, Contacts, Count, Distance, Mesh, Parameter,
    Parameters, Placed, Query, Refusal, Scene, Separation, raw,
};

/// Answers by the x of the second pose: 0 yes, 1 no, 2 panic, 3 gave up, 4 unsupported, 5 error.
#[derive(Default)]
struct Whimsical {
    level: f64,
}

opencollbench_plugin::export!(Whimsical: distance contacts counts parameters scene);

impl Algorithm for Whimsical {
    const ABOUT: About =
        About { id: c"whimsical", name: c"Whimsical", capabilities: &[Capability::Coherent], ..About::new() };
    type Object = usize;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<usize> {
        if mesh.triangles.len() == 3 {
            Err(Refusal::Error("three is\0unlucky".into()))
        } else {
            Ok(mesh.positions.len())
        }
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, work: &mut impl Count) -> Answer<Collision> {
        assert_eq!((*a.object, *b.object), (4, 4));
        work.bv_tests(7);
        work.primitive_test(0, 1);
        work.primitive_test(1, 1);
        match b.pose.0[3] {
            0.0 => Ok(Collision::Pair(1, 0)),
            1.0 => Ok(Collision::Apart),
            2.0 => panic!("at level {}", self.level),
            3.0 => Err(Refusal::GaveUp),
            4.0 => Err(Refusal::Unsupported),
            _ => Err(Refusal::Error("out of luck".into())),
        }
    }

    fn answers(&self, query: Query) -> bool {
        assert!(self.level < 2.0, "at level 2 it does not even say that");
        query == Query::Distance || self.level != 1.5
    }
}

impl Distance for Whimsical {
    fn distance(&mut self, _: Placed<'_, Self>, _: Placed<'_, Self>, work: &mut impl Count) -> Answer<Separation> {
        work.bv_tests(1);
        Ok(Separation { distance: 0.5, points: None, triangles: Some([1, 0]) })
    }
}

impl Contacts for Whimsical {
    fn contacts(
        &mut self,
        _: Placed<'_, Self>,
        _: Placed<'_, Self>,
        found: &mut ContactList<'_>,
        work: &mut impl Count,
    ) -> Answer<()> {
        assert!(work.is_counting() == (self.level == 2.0));
        (0..5).for_each(|i| found.push(i, i + 10));
        Ok(())
    }
}

impl Scene for Whimsical {}

impl Parameters for Whimsical {
    const PARAMETERS: &'static [&'static Parameter] = &[
        &Parameter::real(c"level", c"How whimsical", 0.0, 2.0, 1.0),
        &Parameter::integer(c"times", c"How often", 1, 9, 3),
    ];

    fn set(&mut self, name: &str, value: f64) -> Answer<()> {
        if name != "level" {
            return Err(Refusal::Unsupported);
        }
        self.level = value;
        Ok(())
    }
}

/// One run of the algorithm through its C table.
struct Run {
    algorithm: &'static raw::Algorithm,
    instance: *mut raw::Instance,
    object: *mut raw::Object,
}

static HOST: raw::Host = raw::Host { struct_size: size_of::<raw::Host>() as u32, abi_minor: 0, get_extension: None };
const POSITIONS: [f64; 12] = [0.0; 12];
const TRIANGLES: [u32; 9] = [0, 1, 2, 1, 2, 3, 0, 1, 3];

impl Run {
    fn new() -> Self {
        // SAFETY: our own descriptor, called in the order of plugin.h.
        unsafe {
            let algorithm = &**(*ocb_entry_v1(raw::ABI_MAJOR)).algorithms;
            let (mut instance, mut object) = (null_mut(), null_mut());
            assert_eq!(algorithm.create.unwrap()(&HOST, &mut instance), raw::OK);
            let load = algorithm.load_mesh.unwrap();
            assert_eq!(load(instance, POSITIONS.as_ptr(), 4, TRIANGLES.as_ptr(), 2, &mut object), raw::OK);
            Self { algorithm, instance, object }
        }
    }

    fn extension(&self, id: &CStr) -> *const c_void {
        // SAFETY: an instance of ours and a C string.
        unsafe { self.algorithm.get_extension.unwrap()(self.instance, id.as_ptr()) }
    }

    fn set_level(&self, level: f64) {
        let table: &raw::parameters::Parameters = self.table(raw::parameters::ID);
        // SAFETY: an instance of ours and a C string.
        assert_eq!(unsafe { table.set.unwrap()(self.instance, c"level".as_ptr(), level) }, raw::OK);
    }

    fn table<T>(&self, id: &CStr) -> &'static T {
        // SAFETY: the id says what the table is.
        unsafe { &*self.extension(id).cast::<T>() }
    }

    fn collide(&self, x: f64) -> (raw::Status, raw::CollideResult) {
        let (mut pose, mut result) = (opencollbench_plugin::Pose::IDENTITY, raw::CollideResult::new());
        pose.0[3] = x;
        let (request, pose) = (raw::CollideRequest::new(0, null_mut()), pose.0.as_ptr());
        let collide = self.algorithm.collide.unwrap();
        // SAFETY: instance and object are the algorithm's own.
        let status = unsafe { collide(self.instance, self.object, pose, self.object, pose, &request, &mut result) };
        (status, result)
    }

    fn message(&self) -> String {
        // SAFETY: as for `collide`; the message is a C string.
        unsafe {
            let message: *const c_char = self.algorithm.error_message.unwrap()(self.instance);
            CStr::from_ptr(message).to_str().unwrap().to_owned()
        }
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        // SAFETY: given back once.
        unsafe {
            self.algorithm.free_mesh.unwrap()(self.instance, self.object);
            self.algorithm.destroy.unwrap()(self.instance);
        }
    }
}

#[test]
fn answers_cross_the_border() {
    let run = Run::new();
    let (status, hit) = run.collide(0.0);
    assert_eq!((status, hit.hit, hit.triangle_a, hit.triangle_b), (raw::OK, 1, 1, 0));
    let (status, miss) = run.collide(1.0);
    assert_eq!((status, miss.hit, miss.triangle_a, miss.triangle_b), (raw::OK, 0, raw::NO_TRIANGLE, raw::NO_TRIANGLE));
    assert_eq!(run.algorithm.capabilities, raw::CAPABILITY_COHERENT | raw::CAPABILITY_COUNTS);
}

#[test]
fn refusals_and_panics_are_statuses() {
    let run = Run::new();
    assert_eq!(run.collide(3.0).0, raw::GAVE_UP);
    assert_eq!(run.collide(4.0).0, raw::UNSUPPORTED);
    assert_eq!(run.collide(5.0).0, raw::ERROR);
    assert_eq!(run.message(), "out of luck");
    assert_eq!(run.collide(2.0).0, raw::ERROR);
    assert_eq!(run.message(), "the plugin panicked: at level 0");
    assert_eq!(run.collide(1.0).0, raw::OK, "a run goes on after a panic, if the host wants it");
}

#[test]
fn a_mesh_that_is_refused_makes_no_object() {
    let (run, mut object) = (Run::new(), null_mut());
    let load = run.algorithm.load_mesh.unwrap();
    // SAFETY: arrays of the lengths that are said.
    let status = unsafe { load(run.instance, POSITIONS.as_ptr(), 4, TRIANGLES.as_ptr(), 3, &mut object) };
    assert_eq!((status, object), (raw::ERROR, null_mut()));
    assert_eq!(run.message(), "three is unlucky");
}

#[test]
fn work_is_counted_when_it_is_asked_for() {
    let run = Run::new();
    assert_eq!(run.algorithm.capabilities, raw::CAPABILITY_COHERENT | raw::CAPABILITY_COUNTS);
    // The arrays sum over queries.
    let (mut tests_a, mut tests_b) = ([0u32; 2], [10u32; 2]);
    let mut counts = raw::Counts::new(tests_a.as_mut_ptr(), tests_b.as_mut_ptr());
    let (request, mut result) = (raw::CollideRequest::new(0, &raw mut counts), raw::CollideResult::new());
    let pose = opencollbench_plugin::Pose::IDENTITY.0.as_ptr();
    let collide = run.algorithm.collide.unwrap();
    // SAFETY: the arrays have one entry per triangle.
    let status = unsafe { collide(run.instance, run.object, pose, run.object, pose, &request, &mut result) };
    assert_eq!((status, result.hit), (raw::OK, 1));
    assert_eq!((counts.bv_tests, counts.primitive_tests, counts.flags), (7, 2, 7));
    assert_eq!((tests_a, tests_b), ([1, 1], [10, 12]));
}

#[test]
fn an_instance_offers_what_its_parameters_allow() {
    let run = Run::new();
    let offered = || [raw::distance::ID, raw::contacts::ID].map(|id| !run.extension(id).is_null());
    assert_eq!(offered(), [true, true]);
    run.set_level(1.5);
    assert_eq!(offered(), [true, false]);
    run.set_level(2.0);
    assert_eq!(offered(), [false, false], "a panic there is a no");
}

#[test]
fn contacts_beyond_the_buffer_are_counted() {
    let run = Run::new();
    let table: &raw::contacts::Contacts = run.table(raw::contacts::ID);
    let mut room = [raw::contacts::Contact::default(); 4];
    let request = raw::contacts::ContactsRequest::new(room.as_mut_ptr(), 3, null_mut());
    let mut result = raw::contacts::ContactsResult::new();
    let pose = opencollbench_plugin::Pose::IDENTITY.0.as_ptr();
    let contacts = table.contacts.unwrap();
    // SAFETY: the request has the room that it says.
    let status = unsafe { contacts(run.instance, run.object, pose, run.object, pose, &request, &mut result) };
    assert_eq!((status, result.total), (raw::OK, 5));
    assert_eq!(room.map(|c| (c.a, c.b)), [(0, 10), (1, 11), (2, 12), (0, 0)]);
}

#[test]
fn distance_flags_what_it_has() {
    let run = Run::new();
    let table: &raw::distance::Distance = run.table(raw::distance::ID);
    let (request, mut result) =
        (raw::distance::DistanceRequest::new(0, null_mut()), raw::distance::DistanceResult::new());
    let pose = opencollbench_plugin::Pose::IDENTITY.0.as_ptr();
    let distance = table.distance.unwrap();
    // SAFETY: as in the other tests.
    let status = unsafe { distance(run.instance, run.object, pose, run.object, pose, &request, &mut result) };
    assert_eq!((status, result.distance, result.flags), (raw::OK, 0.5, raw::distance::HAS_TRIANGLES));
    assert_eq!((result.triangle_a, result.triangle_b), (1, 0));
}

#[test]
fn parameters_are_listed_and_set() {
    let run = Run::new();
    let table: &raw::parameters::Parameters = run.table(raw::parameters::ID);
    assert_eq!(table.parameter_count, 2);
    // SAFETY: the table is ours.
    unsafe {
        let [level, times] = [0, 1].map(|i| &**table.parameters.add(i));
        assert_eq!(CStr::from_ptr(level.name), c"level");
        assert_eq!((level.kind, level.minimum, level.maximum, level.default_value), (1, 0.0, 2.0, 1.0));
        assert_eq!((times.kind, times.minimum, times.maximum, times.default_value), (2, 1.0, 9.0, 3.0));
        let set = table.set.unwrap();
        assert_eq!(set(run.instance, c"level".as_ptr(), 2.0), raw::OK);
        assert_eq!(set(run.instance, c"nonsense".as_ptr(), 2.0), raw::UNSUPPORTED);
    }
    run.collide(2.0);
    assert_eq!(run.message(), "the plugin panicked: at level 2");
}

#[test]
fn a_scene_is_offered_by_its_table_alone() {
    let table: &raw::scene::Scene = Run::new().table(raw::scene::ID);
    assert_eq!(table.struct_size as usize, size_of::<raw::scene::Scene>());
}

#[test]
fn unknown_extensions_are_null() {
    let get = Run::new().algorithm.get_extension.unwrap();
    // SAFETY: a C string, and null, which no host should pass.
    unsafe {
        assert!(get(null_mut(), c"ocb.distance/2".as_ptr()).is_null());
        assert!(get(null_mut(), std::ptr::null()).is_null());
        assert!(!get(null_mut(), raw::distance::ID.as_ptr()).is_null(), "asked before there is an instance");
    }
}

#[test]
fn a_host_of_another_abi_is_refused() {
    assert!(ocb_entry_v1(raw::ABI_MAJOR + 1).is_null());
}
