//! Advice that measuring machines make.

use std::sync::Arc;

use ocb_advice::{Advice, Paper};
use ocb_core::mesh::Mesh;
use ocb_lab::advisor::Request;
use ocb_lab::mesh_file::from_bytes;

use super::no_advice;
use super::work::{Advices, extent};
use crate::attempts::Attempt;
use crate::attempts::worker::Worker;
use crate::blocking::blocking;
use crate::model::{AdviceInfo, Errand, State, Told, Wanted};
use crate::{EngineError, Result};

impl Advices {
    /// The one that is due: of visitors, or the service's own. What cannot be made ends here.
    pub async fn errand(&self, own: bool, worker: &Worker) -> Result<Option<Errand>> {
        while let Some((attempt, info)) = self.begin(own, worker).await? {
            let meshes = match self.meshes_of(&info.spec).await {
                Ok(meshes) => meshes,
                Err(e) => {
                    self.end(&attempt, info, Err(e)).await?;
                    continue;
                }
            };
            let info = AdviceInfo { state: State::Running, ..info };
            if !self.from.store.advice_is_at(&attempt, &info).await? {
                continue;
            }
            let wanted = Wanted::Advise {
                question: info.spec.question,
                names: info.names,
                meshes: meshes.map(|mesh| mesh.sha256()),
                counts: extent(self.from.quick),
            };
            return Ok(Some(Errand { attempt: attempt.id, job: attempt.job, wanted, most_seconds: None }));
        }
        Ok(None)
    }

    /// The meshes of both objects of a request.
    pub async fn meshes_for(&self, id: &str) -> Result<[Arc<Mesh>; 2]> {
        let row = self.from.store.advice(id).await?.ok_or_else(|| no_advice(id))?;
        self.meshes_of(&row.info.spec).await
    }

    /// Keeps how far a machine is; false when the attempt is not the current one.
    pub async fn told(&self, attempt: &Attempt, told: &Told) -> Result<bool> {
        let Told::Step { what, done, total } = told else { return Ok(true) };
        let Some(row) = self.from.store.advice(&attempt.job).await? else { return Ok(false) };
        let info = AdviceInfo { step: what.clone(), done: *done, total: *total, ..row.info };
        self.from.store.advice_is_at(attempt, &info).await
    }

    /// Takes the advice of a machine about objects with these hashes, with the reduced meshes; false when the attempt is not the
    /// current one.
    pub async fn take(
        &self,
        attempt: &Attempt,
        objects: &[String; 2],
        (advice, papers): (Advice, [Vec<Paper>; 2]),
        files: Vec<Vec<u8>>,
    ) -> Result<bool> {
        let Some(row) = self.from.store.advice(&attempt.job).await? else { return Ok(false) };
        let meshes = self.meshes_of(&row.info.spec).await?;
        let (AdviceInfo { spec, names, .. }, objects) = (row.info.clone(), objects.clone());
        let found = blocking(move || {
            if advice.question != Request::of(spec.question, names, meshes, [0; 2]).question {
                return Err(wrong("it answers another question"));
            }
            if files.len() != papers.iter().map(Vec::len).sum::<usize>() {
                return Err(wrong("there is a file too many or too few"));
            }
            let mut files = files.into_iter();
            let [of_a, of_b] = papers;
            let [a, b] = &objects;
            Ok((advice, [reduced(of_a, a, &mut files)?, reduced(of_b, b, &mut files)?]))
        });
        self.end(attempt, row.info, Ok(Some(found.await?))).await
    }

    /// Notes why a machine made none.
    pub async fn not_done(&self, attempt: &Attempt, why: EngineError) -> Result<()> {
        let Some(row) = self.from.store.advice(&attempt.job).await? else { return Ok(()) };
        self.end(attempt, row.info, Err(why)).await.map(|_| ())
    }
}

/// The reduced meshes of an object with the certificates that speak of them.
fn reduced(
    papers: Vec<Paper>,
    object: &str,
    files: &mut impl Iterator<Item = Vec<u8>>,
) -> Result<Vec<(Paper, Arc<Mesh>)>> {
    let read = |(paper, bytes): (Paper, Vec<u8>)| {
        let mesh = from_bytes(&bytes).map_err(|e| wrong(&e.to_string()))?;
        if paper.certificate.object != object || paper.certificate.reduced != mesh.sha256() {
            return Err(wrong("a certificate speaks of another mesh"));
        }
        Ok((paper, Arc::new(mesh)))
    };
    papers.into_iter().zip(files).map(read).collect()
}

fn wrong(what: &str) -> EngineError {
    EngineError::Invalid(format!("This is not the advice that was ordered: {what}."))
}
