//! One jailed runner, as its supervisor uses it: ask, time, end. A whole pass of questions: `pass.rs`.

use std::marker::PhantomData;

use ocb_core::configuration::Configuration;
use ocb_core::instance::Presented;
use ocb_core::query::{Answer, Counters, Query};

use crate::clock::ClockFacts;
use crate::confine::pin;
use crate::exchange::{Exchange, Poses, Resting, Timed};
use crate::launch::Killer;
use crate::outcome::{Ending, Outcome, Phase};
use crate::policy::Policy;
use crate::protocol::{Command, counts_per_triangle, parse_answer, parse_counters};
use crate::question::Question;
use crate::speed;
use crate::usage::Usage;

/// After questions that took so long together, the kernel is asked how long the runner waited for its CPU.
const LOOK_NS: f64 = 20_000.0;
/// Waits shorter than this stay in a time; so does this much of a longer one, which the null round trips had, too.
const WAIT_NS: f64 = 10_000.0;
const USUAL_WAIT_NS: f64 = 5_000.0;

/// One running jail with a loaded plugin and built objects. Dropping it kills the jail.
pub struct Session {
    pub(crate) policy: Policy,
    exchange: Exchange,
    /// How many objects a question may name.
    objects: u32,
    set_up: SetUp,
    clock: ClockFacts,
    waits: Waits,
    /// Primitive tests of all counted queries; nothing once one of them was not counted per triangle.
    primitive_tests: Option<u64>,
    /// The runner is to sleep since then.
    resting: Option<Resting>,
    ended: Option<Outcome>,
    pinned: Pinned,
    /// The jail dies with the thread that started it, so the session stays there.
    _thread: PhantomData<*const ()>,
}

/// What was done before the first question, by the supervisor's clock.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SetUp {
    /// Loading the file, which runs its constructors, its description, its instance and its parameters, nanoseconds. The
    /// meshes cannot be seen yet.
    pub load_ns: f64,
    /// Building the structures of all objects, from the moment on at which the meshes can be seen, nanoseconds.
    pub build_ns: f64,
}

/// How long the runner waited for its CPU while it was asked. Only what certainly fell into one question is told of it: the
/// rest may have been in any of those before it.
#[derive(Debug, Default)]
struct Waits {
    /// By the last look, since the runner began.
    seen_ns: f64,
    /// What the questions since the last look took.
    unlooked_ns: f64,
    /// Told so far.
    told_ns: f64,
}

/// One timed answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// From the question's release to the seen answer, by the supervisor's clock.
    pub raw_ns: f64,
    /// The part of it in which the runner certainly waited for its CPU, as the kernel counts it.
    pub waited_ns: f64,
    /// `raw_ns` without `waited_ns`, minus the session's median null round trip; the clock's resolution when below it, never 0.
    pub time_ns: f64,
    /// `time_ns` is only an upper bound.
    pub below_resolution: bool,
    /// The supervisor missed the moment of the answer.
    pub disturbed: bool,
    /// What the plugin answered.
    pub answer: Answer,
}

/// Answers to questions that were released together.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// All of them, the null round trip of as many questions subtracted; the clock's resolution when below it, never 0.
    pub time_ns: f64,
    /// The supervisor missed the moment of the last answer.
    pub disturbed: bool,
    /// In the order of the questions.
    pub answers: Vec<Answer>,
}

/// An answer, with counters where they were asked for and the plugin has them.
type Counted = (Answer, Option<Counters>);

impl Session {
    pub(crate) fn new(
        policy: Policy,
        exchange: Exchange,
        objects: u32,
        set_up: SetUp,
        clock: ClockFacts,
        pinned: Pinned,
        resting: Resting,
    ) -> Self {
        let waits = Waits::default();
        Self {
            policy,
            exchange,
            objects,
            set_up,
            clock,
            waits,
            primitive_tests: Some(0),
            resting: Some(resting),
            ended: None,
            pinned,
            _thread: PhantomData,
        }
    }

    /// What was done before the first question.
    pub fn set_up(&self) -> SetUp {
        self.set_up
    }

    /// How the clock behaved.
    pub fn clock(&self) -> &ClockFacts {
        &self.clock
    }

    /// The layers of the jail in force, one short phrase each.
    pub fn layers(&self) -> Vec<String> {
        self.exchange.jail.layers.phrases()
    }

    /// Process id of the runner, as this process sees it.
    pub fn pid(&self) -> i32 {
        self.exchange.jail.pid
    }

    /// Asks one question and times the answer. After an error the session has ended; [`Session::finish`] tells the rest.
    pub fn query(&mut self, query: Query, configuration: &Configuration) -> Result<Sample, Outcome> {
        self.put(query, Presented { configuration: *configuration, swapped: false })
    }

    /// As [`Session::query`], with the objects in either order.
    pub fn put(&mut self, query: Query, question: Presented) -> Result<Sample, Outcome> {
        self.put_words(query, &Poses::from(&Question::of_pair(query, question)))
    }

    /// As [`Session::query`], about any two of the objects.
    pub fn question(&mut self, question: &Question) -> Result<Sample, Outcome> {
        self.put_words(question.query, &Poses::from(question))
    }

    /// As [`Session::put`]; what can be done before the clock runs has been done.
    pub(crate) fn put_words(&mut self, query: Query, question: &Poses) -> Result<Sample, Outcome> {
        // A stretch does not fit into the nearest cache. The null question lies there, so this one is brought there, too.
        let question = std::hint::black_box(question.clone());
        let (timed, mut answers) = self.ask(query, std::slice::from_ref(&question), false)?;
        let waited_ns = self.waited(timed.raw_ns);
        let (time_ns, below_resolution) = self.clock.subtract(timed.raw_ns - waited_ns, 1);
        let disturbed = self.exchange.disturbed(&timed);
        let answer = answers.remove(0).0;
        Ok(Sample { raw_ns: timed.raw_ns, waited_ns, time_ns, below_resolution, disturbed, answer })
    }

    /// Releases up to [`MAX_BATCH`](crate::MAX_BATCH) questions together and times them as one. Lists of all contacts
    /// share one buffer, so they cannot be asked for in batches.
    pub fn batch(&mut self, query: Query, questions: &[Presented]) -> Result<Batch, Outcome> {
        let words: Vec<Poses> = questions.iter().map(|it| Poses::from(&Question::of_pair(query, *it))).collect();
        self.batch_words(query, &words)
    }

    /// As [`Session::batch`]; what can be done before the clock runs has been done.
    pub(crate) fn batch_words(&mut self, query: Query, words: &[Poses]) -> Result<Batch, Outcome> {
        let (timed, answers) = self.ask(query, words, false)?;
        let (time_ns, _) = self.clock.subtract(timed.raw_ns, words.len());
        let answers = answers.into_iter().map(|(answer, _)| answer).collect();
        Ok(Batch { time_ns, disturbed: self.exchange.disturbed(&timed), answers })
    }

    /// Asks one question untimed, with counters where the plugin has them.
    pub fn count(
        &mut self,
        query: Query,
        configuration: &Configuration,
    ) -> Result<(Answer, Option<Counters>), Outcome> {
        let question = Question::of_pair(query, Presented { configuration: *configuration, swapped: false });
        let (answer, counters) = self.ask(query, &[Poses::from(&question)], true)?.1.remove(0);
        let tests = counters.and_then(|counters| counters.primitive_tests);
        let tests = tests.filter(|_| counts_per_triangle(&self.exchange.slots()[0]));
        self.primitive_tests = self.primitive_tests.zip(tests).and_then(|(all, tests)| all.checked_add(tests));
        Ok((answer, counters))
    }

    /// In how many primitive tests of the counted queries so far each triangle of A and of B took part, as the plugin says;
    /// absent when it did not count that in each of them, or when it does not add up to its primitive tests.
    pub fn triangle_tests(&self) -> Option<[Vec<u32>; 2]> {
        let all = self.primitive_tests?;
        let tests = self.exchange.jail.triangle_tests();
        tests.iter().all(|of| of.iter().map(|tests| u64::from(*tests)).sum::<u64>() == all).then_some(tests)
    }

    /// From now on the runner is to sleep, until the next question.
    pub(crate) fn rest(&mut self) -> Result<Resting, Outcome> {
        match self.resting {
            Some(resting) => Ok(resting),
            None => {
                let resting = self.guarded(|session| session.exchange.rest(session.policy.query_seconds))?;
                self.resting = Some(resting);
                Ok(resting)
            }
        }
    }

    /// Ends a rest: the moment, how long it was, and how much the runner has computed in it all the same, nanoseconds.
    pub(crate) fn resume(&mut self) -> (Resting, [f64; 2]) {
        let resting = self.resting.take();
        let now = self.exchange.resumed(resting.as_ref());
        let Some(resting) = resting else { return (now, [0.0; 2]) };
        let computed_ns = now.usage.zip(resting.usage).map_or(0.0, |(now, then)| now.since(then).run_ns);
        (now, [(now.told - resting.told).as_nanos() as f64, computed_ns])
    }

    /// What the runner computed between two rests while nothing was open; see [`Exchange::beside_ns`].
    pub(crate) fn beside_ns(&self, resumed: &Resting, now: &Resting, asked_ns: f64, questions: usize) -> f64 {
        self.exchange.beside_ns(resumed, now, asked_ns, questions)
    }

    /// How fast the runner's CPU is, which is only to be asked while the runner rests.
    pub(crate) fn speed_ns(&self) -> Result<f64, Outcome> {
        speed::measure(self.policy.runner_cpu)
    }

    /// What the runner has computed so far, where the kernel counts.
    pub(crate) fn usage(&self) -> Option<Usage> {
        self.exchange.meter().read()
    }

    /// How long the runner has waited for its CPU in questions, nanoseconds.
    pub(crate) fn waited_ns(&self) -> f64 {
        self.waits.told_ns
    }

    /// How much of a question's time the runner certainly waited for its CPU. With several threads one of them may wait while
    /// others compute, so that nothing is said.
    fn waited(&mut self, raw_ns: f64) -> f64 {
        let unlooked_ns = self.waits.unlooked_ns;
        self.waits.unlooked_ns += raw_ns;
        if self.waits.unlooked_ns < LOOK_NS || self.policy.threads > 1 {
            return 0.0;
        }
        let Some(usage) = self.usage() else { return 0.0 };
        // The questions before may have waited for all of their time.
        let waited_ns = (usage.delay_ns - self.waits.seen_ns - unlooked_ns).min(raw_ns);
        (self.waits.seen_ns, self.waits.unlooked_ns) = (usage.delay_ns, 0.0);
        if waited_ns < WAIT_NS {
            return 0.0;
        }
        self.waits.told_ns += waited_ns - USUAL_WAIT_NS;
        waited_ns - USUAL_WAIT_NS
    }

    fn ask(&mut self, query: Query, questions: &[Poses], counted: bool) -> Result<(Timed, Vec<Counted>), Outcome> {
        let loaded = |poses: &Poses| poses.objects.iter().all(|number| *number < self.objects);
        assert!(questions.iter().all(loaded), "a question names an object that was not loaded");
        self.guarded(|session| {
            let limit = session.policy.query_seconds;
            session.resting = None;
            if session.exchange.wake(limit)? {
                let delay_ns = session.usage().map_or(0.0, |usage| usage.delay_ns);
                (session.waits.seen_ns, session.waits.unlooked_ns) = (delay_ns, 0.0);
            }
            let exchange = &mut session.exchange;
            let timed = exchange.asked(Command::ask(query, counted), questions, limit)?;
            let read = |slot| {
                let answer = parse_answer(query, slot, exchange.contacts())
                    .map_err(|rule| Outcome::ProtocolViolation { phase: Phase::Query, rule })?;
                Ok((answer, parse_counters(slot).filter(|_| counted)))
            };
            Ok((timed, exchange.slots().iter().map(read).collect::<Result<_, _>>()?))
        })
    }

    /// Nothing is asked of a session that has ended or shall end; the first error ends it.
    fn guarded<T>(&mut self, work: impl FnOnce(&mut Self) -> Result<T, Outcome>) -> Result<T, Outcome> {
        if let Some(outcome) = &self.ended {
            return Err(outcome.clone());
        }
        let result = if self.exchange.jail.killer.asked() { Err(Outcome::Cancelled) } else { work(self) };
        if let Err(outcome) = &result {
            self.ended = Some(outcome.clone());
        }
        result
    }

    /// A handle that ends this session from another thread.
    pub fn killer(&self) -> Killer {
        self.exchange.jail.killer.clone()
    }

    /// Ends the runner, reaps it and says how it went. It is killed, not asked: everything that counts has been read by
    /// then, and a plugin's destructors have no business with us.
    pub fn finish(self) -> Ending {
        let Session { exchange, ended, pinned, .. } = self;
        let ending = exchange.jail.end(ended.unwrap_or(Outcome::Completed));
        drop(pinned);
        ending
    }
}

/// Keeps the calling thread on one CPU until dropped.
pub(crate) struct Pinned(Option<Vec<usize>>);

impl Pinned {
    pub(crate) fn to(cpu: Option<usize>) -> Result<Self, Outcome> {
        let Some(cpu) = cpu else { return Ok(Pinned(None)) };
        match pin(&[cpu]) {
            Ok(before) => Ok(Pinned(Some(before))),
            Err(error) => Err(Outcome::fault("Cpu", format!("the supervisor cannot run on CPU {cpu}: {error}"))),
        }
    }
}

impl Drop for Pinned {
    fn drop(&mut self) {
        if let Some(before) = self.0.take() {
            // Where it may not run any more it stays where it is: no harm to anybody.
            let _ = pin(&before);
        }
    }
}
