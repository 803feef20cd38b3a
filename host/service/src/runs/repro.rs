//! A run as a repro archive, and asking one again.

use std::fs::File;
use std::sync::Arc;

use ocb_core::instance;
use ocb_core::mesh::{Mesh, obj};
use ocb_core::validation::Precision;
use ocb_lab::algorithm::{Algorithm, read_plugin};
use ocb_lab::check::is_free;
use ocb_lab::pairing::Pairing;
use tokio::runtime::Handle;

use crate::blocking::blocking;
use crate::boxed;
use crate::columns::{AnswerRow, read_answers, set_versions};
use crate::engine::Engine;
use crate::model::{ObjectId, Recipe, RecipeAlgorithm, RecipeObject, RecipeVersions, Replay, Replayed, State};
use crate::plugins::registry::submitted;
use crate::replay::{Packing, Questions, Unpacked};
use crate::results::not_yet;
use crate::results::sql::StoredResult;
use crate::runs::sql::RunRow;
use crate::sha256_hex;
use crate::{EngineError, Result};

impl Engine {
    /// A run that has ended as a repro archive; the file is gone when it is closed.
    #[boxed]
    pub async fn repro(&self, run: &str) -> Result<File> {
        let (engine, run, handle) = (self.clone(), run.to_owned(), Handle::current());
        blocking(move || handle.block_on(engine.repro_of(&run))).await
    }

    async fn repro_of(&self, run: &str) -> Result<File> {
        let row = self.inner.store.run_row(run).await?;
        if matches!(row.state, State::Queued | State::Running) {
            return Err(EngineError::Busy("This run has not ended; it can be exported when it has.".into()));
        }
        let (Some(set), Some(environment)) = (&row.set_blob, &row.environment) else { return Err(not_yet(run)) };
        let seed = environment.draw.as_ref().ok_or_else(too_old)?.seed;
        let mut packing = Packing::begin(&self.inner.config.data)?;
        let set = self.inner.blobs.get(set).await?;
        let (sampling, oracle) = set_versions(&set)?;
        let recipe = Recipe {
            format: 0,
            version: environment.version.clone(),
            run: row.id.clone(),
            spec: row.spec.clone(),
            seed,
            versions: RecipeVersions { sampling, oracle, instances: instance::VERSION },
            objects: self.repro_objects(&row, &mut packing).await?,
            configurations: packing.add("configurations.parquet", &set)?,
            algorithms: self.repro_answers(&row, &mut packing).await?,
            environment: environment.clone(),
            files: Vec::new(),
        };
        Ok(packing.finish(recipe)?)
    }

    async fn repro_objects(&self, row: &RunRow, packing: &mut Packing) -> Result<Vec<RecipeObject>> {
        let mut objects = Vec::new();
        for (letter, id) in [("a", Some(&row.spec.object_a)), ("b", row.spec.object_b.as_ref())] {
            let Some(id) = id else { continue };
            let info = self.inner.objects.info(id).await?;
            let file = if info.stock {
                None
            } else {
                let text = obj::write(&*self.inner.objects.mesh(id).await?);
                Some(packing.add(&format!("objects/{letter}.obj"), text.as_bytes())?)
            };
            objects.push(RecipeObject { id: info.id, name: info.name, sha256: info.sha256, file });
        }
        Ok(objects)
    }

    async fn repro_answers(&self, row: &RunRow, packing: &mut Packing) -> Result<Vec<RecipeAlgorithm>> {
        let mut algorithms = Vec::new();
        for StoredResult { result, records, plugin_sha256, .. } in self.inner.store.results(&row.id).await? {
            let Some(records) = records else { continue };
            let records = self.inner.blobs.get(&records).await?;
            read_answers(&records).map_err(|_| too_old())?;
            // By number: two ids may differ by nothing that a file name shows.
            let answers = packing.add(&format!("answers/{}.parquet", algorithms.len() + 1), &records)?;
            let plugin = self.free_plugin(&plugin_sha256, packing)?;
            algorithms.push(RecipeAlgorithm {
                id: result.algorithm,
                plugin_sha256,
                plugin,
                rounded: result.rounded,
                answers,
            });
        }
        Ok(algorithms)
    }

    /// Adds the plugin's file where it is known and its licence lets it be given away.
    fn free_plugin(&self, sha256: &str, packing: &mut Packing) -> Result<Option<String>> {
        let path = format!("plugins/{sha256}.so");
        if packing.has(&path) {
            return Ok(Some(path));
        }
        let known = self.inner.registry.of_file(sha256);
        let Some(found) = known.first().filter(|c| is_free(&c.info.license)) else { return Ok(None) };
        let bytes = read_plugin(&found.file)?;
        // It may have been replaced since the service began.
        if sha256_hex(&bytes) != sha256 {
            return Ok(None);
        }
        Ok(Some(packing.add(&path, &bytes)?))
    }

    /// Asks everything in the archive again, or these algorithms of it; `each` hears of every algorithm when it is through.
    pub async fn replay(
        &self,
        archive: Unpacked,
        only: &[String],
        mut each: impl FnMut(&Replayed) + Send + 'static,
    ) -> Result<Replay> {
        let recipe = &archive.recipe;
        if let Some(unknown) = only.iter().find(|id| recipe.algorithms.iter().all(|a| a.id != **id)) {
            let there_are: Vec<&str> = recipe.algorithms.iter().map(|a| a.id.as_str()).collect();
            return Err(EngineError::Invalid(format!(
                "The algorithm {unknown:?} is not in this archive; available: {}.",
                there_are.join(", ")
            )));
        }
        let mesh_a = self.replayed_object(&archive, 0).await?;
        let mesh_b = if recipe.objects.len() > 1 { Some(self.replayed_object(&archive, 1).await?) } else { None };
        let mut asked = Vec::new();
        for algorithm in recipe.algorithms.iter().filter(|a| only.is_empty() || only.contains(&a.id)) {
            let found = match self.same_plugin(&archive, algorithm).await {
                Ok(found) => found.ok_or_else(|| not_here(algorithm)),
                Err(EngineError::Invalid(why)) => Err(why),
                Err(fault) => return Err(fault),
            };
            asked.push((algorithm.clone(), archive.answers(algorithm)?, found));
        }
        let inner = self.inner.clone();
        // A thread of its own: a jail ends with the thread that started it.
        let (sender, algorithms) = tokio::sync::oneshot::channel();
        std::thread::spawn(move || {
            let (recipe, poses) = (&archive.recipe, &archive.poses);
            let (pairing, runner) = (&Pairing::new(mesh_a, mesh_b), inner.registry.runner());
            let questions = Questions { recipe, runner, pairing, poses };
            let ask = |(of, rows, found): (RecipeAlgorithm, Vec<AnswerRow>, std::result::Result<Algorithm, String>)| {
                let (algorithm, precision) = (of.id, if of.rounded { Precision::Single } else { Precision::Double });
                let replayed = match found {
                    Ok(found) => Replayed { algorithm, ..questions.ask(&found, precision, &rows) },
                    Err(why) => {
                        Replayed { algorithm, answers: rows.len() as u32, equal: 0, first: None, trouble: Some(why) }
                    }
                };
                each(&replayed);
                replayed
            };
            let algorithms: Vec<Replayed> = asked.into_iter().map(ask).collect();
            let _ = sender.send((recipe.run.clone(), algorithms));
        });
        let broken = |_| EngineError::Fault("Repeating the queries failed.".into());
        let (run, algorithms) = algorithms.await.map_err(broken)?;
        Ok(Replay { run, identical: algorithms.iter().all(Replayed::is_identical), algorithms })
    }

    /// The object as it was then.
    async fn replayed_object(&self, archive: &Unpacked, number: usize) -> Result<Arc<Mesh>> {
        let of = &archive.recipe.objects[number];
        let bad = |why: String| EngineError::Invalid(format!("The archive's object {:?} {why}.", of.name));
        let mesh = match archive.object(of) {
            Some(bytes) => Arc::new(obj::read(bytes).map_err(|e| bad(format!("cannot be read: {e}")))?.mesh),
            None if ObjectId::of(&of.id).is_stock() => self.inner.objects.mesh(&of.id).await?,
            None => return Err(bad("is missing".into())),
        };
        if mesh.sha256() != of.sha256 {
            return Err(bad("is not the object of the run: its SHA-256 differs".into()));
        }
        Ok(mesh)
    }

    /// The algorithm in the very file that answered then: one that is installed here, or the archive's own copy.
    async fn same_plugin(&self, archive: &Unpacked, of: &RecipeAlgorithm) -> Result<Option<Algorithm>> {
        let registry = &self.inner.registry;
        let mut known = registry.of_file(&of.plugin_sha256);
        if let (true, Some(bytes)) = (known.is_empty(), archive.plugin(of)) {
            let sha256 = self.inner.blobs.put(bytes.to_vec()).await?;
            if sha256 != of.plugin_sha256 {
                return Err(EngineError::Invalid(format!("The archive's plugin for {:?} is another file.", of.id)));
            }
            let file = submitted::plugin_file(&self.inner.blobs, &self.inner.config.data, &sha256).await?;
            known = registry.foreign(&file, &sha256).await?;
        }
        registry.chosen_of(&known, &of.id)
    }
}

fn not_here(of: &RecipeAlgorithm) -> String {
    format!(
        "Its plugin, the file with the SHA-256 {}, is neither in the archive nor installed here; provide it with \
         --plugins.",
        of.plugin_sha256
    )
}

fn too_old() -> EngineError {
    let told = "This run was measured by a version that did not record the instance of each query; measure it again.";
    EngineError::Busy(told.into())
}
