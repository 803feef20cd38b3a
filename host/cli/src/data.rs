//! `ocb data`: what one has made, here or on a service: looking at it, deleting it, taking it along.

use std::io::{BufRead, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

use ocb_service::Engine;
use ocb_service::model::OwnedItems;

use crate::args::{DataCommand, Deleted, PlaceArgs, ServiceArgs, Store};
use crate::failure::{Failure, Result};
use crate::open::{self, OWNER, Purpose};
use crate::{output, run, units};

/// Where the things are.
enum Place {
    Here(Engine),
    There(ServiceArgs),
}

/// Shows, deletes or packs.
pub async fn data(store: &Store, command: &DataCommand, json: bool) -> Result<ExitCode> {
    let (DataCommand::Show { place } | DataCommand::Delete { place, .. } | DataCommand::Export { place, .. }) = command;
    let place = Place::open(store, place).await?;
    let done = match command {
        DataCommand::Show { .. } => show(&place, json).await,
        DataCommand::Delete { what, id, yes, .. } => delete(&place, *what, id.as_deref(), *yes, json).await,
        DataCommand::Export { output, .. } => export(&place, output, json).await,
    };
    if let Place::Here(engine) = place {
        engine.shutdown().await;
    }
    done.map(|()| ExitCode::SUCCESS)
}

async fn show(place: &Place, json: bool) -> Result<()> {
    let things = place.owned_items(Deleted::All, "").await?;
    if json { output::print_json(&things) } else { output::print(&list(&things)) }
}

async fn delete(place: &Place, what: Deleted, id: Option<&str>, yes: bool, json: bool) -> Result<()> {
    let id = place.named(what, id.unwrap_or_default()).await?;
    if !yes {
        let goes = place.owned_items(what, &id).await?;
        eprintln!("{}", list(&goes));
        if !agreed()? {
            return Err(Failure::Input("Nothing was deleted; add --yes to delete it.".to_owned()));
        }
    }
    let gone = place.remove(what, &id).await?;
    if json {
        return output::print_json(&gone);
    }
    output::print(&format!("Deleted: {}", count(&gone)))
}

async fn export(place: &Place, path: &Path, json: bool) -> Result<()> {
    let bytes = match place {
        Place::Here(engine) => {
            let mut packed = engine.archive(OWNER, ocb_service::Contents::ALL).await?;
            let unwritten = |e| Failure::file("write", path, &e);
            let mut file = std::fs::File::create(path).map_err(unwritten)?;
            std::io::copy(&mut packed, &mut file).map_err(unwritten)?
        }
        Place::There(service) => service.service().save("/api/v1/data.tar", path).await?,
    };
    if json {
        return output::print_json(&serde_json::json!({ "file": path, "bytes": bytes }));
    }
    output::print(&format!("{} ({})", path.display(), units::bytes(bytes)))
}

impl Place {
    async fn open(store: &Store, args: &PlaceArgs) -> Result<Self> {
        Ok(match (&args.server, &args.token) {
            (Some(server), Some(token)) => Self::There(ServiceArgs { server: server.clone(), token: token.clone() }),
            _ => Self::Here(open::open(store, Purpose::Look).await?),
        })
    }

    /// The id that is meant; `latest` is the newest run here.
    async fn named(&self, what: Deleted, id: &str) -> Result<String> {
        match (self, what) {
            (Self::Here(engine), Deleted::Run) => Ok(run::find(engine, id).await?.id),
            _ => Ok(id.to_owned()),
        }
    }

    async fn owned_items(&self, what: Deleted, id: &str) -> Result<OwnedItems> {
        match self {
            Self::Here(engine) => Ok(match what {
                Deleted::Run => engine.deletion_preview_of_run(id, OWNER).await?,
                Deleted::Object => engine.deletion_preview_of_object(id, OWNER).await?,
                Deleted::All => engine.owned_items(OWNER).await?,
            }),
            Self::There(service) => {
                let path = match what {
                    Deleted::All => "/api/v1/data".to_owned(),
                    one => format!("{}/deletion-preview", path_of(one, id)),
                };
                service.service().get(&path).await
            }
        }
    }

    async fn remove(&self, what: Deleted, id: &str) -> Result<OwnedItems> {
        match self {
            Self::Here(engine) => Ok(match what {
                Deleted::Run => engine.remove_run(id, OWNER).await?,
                Deleted::Object => engine.remove_object(id, OWNER).await?,
                Deleted::All => engine.delete_all(OWNER).await?,
            }),
            Self::There(service) => service.service().delete(&path_of(what, id)).await,
        }
    }
}

fn path_of(what: Deleted, id: &str) -> String {
    match what {
        Deleted::Run => format!("/api/v1/runs/{id}"),
        Deleted::Object => format!("/api/v1/objects/{id}"),
        Deleted::All => "/api/v1/data".to_owned(),
    }
}

/// Asks on the terminal; without one nobody can say yes.
pub fn agreed() -> Result<bool> {
    if !std::io::stdin().is_terminal() {
        return Ok(false);
    }
    eprint!("Delete permanently? [y/N] ");
    let _ = std::io::stderr().flush();
    let mut line = String::new();
    std::io::stdin()
        .lock()
        .read_line(&mut line)
        .map_err(|e| Failure::Input(format!("Cannot read the answer: {e}.")))?;
    Ok(matches!(line.trim(), "y" | "Y" | "yes"))
}

/// A line for each, then the sum.
fn list(things: &OwnedItems) -> String {
    let all = [("run", &things.runs), ("object", &things.objects), ("configurations", &things.configurations)];
    let lines = all.into_iter().flat_map(|(kind, all)| all.iter().map(move |thing| (kind, thing)));
    let mut text: Vec<String> = lines.map(|(kind, thing)| format!("{kind}  {}  {}", thing.id, thing.name)).collect();
    text.push(count(things));
    text.join("\n")
}

fn count(things: &OwnedItems) -> String {
    let several = |n: usize, one: &str, more: &str| format!("{n} {}", if n == 1 { one } else { more });
    format!(
        "{}, {}, {}, {}, {}, {}; {} in files that no one else uses",
        several(things.runs.len(), "run", "runs"),
        several(things.objects.len(), "object", "objects"),
        several(things.configurations.len(), "saved set of configurations", "saved sets of configurations"),
        several(things.advice as usize, "piece of advice", "pieces of advice"),
        several(things.stability as usize, "stability run", "stability runs"),
        several(things.workloads as usize, "workload", "workloads"),
        units::bytes(things.bytes)
    )
}
