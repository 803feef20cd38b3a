//! From arguments to a run's specification; whatever is wrong is said before anything is kept.

use std::path::Path;

use ocb_core::configuration::{Method, Sampling};
use ocb_core::mesh::obj;
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling::sphere;
use ocb_core::stock;
use ocb_engine::Engine;
use ocb_engine::model::RunSpec;

use crate::args::{BenchArgs, Contacts, Question, SamplingMethod};
use crate::failure::{Failure, Result};
use crate::open::{OWNER, read_bounded};

/// The most that a file of configurations may have: ten million matrices of 16 f64.
pub const MAX_CONFIGURATION_BYTES: usize = sphere::MAX_CONFIGURATIONS as usize * 128;

/// Degrees of a step when nothing is said.
const DEFAULT_STEP: f64 = 20.0;

/// What the arguments name, read and checked.
pub struct Inputs {
    a: Object,
    b: Option<Object>,
    query: Query,
    placing: Placing,
}

/// An object as it was named.
enum Object {
    /// By its id.
    Known(String),
    /// As a file.
    File { name: String, bytes: Vec<u8> },
}

/// Where configurations come from.
enum Placing {
    Sampling { sampling: Sampling, seed: u64 },
    File(Vec<u8>),
}

impl Inputs {
    /// Reads all files and checks what can be checked without a store.
    pub fn read(args: &BenchArgs) -> Result<Self> {
        let query = query(args)?;
        let placing = placing(args)?;
        let distance = args.distance.unwrap_or_default();
        if !(distance >= 0.0 && distance.is_finite()) {
            return Err(Failure::Input(format!("The relative distance must be 0 or more, not {distance}.")));
        }
        let a = object(&args.a)?;
        let b = args.b.as_deref().filter(|b| *b != args.a).map(object).transpose()?;
        // What is kept is kept one by one: before the first, all must be known to be good.
        if b.is_some() || matches!(placing, Placing::File(_)) {
            for object in [Some(&a), b.as_ref()].into_iter().flatten() {
                object.check()?;
            }
        }
        Ok(Self { a, b, query, placing })
    }

    /// Gives the files to the engine and names them in a specification.
    pub async fn into_spec(self, engine: &Engine, args: &BenchArgs) -> Result<RunSpec> {
        self.rehearse(engine, args).await?;
        let method = match self.placing {
            Placing::Sampling { sampling, seed } => Method::Sphere { sampling, seed },
            Placing::File(bytes) => engine.add_configurations(bytes).await?,
        };
        let object_a = self.a.into_id(engine).await?;
        let object_b = match self.b {
            Some(object) => Some(object.into_id(engine).await?),
            None => None,
        };
        Ok(spec(args, self.query, method, object_a, object_b))
    }

    /// Lets the engine check all settings before it keeps a file: a stand-in takes the place of what it does not have yet.
    async fn rehearse(&self, engine: &Engine, args: &BenchArgs) -> Result<()> {
        let name = |object: &Object| match object {
            Object::Known(id) => id.clone(),
            Object::File { .. } => stand_in(),
        };
        let method = match self.placing {
            Placing::Sampling { sampling, seed } => Method::Sphere { sampling, seed },
            Placing::File(_) => Method::Sphere { sampling: Sampling::Count { count: 1 }, seed: 0 },
        };
        engine.estimate(&spec(args, self.query, method, name(&self.a), self.b.as_ref().map(name))).await?;
        Ok(())
    }
}

/// The id of an object that is always there and quickly made.
fn stand_in() -> String {
    let simplest = stock::list().iter().min_by_key(|object| object.lowest_triangles);
    simplest.map_or_else(String::new, |object| format!("stock:{}@{}", object.name, object.lowest_triangles))
}

fn spec(args: &BenchArgs, query: Query, method: Method, object_a: String, object_b: Option<String>) -> RunSpec {
    RunSpec {
        object_a,
        object_b,
        query,
        semantics: if args.solid { Semantics::Solid } else { Semantics::Surface },
        method,
        relative_distance: args.distance.unwrap_or_default(),
        algorithms: args.algorithm.clone(),
        passes: args.passes,
        budget_seconds: args.budget,
    }
}

impl Object {
    fn check(&self) -> Result<()> {
        match self {
            Self::Known(_) => Ok(()),
            Self::File { name, bytes } => {
                obj::read(bytes).map(|_| ()).map_err(|e| Failure::Input(format!("{name}: {e}.")))
            }
        }
    }

    async fn into_id(self, engine: &Engine) -> Result<String> {
        match self {
            Self::Known(id) => Ok(id),
            Self::File { name, bytes } => {
                let object = engine.add_object(&name, bytes, Some(OWNER)).await?;
                for warning in &object.warnings {
                    eprintln!("ocb: {name}: {warning}");
                }
                Ok(object.id)
            }
        }
    }
}

fn query(args: &BenchArgs) -> Result<Query> {
    match (args.query, args.contacts) {
        (Question::Pq, Some(_)) => {
            Err(Failure::Input("--contacts belongs to --query cd; a proximity query has one answer.".to_owned()))
        }
        (Question::Pq, None) => Ok(Query::Proximity),
        (Question::Cd, None | Some(Contacts::First)) => Ok(Query::CollisionFirst),
        (Question::Cd, Some(Contacts::All)) => Ok(Query::CollisionAll),
    }
}

fn placing(args: &BenchArgs) -> Result<Placing> {
    let SamplingMethod::Sphere = args.method;
    if let Some(file) = &args.configurations {
        return Ok(Placing::File(read_bounded(file, MAX_CONFIGURATION_BYTES)?));
    }
    let (rotate, move_by) = (args.rotate.unwrap_or(DEFAULT_STEP), args.move_by.unwrap_or(DEFAULT_STEP));
    let sampling = match args.count {
        Some(count) => Sampling::Count { count: small_count(count)? },
        None if args.paper_compat => Sampling::PaperCompat { rotate, move_by },
        None => Sampling::Steps { rotate, move_by },
    };
    sphere::count(&sampling).map_err(|e| Failure::Input(format!("{e}")))?;
    Ok(Placing::Sampling { sampling, seed: args.seed.unwrap_or_default() })
}

fn small_count(count: i64) -> Result<u32> {
    let most = sphere::MAX_CONFIGURATIONS;
    let fits = u32::try_from(count).ok().filter(|count| (1..=most).contains(&u64::from(*count)));
    fits.ok_or_else(|| Failure::Input(format!("The number of configurations must be 1 to {most}, not {count}.")))
}

fn object(named: &str) -> Result<Object> {
    if named.starts_with("stock:") {
        return Ok(Object::Known(named.to_owned()));
    }
    let path = Path::new(named);
    // The id of an object of an earlier command, as `ocb object list` shows it.
    if !path.exists() && named.len() == 36 && named.bytes().all(|c| c.is_ascii_hexdigit() || c == b'-') {
        return Ok(Object::Known(named.to_owned()));
    }
    let bytes = read_bounded(path, obj::MAX_BYTES)?;
    let name = path.file_name().map_or_else(|| named.to_owned(), |name| name.to_string_lossy().into_owned());
    Ok(Object::File { name, bytes })
}
