//! Forged plugins gain nothing: the kit of `sandbox/tests/fixtures/forgers/` is measured by `ocb bench` as any other
//! plugin, in the production profile, and no forger may have a rank with a time, or a build time, that honest plugins
//! of the same work do not reach. The honest ones keep their rank.
//!
//! `OCB_FORGERS` says how many runs to make; without it a slice of the grossest forgers is measured. A campaign goes on where it
//! ended when `OCB_FORGERS_KEPT` names a file for its results. `OCB_FORGERS_ONLY=NAME,NAME` leaves out the other
//! forgers, and `OCB_FORGERS_AT=300ns:one-busy-cpu` all runs but those of one class and condition.

mod bench;
mod judge;
mod kept;
mod kit;
mod layout;
mod load;
mod objects;
mod plan;
mod table;

use std::time::Instant;

use judge::Ledger;
use kept::Kept;
use kit::Kit;

#[test]
fn forgers_gain_nothing_and_honest_twins_keep_their_rank() {
    let rounds: Option<usize> = std::env::var("OCB_FORGERS").ok().and_then(|n| n.parse().ok());
    let folder = tempfile::tempdir().expect("a folder");
    let kit = Kit::new(folder.path());
    objects::write(folder.path());
    let (mut ledger, mut kept) = (Ledger::default(), Kept::open());
    let [only, at] = ["OCB_FORGERS_ONLY", "OCB_FORGERS_AT"].map(|name| std::env::var(name).ok());
    let runs =
        rounds.map_or_else(plan::slice, |rounds| plan::campaign(rounds, only.as_deref(), at.as_deref().map(plan::At)));
    for (i, run) in (1..).zip(runs) {
        let begun = Instant::now();
        let results = kept.next(|| bench::measure(folder.path(), &kit, &run));
        ledger.enter(&run, &bench::found(&run, &results));
        eprintln!("{:?} {:?} {:?}: {:.0} s", run.classes, run.question, run.condition, begun.elapsed().as_secs_f64());
        // What a long campaign has found so far, in case that it is ended early.
        if i % plan::CYCLE == 0 {
            println!("after {i} runs\n{}", table::of(&ledger));
        }
    }
    println!("{}", table::of(&ledger));
    let complaints = ledger.complaints();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}
