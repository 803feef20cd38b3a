//! Where methods fail: faults that were put into a method on purpose are found, and methods without a known fault have none.

mod clean;
mod faults;

use std::path::PathBuf;

use ocb_service::StabilitySelection as Selection;
use ocb_service::model::Stability;
use ocb_service::{Engine, EngineConfig, Profile, Stop};
use ocb_tests::place::built;

/// An engine with these plugin files alone, in a folder that goes away.
async fn engine(plugins: Vec<PathBuf>) -> (Engine, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut config = EngineConfig::beside_executable(folder.path());
    config.runner = built("ocb-runner");
    config.plugins = plugins;
    config.profile = Profile::Dev;
    config.dispatch = false;
    (Engine::open(config).await.expect("an engine"), folder)
}

/// Everything of one algorithm, once, or only these parts.
async fn tried(engine: &Engine, algorithm: &str, parts: &[&str]) -> Stability {
    let parts = parts.iter().map(|part| (*part).to_owned()).collect();
    let selection = Selection { parts, seeds: 1, ..Selection::default() };
    engine.try_stability(algorithm, selection, Stop::default(), |_| ()).await.expect("answers")
}

/// The families and relations that found something, and whether it is slowness alone.
fn found(tried: &Stability) -> Vec<(&str, bool)> {
    let failing = tried.families.iter().filter(|family| family.tally.failed() || family.tally.slow > 0);
    let families = failing.map(|family| (family.family.as_str(), !family.tally.failed()));
    let broken = tried.relations.iter().filter(|relation| relation.decisions + relation.distances > 0);
    families.chain(broken.map(|relation| (relation.relation.as_str(), false))).collect()
}
