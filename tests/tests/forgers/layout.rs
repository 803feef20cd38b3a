//! Where things lie in the shared memory, for the kit's compiler: all of it can be read in these sources by an author.

use ocb_sandbox::protocol::{Command, MAX_BATCH, SLOT_WORDS, answer, request, slot};

/// Name and value of what the kit is compiled with.
pub fn defines() -> Vec<String> {
    let numbers: [(&str, usize); 24] = [
        ("REQUEST_NUMBER", request::NUMBER),
        ("REQUEST_SLEEPS", request::SUPERVISOR_SLEEPS),
        ("REQUEST_COMMAND", request::COMMAND),
        ("REQUEST_QUESTIONS", request::QUESTIONS),
        ("REQUEST_OBJECTS", request::OBJECTS),
        ("REQUEST_BYTES", request::BYTES),
        ("POSES_AT", request::POSES),
        ("POSES_STRIDE", request::POSES_STRIDE),
        ("ANSWER_NUMBER", answer::NUMBER),
        ("ANSWER_RUNNER_SLEEPS", answer::RUNNER_SLEEPS),
        ("ANSWER_TESTS", answer::TESTS),
        ("SLOT_AT", answer::SLOT),
        ("SLOT_STRIDE", answer::SLOT_STRIDE),
        ("SLOT_WORDS", SLOT_WORDS),
        ("SLOT_HIT_OR_FLAGS", slot::HIT_OR_FLAGS),
        ("SLOT_TRIANGLES", slot::TRIANGLES),
        ("SLOT_DISTANCE", slot::DISTANCE),
        ("SLOT_POINTS", slot::POINTS),
        ("MAX_BATCH", MAX_BATCH),
        ("COMMAND_REST", Command::Rest as usize),
        ("COMMAND_COLLISION_FIRST", Command::CollisionFirst as usize),
        ("COMMAND_PROXIMITY", Command::Proximity as usize),
        ("COMMAND_COUNT_COLLISION_FIRST", Command::CountCollisionFirst as usize),
        ("COMMAND_COUNT_PROXIMITY", Command::CountProximity as usize),
    ];
    numbers.iter().map(|(name, value)| format!("-D{name}={value}")).collect()
}
