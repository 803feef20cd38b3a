//! `ocb scene`: scenes of many objects.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::Unit;
use crate::choice::{ColormapArg, ObjectMeasureArg, OrderArg, ScaleArg};

/// `ocb scene`
#[derive(Debug, Subcommand)]
pub enum SceneCommand {
    /// Import the collision geometry of a robot, placed by its joints, with the pairs that are not asked.
    Import(ImportArgs),
    /// Replace each object of a recording by the simplest body that keeps every recorded answer within a tolerance, certified for
    /// each recorded query, and measure what that saves.
    Reduce(ReduceArgs),
    /// Write where on an object of a replayed recording an algorithm is slow or wrong, as .glb, .ply or .csv.
    Heatmap(SceneHeatmapArgs),
    /// List the objects of a scene or a recording.
    Show {
        /// A scene (.ocbscene) or a recording (.ocbrec).
        file: PathBuf,
    },
}

/// `ocb scene import`
#[derive(Debug, Args)]
pub struct ImportArgs {
    /// The robot or model: URDF, MJCF or SDF. Xacro files must be expanded first.
    pub file: PathBuf,
    /// SRDF file with the pairs of links that are not asked; adjacent links never are.
    #[arg(long, value_name = "FILE")]
    pub srdf: Option<PathBuf>,
    /// Folder of a package that `package://NAME/` names; may be repeated [default: a folder of that name above the file, or
    /// beside such a folder]. No file outside of these folders and the robot's own is opened.
    #[arg(long, value_name = "NAME=DIR", value_parser = package)]
    pub package: Vec<(String, PathBuf)>,
    /// Value of a joint, in radians or metres; may be repeated [default: 0].
    #[arg(long, value_name = "NAME=VALUE", value_parser = joint)]
    pub joint: Vec<(String, f64)>,
    /// File to write (.ocbscene).
    #[arg(short, long, value_name = "FILE")]
    pub out: PathBuf,
}

/// `ocb scene reduce`
#[derive(Debug, Args)]
pub struct ReduceArgs {
    /// The recording (.ocbrec).
    pub recording: PathBuf,
    /// Largest change: of a distance that was asked for, or of the distance at which an answer turns from no to yes; a length such
    /// as 1mm or 0.001 (units of the scene).
    #[arg(long, value_name = "LENGTH")]
    pub tolerance: String,
    /// The same shall hold where one object, with its body, is moved relative to the other by less than this length.
    #[arg(long, value_name = "LENGTH", default_value = "0")]
    pub near: String,
    /// Every body contains the object that it stands for, so that no collision is missed, anywhere.
    #[arg(long)]
    pub outside_only: bool,
    /// Also choose and replay bodies for a half to an eighth of the tolerance, and for two to eight times as much: speed against error.
    #[arg(long, requires = "algorithm")]
    pub frontier: bool,
    /// Unit of the scene, for lengths such as 1mm.
    #[arg(long, value_enum, default_value_t = Unit::M)]
    pub unit: Unit,
    /// Algorithms that replay the queries about both scenes [default: no replay].
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    pub algorithm: Vec<String>,
    /// Processes per algorithm and pair of objects in each replay.
    #[arg(long, default_value_t = 1)]
    pub passes: u32,
    /// Measuring time per algorithm in each replay.
    #[arg(long, default_value_t = 60.0, value_name = "SECONDS")]
    pub budget: f64,
    /// Also write this robot with the simpler bodies as collision geometry. Its objects must have the names of `ocb scene import`.
    #[arg(long, value_name = "FILE", requires = "out")]
    pub urdf: Option<PathBuf>,
    /// Folder of a package that `package://NAME/` names, as for `ocb scene import`.
    #[arg(long, value_name = "NAME=DIR", value_parser = package, requires = "urdf")]
    pub package: Vec<(String, PathBuf)>,
    /// Folder for the reduced recording (reduced.ocbrec), the report (reduction.json) and the robot.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// `ocb scene heatmap`
#[derive(Debug, Args)]
pub struct SceneHeatmapArgs {
    /// The recording (.ocbrec).
    pub recording: PathBuf,
    /// The table of its replay: queries.parquet of `ocb bench --workload`, or from the page of a replay.
    pub queries: PathBuf,
    /// Name of the object; all queries count that it takes part in.
    #[arg(long, value_name = "NAME")]
    pub object: String,
    /// Algorithm.
    #[arg(long, value_name = "ID")]
    pub algorithm: String,
    /// Order of the queries.
    #[arg(long, value_enum, default_value_t = OrderArg::Shuffled)]
    pub order: OrderArg,
    /// What to show.
    #[arg(long, value_enum, default_value_t = ObjectMeasureArg::Time)]
    pub measure: ObjectMeasureArg,
    /// Number of the first query [default: the first of the recording].
    #[arg(long, value_name = "SEQUENCE")]
    pub from: Option<u64>,
    /// Number of the query behind the last one [default: the end of the recording].
    #[arg(long, value_name = "SEQUENCE")]
    pub to: Option<u64>,
    /// Colours.
    #[arg(long, value_enum, default_value_t = ColormapArg::Turbo)]
    pub colormap: ColormapArg,
    /// How values are mapped to colours.
    #[arg(long, value_enum, default_value_t = ScaleArg::Linear)]
    pub scale: ScaleArg,
    /// File to write: .glb (colours and values), .ply (colours and quality) or .csv (vertex, value, count).
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

fn package(text: &str) -> Result<(String, PathBuf), String> {
    let (name, folder) = named(text)?;
    Ok((name, folder.into()))
}

fn joint(text: &str) -> Result<(String, f64), String> {
    let (name, value) = named(text)?;
    let value = value.parse().ok().filter(|value: &f64| value.is_finite());
    Ok((name, value.ok_or("the value is not a finite number")?))
}

fn named(text: &str) -> Result<(String, &str), String> {
    let (name, value) = text
        .split_once('=')
        .filter(|(name, value)| !name.is_empty() && !value.is_empty())
        .ok_or("a name, = and a value are needed")?;
    Ok((name.to_owned(), value))
}
