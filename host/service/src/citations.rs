//! How runs and plugins are cited.

use ocb_citation::{Kind, Work, bibtex, cff, names};
use ocb_core::query::Query;

use crate::boxed;
use crate::engine::Engine;
use crate::model::{AccountInfo, Citation, State};
use crate::results::not_yet;
use crate::{EngineError, Result};

impl Engine {
    /// How a run that has ended is cited; `origin` is where this service is reached, such as `https://bench.example`. It names
    /// the service as its author: who asked for it is nobody's business.
    #[boxed]
    pub async fn cite_run(&self, id: &str, origin: &str) -> Result<Citation> {
        let row = self.inner.store.run_row(id).await?;
        if matches!(row.state, State::Queued | State::Running) {
            return Err(EngineError::Busy("This run has not ended; it can be cited when it has.".into()));
        }
        let (Some(set), Some(environment)) = (&row.set, &row.environment) else { return Err(not_yet(id)) };
        let results = self.inner.store.results(id).await?;
        let algorithms: Vec<String> = results
            .iter()
            .map(|stored| format!("{} ({})", stored.result.algorithm, short(&stored.plugin_sha256)))
            .collect();
        let question = match row.spec.query {
            Query::CollisionFirst => "collision queries, first contact",
            Query::CollisionAll => "collision queries, all contacts",
            Query::Proximity => "distance queries",
        };
        let count = match &row.preview {
            Some(preview) => format!("preview of {} of {} configurations", preview.n, preview.of),
            None => format!("{} configurations", set.configurations),
        };
        Ok(citation(Work {
            kind: Kind::Dataset,
            key: format!("opencollbench-run-{}", row.id),
            title: format!("{} x {}: {question}, {count}", row.object_a_name, row.object_b_name),
            authors: vec!["OpenCollBench".into()],
            at_us: row.finished_us.unwrap_or(row.created_us),
            url: format!("{origin}/r/{}", row.id),
            version: None,
            license: None,
            source: None,
            summary: format!(
                "Benchmark of collision detection by OpenCollBench {} on {} (hardware class {}), configuration set {}: {}.",
                environment.version,
                environment.cpu,
                environment.hardware_class,
                short(&set.sha256),
                algorithms.join(", ")
            ),
        }))
    }

    /// How a plugin is cited, by whoever may see it.
    #[boxed]
    pub async fn cite_plugin(&self, id: &str, viewer: Option<&AccountInfo>, origin: &str) -> Result<Citation> {
        let plugin = self.plugin(id, viewer).await?;
        let manifest = plugin.manifest;
        let algorithms: Vec<&str> = plugin.algorithms.iter().map(|algorithm| algorithm.id.as_str()).collect();
        let paper = if manifest.paper.is_empty() { String::new() } else { format!(" Paper: {}.", manifest.paper) };
        Ok(citation(Work {
            kind: Kind::Software,
            key: format!("opencollbench-plugin-{}", plugin.id),
            title: format!("{} {}", manifest.name, manifest.version),
            authors: match names(&manifest.authors) {
                none if none.is_empty() => vec![manifest.authors],
                all => all,
            },
            at_us: plugin.created_us,
            url: format!("{origin}/p/{}", plugin.id),
            version: Some(manifest.version),
            license: spdx::license_id(&manifest.license).map(|id| id.name.to_owned()),
            source: Some(manifest.source).filter(|source| !source.is_empty()),
            summary: format!(
                "Plugin for OpenCollBench with the algorithms {}; SHA-256 of its file: {}.{paper}",
                algorithms.join(", "),
                plugin.sha256
            ),
        }))
    }
}

fn citation(work: Work) -> Citation {
    Citation { bibtex: bibtex(&work), cff: cff(&work), link: work.url }
}

/// Enough of a hash to know it by.
fn short(sha256: &str) -> &str {
    sha256.get(..12).unwrap_or(sha256)
}
