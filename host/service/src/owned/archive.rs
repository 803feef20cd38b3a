//! Everything of one owner, as one file to take along.

use std::fs::File;
use std::io::{Seek, SeekFrom};

use ocb_core::mesh::obj;
use serde::Serialize;
use tokio::runtime::Handle;

use crate::advice::sql::StoredPaper;
use crate::blocking::blocking;
use crate::boxed;
use crate::engine::Engine;
use crate::model::{AccountInfo, Owner};
use crate::{EngineError, Result};

/// What goes into an archive beside objects, runs and advice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contents {
    /// Plugins with their files.
    pub plugins: bool,
    /// Personal data: the account, its address, choices and notices.
    pub account: bool,
}

impl Contents {
    /// Everything, for the logged-in owner.
    pub const ALL: Contents = Contents { plugins: true, account: true };
}

impl Engine {
    /// What this owner has, as a tar archive; the file is gone when it is closed.
    #[boxed]
    pub async fn archive(&self, owner: &str, contents: Contents) -> Result<File> {
        let (engine, owner, handle) = (self.clone(), owner.to_owned(), Handle::current());
        blocking(move || handle.block_on(engine.packed(&owner, contents))).await
    }

    async fn packed(&self, owner: &str, contents: Contents) -> Result<File> {
        let mut packer = Packer::new(&self.inner.config.data)?;
        let all = self.inner.store.owned_ids(owner, None).await?;
        packer.json("items.json", &self.owned_items(owner).await?)?;
        for object in &all.objects {
            let folder = format!("objects/{}", object.id);
            packer.json(&format!("{folder}/object.json"), &self.object(&object.id, Some(owner)).await?)?;
            packer.add(&format!("{folder}/object.obj"), obj::write(&*self.mesh(&object.id).await?).as_bytes())?;
        }
        for run in &all.runs {
            // With an object that was hidden from them since, nothing of the run is there for its owner either.
            if is_there(self.run_is_for(&run.id, Some(owner)).await)? {
                self.pack_run(&mut packer, &run.id, owner).await?;
            }
        }
        for id in &all.advice {
            if is_there(self.advice_is_for(id, Some(owner)).await)? {
                self.pack_advice(&mut packer, id).await?;
            }
        }
        for saved in &all.configurations {
            let (told, bytes) = self.saved_file(&saved.id, owner).await?;
            packer.json(&format!("configurations/{}.json", saved.id), &told)?;
            packer.add(&format!("configurations/{}.file", saved.id), &bytes)?;
        }
        for id in &all.stability {
            packer.json(&format!("stability/{id}.json"), &self.stability_run(id).await?)?;
        }
        for id in &all.workloads {
            self.pack_workload(&mut packer, id).await?;
        }
        if let Some(account) = self.account_of(owner).await? {
            if contents.account {
                self.pack_account(&mut packer, &account).await?;
            }
            if contents.plugins {
                self.pack_plugins(&mut packer, &account).await?;
            }
        }
        packer.finish()
    }

    async fn pack_run(&self, packer: &mut Packer, id: &str, owner: &str) -> Result<()> {
        let run = self.run(id, Some(owner)).await?;
        let folder = format!("runs/{id}");
        if run.set.is_some() {
            packer.add(&format!("{folder}/configurations.parquet"), &self.configurations_parquet(id).await?)?;
        }
        for stored in self.inner.store.results(id).await?.iter().filter(|stored| stored.records.is_some()) {
            let algorithm = &stored.result.algorithm;
            let records = self.records_parquet(id, algorithm).await?;
            packer.add(&format!("{folder}/{}.parquet", plain(algorithm)), &records)?;
            if let Some(tests) = &stored.triangle_tests {
                packer.add(
                    &format!("{folder}/{}.triangles.parquet", plain(algorithm)),
                    &self.inner.blobs.get(tests).await?,
                )?;
            }
        }
        packer.json(&format!("{folder}/run.json"), &run)
    }

    async fn pack_advice(&self, packer: &mut Packer, id: &str) -> Result<()> {
        let folder = format!("advice/{id}");
        packer.json(&format!("{folder}/advice.json"), &self.advice(id).await?)?;
        let Some(row) = self.inner.store.advice(id).await? else { return Ok(()) };
        for StoredPaper { mesh, certificate, file } in row.papers.iter().flatten() {
            let (mesh, certificate) = (self.inner.blobs.get(mesh).await?, self.inner.blobs.get(certificate).await?);
            packer.add(&format!("{folder}/{}", plain(file)), &mesh)?;
            packer.add(&format!("{folder}/{}", plain(&file.replace(".obj", ".certificate.json"))), &certificate)?;
        }
        Ok(())
    }

    async fn pack_workload(&self, packer: &mut Packer, id: &str) -> Result<()> {
        let folder = format!("workloads/{id}");
        let workload = self.workload(id).await?;
        packer.json(&format!("{folder}/workload.json"), &workload)?;
        packer.add(&format!("{folder}/recording.ocbrec"), &self.workload_recording(id).await?.0)?;
        if let Some(result) = workload.result {
            packer.add(&format!("{folder}/queries.parquet"), &self.workload_queries(id).await?)?;
            if result.reduced.is_some() {
                packer.add(&format!("{folder}/reduced.ocbrec"), &self.reduced_recording(id).await?.0)?;
            }
        }
        Ok(())
    }

    /// Guests have none.
    async fn account_of(&self, owner: &str) -> Result<Option<AccountInfo>> {
        match Owner::of(owner).account() {
            Some(account) => self.inner.store.account(account).await,
            None => Ok(None),
        }
    }

    /// The account with its choices and notices.
    async fn pack_account(&self, packer: &mut Packer, account: &AccountInfo) -> Result<()> {
        packer.json("account.json", account)?;
        packer.json("choices.json", &self.choices(account).await?)?;
        packer.json("notices.json", &self.all_notices(account).await?)
    }

    /// Its plugins with their manifests and reports.
    async fn pack_plugins(&self, packer: &mut Packer, account: &AccountInfo) -> Result<()> {
        for row in self.inner.store.plugins().await?.iter().filter(|row| row.account == account.id) {
            let folder = format!("plugins/{}", row.id);
            packer.json(&format!("{folder}/plugin.json"), &self.plugin(&row.id, Some(account)).await?)?;
            packer.add(&format!("{folder}/{}", plain(&row.file)), &self.inner.blobs.get(&row.blob).await?)?;
        }
        Ok(())
    }
}

/// What is hidden is left out; a fault ends the packing, so that nothing is missing without a word.
fn is_there(looked: Result<()>) -> Result<bool> {
    match looked {
        Ok(()) => Ok(true),
        Err(EngineError::NotFound(_)) => Ok(false),
        Err(fault) => Err(fault),
    }
}

/// A file name on every system.
fn plain(name: &str) -> String {
    let keep = |c: char| if c.is_ascii_alphanumeric() || "._-@=+".contains(c) { c } else { '_' };
    name.chars().map(keep).collect()
}

struct Packer {
    tar: tar::Builder<File>,
}

impl Packer {
    fn new(folder: &std::path::Path) -> Result<Self> {
        let file = tempfile::tempfile_in(folder).map_err(|e| fault(&e))?;
        Ok(Self { tar: tar::Builder::new(file) })
    }

    fn json(&mut self, path: &str, value: &impl Serialize) -> Result<()> {
        let text = serde_json::to_vec_pretty(value).map_err(|e| EngineError::fault("Writing JSON failed", e))?;
        self.add(path, &text)
    }

    fn add(&mut self, path: &str, bytes: &[u8]) -> Result<()> {
        let mut header = tar::Header::new_gnu();
        header.set_size(bytes.len() as u64);
        header.set_mode(0o644);
        self.tar.append_data(&mut header, format!("opencollbench/{path}"), bytes).map_err(|e| fault(&e))
    }

    fn finish(self) -> Result<File> {
        let mut file = self.tar.into_inner().map_err(|e| fault(&e))?;
        file.seek(SeekFrom::Start(0)).map_err(|e| fault(&e))?;
        Ok(file)
    }
}

fn fault(e: &std::io::Error) -> EngineError {
    EngineError::fault("Packing the archive failed", e)
}
