//! How fast a CPU is now: a chain of dependent multiplications, run by the supervisor itself on that CPU while the runner
//! sleeps. No memory of the runner is looked at, so nothing in it can make a CPU look slower or faster than it is.

use std::io;

use crate::clock::Clock;
use crate::confine::pin;
use crate::outcome::Outcome;

/// Multiplications, each waiting for the one before: some 10 us on today's processors.
const STEPS: u32 = 10_000;
/// The shortest of so many is the CPU's speed; what something else disturbs takes longer.
const LOOPS: usize = 5;

/// How long the loop takes on this CPU, or on the one where this thread happens to be; nanoseconds.
pub(crate) fn measure(cpu: Option<usize>) -> Result<f64, Outcome> {
    let fault = |error: io::Error| Outcome::fault("Cpu", error);
    let before = cpu.map(|cpu| pin(&[cpu])).transpose().map_err(fault)?;
    let clock = Clock::get();
    let loops = (0..LOOPS).map(|_| {
        let begun = clock.ticks();
        multiply(STEPS);
        clock.nanoseconds(begun, clock.ticks())
    });
    let shortest = loops.fold(f64::INFINITY, f64::min);
    before.map(|before| pin(&before)).transpose().map_err(fault)?;
    Ok(shortest)
}

/// Each product waits for the one before, so that it takes so many cycles, whatever else the processor can do.
#[inline(never)]
fn multiply(steps: u32) {
    // SAFETY: two registers of its own.
    unsafe {
        core::arch::asm!(
            "2:", "imul {x}, {x}, 3", "dec {n:e}", "jnz 2b",
            x = inout(reg) 3u64 => _, n = inout(reg) steps => _,
            options(nomem, nostack)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_loop_is_timed_and_the_thread_is_where_it_was() {
        let before = crate::confine::own_cpus().unwrap();
        for cpu in [None, before.first().copied(), before.last().copied()] {
            // Ten thousand multiplications of three cycles take a microsecond at 30 GHz, and a machine may be slow.
            let ns = measure(cpu).unwrap();
            assert!(ns > 1000.0 && ns.is_finite(), "{ns}");
        }
        assert_eq!(crate::confine::own_cpus().unwrap(), before);
        assert!(measure(Some(usize::MAX >> 1)).is_err());
    }
}
