//! The C functions of an algorithm, generic over the author's type: pointers in, safe values to the author, status out.

use core::ffi::{CStr, c_char};
use core::mem::MaybeUninit;
use std::ffi::CString;
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::algorithm::{
    Algorithm, Answer, Collision, ContactList, Contacts, Distance, Mesh, Parameters, Placed, Pose, Query, Refusal,
    Separation,
};
use crate::count::{Count, Counts, Uncounted};
use crate::raw;
use crate::raw::contacts::{Contact, ContactsRequest, ContactsResult};
use crate::raw::distance::{DistanceRequest, DistanceResult};
use crate::raw::{CollideRequest, CollideResult, Host, Instance, Object, Status};

/// What an `ocb_instance` is here.
struct Running<A> {
    algorithm: A,
    /// Of the latest error.
    message: CString,
}

/// What an `ocb_object` is here.
struct Built<A: Algorithm> {
    object: A::Object,
    /// Length of the host's arrays of tests per triangle.
    triangle_count: u32,
}

/// Runs one piece of the author's code: panics and refusals become a status and a message.
///
/// # Safety
/// `instance` comes from [`create`] for the same `A` and is not in use elsewhere (one thread, plugin.h).
unsafe fn run<A: Algorithm>(instance: *mut Instance, question: impl FnOnce(&mut A) -> Answer<()>) -> Status {
    // SAFETY: by this function's contract.
    let running = unsafe { &mut *instance.cast::<Running<A>>() };
    let message = match catch_unwind(AssertUnwindSafe(|| question(&mut running.algorithm))) {
        Ok(Ok(())) => return raw::OK,
        Ok(Err(Refusal::GaveUp)) => return raw::GAVE_UP,
        Ok(Err(Refusal::Unsupported)) => return raw::UNSUPPORTED,
        Ok(Err(Refusal::Error(message))) => message,
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().copied();
            let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
            format!("the plugin panicked: {}", text.unwrap_or("no message"))
        }
    };
    running.message = CString::new(message.replace('\0', " ")).unwrap_or_default();
    raw::ERROR
}

pub unsafe extern "C" fn create<A: Algorithm>(_host: *const Host, instance: *mut *mut Instance) -> Status {
    match catch_unwind(A::default) {
        Ok(algorithm) => {
            let running = Box::new(Running { algorithm, message: CString::default() });
            // SAFETY: the host passes a place for the pointer.
            unsafe { *instance = Box::into_raw(running).cast() };
            raw::OK
        }
        Err(_) => raw::ERROR,
    }
}

pub unsafe extern "C" fn destroy<A: Algorithm>(instance: *mut Instance) {
    // SAFETY: the host gives back, once, what `create` made.
    let running = unsafe { Box::from_raw(instance.cast::<Running<A>>()) };
    // A panic in a drop must not cross into C, and nobody is left to hear of it.
    let _ = catch_unwind(AssertUnwindSafe(|| drop(running)));
}

pub unsafe extern "C" fn error_message<A: Algorithm>(instance: *mut Instance) -> *const c_char {
    if instance.is_null() {
        return c"the plugin panicked while making its instance".as_ptr();
    }
    // SAFETY: the host passes what `create` made.
    unsafe { &*instance.cast::<Running<A>>() }.message.as_ptr()
}

pub unsafe extern "C" fn set<A: Parameters>(instance: *mut Instance, name: *const c_char, value: f64) -> Status {
    // SAFETY: the host passes its instance and a C string.
    unsafe {
        let name = CStr::from_ptr(name).to_str();
        run::<A>(instance, |algorithm| algorithm.set(name.map_err(|_| Refusal::Unsupported)?, value))
    }
}

pub unsafe extern "C" fn load_mesh<A: Algorithm>(
    instance: *mut Instance,
    positions: *const f64,
    vertex_count: u32,
    triangles: *const u32,
    triangle_count: u32,
    object: *mut *mut Object,
) -> Status {
    // SAFETY: the host passes its instance, arrays of these lengths that live until we return, and a place for the
    // object.
    unsafe {
        let positions = core::slice::from_raw_parts(positions.cast::<[f64; 3]>(), vertex_count as usize);
        let triangles = core::slice::from_raw_parts(triangles.cast::<[u32; 3]>(), triangle_count as usize);
        run::<A>(instance, |algorithm| {
            let built = Built::<A> { object: algorithm.load_mesh(Mesh { positions, triangles })?, triangle_count };
            *object = Box::into_raw(Box::new(built)).cast();
            Ok(())
        })
    }
}

pub unsafe extern "C" fn free_mesh<A: Algorithm>(_instance: *mut Instance, object: *mut Object) {
    // SAFETY: the host gives back, once, what `load_mesh` made.
    let built = unsafe { Box::from_raw(object.cast::<Built<A>>()) };
    // A panic in a drop must not cross into C, and nobody is left to hear of it.
    let _ = catch_unwind(AssertUnwindSafe(|| drop(built)));
}

/// An object and its pose as the author sees them. Shared, because both objects of a query may be the same one.
///
/// # Safety
/// `object` comes from [`load_mesh`] for the same `A`, `pose` points to 16 numbers; both outlive `'a`.
unsafe fn placed<'a, A: Algorithm>(object: *mut Object, pose: *const f64) -> Placed<'a, A> {
    // SAFETY: by this function's contract; `Pose` is transparent over 16 numbers.
    unsafe { Placed { object: &(*object.cast::<Built<A>>()).object, pose: &*pose.cast::<Pose>() } }
}

/// Whether the algorithm answers a kind of query with the parameters that are set; without an instance, at all.
///
/// # Safety
/// `instance` is null or comes from [`create`] for the same `A`.
pub unsafe fn answers<A: Algorithm>(instance: *mut Instance, query: Query) -> bool {
    // SAFETY: by this function's contract.
    let Some(running) = (unsafe { instance.cast::<Running<A>>().as_ref() }) else { return true };
    catch_unwind(AssertUnwindSafe(|| running.algorithm.answers(query))).unwrap_or(false)
}

/// Query code for a request: compiled once without counting, and once with it.
macro_rules! counted {
    ($A:ty, $counts:expr, $objects:ident, |$work:ident| $query:expr) => {
        if $counts.is_null() {
            let $work = &mut Uncounted;
            $query
        } else {
            let mut counts = borrow_counts::<$A>($counts, $objects);
            let $work = &mut counts;
            let answer = $query;
            return_counts($counts, &counts);
            answer
        }
    };
}

pub unsafe extern "C" fn collide<A: Algorithm>(
    instance: *mut Instance,
    a: *mut Object,
    pose_a: *const f64,
    b: *mut Object,
    pose_b: *const f64,
    request: *const CollideRequest,
    result: *mut CollideResult,
) -> Status {
    // SAFETY: the host passes its instance, two objects of it, two poses, a request and a place for the result.
    unsafe {
        let (objects, a, b) = ([a, b], placed::<A>(a, pose_a), placed::<A>(b, pose_b));
        run::<A>(instance, |algorithm| {
            let answer =
                counted!(A, (*request).counts, objects, |work| collision(algorithm, a, b, (*request).flags, work));
            write_collision(&mut *result, answer?);
            Ok(())
        })
    }
}

pub unsafe extern "C" fn distance<A: Distance>(
    instance: *mut Instance,
    a: *mut Object,
    pose_a: *const f64,
    b: *mut Object,
    pose_b: *const f64,
    request: *const DistanceRequest,
    result: *mut DistanceResult,
) -> Status {
    // SAFETY: the host passes its instance, two objects of it, two poses, a request and a place for the result.
    unsafe {
        let (objects, a, b) = ([a, b], placed::<A>(a, pose_a), placed::<A>(b, pose_b));
        run::<A>(instance, |algorithm| {
            let answer =
                counted!(A, (*request).counts, objects, |work| separation(algorithm, a, b, (*request).flags, work));
            write_separation(&mut *result, &answer?);
            Ok(())
        })
    }
}

pub unsafe extern "C" fn contacts<A: Contacts>(
    instance: *mut Instance,
    a: *mut Object,
    pose_a: *const f64,
    b: *mut Object,
    pose_b: *const f64,
    request: *const ContactsRequest,
    result: *mut ContactsResult,
) -> Status {
    // SAFETY: the host passes its instance, two objects of it, two poses, a request with room as it says, and a place
    // for the result.
    unsafe {
        let (objects, a, b) = ([a, b], placed::<A>(a, pose_a), placed::<A>(b, pose_b));
        let mut found = ContactList::new(borrow_room(&*request));
        let status = run::<A>(instance, |algorithm| {
            counted!(A, (*request).counts, objects, |work| algorithm.contacts(a, b, &mut found, work))
        });
        (*result).total = found.total();
        status
    }
}

/// The answer for the surfaces, or for solid bodies.
fn collision<A: Algorithm>(
    algorithm: &mut A,
    a: Placed<'_, A>,
    b: Placed<'_, A>,
    flags: u32,
    work: &mut impl Count,
) -> Answer<Collision> {
    let surfaces = algorithm.collide(a, b, work)?;
    let apart = surfaces == Collision::Apart && flags & raw::REQUEST_SOLID != 0;
    Ok(if apart && algorithm.inside(a, b, work)? { Collision::Somewhere } else { surfaces })
}

/// The same for the distance.
fn separation<A: Distance>(
    algorithm: &mut A,
    a: Placed<'_, A>,
    b: Placed<'_, A>,
    flags: u32,
    work: &mut impl Count,
) -> Answer<Separation> {
    let surfaces = algorithm.distance(a, b, work)?;
    let apart = surfaces.distance > 0.0 && flags & raw::REQUEST_SOLID != 0;
    let inside = apart && algorithm.inside(a, b, work)?;
    Ok(if inside { Separation { distance: 0.0, points: None, triangles: None } } else { surfaces })
}

fn write_collision(result: &mut CollideResult, answer: Collision) {
    result.hit = u32::from(answer != Collision::Apart);
    if let Collision::Pair(a, b) = answer {
        (result.triangle_a, result.triangle_b) = (a, b);
    }
}

fn write_separation(result: &mut DistanceResult, answer: &Separation) {
    result.distance = answer.distance;
    if let Some([a, b]) = answer.points {
        result.flags |= raw::distance::HAS_POINTS;
        (result.point_a, result.point_b) = (a, b);
    }
    if let Some([a, b]) = answer.triangles {
        result.flags |= raw::distance::HAS_TRIANGLES;
        (result.triangle_a, result.triangle_b) = (a, b);
    }
}

/// The host's buffer for contacts.
///
/// # Safety
/// The request is as plugin.h wants it, for as long as `'a`.
unsafe fn borrow_room<'a>(request: &ContactsRequest) -> &'a mut [MaybeUninit<Contact>] {
    if request.contacts.is_null() || request.capacity == 0 {
        return &mut [];
    }
    // SAFETY: by this function's contract.
    unsafe { core::slice::from_raw_parts_mut(request.contacts.cast(), request.capacity as usize) }
}

/// A counter that writes into the host's arrays of tests per triangle.
///
/// # Safety
/// The arrays are null, or as long as the objects have triangles and two even when the objects are one (plugin.h).
unsafe fn borrow_counts<'a, A: Algorithm>(counts: *mut raw::Counts, [a, b]: [*mut Object; 2]) -> Counts<'a> {
    // SAFETY: by this function's contract.
    unsafe {
        let tests = |array: *mut u32, object: *mut Object| -> &'a mut [u32] {
            if array.is_null() {
                return &mut [];
            }
            core::slice::from_raw_parts_mut(array, (*object.cast::<Built<A>>()).triangle_count as usize)
        };
        Counts { tests_a: tests((*counts).tests_a, a), tests_b: tests((*counts).tests_b, b), ..Counts::default() }
    }
}

/// Tells the host what was counted.
///
/// # Safety
/// `counts` is the host's.
unsafe fn return_counts(counts: *mut raw::Counts, work: &Counts<'_>) {
    // SAFETY: by this function's contract.
    let counts = unsafe { &mut *counts };
    counts.flags = raw::COUNTS_BV_TESTS | raw::COUNTS_PRIMITIVE_TESTS | raw::COUNTS_PER_TRIANGLE;
    counts.bv_tests = work.bv_tests;
    counts.primitive_tests = work.primitive_tests;
}
