//! `ocb truth`: the oracle's certified answers, for anybody.

mod number;
mod pairs;
mod text;
pub mod work;

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use ocb_core::mesh::{self, MAX_BYTES, Mesh};
use ocb_core::oracle::Shape;
use ocb_service::model::{ObjectId, TruthRow};
use ocb_service::truth::{self, Depth};
use serde_json::json;

use crate::args::{Store, TruthArgs, TruthCommand, TruthQuestion};
use crate::bench::spec::MAX_CONFIGURATION_BYTES;
use crate::failure::{Failure, INTERRUPTED, OUR_FAULT, Result};
use crate::open::read_bounded;
use crate::{open, output};

/// The most that a file of pairs may have.
const MAX_PAIRS_BYTES: usize = 256 << 20;

/// What the file of `--output` shall be.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Parquet,
    Csv,
    Json,
}

/// Answers, prints or writes.
pub async fn truth(store: &Store, args: &TruthArgs, json: bool) -> Result<ExitCode> {
    match &args.command {
        Some(TruthCommand::Pairs { file, output }) => pairs(file, output.as_deref(), json).await,
        None => configurations(store, args, json).await,
    }
}

async fn pairs(file: &Path, output: Option<&Path>, json: bool) -> Result<ExitCode> {
    let format = output.map(format_of).transpose()?;
    let bad = |reason: &str| Failure::Input(format!("{} is not a file of triangle pairs: {reason}.", file.display()));
    let text = String::from_utf8(read_bounded(file, MAX_PAIRS_BYTES)?).map_err(|_| bad("it is not UTF-8 text"))?;
    let cases = pairs::read(&text).map_err(|reason| bad(&reason))?;
    let answered =
        work::watch("pairs", cases.len(), move |gauge| truth::on_all_cpus(cases.len(), gauge, |i| cases[i].answer()));
    let Some(rows) = answered.await? else { return Ok(ExitCode::from(INTERRUPTED)) };
    let told = Told { index: "line", rows: &rows, depth: Depth::Distance };
    told.tell(output.zip(format), json)?;
    let differing: Vec<&TruthRow> = rows.iter().filter(|r| r.differs.as_ref().is_some_and(|d| !d.is_empty())).collect();
    for row in &differing {
        let name = row.name.as_ref().map_or_else(String::new, |name| format!(" ({name})"));
        let differs = row.differs.as_deref().unwrap_or_default();
        eprintln!("ocb: {}, line {}{name}: {differs}.", file.display(), row.index);
    }
    Ok(if differing.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(OUR_FAULT) })
}

async fn configurations(store: &Store, args: &TruthArgs, json: bool) -> Result<ExitCode> {
    let format = args.output.as_deref().map(format_of).transpose()?;
    let (Some(a), Some(file)) = (&args.a, &args.configurations) else {
        return Err(Failure::Input("Name an object and --configurations, or use `ocb truth pairs FILE`.".to_owned()));
    };
    let bytes = read_bounded(file, MAX_CONFIGURATION_BYTES)?;
    let poses = truth::read_matrices(&bytes).map_err(|e| Failure::Input(format!("{}: {e}", file.display())))?;
    let mesh_a = seen(store, a, args.rounded).await?;
    let mesh_b = match args.b.as_ref().filter(|b| *b != a) {
        Some(b) => seen(store, b, args.rounded).await?,
        None => mesh_a.clone(),
    };
    let depth = match args.query {
        TruthQuestion::Cd => Depth::Collision,
        TruthQuestion::Pq => Depth::Distance,
        TruthQuestion::All => Depth::Contacts,
    };
    let answered = work::watch("configurations", poses.len(), move |gauge| {
        let a = Shape::new(mesh_a.clone());
        let b = if Arc::ptr_eq(&mesh_a, &mesh_b) { a.clone() } else { Shape::new(mesh_b) };
        truth::certify(&a, &b, &poses, depth, gauge)
    });
    let Some(rows) = answered.await? else { return Ok(ExitCode::from(INTERRUPTED)) };
    Told { index: "configuration", rows: &rows, depth }.tell(args.output.as_deref().zip(format), json)?;
    Ok(ExitCode::SUCCESS)
}

/// The mesh as algorithms in double precision get it, or `rounded` as those in single precision do.
async fn seen(store: &Store, named: &str, rounded: bool) -> Result<Arc<Mesh>> {
    let mesh = object(store, named).await?;
    if !rounded {
        return Ok(mesh);
    }
    let bad = |e| Failure::Input(format!("{named} cannot be rounded to single precision: {e}."));
    Ok(Arc::new(Arc::unwrap_or_clone(mesh).to_f32_representable().map_err(bad)?))
}

/// The mesh in the numbers of its file.
pub async fn object(store: &Store, named: &str) -> Result<Arc<Mesh>> {
    if ObjectId::of(named).is_stock() {
        let (engine, _folder) = open::open_aside(store).await?;
        let mesh = engine.mesh(named).await;
        engine.shutdown().await;
        return Ok(mesh?);
    }
    let bytes = read_bounded(Path::new(named), MAX_BYTES)?;
    let bad = |e: &dyn std::fmt::Display| Failure::Input(format!("{named} cannot be used: {e}."));
    let read = mesh::read(&bytes).map_err(|e| bad(&e))?;
    for warning in &read.warnings {
        eprintln!("ocb: {named}: {warning}");
    }
    Ok(Arc::new(read.mesh))
}

fn format_of(path: &Path) -> Result<Format> {
    match path.extension().and_then(|end| end.to_str()).map(str::to_lowercase).as_deref() {
        Some("parquet") => Ok(Format::Parquet),
        Some("csv") => Ok(Format::Csv),
        Some("json") => Ok(Format::Json),
        _ => Err(Failure::Input(format!("{} must end in .parquet, .csv or .json.", path.display()))),
    }
}

/// Answers and how they are told.
struct Told<'a> {
    /// What [`TruthRow::index`] counts.
    index: &'static str,
    rows: &'a [TruthRow],
    depth: Depth,
}

impl Told<'_> {
    fn tell(&self, output: Option<(&Path, Format)>, json: bool) -> Result<()> {
        let Some((path, format)) = output else {
            return if json {
                output::print_json(&self.rows)
            } else {
                output::print(&format!(
                    "{}\n{}",
                    text::table(self.index, self.rows, self.depth),
                    text::summary(self.rows)
                ))
            };
        };
        let bytes = self.bytes(format)?;
        std::fs::write(path, &bytes).map_err(|e| Failure::file("write", path, &e))?;
        if json {
            let hits = self.rows.iter().filter(|r| r.hit).count();
            return output::print_json(&json!({ "file": path, "rows": self.rows.len(), "hits": hits }));
        }
        output::print(&format!("{}\n{}", text::summary(self.rows), path.display()))
    }

    fn bytes(&self, format: Format) -> Result<Vec<u8>> {
        if format == Format::Json {
            return Ok(output::to_json(&self.rows)?.into_bytes());
        }
        let parquet = match self.depth {
            Depth::Contacts => truth::contacts_parquet(self.rows)?,
            Depth::Collision | Depth::Distance => truth::truths_parquet(self.index, self.rows)?,
        };
        Ok(if format == Format::Csv { truth::csv(&parquet)? } else { parquet })
    }
}
