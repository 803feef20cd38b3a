//! The timed region: what happens between the supervisor's question and the committed answer.
//!
//! The official clock starts when the question is released and stops when the answer's number is seen, both in the
//! supervisor. So this file keeps what lies around the plugin's call short and the same for all of them. The null plugin
//! is called the same way and does nothing; its median is subtracted.

use ocb_core::query::Semantics;
use ocb_sandbox::gate::{self, Inspection};
use ocb_sandbox::inside::{Shared, Slot};
use ocb_sandbox::protocol::{Answers, Command, answer, slot};
use ocb_sandbox::seccomp;
use opencollbench_plugin::raw::contacts::{Contact, ContactsRequest, ContactsResult};
use opencollbench_plugin::raw::distance::{DistanceRequest, DistanceResult};
use opencollbench_plugin::raw::{self, CollideRequest, CollideResult, Counts, Host, Instance, Object};

use crate::library::{Algorithm, Failure, Mapped, Plugin};
use crate::serve::head;

/// The plugin and what it has made so far.
pub struct Measured {
    path: String,
    libraries: Vec<String>,
    /// The tighter filters, compiled before anything foreign is in this process.
    tighter: Vec<seccompiler::BpfProgram>,
    plugin: Option<Plugin>,
    algorithm: Option<Algorithm>,
    instance: *mut Instance,
    /// By their numbers; a pair has two from the start, which the null plugin gets, too.
    objects: Vec<*mut Object>,
    built: usize,
    /// Flags of every request of this trial.
    flags: u32,
    /// The algorithm does not know what this trial asks, so that it is never called for an answer.
    unasked: bool,
    /// Where it adds its tests per triangle, if it counts.
    tests: Option<[*mut u32; 2]>,
    avx: bool,
}

impl Measured {
    /// Nothing is loaded yet.
    pub fn new(path: String, libraries: Vec<String>, tighter: Vec<seccompiler::BpfProgram>) -> Self {
        let nothing = std::ptr::null_mut();
        let avx = std::is_x86_feature_detected!("avx");
        Self {
            path,
            libraries,
            tighter,
            plugin: None,
            algorithm: None,
            instance: nothing,
            objects: vec![std::ptr::null_mut(); 2],
            built: 0,
            flags: 0,
            unasked: false,
            tests: None,
            avx,
        }
    }

    /// Does what is asked and fills the slot.
    pub fn obey(&mut self, command: Command, shared: &Shared, question: usize, slot: &mut Slot) -> Result<(), Failure> {
        match command {
            Command::CloseListener | Command::Rest => Ok(()),
            Command::Null => {
                self.call_collide(null_plugin, shared, question, slot, false);
                Ok(())
            }
            Command::Tighten => seccomp::tighten(&self.tighter)
                .map_err(|e| Failure::error(format!("the tighter filter is refused: {e}"))),
            Command::Inspect => {
                let json = serde_json::to_vec(&self.gate(gate::inspect, |inspection| inspection)?)
                    .map_err(|e| Failure::not_loaded(e.to_string()))?;
                shared.say(slot, &json);
                Ok(())
            }
            Command::Open => self.open(shared, slot),
            Command::Prepare => self.prepare(shared, slot),
            Command::Build => self.build(shared),
            _ if self.unasked => {
                slot[slot::STATUS] = raw::UNSUPPORTED as u64;
                Ok(())
            }
            Command::CollisionFirst => self.collide(shared, question, slot, false),
            Command::CountCollisionFirst => self.collide(shared, question, slot, true),
            Command::CollisionAll => self.contacts(shared, question, slot, false),
            Command::CountCollisionAll => self.contacts(shared, question, slot, true),
            Command::Proximity => self.distance(shared, question, slot, false),
            Command::CountProximity => self.distance(shared, question, slot, true),
        }
    }

    /// What the gate says of the plugin's file.
    fn gate<T>(&self, look: fn(&[u8], &[gate::Offered]) -> T, unreadable: fn(Inspection) -> T) -> Result<T, Failure> {
        let file = Mapped::open(&self.path).map_err(|e| Failure::not_loaded(format!("it cannot be read ({e})")))?;
        let bytes = file.bytes();
        let offered = self.libraries.iter().map(|path| gate::Offered {
            name: path.rsplit('/').next().unwrap_or(path).to_string(),
            versions: Mapped::open(path).map_or_else(|_| Vec::new(), |library| gate::versions_of(library.bytes())),
        });
        let offered: Vec<_> = offered.collect();
        let found = std::panic::catch_unwind(|| look(bytes, &offered));
        let confused = || unreadable(Inspection::unreadable("its ELF structure cannot be parsed"));
        Ok(found.unwrap_or_else(|_| confused()))
    }

    fn open(&mut self, shared: &Shared, slot: &mut Slot) -> Result<(), Failure> {
        // No loader touches what the gate refuses.
        if let Some(rejection) = self.gate(gate::rejections, |inspection| inspection.rejections)?.first() {
            return Err(Failure::not_loaded(rejection.to_string()));
        }
        let plugin = self.guarded(|| Plugin::open(&self.path))?;
        let descriptors = plugin.describe()?;
        let json = serde_json::to_vec(&descriptors).map_err(|e| Failure::not_loaded(e.to_string()))?;
        if json.len() > answer::TEXT_BYTES {
            return Err(Failure::not_loaded("its description is too long"));
        }
        shared.say(slot, &json);
        self.plugin = Some(plugin);
        Ok(())
    }

    fn prepare(&mut self, shared: &Shared, slot: &mut Slot) -> Result<(), Failure> {
        let head = head(shared)?;
        let plugin = self.plugin.as_ref().ok_or_else(|| Failure::error("nothing is loaded"))?;
        let algorithm = plugin.algorithm(&head.algorithm)?;
        if head.semantics == Semantics::Solid {
            self.flags = raw::REQUEST_SOLID;
            // It would answer for the surfaces, which is another question.
            self.unasked = !algorithm.knows_solids();
        }
        if algorithm.raw.capabilities & raw::CAPABILITY_COUNTS != 0
            && let Some(triangles) = head.triangles
        {
            let at = [answer::TESTS, answer::tests_b(triangles)];
            self.tests = Some(at.map(|at| shared.answer.address(at).cast()));
        }
        if let Some(create) = algorithm.raw.create {
            let mut instance = std::ptr::null_mut();
            // SAFETY: by plugin.h, with a host that lives for ever and a live place for the instance.
            let status = self.guarded(|| unsafe { create(&HOST, &raw mut instance) });
            if status != raw::OK {
                return Err(algorithm.said(std::ptr::null_mut(), &format!("create returned {}", spell(status))));
            }
            self.instance = instance;
        }
        for (name, value) in &head.parameters {
            self.guarded(|| algorithm.set(self.instance, name, *value))?;
        }
        let algorithm = self.guarded(|| Algorithm::with(algorithm.raw, self.instance))?;
        let answers = Answers { queries: algorithm.queries(), scene: algorithm.scene.is_some() };
        shared.say(slot, &serde_json::to_vec(&answers).map_err(|e| Failure::error(e.to_string()))?);
        self.algorithm = Some(algorithm);
        Ok(())
    }

    fn build(&mut self, shared: &Shared) -> Result<(), Failure> {
        let algorithm = self.algorithm()?;
        let [vertex_count, triangle_count, positions_at, triangles_at] = shared.mesh();
        let (vertex_count, triangle_count) = (vertex_count as u32, triangle_count as u32);
        let positions = shared.trial_address(positions_at as usize).cast();
        let triangles = shared.trial_address(triangles_at as usize).cast();
        let load = algorithm.raw.load_mesh.ok_or_else(|| Failure::error("load_mesh is missing"))?;
        let mut object = std::ptr::null_mut();
        // SAFETY: by plugin.h; both arrays lie in the sealed trial mapping, aligned to 64 bytes, as long as said.
        let status = self.guarded(|| unsafe {
            load(self.instance, positions, vertex_count, triangles, triangle_count, &raw mut object)
        });
        match status {
            raw::OK if object.is_null() => Err(Failure::error("load_mesh returned OCB_OK and no object")),
            raw::OK => {
                self.objects.truncate(self.built);
                self.objects.push(object);
                self.built += 1;
                if self.built == 1 {
                    // The same mesh twice is loaded once; a second one replaces this.
                    self.objects.push(object);
                }
                Ok(())
            }
            other => Err(algorithm.said(self.instance, &format!("load_mesh returned {}", spell(other)))),
        }
    }

    fn collide(&self, shared: &Shared, question: usize, slot: &mut Slot, counted: bool) -> Result<(), Failure> {
        let Some(call) = self.algorithm()?.raw.collide else {
            slot[slot::STATUS] = raw::UNSUPPORTED as u64;
            return Ok(());
        };
        let status = self.call_collide(call, shared, question, slot, counted);
        self.said_error(status, "collide")
    }

    /// The call that null plugin and plugins have in common.
    #[inline(never)]
    fn call_collide(&self, call: Collide, shared: &Shared, at: usize, slot: &mut Slot, counted: bool) -> raw::Status {
        let poses = shared.poses(at);
        let (pose_a, pose_b) = (poses.as_ptr(), poses[16..].as_ptr());
        let ([a, b], mut counts, mut result) = (self.ordered(shared, at), self.counts(counted), CollideResult::new());
        let request = CollideRequest::new(self.flags, pointer(&mut counts));
        // SAFETY: by plugin.h: objects of this instance, 16 numbers per pose, live request, counts and result.
        let status =
            self.guarded(|| unsafe { call(self.instance, a, pose_a, b, pose_b, &raw const request, &raw mut result) });
        slot[slot::STATUS] = u64::from(status as u32);
        slot[slot::HIT_OR_FLAGS] = result.hit.into();
        slot[slot::TRIANGLES] = result.triangle_a.into();
        slot[slot::TRIANGLES + 1] = result.triangle_b.into();
        fill_counts(slot, counts);
        status
    }

    fn contacts(&self, shared: &Shared, at: usize, slot: &mut Slot, counted: bool) -> Result<(), Failure> {
        let Some(call) = self.algorithm()?.contacts.and_then(|table| table.contacts) else {
            slot[slot::STATUS] = raw::UNSUPPORTED as u64;
            return Ok(());
        };
        let poses = shared.poses(at);
        let (pose_a, pose_b) = (poses.as_ptr(), poses[16..].as_ptr());
        let ([a, b], mut counts, mut result) = (self.ordered(shared, at), self.counts(counted), ContactsResult::new());
        let buffer = shared.answer.address(answer::CONTACTS).cast::<Contact>();
        let request = ContactsRequest::new(buffer, answer::CONTACT_CAPACITY as u64, pointer(&mut counts));
        // SAFETY: as in `collide`; the buffer is this process's writable mapping with room for the capacity.
        let status =
            self.guarded(|| unsafe { call(self.instance, a, pose_a, b, pose_b, &raw const request, &raw mut result) });
        slot[slot::STATUS] = u64::from(status as u32);
        slot[slot::TOTAL] = result.total;
        fill_counts(slot, counts);
        self.said_error(status, "contacts")
    }

    fn distance(&self, shared: &Shared, at: usize, slot: &mut Slot, counted: bool) -> Result<(), Failure> {
        let Some(call) = self.algorithm()?.distance.and_then(|table| table.distance) else {
            slot[slot::STATUS] = raw::UNSUPPORTED as u64;
            return Ok(());
        };
        let poses = shared.poses(at);
        let (pose_a, pose_b) = (poses.as_ptr(), poses[16..].as_ptr());
        let ([a, b], mut counts, mut result) = (self.ordered(shared, at), self.counts(counted), DistanceResult::new());
        let request = DistanceRequest::new(self.flags, pointer(&mut counts));
        // SAFETY: as in `collide`.
        let status =
            self.guarded(|| unsafe { call(self.instance, a, pose_a, b, pose_b, &raw const request, &raw mut result) });
        slot[slot::STATUS] = u64::from(status as u32);
        slot[slot::HIT_OR_FLAGS] = result.flags.into();
        slot[slot::TRIANGLES] = result.triangle_a.into();
        slot[slot::TRIANGLES + 1] = result.triangle_b.into();
        slot[slot::DISTANCE] = result.distance.to_bits();
        for (i, x) in result.point_a.iter().chain(&result.point_b).enumerate() {
            slot[slot::POINTS + i] = x.to_bits();
        }
        fill_counts(slot, counts);
        self.said_error(status, "distance")
    }

    /// Room for the work of a query, when it is to be counted.
    #[inline]
    fn counts(&self, counted: bool) -> Option<Counts> {
        self.tests.filter(|_| counted).map(|[a, b]| Counts::new(a, b))
    }

    /// The object that stands first in a question, and the one that stands second.
    #[inline]
    fn ordered(&self, shared: &Shared, question: usize) -> [*mut Object; 2] {
        shared.objects(question).map(|number| self.objects[number])
    }

    fn said_error(&self, status: raw::Status, what: &str) -> Result<(), Failure> {
        if status == raw::ERROR {
            return Err(self.algorithm()?.said(self.instance, &format!("{what} returned OCB_ERROR")));
        }
        Ok(())
    }

    fn algorithm(&self) -> Result<&Algorithm, Failure> {
        self.algorithm.as_ref().ok_or_else(|| Failure::error("no algorithm is chosen"))
    }

    /// Runs foreign code between two known floating-point states: it finds the state of the ABI (round to nearest,
    /// exceptions masked, denormals kept), and whatever it leaves behind is gone.
    #[inline(always)]
    fn guarded<T>(&self, foreign: impl FnOnce() -> T) -> T {
        static MXCSR: u32 = 0x1f80;
        let result = foreign();
        if self.avx {
            // SAFETY: AVX is there; upper halves of vector registers carry nothing across a call.
            unsafe { core::arch::asm!("vzeroupper", clobber_abi("C"), options(nostack, preserves_flags)) };
        }
        // SAFETY: sets control words to what the ABI wants at every call; FNINIT also empties the x87 stack, which is
        // empty at calls anyway.
        unsafe {
            core::arch::asm!(
                "cld", "fninit", "ldmxcsr [{0}]",
                in(reg) &raw const MXCSR, clobber_abi("C"), options(nostack)
            );
        }
        result
    }
}

/// `collide` of plugin.h.
type Collide = unsafe extern "C" fn(
    *mut Instance,
    *mut Object,
    *const f64,
    *mut Object,
    *const f64,
    *const CollideRequest,
    *mut CollideResult,
) -> raw::Status;

/// The plugin that does nothing.
unsafe extern "C" fn null_plugin(
    _: *mut Instance,
    _: *mut Object,
    _: *const f64,
    _: *mut Object,
    _: *const f64,
    _: *const CollideRequest,
    _: *mut CollideResult,
) -> raw::Status {
    raw::OK
}

/// The host as plugins see it. It offers nothing yet.
static HOST: Host =
    Host { struct_size: size_of::<Host>() as u32, abi_minor: raw::ABI_MINOR, get_extension: Some(offers_nothing) };

unsafe extern "C" fn offers_nothing(_: *const Host, _: *const std::ffi::c_char) -> *const std::ffi::c_void {
    std::ptr::null()
}

#[inline]
fn pointer(counts: &mut Option<Counts>) -> *mut Counts {
    counts.as_mut().map_or(std::ptr::null_mut(), std::ptr::from_mut)
}

#[inline]
fn fill_counts(slot: &mut Slot, counts: Option<Counts>) {
    if let Some(counts) = counts {
        slot[slot::COUNTS] = counts.flags.into();
        slot[slot::COUNTS + 1] = counts.bv_tests;
        slot[slot::COUNTS + 2] = counts.primitive_tests;
    }
}

fn spell(status: raw::Status) -> String {
    match status {
        raw::GAVE_UP => "OCB_GAVE_UP".into(),
        raw::UNSUPPORTED => "OCB_UNSUPPORTED".into(),
        raw::ERROR => "OCB_ERROR".into(),
        other => format!("the unknown status {other}"),
    }
}
