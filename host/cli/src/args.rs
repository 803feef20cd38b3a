//! What can be said on the command line.

mod bench;
mod campaigns;
mod data;
mod looking;
mod mail;
mod plugins;
mod record;
mod runs;
mod scene;
mod secret;
mod services;
mod suite;
mod work;

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

pub use bench::{BenchArgs, Contacts, Question};
pub use campaigns::{CampaignArgs, CampaignCommand, CampaignOf};
pub use data::{DataCommand, Deleted, PlaceArgs};
pub use looking::{HeatmapArgs, SelectArgs, WorstArgs};
pub use mail::MailArgs;
pub use plugins::{AdminCommand, PluginCommand, SubmitArgs};
pub use record::RecordArgs;
pub use runs::{ReplayArgs, RunCommand};
pub use scene::{ImportArgs, ReduceArgs, SceneCommand, SceneHeatmapArgs};
pub use services::{CiteArgs, CiteAs, Cited, LookArgs, ServiceArgs, Shown, VisibilityArgs};
pub use suite::{SuiteCommand, SuiteRunArgs};
pub use work::WorkArgs;

use ocb_service::Profile;

use crate::board::BoardArgs;
use crate::chart::ChartArgs;
use crate::choice::Switch;
use crate::placing::PlacingArgs;

/// Benchmark of collision detection and proximity query algorithms.
#[derive(Debug, Parser)]
#[command(name = "ocb", version, about, after_help = EXIT_CODES)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub store: Store,
    /// Print JSON to stdout, and nothing else.
    #[arg(long, global = true)]
    pub json: bool,
}

const EXIT_CODES: &str = "Exit codes:
  0    success; for a benchmark: every algorithm completed and no answer was wrong
  1    internal error, or a fault of the machine; for `ocb truth pairs`: an answer differs from the truth in the file
  2    bad input; nothing was stored
  3    the run finished, but an algorithm failed or gave wrong answers; for `ocb advise --verify`: the certificate does not hold;
       for `ocb replay`: an answer differs, or a query could not be repeated
  130  stopped by Ctrl-C; the run is cancelled and all its processes have ended";

/// Where data, runner and plugins are.
#[derive(Debug, Args)]
pub struct Store {
    /// Data folder [default: $XDG_DATA_HOME/opencollbench, else ~/.local/share/opencollbench].
    #[arg(long, global = true, env = "OCB_DATA", value_name = "DIR", hide_env_values = true)]
    pub data: Option<PathBuf>,
    /// Database, `postgres://...`, or `@FILE` with that address in it [default: SQLite in the data folder].
    #[arg(long, global = true, env = "OCB_DATABASE", value_name = "URL", hide_env_values = true, value_parser = secret::value)]
    pub database: Option<String>,
    /// Blob storage, `s3://bucket/prefix?endpoint=...`, or `@FILE` with that address in it [default: a folder in the data folder].
    #[arg(long, global = true, env = "OCB_BLOBS", value_name = "URL", hide_env_values = true, value_parser = secret::value)]
    pub blobs: Option<String>,
    /// The `ocb-runner` binary, with `ocb-advisor` in the same folder [default: beside this program].
    #[arg(long, global = true, env = "OCB_RUNNER", value_name = "FILE", hide_env_values = true)]
    pub runner: Option<PathBuf>,
    /// Plugin file, or folder of plugins; may be repeated [default: beside this program].
    #[arg(
        long,
        global = true,
        env = "OCB_PLUGINS",
        value_name = "PATH",
        value_delimiter = ':',
        hide_env_values = true
    )]
    pub plugins: Vec<PathBuf>,
    /// Jail for third-party plugins: production runs them with every required layer or not at all, dev runs them with the
    /// layers that this machine has and ranks nothing.
    #[arg(long, global = true, env = "OCB_PROFILE", value_enum, default_value_t = ProfileArg::Production, hide_env_values = true)]
    pub profile: ProfileArg,
    /// Folder with the Stanford objects, `bunny.obj` and `dragon.obj` [default: `stock` beside this program or above it].
    #[arg(long, global = true, env = "OCB_STOCK", value_name = "DIR", hide_env_values = true)]
    pub stock_dir: Option<PathBuf>,
    /// File of the suite that public plugins are measured on [default: the newest that ships].
    #[arg(long = "suite-file", global = true, env = "OCB_SUITE", value_name = "FILE", hide_env_values = true)]
    pub suite_file: Option<PathBuf>,
    /// Note on this machine for something that the kernel does not report, such as `turbo off`; only results of machines with
    /// the same note are compared.
    #[arg(long, global = true, env = "OCB_MACHINE_NOTE", value_name = "TEXT", hide_env_values = true)]
    pub machine_note: Option<String>,
}

impl Store {
    /// The profile as the engine names it.
    pub fn profile(&self) -> Profile {
        match self.profile {
            ProfileArg::Production => Profile::Production,
            ProfileArg::Dev => Profile::Dev,
        }
    }
}

/// Jail for third-party plugins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ProfileArg {
    /// With every required layer or not at all.
    Production,
    /// With the layers that this machine has; results are not ranked.
    Dev,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Serve the pages and the API.
    Serve(ServeArgs),
    /// Measure algorithms on a pair of objects, print the table, write the result files.
    Bench(BenchArgs),
    /// Find and certify configurations, and write their poses, distances and classes to a file.
    Generate(GenerateArgs),
    /// Find out how far the objects can be reduced for a query: reduced objects with certificates, speedups and errors.
    Advise(AdviseArgs),
    /// Print certified answers to collision and distance queries.
    Truth(TruthArgs),
    /// List or check plugins.
    Plugin {
        #[command(subcommand)]
        command: PluginCommand,
    },
    /// List objects.
    Object {
        #[command(subcommand)]
        command: ObjectCommand,
    },
    /// Make a scene of a robot, or list the objects of a scene or recording.
    Scene {
        #[command(subcommand)]
        command: SceneCommand,
    },
    /// List, show, refine or archive runs of the command line; runs of the web pages can be shown by id.
    Run {
        #[command(subcommand)]
        command: RunCommand,
    },
    /// Run a program unchanged and record what it asks of collision libraries (FCL, Coal, MuJoCo; also from Python), for
    /// `ocb bench --workload`. The exit code is the program's.
    Record(RecordArgs),
    /// Repeat every query of a repro archive in the jail, and compare every answer bit by bit.
    Replay(ReplayArgs),
    /// Submit a plugin to a service, which checks it.
    Submit(SubmitArgs),
    /// Show, delete or export your data, here or on a service.
    Data {
        #[command(subcommand)]
        command: DataCommand,
    },
    /// Print the citation of a run or a plugin on a service: BibTeX, CFF or the stable link.
    Cite(CiteArgs),
    /// Set who can see your run or object on a service.
    Visibility(VisibilityArgs),
    /// Manage the accounts of a service, on its data folder while it is stopped.
    Admin {
        #[command(subcommand)]
        command: AdminCommand,
    },
    /// Write everything that a service has stored (accounts, runs, objects, plugins) into one file; the service may be running.
    Backup(BackupArgs),
    /// Restore a backup into a data folder and a database that hold nothing yet, of the same kind or of the other one.
    Restore(BackupArgs),
    /// Measure runs of a service that runs on another machine (`ocb serve --internal`), until stopped.
    Work(WorkArgs),
    /// Test where algorithms fail: stress families, relations between answers, failures reported elsewhere.
    Stability(StabilityArgs),
    /// Check what the jail needs of this machine, what is missing and how to get it; exit code 1 if third-party plugins
    /// cannot run under the chosen profile.
    Doctor,
    /// Show or measure the suite, the public benchmark: the scenes, distances and queries for every public plugin.
    Suite {
        #[command(subcommand)]
        command: SuiteCommand,
    },
    /// Measure stored benchmarks again for a new hardware class, suite or oracle, and compare them with the old results.
    Campaign {
        #[command(subcommand)]
        command: CampaignCommand,
    },
    /// Compare algorithms over all runs: speed against accuracy, with a table and a chart.
    Board(BoardArgs),
    /// Write a chart of a run as .svg, .png, .csv, .parquet or .json.
    Chart(ChartArgs),
    /// Write a heatmap of a run as .glb, .ply or .csv.
    Heatmap(HeatmapArgs),
    /// List the configurations on which an algorithm was worst: wrong answers first, then by time or error.
    #[command(after_help = selections())]
    Worst(WorstArgs),
    /// Count the configurations of a selection and show the times of each algorithm on them, or write their records.
    #[command(after_help = selections())]
    Select(SelectArgs),
}

fn selections() -> String {
    format!(
        "A selection consists of\n{}\njoined by & (and), | (or), ! (not) and parentheses, e.g.\n  \
         'time in [500us, 15ms] & bv in [1200, 35000] & near(vertex 8367, 0.05)'",
        ocb_core::selection::help()
    )
}

/// `ocb backup` and `ocb restore`
#[derive(Debug, Args)]
pub struct BackupArgs {
    /// The backup, a tar file.
    pub file: PathBuf,
}

/// `ocb serve`
#[derive(Debug, Args)]
pub struct ServeArgs {
    /// Address to listen on; port 0 takes a free port.
    #[arg(long, visible_alias = "listen", default_value = "127.0.0.1:8080")]
    pub address: SocketAddr,
    /// Additional host name of the service, besides IP addresses, loopback names and the host of --public-url; repeated, or
    /// separated by commas.
    #[arg(long, value_delimiter = ',', env = "OCB_HOST_NAMES", value_name = "NAME", hide_env_values = true)]
    pub host_name: Vec<String>,
    /// IP address or network (10.1.0.0/16) of a proxy on another machine whose `X-Forwarded-For` names the visitor; repeated, or
    /// separated by commas. Proxies on this machine are always trusted.
    #[arg(long, value_delimiter = ',', env = "OCB_TRUSTED_PROXIES", value_name = "NETWORK", hide_env_values = true)]
    pub trusted_proxies: Vec<ocb_server::ProxyNetwork>,
    /// Address at which Prometheus finds figures (`/metrics`), such as 127.0.0.1:9090; visitors must not reach it [default: none].
    #[arg(long, env = "OCB_METRICS", value_name = "ADDRESS", hide_env_values = true)]
    pub metrics: Option<SocketAddr>,
    /// Address at which machines with `ocb work` take runs, such as 10.0.0.1:9091; visitors must not reach it. Runs are then measured
    /// by these machines alone [default: none; runs are measured here].
    #[arg(long, env = "OCB_INTERNAL", value_name = "ADDRESS", hide_env_values = true)]
    pub internal: Option<SocketAddr>,
    /// A machine gets no run while the sentinel, a short measurement that each repeats every hour, takes so many percent more or less
    /// on it than on the others.
    #[arg(long, default_value_t = 3.0, value_parser = percent, env = "OCB_MOST_DRIFT", value_name = "PERCENT", hide_env_values = true, requires = "internal")]
    pub most_drift: f64,
    /// The machines are nodes of these partitions of a Slurm cluster, one for each hardware class: while runs wait, jobs are
    /// submitted.
    #[arg(long, env = "OCB_SLURM", value_name = "PARTITION", value_delimiter = ',', hide_env_values = true, requires_all = ["internal", "slurm_job"])]
    pub slurm: Vec<String>,
    /// What a job runs: a program on each node that runs `ocb work --once` with the token of the node.
    #[arg(long, env = "OCB_SLURM_JOB", value_name = "PROGRAM", hide_env_values = true, requires = "slurm")]
    pub slurm_job: Option<String>,
    /// Days until the data of a guest is deleted, counted from the last item that the guest created or asked to keep.
    #[arg(long, default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..=36_500), env = "OCB_GUEST_DAYS", value_name = "DAYS", hide_env_values = true)]
    pub guest_days: u32,
    /// Measure what nobody asked for: a first heatmap for the start page and, while the service is idle, its examples, the missing
    /// results of the suite, and the stability of the installed algorithms. Any request interrupts this.
    #[arg(long, value_enum, default_value_t = Switch::On, env = "OCB_IDLE", hide_env_values = true)]
    pub idle: Switch,
    #[command(flatten)]
    pub ceilings: CeilingArgs,
    #[command(flatten)]
    pub mail: MailArgs,
}

/// Limits on the measuring time that visitors may have queued and running: the sum of the budgets of all algorithms.
#[derive(Debug, Args)]
pub struct CeilingArgs {
    /// Longest run of a guest in minutes; the run ends there.
    #[arg(long, default_value_t = 10, value_parser = minutes(), env = "OCB_GUEST_RUN_MINUTES", value_name = "MINUTES", hide_env_values = true)]
    pub guest_run_minutes: u32,
    /// Minutes of measuring that a guest may have queued and running.
    #[arg(long, default_value_t = 30, value_parser = minutes(), env = "OCB_GUEST_MINUTES", value_name = "MINUTES", hide_env_values = true)]
    pub guest_minutes: u32,
    /// The same for an account.
    #[arg(long, default_value_t = 720, value_parser = minutes(), env = "OCB_ACCOUNT_MINUTES", value_name = "MINUTES", hide_env_values = true)]
    pub account_minutes: u32,
    /// The same for all visitors from one IP address (IPv6: from one /64 network).
    #[arg(long, default_value_t = 1440, value_parser = minutes(), env = "OCB_ADDRESS_MINUTES", value_name = "MINUTES", hide_env_values = true)]
    pub address_minutes: u32,
}

/// A positive number of percent.
fn percent(text: &str) -> Result<f64, String> {
    let percent = text.parse::<f64>().ok().filter(|percent| *percent > 0.0 && percent.is_finite());
    percent.ok_or_else(|| "this is a number above 0, such as 3".to_owned())
}

fn minutes() -> clap::builder::RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=1_000_000)
}

/// `ocb generate`
#[derive(Debug, Args)]
pub struct GenerateArgs {
    /// Object A (fixed): a file (OBJ, STL, PLY, OFF, glTF, GLB, COLLADA), or a stock object such as `stock:castle@5000`.
    pub a: String,
    /// Object B (moving) [default: the same as A].
    pub b: Option<String>,
    #[command(flatten)]
    pub placing: PlacingArgs,
    /// File to write (Parquet).
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

/// `ocb advise`
#[derive(Debug, Args)]
pub struct AdviseArgs {
    /// Object A (fixed): a file (OBJ, STL, PLY, OFF, glTF, GLB, COLLADA), or a stock object such as `stock:castle@5000`; with
    /// --verify, the file of the certificate's object [default: the file that the certificate names].
    #[arg(required_unless_present = "verify")]
    pub a: Option<String>,
    /// Object B (moving) [default: the same as A].
    #[arg(conflicts_with = "verify")]
    pub b: Option<String>,
    /// The query: the distance (distance), or whether the distance is greater than a length (clearance=LENGTH).
    #[arg(long, default_value = "distance", value_name = "distance|clearance=LENGTH")]
    pub question: String,
    /// Largest error of a distance: a share of A's longest side (1%), or a length.
    #[arg(long, value_name = "LENGTH")]
    pub tolerance: Option<String>,
    /// Unit of the files, for lengths such as 0.5mm or 2cm.
    #[arg(long, value_enum, default_value_t = Unit::Mm)]
    pub unit: Unit,
    /// Number of configurations to choose the advice by.
    #[arg(long, default_value_t = ocb_advice::CONFIGURATIONS, value_parser = clap::value_parser!(u32).range(8..=1_000_000), value_name = "N")]
    pub configurations: u32,
    /// Number of other configurations to check the advice by.
    #[arg(long, default_value_t = ocb_advice::HELD_OUT, value_parser = clap::value_parser!(u32).range(0..=1_000_000), value_name = "N")]
    pub held_out: u32,
    /// Relative distances of the configurations, separated by commas [default: distances that fit the query].
    #[arg(long, value_delimiter = ',', value_name = "X")]
    pub distance: Vec<f64>,
    /// Seed of the low-discrepancy sequences.
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Folder for the reduced objects (OBJ), their certificates (JSON), the advice (JSON) and maps of the required detail (PLY).
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Verify a certificate instead; the reduced object must be in the same folder.
    #[arg(long, value_name = "CERTIFICATE")]
    pub verify: Option<PathBuf>,
}

/// Unit of an object's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Unit {
    /// A millimetre.
    Mm,
    /// A centimetre.
    Cm,
    /// A metre.
    M,
}

/// `ocb truth`
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
pub struct TruthArgs {
    /// Object A: a file (OBJ, STL, PLY, OFF, glTF, GLB, COLLADA), or a stock object such as `stock:castle@5000`.
    pub a: Option<String>,
    /// Object B [default: the same as A].
    pub b: Option<String>,
    /// Configurations from a file, as for `ocb bench`.
    #[arg(long, value_name = "FILE")]
    pub configurations: Option<PathBuf>,
    /// The query.
    #[arg(long, value_enum, default_value_t = TruthQuestion::Pq)]
    pub query: TruthQuestion,
    /// Round the coordinates to single precision first, as for algorithms that compute in it.
    #[arg(long)]
    pub rounded: bool,
    /// File to write: .parquet, .csv or .json [default: a table on stdout].
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    #[command(subcommand)]
    pub command: Option<TruthCommand>,
}

/// `ocb truth pairs`
#[derive(Debug, Subcommand)]
pub enum TruthCommand {
    /// Answer a file of triangle pairs, one case per line, and compare with the truth in the file, if there is any.
    #[command(after_help = PAIRS_FORMAT)]
    Pairs {
        /// The file.
        file: PathBuf,
        /// File to write: .parquet, .csv or .json [default: a table on stdout].
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

const PAIRS_FORMAT: &str = "A line is one of
  NAME FAMILY nA nB <9 coordinates for each of nA + nB triangles> [| hit distance margin size]
  <9 + 9 coordinates> <9 entries of a rotation, by rows> <3 of a translation> [hit distance]
with decimal or C99 hexadecimal numbers; the rotation and translation place the second triangle. Parts in brackets
are optional. Empty lines and lines that begin with # are skipped.";

/// A query to the oracle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TruthQuestion {
    /// Collisions with their margins; no distances.
    Cd,
    /// Everything, with the distance as a certified interval.
    Pq,
    /// All pairs of intersecting triangles, each with its margin.
    All,
}

/// `ocb object`
#[derive(Debug, Subcommand)]
pub enum ObjectCommand {
    /// List stock objects and the objects of earlier commands.
    List,
}

/// `ocb stability`
#[derive(Debug, Args)]
pub struct StabilityArgs {
    /// Algorithm ids, with optional settings.
    #[arg(required = true, value_name = "ID")]
    pub algorithms: Vec<String>,
    /// Only this family or relation, or `reported` (failures), `tessellations` or `search` (adversarial); may be repeated
    /// [default: all; the result is then stored for the page].
    #[arg(long, value_name = "NAME")]
    pub family: Vec<String>,
    /// Only this parameter value of the family, or this amount of the relation.
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true, conflicts_with = "server")]
    pub at: Option<f64>,
    /// Only this seed.
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["seeds", "server"])]
    pub seed: Option<u32>,
    /// Seeds per value [default: 3].
    #[arg(long, value_name = "COUNT")]
    pub seeds: Option<u32>,
    /// Time limit; the table is then marked incomplete.
    #[arg(long, value_name = "SECONDS", conflicts_with = "server")]
    pub budget: Option<u64>,
    /// URL of a service that tries the algorithms instead of this machine; Ctrl-C cancels the run there.
    #[arg(long, value_name = "URL", requires = "token")]
    pub server: Option<String>,
    /// Token of your account there for runs and objects; its account page creates tokens.
    #[arg(long, env = "OCB_TOKEN", value_name = "TOKEN", hide_env_values = true)]
    pub token: Option<String>,
    /// Folder for the failing cases: both objects as OBJ, poses, expected and actual answers, the command line.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
