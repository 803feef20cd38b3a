//! Recordings that visitors bring: asking for a replay, looking at it, ending it.

mod errands;
mod heatmaps;
pub mod recordings;
pub mod replay;
pub mod sql;
mod work;

use std::sync::Arc;

use ocb_core::mesh::Mesh;
use ocb_lab::workload::{Progress, Replayed};

use crate::attempts::Kind;
use crate::blocking::blocking;
use crate::boxed;
use crate::engine::Engine;
use crate::locks::Lock;
use crate::measure::Stop;
use crate::model::{
    AccountInfo, Cursor, Page, Part, PosedGroup, PosedScene, RecordingInfo, Role, State, Stretch, StretchResult,
    WhichGroup, WorkloadInfo, WorkloadSpec,
};
use crate::quotas::{Visitor, has_room_for_a_file, turn};
use crate::requests::Made;
use crate::runs::current::Work;
use crate::store::{Store, now_us};
use crate::{EngineError, Recording, Result, sha256_hex};
use recordings::parsed;
use replay::Order;
use sql::WorkloadRow;

/// So many of one account, or of the guests of one address, may be queued or running, and so many in all.
const MOST_OPEN: i64 = 3;
const MOST_IN_ALL: i64 = 200;
/// When to ask again: a replay takes minutes.
const RETRY_SECONDS: u32 = 120;

impl Engine {
    /// Replays a recording with algorithms that answer at least one of its kinds of query.
    #[boxed]
    pub async fn replay_workload(
        &self,
        recording: Arc<Recording>,
        spec: WorkloadSpec,
        stop: Stop,
        tell: impl Fn(Progress) + Send + 'static,
        waits: impl FnOnce() + Send + 'static,
    ) -> Result<Replayed> {
        spec.check().map_err(EngineError::Invalid)?;
        let algorithms = replay::algorithms_for(&self.inner.registry, &recording, &spec.algorithms, None)?;
        let order = Order { recording, spec, algorithms };
        self.inner.replays.here(order, stop, move |asked, site| asked.replay(site, &tell, waits)).await
    }

    /// Keeps an uploaded recording and queues its replay; of a scene without queries nothing is replayed. True when it is new: the
    /// same request under the same key returns the existing one.
    ///
    /// # Errors
    /// `Invalid` for a file that is no recording or a replay that cannot be carried out, `TooMuch` when too many wait.
    #[boxed]
    pub async fn add_workload(
        &self,
        name: &str,
        bytes: Vec<u8>,
        spec: WorkloadSpec,
        visitor: &Visitor,
        key: Option<&str>,
    ) -> Result<(WorkloadInfo, bool)> {
        let owner = visitor.owner.as_str();
        has_room_for_a_file(&self.inner.store, Some(owner), bytes.len()).await?;
        let (name, folder) = (name.to_owned(), self.inner.config.data.clone());
        let (bytes, recording, told) = blocking(move || {
            let recording = parsed(&name, &bytes, &folder)?;
            let told = describe(&name, &bytes, &recording);
            Ok((bytes, recording, told))
        })
        .await?;
        self.queue_workload(told, Some(bytes), &recording, spec, visitor, key).await
    }

    /// Queues another replay of a recording that the visitor has brought.
    #[boxed]
    pub async fn replay_again(
        &self,
        id: &str,
        spec: WorkloadSpec,
        visitor: &Visitor,
        key: Option<&str>,
    ) -> Result<(WorkloadInfo, bool)> {
        self.inner.store.own_workload(id, Some(&visitor.owner), "repeat").await?;
        let (told, recording) = self.recording(id).await?;
        if recording.queries.is_empty() {
            return Err(EngineError::Invalid(format!(
                "{:?} has no queries, so there is nothing to replay.",
                told.file
            )));
        }
        self.queue_workload(told, None, &recording, spec, visitor, key).await
    }

    /// The recording of a workload, and what is told of it.
    async fn recording(&self, id: &str) -> Result<(RecordingInfo, Arc<Recording>)> {
        let told = self.inner.store.workload_row(id).await?.recording;
        let recording = self.inner.recordings.get(&told).await?;
        Ok((told, recording))
    }

    async fn queue_workload(
        &self,
        recording: RecordingInfo,
        bytes: Option<Vec<u8>>,
        read: &Recording,
        spec: WorkloadSpec,
        visitor: &Visitor,
        key: Option<&str>,
    ) -> Result<(WorkloadInfo, bool)> {
        let (inner, owner) = (&self.inner, visitor.owner.as_str());
        let replayed = !read.queries.is_empty();
        if replayed {
            spec.check().map_err(EngineError::Invalid)?;
            let algorithms = replay::algorithms_for(&inner.registry, read, &spec.algorithms, Some(owner))?;
            inner.config.ceilings.replay_may_take(owner, &spec, algorithms.len())?;
        }
        let id = self.id_of_request(owner, Made::Workload, key, &(&recording, &spec)).await?;
        // Two concurrent requests must not share the last of a quota.
        let _alone = inner.store.locks.alone(Lock::Admission).await?;
        if inner.store.workload(&id).await?.is_some() {
            return Ok((self.workload(&id).await?, false));
        }
        let turn = turn(owner, visitor.address.as_deref());
        let [all, own] = inner.store.open_workloads_of(&turn).await?;
        if replayed && (own >= MOST_OPEN || all >= MOST_IN_ALL) {
            let whose = if own >= MOST_OPEN { format!("{own} of your") } else { format!("{all}") };
            let message = format!("{whose} recordings are queued or replayed; try again when one of them has ended.");
            return Err(EngineError::TooMuch { message, retry_seconds: RETRY_SECONDS });
        }
        let _keeping = inner.store.locks.keeping().await?;
        if let Some(bytes) = bytes {
            let length = bytes.len();
            let blob = inner.blobs.put(bytes).await?;
            inner.store.add_blob(&blob, length, "application/zip").await?;
        }
        let row = WorkloadRow {
            id,
            owner: Some(owner.to_owned()),
            turn,
            state: if replayed { State::Queued } else { State::Done },
            attempts: 0,
            message: None,
            spec,
            recording,
            done: 0,
            created_us: now_us(),
            finished_us: (!replayed).then(now_us),
        };
        let new = inner.store.add_workload(&row).await?;
        if replayed {
            inner.work.call();
        }
        Ok((self.workload(&row.id).await?, new))
    }

    /// Those of this owner, newest first, without results.
    #[boxed]
    pub async fn workloads(&self, owner: &str, page: &Page) -> Result<Part<WorkloadInfo>> {
        let (from, limit) = page.start()?;
        let rows = self.inner.store.workloads_of(owner, &from, limit + 1).await?;
        let part = Part::of(rows, limit, |row: &WorkloadRow| Cursor::behind(row.created_us, &row.id));
        let mut entries = Vec::new();
        for row in part.entries {
            entries.push(self.inner.store.workload_info(row).await?);
        }
        Ok(Part { entries, next: part.next })
    }

    /// How far it is, with what was found when it is done.
    #[boxed]
    pub async fn workload(&self, id: &str) -> Result<WorkloadInfo> {
        let row = self.inner.store.workload_row(id).await?;
        let result = self.inner.store.workload_result(id).await?;
        Ok(WorkloadInfo { result, ..self.inner.store.workload_info(row).await? })
    }

    /// What each algorithm does within a stretch of the recording.
    ///
    /// # Errors
    /// `NotFound` before the end.
    #[boxed]
    pub async fn workload_stretch(&self, id: &str, stretch: Stretch) -> Result<StretchResult> {
        let table = self.workload_queries(id).await?;
        blocking(move || Ok(ocb_lab::workload::stretch(&table, stretch)?)).await
    }

    /// The table of all replayed queries, as Parquet.
    ///
    /// # Errors
    /// `NotFound` before the end.
    #[boxed]
    pub async fn workload_queries(&self, id: &str) -> Result<Vec<u8>> {
        self.inner.store.workload_row(id).await?;
        let blob = self.inner.store.workload_table(id).await?;
        let none = || EngineError::NotFound("This recording has not been replayed to its end.".to_owned());
        self.inner.blobs.get(&blob.ok_or_else(none)?).await
    }

    /// The recording about the reduced scene, and a name for its file.
    ///
    /// # Errors
    /// `NotFound` where no reduced scene was asked for, and before the end.
    #[boxed]
    pub async fn reduced_recording(&self, id: &str) -> Result<(Vec<u8>, String)> {
        let told = self.inner.store.workload_row(id).await?.recording;
        let blob = self.inner.store.reduced_recording(id).await?;
        let none = || EngineError::NotFound("This replay has no reduced scene.".to_owned());
        let name = format!("{}-reduced.ocbrec", told.file.trim_end_matches(".ocbrec"));
        Ok((self.inner.blobs.get(&blob.ok_or_else(none)?).await?, name))
    }

    /// The recording and the name of its file.
    #[boxed]
    pub async fn workload_recording(&self, id: &str) -> Result<(Vec<u8>, String)> {
        let told = self.inner.store.workload_row(id).await?.recording;
        Ok((self.inner.blobs.get(&told.sha256).await?, told.file))
    }

    /// A group as it stands in space.
    #[boxed]
    pub async fn workload_group(&self, id: &str, which: WhichGroup) -> Result<PosedGroup> {
        let (_, recording) = self.recording(id).await?;
        Ok(ocb_lab::workload::posed_group(&recording, which)?)
    }

    /// The scene with all its objects, and its pairs.
    #[boxed]
    pub async fn workload_scene(&self, id: &str) -> Result<PosedScene> {
        let (_, recording) = self.recording(id).await?;
        blocking(move || Ok(ocb_lab::workload::posed_scene(&recording)?)).await
    }

    /// The triangles of an object of the scene, as algorithms get them.
    #[boxed]
    pub async fn workload_mesh(&self, id: &str, object: usize) -> Result<Arc<Mesh>> {
        let (_, recording) = self.recording(id).await?;
        blocking(move || Ok(ocb_lab::workload::mesh_of(&recording, object)?)).await
    }

    /// Ends it; only its owner may.
    #[boxed]
    pub async fn cancel_workload(&self, id: &str, caller: Option<&str>) -> Result<WorkloadInfo> {
        self.inner.store.own_workload(id, caller, "cancel").await?;
        self.inner.work.end_workload(&self.inner.store, id, None).await?;
        self.workload(id).await
    }

    /// Ends anybody's, for curators and administrators, who do not see what it is about; its owner sees who did.
    ///
    /// # Errors
    /// `Forbidden` for all others.
    #[boxed]
    pub async fn cancel_workload_of_others(&self, id: &str, curator: &AccountInfo) -> Result<()> {
        if curator.role < Role::Curator {
            let told = "Only the owner of this replay or a curator may cancel it.";
            return Err(EngineError::Forbidden(told.into()));
        }
        self.inner.store.workload_row(id).await?;
        self.inner.work.end_workload(&self.inner.store, id, Some("Cancelled by a curator.")).await
    }

    /// Takes it away with its recording; only its owner may.
    #[boxed]
    pub async fn remove_workload(&self, id: &str, caller: Option<&str>) -> Result<()> {
        let row = self.inner.store.own_workload(id, caller, "delete").await?;
        let what = crate::owned::sql::OwnedIds { workloads: vec![row.id], ..Default::default() };
        self.remove(caller.unwrap_or_default(), what).await.map(|_| ())
    }

    /// # Errors
    /// `NotFound` when the workload is there and somebody else's.
    #[boxed]
    pub async fn workload_is_for(&self, id: &str, viewer: Option<&str>) -> Result<()> {
        match self.inner.store.workload(id).await? {
            Some(row) if row.owner.as_deref() != viewer => Err(no_workload(id)),
            _ => Ok(()),
        }
    }
}

impl Store {
    pub(super) async fn workload_row(&self, id: &str) -> Result<WorkloadRow> {
        self.workload(id).await?.ok_or_else(|| no_workload(id))
    }

    async fn workload_info(&self, row: WorkloadRow) -> Result<WorkloadInfo> {
        let waits = row.state == State::Queued;
        let runs_ahead = if waits { self.workloads_before(&row).await? } else { 0 };
        let WorkloadRow { id, spec, recording, state, done, message, created_us, finished_us, .. } = row;
        let total = recording.queries;
        Ok(WorkloadInfo {
            id,
            spec,
            recording,
            state,
            done,
            total,
            runs_ahead,
            message,
            created_us,
            finished_us,
            result: None,
        })
    }

    async fn own_workload(&self, id: &str, caller: Option<&str>, may: &str) -> Result<WorkloadRow> {
        let row = self.workload_row(id).await?;
        if caller.is_some() && row.owner.as_deref() == caller {
            return Ok(row);
        }
        Err(EngineError::Forbidden(format!("Only the owner of this recording may {may} it.")))
    }
}

impl Work {
    /// The row first: a replay that ends at this moment finds it ended.
    pub(crate) async fn end_workload(&self, store: &Store, id: &str, reason: Option<&str>) -> Result<()> {
        store.end_workload(id, State::Cancelled, reason).await?;
        self.stop_current(Some(id), None);
        store.withdraw(Kind::Replay, id, &self.worker).await.map(|_| ())
    }
}

fn describe(name: &str, bytes: &[u8], recording: &Recording) -> RecordingInfo {
    RecordingInfo {
        file: name.to_owned(),
        sha256: sha256_hex(bytes),
        bytes: bytes.len() as u64,
        program: recording.about.program.clone(),
        libraries: recording.about.libraries.clone(),
        objects: recording.scene.scene.objects.len() as u64,
        queries: recording.queries.len() as u64,
        seen: recording.about.seen,
    }
}

/// There is no such workload, or not for who asks: both sound alike.
fn no_workload(id: &str) -> EngineError {
    EngineError::NotFound(format!("There is no workload {id:?}; check the link."))
}
