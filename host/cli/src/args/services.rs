//! Services elsewhere, and what one has there.

use clap::{Args, ValueEnum};

use crate::choice::VisibilityArg;

/// Which service, and as whom.
#[derive(Debug, Args)]
pub struct ServiceArgs {
    /// The service.
    #[arg(long, default_value = "http://127.0.0.1:8080", env = "OCB_SERVER", value_name = "URL")]
    pub server: String,
    /// A token of your account there, made on its account page for what you do with it: plugins, or runs and objects.
    #[arg(long, env = "OCB_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: String,
}

/// Which service, perhaps as somebody.
#[derive(Debug, Args)]
pub struct LookArgs {
    /// The service.
    #[arg(long, default_value = "http://127.0.0.1:8080", env = "OCB_SERVER", value_name = "URL")]
    pub server: String,
    /// A token of your account there, for what not everybody sees.
    #[arg(long, env = "OCB_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: Option<String>,
}

/// `ocb cite`
#[derive(Debug, Args)]
pub struct CiteArgs {
    /// What it is.
    #[arg(value_enum)]
    pub what: Cited,
    /// Its id there: the last part of its link.
    pub id: String,
    /// How.
    #[arg(long, value_enum, default_value_t = CiteAs::Bibtex)]
    pub format: CiteAs,
    #[command(flatten)]
    pub service: LookArgs,
}

/// What is cited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Cited {
    /// A run with its results.
    Run,
    /// A plugin.
    Plugin,
}

/// How it is cited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CiteAs {
    /// An entry for BibTeX.
    Bibtex,
    /// A CITATION.cff.
    Cff,
    /// The stable link alone.
    Link,
}

/// `ocb visibility`
#[derive(Debug, Args)]
pub struct VisibilityArgs {
    /// What it is.
    #[arg(value_enum)]
    pub what: Shown,
    /// Its id there: the last part of its link.
    pub id: String,
    /// Who is to see it.
    #[arg(value_enum)]
    pub to: VisibilityArg,
    #[command(flatten)]
    pub service: ServiceArgs,
}

/// What is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Shown {
    /// A run with its results.
    Run,
    /// An object; a run is seen by no more than see its objects.
    Object,
}
