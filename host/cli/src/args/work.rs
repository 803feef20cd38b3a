//! `ocb work`

use clap::Args;

use super::secret;

/// Measuring for a service elsewhere.
#[derive(Args)]
pub struct WorkArgs {
    /// URL at which the service waits for machines, as its `--internal` says: http://HOST:PORT.
    #[arg(long, env = "OCB_INTERNAL_SERVER", value_name = "URL", hide_env_values = true)]
    pub server: String,
    /// Token of this machine, as `ocb admin machine` prints it; better `@FILE` with the token in it, because all users of this
    /// machine can see its command lines.
    #[arg(long, env = "OCB_MACHINE_TOKEN", value_name = "TOKEN", hide_env_values = true, value_parser = secret::value)]
    pub token: String,
    /// Measure the next run and end; end as well if none comes within 15 seconds.
    #[arg(long)]
    pub once: bool,
}

/// Without the token.
impl std::fmt::Debug for WorkArgs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("WorkArgs").field("server", &self.server).field("once", &self.once).finish_non_exhaustive()
    }
}
