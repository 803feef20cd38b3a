//! From arguments to a run's specification; whatever is wrong is said before anything is kept.

use ocb_core::configuration::{Method, Sampling};
use ocb_core::query::{Query, Semantics};
use ocb_core::sampling::MAX_CONFIGURATIONS;
use ocb_service::Engine;
use ocb_service::model::RunSpec;

use crate::args::{BenchArgs, Contacts, Question};
use crate::failure::{Failure, Result};
use crate::named::{Object, stand_in};
use crate::open::read_bounded;

/// The most that a file of configurations may have: ten million matrices of 16 f64.
pub const MAX_CONFIGURATION_BYTES: usize = MAX_CONFIGURATIONS as usize * 128;

/// Configurations of `--quick`.
const QUICK_LOOK: u32 = 5000;

/// What the arguments name, read and checked.
pub struct Inputs {
    a: Object,
    b: Option<Object>,
    query: Query,
    placing: Placing,
}

/// Where configurations come from.
enum Placing {
    Method(Method),
    File(Vec<u8>),
}

impl Inputs {
    /// Reads all files and checks what can be checked without a store.
    pub fn read(args: &BenchArgs) -> Result<Self> {
        let query = query(args)?;
        let placing = placing(args)?;
        let Some(named_a) = &args.a else { return Err(Failure::Input("Name an object.".to_owned())) };
        let a = Object::named(named_a)?;
        let b = args.b.as_deref().filter(|b| b != named_a).map(Object::named).transpose()?;
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
            Placing::Method(method) => method,
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
        let method = match &self.placing {
            Placing::Method(method) => method.clone(),
            Placing::File(_) => Method::Sphere { sampling: Sampling::Count { count: 1 }, seed: 0 },
        };
        let spec = spec(args, self.query, method, name(&self.a), self.b.as_ref().map(name));
        engine.estimate(&spec, Some(crate::open::OWNER)).await?;
        Ok(())
    }
}

fn spec(args: &BenchArgs, query: Query, method: Method, object_a: String, object_b: Option<String>) -> RunSpec {
    RunSpec {
        object_a,
        object_b,
        query,
        semantics: if args.solid { Semantics::Solid } else { Semantics::Surface },
        method,
        separation: args.placing.separation(),
        algorithms: args.algorithm.clone(),
        passes: args.passes,
        budget_seconds: args.budget,
        seed: args.run_seed,
        precision: args.precision,
        at_most: args.quick.then_some(QUICK_LOOK),
        hardware_class: None,
    }
}

fn query(args: &BenchArgs) -> Result<Query> {
    match (args.query, args.contacts) {
        (Question::Pq, Some(_)) => {
            Err(Failure::Input("--contacts needs --query cd; a distance query has one answer.".to_owned()))
        }
        (Question::Pq, None) => Ok(Query::Proximity),
        (Question::Cd, None | Some(Contacts::First)) => Ok(Query::CollisionFirst),
        (Question::Cd, Some(Contacts::All)) => Ok(Query::CollisionAll),
    }
}

fn placing(args: &BenchArgs) -> Result<Placing> {
    match &args.configurations {
        Some(file) => Ok(Placing::File(read_bounded(file, MAX_CONFIGURATION_BYTES)?)),
        None => Ok(Placing::Method(args.placing.method()?)),
    }
}
