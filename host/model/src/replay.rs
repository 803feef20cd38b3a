//! Repro archives, and what asking their questions again has shown.

use serde::{Deserialize, Serialize};

use super::{Environment, RunSpec};

/// `recipe.json` of a repro archive: everything that the answers of a run follow from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recipe {
    /// Version of the archive's format.
    pub format: u32,
    /// Version of the program that wrote it.
    pub version: String,
    /// Id of the run.
    pub run: String,
    /// What was asked.
    pub spec: RunSpec,
    /// The seed of everything that was drawn.
    pub seed: u64,
    /// Of the parts whose change would change questions or truths.
    pub versions: RecipeVersions,
    /// A, and B unless it is the same.
    pub objects: Vec<RecipeObject>,
    /// The file with the poses and their truth.
    pub configurations: String,
    /// The algorithms that answered.
    pub algorithms: Vec<RecipeAlgorithm>,
    /// The machine.
    pub environment: Environment,
    /// Every other file of the archive.
    pub files: Vec<RecipeFile>,
}

/// Versions of the parts that make questions and truths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecipeVersions {
    /// Of finding configurations, where the set says.
    pub sampling: Option<u32>,
    /// Of the oracle, where the set says.
    pub oracle: Option<u32>,
    /// Of drawing equivalent instances.
    pub instances: u32,
}

/// An object: its file, or how it is made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecipeObject {
    /// Its id; that of a stock object says how it is made.
    pub id: String,
    /// Its name.
    pub name: String,
    /// SHA-256 of its mesh.
    pub sha256: String,
    /// An OBJ file in the archive; absent for stock objects.
    pub file: Option<String>,
}

/// An algorithm and its answers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecipeAlgorithm {
    /// Its id, with its settings behind it.
    pub id: String,
    /// SHA-256 of its plugin's file.
    pub plugin_sha256: String,
    /// That file in the archive; absent where its licence does not let it be given away, or it is not known any more.
    pub plugin: Option<String>,
    /// It got the objects' coordinates rounded to single precision; the others got the numbers of the files.
    #[serde(default, skip_serializing_if = "is_false")]
    pub rounded: bool,
    /// The file with its answers.
    pub answers: String,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde gives a reference")]
fn is_false(flag: &bool) -> bool {
    !flag
}

/// A file of the archive.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecipeFile {
    /// Its path there.
    pub path: String,
    /// Its length.
    pub bytes: u64,
    /// Its SHA-256.
    pub sha256: String,
}

/// What asking all questions of an archive again has shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replay {
    /// Id of the run.
    pub run: String,
    /// Every answer of every algorithm was given again, bit for bit.
    pub identical: bool,
    /// Algorithm by algorithm.
    pub algorithms: Vec<Replayed>,
}

/// What asking one algorithm again has shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Replayed {
    /// Its id, with its settings behind it.
    pub algorithm: String,
    /// Recorded answers.
    pub answers: u32,
    /// Those that were given again, bit for bit.
    pub equal: u32,
    /// The first that was not, in the order of the configurations.
    pub first: Option<Difference>,
    /// Why it was not asked, or not everything; one sentence.
    pub trouble: Option<String>,
}

impl Replayed {
    /// Was every answer given again?
    pub fn is_identical(&self) -> bool {
        self.trouble.is_none() && self.equal == self.answers
    }
}

/// An answer that was another one this time.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// Index of the configuration.
    pub configuration: u32,
    /// What was answered in the run.
    pub recorded: String,
    /// What is answered now.
    pub replayed: String,
}
