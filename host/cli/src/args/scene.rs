//! `ocb scene`: scenes of many objects.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// `ocb scene`
#[derive(Debug, Subcommand)]
pub enum SceneCommand {
    /// Import the collision geometry of a robot, placed by its joints, with the pairs that are not asked.
    Import(ImportArgs),
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
