//! Services elsewhere, and what one has there.

use clap::{Args, ValueEnum};

use crate::choice::VisibilityArg;

/// Which service, and as whom.
#[derive(Debug, Args)]
pub struct ServiceArgs {
    /// URL of the service.
    #[arg(long, default_value = "http://127.0.0.1:8080", env = "OCB_SERVER", value_name = "URL")]
    pub server: String,
    /// Token of your account there for plugins, or for runs and objects; its account page creates tokens.
    #[arg(long, env = "OCB_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: String,
}

/// Which service, perhaps as somebody.
#[derive(Debug, Args)]
pub struct LookArgs {
    /// URL of the service.
    #[arg(long, default_value = "http://127.0.0.1:8080", env = "OCB_SERVER", value_name = "URL")]
    pub server: String,
    /// Token of your account there, for items that are not public.
    #[arg(long, env = "OCB_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: Option<String>,
}

/// `ocb cite`
#[derive(Debug, Args)]
pub struct CiteArgs {
    /// Kind of item.
    #[arg(value_enum)]
    pub what: Cited,
    /// Its id, the last part of its link.
    pub id: String,
    /// Format of the citation.
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
    /// Kind of item.
    #[arg(value_enum)]
    pub what: Shown,
    /// Its id, the last part of its link.
    pub id: String,
    /// Who can see it.
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
    /// An object; a run is visible at most to those who can see its objects.
    Object,
}
