//! MJCF, the models of MuJoCo: bodies in each other, with geoms, of which those are imported that can collide.
//!
//! The joints are as the file has them (`qpos0`), unless values are given. Meshes are imported as they are; MuJoCo collides their
//! convex hulls. Planes, height fields and signed distance fields are no objects of a scene and are left out with a note.

mod bodies;
mod defaults;
mod filter;
mod geom;
mod include;
mod orientation;

use std::collections::{BTreeMap, HashMap, HashSet};

use super::assembly::{Assembly, Part};
use super::element::Element;
use super::kinematics::within;
use super::packages::Packages;
use super::{Found, Imported, Wanted, shown};
use bodies::Bodies;
use defaults::Defaults;
use geom::Shapes;
use include::Including;
use orientation::Angles;

/// The settings of `<compiler>`.
#[derive(Clone, Debug)]
struct Compiler {
    angles: Angles,
    /// Before the names of mesh files.
    meshes: String,
    /// Only the last part of these names counts.
    strip: bool,
}

impl Compiler {
    fn new(model: &Element) -> Found<Self> {
        let stated = |name: &str| model.named("compiler").filter_map(|it| it.attribute(name)).last();
        let fault = |why: &str| model.child("compiler").unwrap_or(model).fault(why);
        if stated("coordinate").is_some_and(|it| it != "local") {
            return Err(fault("global coordinates are not read; save the model with a newer MuJoCo"));
        }
        let unit = if stated("angle") == Some("radian") { 1.0 } else { 1f64.to_radians() };
        let sequence: Vec<char> = stated("eulerseq").unwrap_or("xyz").chars().collect();
        let sequence = sequence.try_into().ok().filter(|it: &[char; 3]| it.iter().all(|c| "xyzXYZ".contains(*c)));
        let sequence = sequence.ok_or_else(|| fault("eulerseq needs three of the letters xyzXYZ"))?;
        let meshes = stated("meshdir").or(stated("assetdir")).unwrap_or_default().to_owned();
        Ok(Self { angles: Angles { unit, sequence }, meshes, strip: stated("strippath") == Some("true") })
    }
}

/// Imports the model of this element.
pub fn import(mut model: Element, wanted: &Wanted, mut packages: Packages) -> Found<Imported> {
    Including::new(&mut packages).expand(&mut model, 0)?;
    let compiler = Compiler::new(&model)?;
    let defaults = Defaults::new(&model)?;
    let Bodies { bodies, geoms } = Bodies::read(&model, &compiler.angles, &defaults, &wanted.joints)?;
    let mut shapes = Shapes::new(&model, &compiler, &defaults)?;
    let paired: HashSet<&str> = filter::explicit(&model)?.into_iter().flatten().collect();

    let mut assembly = Assembly::new(packages, bodies.iter().map(|body| body.name.clone()).collect());
    let mut left_out: BTreeMap<String, usize> = BTreeMap::new();
    let (mut masks, mut by_name, mut numbers) = (Vec::new(), HashMap::new(), vec![0; bodies.len()]);
    for it in &geoms {
        let (element, body) = (&it.element, &bodies[it.body]);
        let number = numbers[it.body];
        numbers[it.body] += 1;
        let name = element.attribute("name");
        let mask = filter::masks(element)?;
        if mask == [0, 0] && !name.is_some_and(|name| paired.contains(name)) {
            continue;
        }
        let kind = element.attribute("type").unwrap_or("sphere");
        if ["plane", "hfield", "sdf"].contains(&kind) {
            *left_out.entry(kind.to_owned()).or_default() += 1;
            continue;
        }
        let (shape, frame) = shapes.of(element)?;
        if let Some(name) = name
            && by_name.insert(name.to_owned(), masks.len() as u32).is_some()
        {
            return Err(element.fault(&format!("two geoms are named {}; rename one of them", shown(name))));
        }
        let name = name.map_or_else(|| format!("{}_{number}", body.name), str::to_owned);
        let pose = within(&body.pose, &within(&it.frame, &frame));
        assembly.add(Part { link: it.body, name, shape, pose }).map_err(|why| element.fault(&why))?;
        masks.push(mask);
    }
    for (kind, count) in left_out {
        assembly.note(format!("{count} geom(s) of the type {kind} were left out."));
    }
    if shapes.hulls {
        assembly.note("MuJoCo collides the convex hulls of meshes; the meshes are imported as they are.".to_owned());
    }
    let disabled = filter::disabled(&model, &bodies, assembly.link_of(), &masks, &by_name)?;
    assembly.finish(model.attribute("model").unwrap_or("MuJoCo Model"), disabled)
}
