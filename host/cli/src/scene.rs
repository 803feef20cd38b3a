//! `ocb scene`: robots as scenes, and what a scene consists of.

mod heatmap;
mod reduce;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;

use ocb_core::scene::{Geometry, SceneObject};
use ocb_service::scene_file::SceneFile;
use ocb_service::scene_import::{self, Wanted};
use serde::Serialize;

use crate::args::{ImportArgs, SceneCommand, Store};
use crate::failure::Result;
use crate::output;

/// Imports, reduces, shows, or writes a heatmap.
pub async fn scene(store: &Store, command: &SceneCommand, json: bool) -> Result<ExitCode> {
    match command {
        SceneCommand::Reduce(args) => reduce::reduce(store, args, json).await,
        SceneCommand::Import(args) => import(args, json),
        SceneCommand::Heatmap(args) => heatmap::heatmap(args, json),
        SceneCommand::Show { file } => show(file, json),
    }
}

/// What a scene consists of.
#[derive(Serialize)]
struct Summary {
    name: String,
    objects: usize,
    /// Numbers of objects.
    kinds: BTreeMap<&'static str, usize>,
    /// Triangles of all objects that are meshes.
    triangles: usize,
    disabled_pairs: usize,
    /// Links, also those without objects.
    #[serde(skip_serializing_if = "Option::is_none")]
    links: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
}

impl Summary {
    fn new(file: &SceneFile) -> Self {
        let scene = &file.scene;
        let mut kinds: BTreeMap<&'static str, usize> = BTreeMap::new();
        scene.objects.iter().for_each(|it| *kinds.entry(kind(&it.geometry)).or_default() += 1);
        Self {
            name: scene.name.clone(),
            objects: scene.objects.len(),
            kinds,
            triangles: scene.objects.iter().filter_map(|it| triangles(file, &it.geometry)).sum(),
            disabled_pairs: scene.disabled.len(),
            links: None,
            notes: Vec::new(),
        }
    }

    fn text(&self) -> String {
        let kinds: Vec<String> = self.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        let links = self.links.map_or_else(String::new, |links| format!(" of {links} links"));
        let Self { name, objects, triangles, disabled_pairs, .. } = self;
        let pairs = objects * (objects - 1) / 2;
        let mut text = format!(
            "{name}: {objects} objects{links} ({}), {triangles} triangles; {disabled_pairs} of {pairs} pairs are disabled.",
            kinds.join(", ")
        );
        for note in &self.notes {
            text.push('\n');
            text.push_str(note);
        }
        text
    }
}

fn import(args: &ImportArgs, json: bool) -> Result<ExitCode> {
    let wanted = Wanted { srdf: args.srdf.clone(), packages: args.package.clone(), joints: args.joint.clone() };
    let imported = scene_import::import(&args.file, &wanted)?;
    imported.file.write(&args.out, &[])?;
    let summary = Summary { links: Some(imported.links), notes: imported.notes, ..Summary::new(&imported.file) };
    if json {
        output::print_json(&summary)?
    } else {
        output::print(&summary.text())?
    }
    Ok(ExitCode::SUCCESS)
}

/// An object with what its geometry amounts to.
#[derive(Serialize)]
struct Row<'a> {
    #[serde(flatten)]
    object: &'a SceneObject,
    /// Of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    triangles: Option<usize>,
}

#[derive(Serialize)]
struct Shown<'a> {
    #[serde(flatten)]
    summary: Summary,
    rows: Vec<Row<'a>>,
}

fn show(path: &Path, json: bool) -> Result<ExitCode> {
    let file = SceneFile::read(path)?;
    let summary = Summary::new(&file);
    let objects = file.scene.objects.iter();
    if json {
        let rows = objects.map(|object| Row { object, triangles: triangles(&file, &object.geometry) }).collect();
        output::print_json(&Shown { summary, rows })?;
        return Ok(ExitCode::SUCCESS);
    }
    let rows = objects.map(|object| {
        let link = object.link.clone().unwrap_or_else(|| "-".to_owned());
        let kind = kind(&object.geometry).to_owned();
        let licence = object.licence.clone().unwrap_or_else(|| "-".to_owned());
        vec![object.name.clone(), link, kind, size(&file, object), object.source.clone(), licence]
    });
    let headings = ["object", "link", "kind", "size", "source", "licence"];
    output::print(&output::table(&headings, rows.collect(), &[]))?;
    output::print(&summary.text())?;
    Ok(ExitCode::SUCCESS)
}

fn kind(geometry: &Geometry) -> &'static str {
    match geometry {
        Geometry::Mesh { .. } => "mesh",
        Geometry::Box { .. } => "box",
        Geometry::Sphere { .. } => "sphere",
        Geometry::Cylinder { .. } => "cylinder",
        Geometry::Capsule { .. } => "capsule",
    }
}

/// Of a mesh.
fn triangles(file: &SceneFile, geometry: &Geometry) -> Option<usize> {
    let Geometry::Mesh { sha256, .. } = geometry else { return None };
    file.meshes.get(sha256).map(|mesh| mesh.triangles().len())
}

fn size(file: &SceneFile, object: &SceneObject) -> String {
    match &object.geometry {
        Geometry::Mesh { .. } => {
            let scale = match object.scale {
                [1.0, 1.0, 1.0] => String::new(),
                [x, y, z] => format!(", scaled by {x} {y} {z}"),
            };
            format!("{} triangles{scale}", triangles(file, &object.geometry).unwrap_or_default())
        }
        Geometry::Box { size: [x, y, z] } => format!("{x} x {y} x {z}"),
        Geometry::Sphere { radius } => format!("radius {radius}"),
        Geometry::Cylinder { radius, length } | Geometry::Capsule { radius, length } => {
            format!("radius {radius}, length {length}")
        }
    }
}
