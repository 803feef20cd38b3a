//! Advice about levels of detail on a measuring machine.

use std::sync::{Mutex, PoisonError};

use ocb_advice::Watch;

use super::{Fetch, Handed, Report, Tell, Worker, mesh, temporary_folder};
use crate::Result;
use crate::advisor::{Advisor, PROGRAM, Request, SHELF};
use crate::measure::Stop;
use crate::mesh_file::to_bytes;
use crate::model::{Asked, Ended, Told};

impl Worker {
    /// Makes advice about objects with these names and hashes; `None` when it was stopped.
    pub(super) fn advise(
        &self,
        (question, names, counts): (Asked, &[String; 2], [u32; 2]),
        [a, b]: [&str; 2],
        stop: &Stop,
        fetch: &Fetch<'_>,
        tell: Tell<'_>,
    ) -> Result<Option<Handed>> {
        let mesh_a = mesh("a", a, fetch)?;
        let mesh_b = if a == b { mesh_a.clone() } else { mesh("b", b, fetch)? };
        let folder = temporary_folder()?;
        let program = self.runner.program.with_file_name(PROGRAM);
        let advisor = Advisor::new(&program, &self.machine, &folder.path().join(SHELF)).waiting_for_the_right();
        let request = Request::of(question, names.clone(), [mesh_a, mesh_b], counts);
        let advised = advisor.advise(&request, &Watching { stop, tell: Mutex::new(tell) })?;
        Ok(advised.map(|advised| {
            let (advice, found) = advised.found(names);
            let files = found.iter().flatten().map(|(_, mesh)| to_bytes(mesh)).collect();
            let papers = found.map(|of_one| of_one.into_iter().map(|(paper, _)| paper).collect());
            Handed { ended: Ended::Advised { advice: Box::new(advice), papers }, files }
        }))
    }
}

/// Tells the service, and stops for it.
struct Watching<'a> {
    stop: &'a Stop,
    tell: Mutex<Tell<'a>>,
}

impl Watch for Watching<'_> {
    fn step(&self, what: &str, done: u64, total: u64) {
        let step = Told::Step { what: what.to_owned(), done, total };
        (self.tell.lock().unwrap_or_else(PoisonError::into_inner))(Report::Told(step));
    }

    fn stopped(&self) -> bool {
        self.stop.asked()
    }
}
