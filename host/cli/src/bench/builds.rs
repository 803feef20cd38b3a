//! How the algorithms of a run were compiled, below its table.

use ocb_service::model::AlgorithmResult;

use crate::output;

/// One row for each file of each algorithm; nothing for runs of older versions.
pub fn table(results: &[AlgorithmResult]) -> Option<String> {
    let or = |said: &[String], none: &str| if said.is_empty() { none.to_owned() } else { said.join(", ") };
    let rows = results.iter().flat_map(|result| {
        result.builds.iter().map(move |build| {
            vec![
                result.algorithm.clone(),
                build.file.clone(),
                or(&build.compilers, "does not say"),
                or(&build.flags, "not recorded"),
                or(&build.instruction_sets, "x86-64 alone"),
            ]
        })
    });
    let rows: Vec<Vec<String>> = rows.collect();
    (!rows.is_empty()).then(|| output::table(&["built", "file", "compiler", "options", "instruction sets"], rows, &[]))
}
