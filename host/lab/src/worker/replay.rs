//! Replays on a measuring machine.

use std::sync::{Mutex, PoisonError};

use super::{Fetch, Handed, Report, Tell, Worker, checked, temporary_folder};
use crate::advisor::{Advisor, PROGRAM, SHELF};
use crate::measure::Stop;
use crate::model::{Ended, OrderedAlgorithm, RecordingInfo, Told, WorkloadSpec};
use crate::recording::Recording;
use crate::workload::{Asked, Far, Site};
use crate::{LabError, Result, sha256_hex};

impl Worker {
    /// Replays a recording; `None` when it was stopped.
    pub(super) fn replay(
        &self,
        (told, spec, ordered): (&RecordingInfo, &WorkloadSpec, &[OrderedAlgorithm]),
        stop: &Stop,
        fetch: &Fetch<'_>,
        tell: Tell<'_>,
    ) -> Result<Option<Handed>> {
        let folder = temporary_folder()?;
        let bytes = fetch("recording")?;
        let bytes = checked("recording", &told.sha256, sha256_hex(&bytes), bytes)?;
        let file = folder.path().join("recording");
        std::fs::write(&file, bytes).map_err(|e| LabError::fault("Keeping the recording failed", e))?;
        let recording = Recording::read_as(&file, &told.file)?;
        let algorithms: Vec<_> = ordered.iter().map(|it| self.algorithm(it, &folder, fetch)).collect::<Result<_>>()?;
        let (runner, machine, folder) = (&self.runner, &self.machine, folder.path());
        let program = runner.program.with_file_name(PROGRAM);
        let advisor = &Advisor::new(&program, machine, &folder.join(SHELF));
        let seed = spec.seed.ok_or_else(|| LabError::Fault("The order of this replay has no seed.".into()))?;
        let asked = Asked { recording: &recording, spec, algorithms: &algorithms, seed };
        let telling = Mutex::new((tell, Replaying::default()));
        let tell = |far: Far| {
            let mut telling = telling.lock().unwrap_or_else(PoisonError::into_inner);
            let told = telling.1.at(far);
            (telling.0)(Report::Told(told));
        };
        let found = match asked.carry_out(&Site { runner, machine, stop, advisor, folder }, &tell) {
            Err(LabError::Stopped) => return Ok(None),
            found => found?,
        };
        let files = [Some(found.queries), found.reduced].into_iter().flatten().collect();
        Ok(Some(Handed { ended: Ended::Replayed { result: Box::new(found.result) }, files }))
    }
}

/// How far a replay is, for its service.
#[derive(Default)]
struct Replaying {
    done: u64,
    doing: Option<String>,
}

impl Replaying {
    fn at(&mut self, far: Far) -> Told {
        match far {
            Far::Pairs(done) => *self = Self { done, doing: None },
            Far::Doing(what) => self.doing = Some(what),
        }
        Told::Replaying { done: self.done, doing: self.doing.clone() }
    }
}
