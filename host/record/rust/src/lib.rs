//! Records what a program asks of any collision library, so that `ocb bench --workload` can put the same queries to every
//! algorithm of OpenCollBench.
//!
//! ```
//! use std::time::Instant;
//! use opencollbench_record::{IDENTITY, Kind, Query, Recording, Shape};
//!
//! # let folder = tempfile::tempdir()?;
//! # let spool = folder.path().join("spool");
//! let recording = Recording::create(&spool, "planner", "my library", "1.2")?;
//! let can = recording.object("can", Shape::Cylinder { radius: 0.03, length: 0.1 })?;
//! let tetrahedron = recording.object("tetrahedron", Shape::Mesh {
//!     vertices: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
//!     triangles: &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
//! })?;
//! for state in 0..10 {
//!     let mut of_can = IDENTITY;
//!     of_can[3] = f64::from(state);
//!     let begun = Instant::now();
//!     let hit = state == 0; // what the library answers
//!     let time = Some(begun.elapsed());
//!     let query = Query::new(Kind::Collide, [can, tetrahedron], [of_can, IDENTITY]);
//!     recording.query(&Query { hit: Some(hit), time, group: state as u64, ..query })?;
//! }
//! recording.close()?;
//! # assert_eq!(std::fs::metadata(spool.join("queries.bin"))?.len(), 10 * 256);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Then `ocb record --spool spool --out planner.ocbrec` makes the recording.
//!
//! * A query is in the spool, a folder, when [`Recording::query`] returns. A program that is killed leaves what it asked.
//! * All functions take `&self` and may be called by several threads at once. None of them panics.
//! * What cannot be recorded is refused with a [`Refusal`], and refused queries are counted in the recording by reason.
//! * A recording has at most 20,000 objects with at most 4 GiB of meshes, and as many queries as are asked, or
//!   [`Recording::limited`] to a number.
#![forbid(unsafe_code)]

mod error;
mod query;
mod shape;
mod spool;

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

pub use error::{Error, Refusal};
pub use query::{IDENTITY, Kind, Pose, Query};
pub use shape::Shape;

use spool::Spool;

/// Bytes of a name.
const LONGEST_NAME: usize = 200;

/// A recording that is being written. It ends when it is dropped, or by [`Recording::close`], which tells whether that succeeded.
pub struct Recording {
    /// Tells the recordings of a process apart.
    number: u64,
    /// Nothing after a file could not be written.
    spool: Mutex<Option<Spool>>,
}

/// An object of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Object {
    recording: u64,
    number: u32,
}

impl Recording {
    /// Begins a recording: a spool in a folder that must not exist yet. All queries are asked of this library.
    ///
    /// # Errors
    /// [`Error::File`] if the folder cannot be made; [`Refusal::Name`] if a text has more than 200 bytes or `program` is empty.
    pub fn create(folder: impl AsRef<Path>, program: &str, library: &str, version: &str) -> Result<Self, Error> {
        static RECORDINGS: AtomicU64 = AtomicU64::new(0);
        if program.is_empty() || [program, library, version].iter().any(|text| text.len() > LONGEST_NAME) {
            return Err(Refusal::Name.into());
        }
        let spool = Spool::create(folder.as_ref(), program, library, version)?;
        Ok(Self { number: RECORDINGS.fetch_add(1, Ordering::Relaxed), spool: Mutex::new(Some(spool)) })
    }

    /// Keeps at most this many queries, and at least one. When there are more, every second group is left out, then every second of
    /// those that remain, so that the kept groups are spread evenly over the run. Queries that are left out are counted.
    #[must_use]
    pub fn limited(self, queries: u64) -> Self {
        if let Some(spool) = self.spool.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            spool.limit = queries.max(1);
        }
        self
    }

    /// Adds an object, or finds the same one of the same name.
    ///
    /// # Errors
    /// [`Error::Refused`] for a shape that cannot be recorded; count queries about it with [`Recording::leave_out`].
    /// [`Error::File`] if it cannot be written.
    pub fn object(&self, name: &str, shape: Shape<'_>) -> Result<Object, Error> {
        if name.is_empty() || name.len() > LONGEST_NAME {
            return Err(Refusal::Name.into());
        }
        let number = self.with(|spool| spool.object(name, &shape))?;
        Ok(Object { recording: self.number, number })
    }

    /// Adds a query, in the order of the calls.
    ///
    /// # Errors
    /// [`Error::Refused`] for a query that cannot be recorded, which is counted; [`Error::File`] if it cannot be written.
    pub fn query(&self, query: &Query) -> Result<(), Error> {
        let ours = query.objects.iter().all(|object| object.recording == self.number);
        let row = if ours { query.row() } else { Err(Refusal::Object) };
        self.with(|spool| spool.query(query.group, row))
    }

    /// Counts a query that is not recorded, because one of its objects was refused or is of no [`Shape`].
    ///
    /// # Errors
    /// [`Error::File`] if the count cannot be written.
    pub fn leave_out(&self, group: u64) -> Result<(), Error> {
        match self.with(|spool| spool.query(group, Err(Refusal::Object))) {
            Err(Error::Refused(_)) => Ok(()),
            other => other,
        }
    }

    /// Ends the recording.
    ///
    /// # Errors
    /// [`Error::File`] if the last counts cannot be written, [`Error::Ended`] if it had ended before.
    pub fn close(self) -> Result<(), Error> {
        self.with(Spool::note)
    }

    /// Does something with the spool, unless a file could not be written before.
    fn with<T>(&self, act: impl FnOnce(&mut Spool) -> Result<T, Error>) -> Result<T, Error> {
        let mut spool = self.spool.lock().unwrap_or_else(PoisonError::into_inner);
        let done = act(spool.as_mut().ok_or(Error::Ended)?);
        // A row or a line may be there in part, and another behind it could not be read.
        if matches!(done, Err(Error::File { .. })) {
            *spool = None;
        }
        done
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        // The counts that were noted before stay.
        drop(self.with(Spool::note));
    }
}
