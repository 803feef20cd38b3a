//! `ocb object`: what can be measured on.

use std::process::ExitCode;

use ocb_service::Engine;
use ocb_service::model::{ObjectInfo, Page};

use crate::args::{ObjectCommand, Store};
use crate::failure::Result;
use crate::open::{self, OWNER, Purpose};
use crate::output;

/// Lists.
pub async fn object(store: &Store, command: &ObjectCommand, json: bool) -> Result<ExitCode> {
    let ObjectCommand::List = command;
    let engine = open::open(store, Purpose::Look).await?;
    let objects = all(&engine).await;
    engine.shutdown().await;
    let objects = objects?;
    if json {
        output::print_json(&objects)?;
    } else {
        let row = |o: &ObjectInfo| {
            let closed = if o.closed { "closed" } else { "open" }.to_owned();
            let (id, name, terms) = (o.id.clone(), o.name.clone(), o.terms.clone());
            vec![id, name, o.triangles.to_string(), o.vertices.to_string(), closed, file(o), terms]
        };
        let headings = ["id", "name", "triangles", "vertices", "surface", "file", "terms"];
        output::print(&output::table(&headings, objects.iter().map(row).collect(), &[2, 3]))?;
        output::print("Procedural objects take any number of triangles after @, e.g. stock:castle@20000.")?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Format and unit of the file, as far as they are known.
fn file(object: &ObjectInfo) -> String {
    let format = object.format.map(|format| format.to_string());
    let unit = object.unit.as_ref().map(|unit| format!("in {}", unit.name));
    let double = object.rounding.map(|_| "needs double precision".to_owned());
    format.into_iter().chain(unit).chain(double).collect::<Vec<_>>().join(", ")
}

async fn all(engine: &Engine) -> Result<Vec<ObjectInfo>> {
    let (mut objects, mut page) = (Vec::new(), Page::default());
    loop {
        let part = engine.objects(Some(OWNER), &page).await?;
        objects.extend(part.entries);
        let Some(next) = part.next else { return Ok(objects) };
        page = page.behind(&next);
    }
}
