//! Which algorithms there are. A plugin is only ever loaded by the jailed runner, also to read its name.

pub mod sql;
pub mod submitted;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock, RwLockReadGuard};

use ocb_core::query::Query;
use ocb_lab::algorithm::{Algorithm, Runner, plugin_files, plugin_hash};
use ocb_sandbox::Profile;

use crate::blobs::Blobs;
use crate::blocking::blocking;
use crate::model::AlgorithmInfo;
use crate::store::Store;
use crate::{EngineConfig, EngineError, Result, boxed};

use submitted::{AllSubmitted, submitted};

/// Our algorithms that a run measures by default: each kind once. Third-party plugins are measured as well. `all`
/// takes every algorithm; with thirty installed, that can take an hour.
const USUAL: [&str; 4] = ["box-tree", "brute-force", "ocb-fast", "parry"];

/// So many algorithms with settings are remembered.
const MAX_KNOWN: usize = 1000;

/// The known plugins.
pub struct Registry {
    store: Store,
    blobs: Blobs,
    /// The data folder, where the files of submitted plugins are.
    data: PathBuf,
    runner: Runner,
    algorithms: Vec<Arc<Algorithm>>,
    submitted: RwLock<AllSubmitted>,
    /// Held from reading which submitted plugins are offered until they are.
    offering: tokio::sync::Mutex<()>,
    /// What algorithms answer with their settings, by plugin file and name.
    queries: Mutex<HashMap<(String, String), Vec<Query>>>,
    problems: Vec<String>,
}

impl Registry {
    /// Looks through the configured files and folders. A file that was described before is not loaded again; one that
    /// cannot be described is a problem of its own and keeps no other from being offered.
    pub async fn open(config: &EngineConfig, store: &Store, blobs: &Blobs) -> Result<Self> {
        let mut registry = Self {
            store: store.clone(),
            blobs: blobs.clone(),
            data: config.data.clone(),
            runner: Runner { program: config.runner.clone(), profile: config.profile },
            algorithms: Vec::new(),
            submitted: RwLock::default(),
            offering: tokio::sync::Mutex::default(),
            queries: Mutex::default(),
            problems: Vec::new(),
        };
        if !config.runner.is_file() {
            registry.problems.push(format!(
                "The runner {} is missing, so nothing can be measured; build it or specify it with --runner.",
                config.runner.display()
            ));
            return Ok(registry);
        }
        let mut all: Vec<Arc<Algorithm>> = Vec::new();
        for file in plugin_files(&config.plugins) {
            match registry.describe(&file).await {
                Ok(found) => {
                    for algorithm in found {
                        if let Some(twin) = all.iter().find(|c| c.info.id == algorithm.info.id) {
                            registry.problems.push(format!(
                                "The algorithm {:?} is in both {} and {}; only the first is used.",
                                algorithm.info.id,
                                twin.file.display(),
                                file.display()
                            ));
                        } else {
                            all.push(Arc::new(algorithm));
                        }
                    }
                }
                Err(e) => registry.problems.push(format!("The plugin {} is not available: {e}", file.display())),
            }
        }
        all.sort_by(|x, y| x.info.id.cmp(&y.info.id));
        registry.problems.iter().for_each(|problem| tracing::warn!("{problem}"));
        registry.algorithms = all;
        Ok(registry)
    }

    /// Those that this viewer may ask for, by id.
    pub fn algorithms(&self, viewer: Option<&str>) -> Vec<AlgorithmInfo> {
        let mut all: Vec<AlgorithmInfo> = self.algorithms.iter().map(|c| c.info.clone()).collect();
        let submitted = self.submitted();
        all.extend(submitted.plugins.iter().filter(|b| b.is_for(viewer)).map(|b| b.algorithm.info.clone()));
        all.sort_by(|x, y| x.id.cmp(&y.id));
        all
    }

    /// Those of the installed plugins, by id.
    pub fn installed(&self) -> Vec<AlgorithmInfo> {
        self.algorithms.iter().map(|c| c.info.clone()).collect()
    }

    /// Those that everybody may ask for, each in its newest version.
    pub fn public(&self) -> Vec<AlgorithmInfo> {
        let mut all = self.algorithms(None);
        all.retain(|algorithm| !algorithm.id.contains('@'));
        all
    }

    /// Offers, of all that developers submitted, what may be benchmarked now.
    #[boxed]
    pub async fn renew(&self) -> Result<()> {
        // Of two that read, the later one offers last.
        let _offering = self.offering.lock().await;
        let all = submitted(&self.store, &self.blobs, &self.data).await?;
        *self.submitted.write().unwrap_or_else(PoisonError::into_inner) = all;
        Ok(())
    }

    fn submitted(&self) -> RwLockReadGuard<'_, AllSubmitted> {
        self.submitted.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// Nobody but its author may ask for this plugin file now.
    pub fn is_private(&self, algorithm: &Algorithm) -> bool {
        let file = &algorithm.info.plugin_sha256;
        let submitted = self.submitted();
        let mut twins = submitted.plugins.iter().filter(|b| b.algorithm.info.plugin_sha256 == *file).peekable();
        twins.peek().is_some() && twins.all(|b| !b.public)
    }

    /// What keeps something from being offered.
    pub fn problems(&self) -> Vec<String> {
        self.problems.iter().chain(&self.submitted().problems).cloned().collect()
    }

    /// What loads plugins here.
    pub fn runner(&self) -> &Runner {
        &self.runner
    }

    /// How much a foreign plugin needs of this machine.
    pub fn profile(&self) -> Profile {
        self.runner.profile
    }

    /// The installed algorithm with this id.
    pub fn algorithm(&self, id: &str) -> Option<Arc<Algorithm>> {
        self.algorithms.iter().find(|c| c.info.id == id).cloned()
    }

    /// The algorithm of this name, which may carry settings (`box-tree:leaf_size=4`); `None` when there is no such id for
    /// this viewer.
    pub fn choose(&self, name: &str, viewer: Option<&str>) -> Result<Option<Arc<Algorithm>>> {
        let (id, settings) = name.split_once(':').map_or((name, None), |(id, settings)| (id, Some(settings)));
        let submitted = || {
            let all = self.submitted();
            all.plugins.iter().find(|b| b.algorithm.info.id == id && b.is_for(viewer)).map(|b| b.algorithm.clone())
        };
        match (self.algorithm(id).or_else(submitted), settings) {
            (Some(plain), Some(settings)) => Ok(Some(Arc::new(plain.with_settings(settings)?))),
            (found, _) => Ok(found),
        }
    }

    /// The same, or why there is none.
    pub fn named(&self, name: &str, viewer: Option<&str>) -> Result<Arc<Algorithm>> {
        let unknown = || {
            let known: Vec<String> = self.algorithms(viewer).into_iter().map(|a| a.id).collect();
            EngineError::Invalid(format!("There is no algorithm {name:?}; available: {}.", known.join(", ")))
        };
        self.choose(name, viewer)?.ok_or_else(unknown)
    }

    /// The kinds of query that an algorithm answers with its settings; a plugin may have to be asked.
    pub async fn queries(&self, algorithm: &Arc<Algorithm>) -> Result<Vec<Query>> {
        if algorithm.settings.is_empty() {
            return Ok(algorithm.info.queries.clone());
        }
        let name = (algorithm.info.plugin_sha256.clone(), algorithm.info.id.clone());
        let known = || -> MutexGuard<'_, _> { self.queries.lock().unwrap_or_else(PoisonError::into_inner) };
        if let Some(queries) = known().get(&name) {
            return Ok(queries.clone());
        }
        let (runner, asked) = (self.runner.clone(), algorithm.clone());
        // How an algorithm ends that ends here is told, with its outcome, when it is measured.
        let Ok(queries) = blocking(move || Ok(runner.queries(&asked))).await? else {
            return Ok(algorithm.info.queries.clone());
        };
        let mut known = known();
        if known.len() >= MAX_KNOWN {
            known.clear();
        }
        known.insert(name, queries.clone());
        Ok(queries)
    }

    /// The algorithms of the plugin file with this hash that are offered here, to whomever.
    pub fn of_file(&self, sha256: &str) -> Vec<Arc<Algorithm>> {
        let submitted = self.submitted();
        let all = self.algorithms.iter().chain(submitted.plugins.iter().map(|b| &b.algorithm));
        all.filter(|c| c.info.plugin_sha256 == sha256).cloned().collect()
    }

    /// The algorithms of a file that somebody gives us and that is offered to nobody.
    pub async fn foreign(&self, file: &Path, sha256: &str) -> Result<Vec<Arc<Algorithm>>> {
        let described = self.described(file, sha256, false).await?;
        Ok(described.into_iter().map(|info| Arc::new(Algorithm::plain(info, file.to_owned(), false))).collect())
    }

    /// The one among these that is meant by the name that a run knew it by, which may carry a version and settings.
    pub fn chosen_of(&self, known: &[Arc<Algorithm>], name: &str) -> Result<Option<Algorithm>> {
        let (id, settings) = name.split_once(':').map_or((name, None), |(id, settings)| (id, Some(settings)));
        let id = id.split('@').next().unwrap_or(id);
        let plain = known.iter().find(|c| c.id_in_plugin == id);
        match (plain, settings) {
            (Some(plain), Some(settings)) => Ok(Some(plain.with_settings(settings)?)),
            (plain, _) => Ok(plain.map(|plain| Algorithm::clone(plain))),
        }
    }

    /// The algorithms of an installed file. One that was described before is not loaded again.
    async fn describe(&self, file: &Path) -> Result<Vec<Algorithm>> {
        let path = file.to_owned();
        let sha256 = blocking(move || Ok(plugin_hash(&path)?)).await?;
        let trusted = self.runner.trusts(file);
        let known_as = self.runner.known_as(file, &sha256)?;
        // A row that an older version wrote may lack a field; then the plugin is described again.
        let algorithms = match self.store.described(&known_as).await {
            Ok(Some(known)) if known.iter().all(|algorithm| !algorithm.builds.is_empty()) => known,
            _ => {
                let described = self.described(file, &sha256, trusted).await?;
                self.store.keep_description(&known_as, &described).await?;
                described
            }
        };
        let algorithm = |mut info: AlgorithmInfo| {
            info.usual = !trusted || USUAL.contains(&info.id.as_str());
            Algorithm::plain(info, file.to_owned(), trusted)
        };
        Ok(algorithms.into_iter().map(algorithm).collect())
    }

    /// What the file with this hash says of itself, asked in the jail.
    async fn described(&self, file: &Path, sha256: &str, trusted: bool) -> Result<Vec<AlgorithmInfo>> {
        let (runner, path, hash) = (self.runner.clone(), file.to_owned(), sha256.to_owned());
        blocking(move || Ok(runner.describe(&path, &hash, trusted)?)).await
    }
}
