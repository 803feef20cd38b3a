//! The shape of a geom, and its frame: stated, or between two points.

use std::collections::HashMap;

use nalgebra::Vector3;
use ocb_core::pose::Pose;
use ocb_core::scene::Geometry;

use super::Compiler;
use super::defaults::{Defaults, MAIN};
use super::orientation::{Angles, z_to};
use crate::scene_import::assembly::Shape;
use crate::scene_import::element::Element;
use crate::scene_import::{Found, shown};

/// The meshes of a model, by their names, and how geoms are read.
pub struct Shapes {
    angles: Angles,
    meshes: HashMap<String, Shape>,
    /// Was one of the meshes used?
    pub hulls: bool,
}

impl Shapes {
    /// Reads what `<asset>` says of meshes.
    pub fn new(model: &Element, compiler: &Compiler, defaults: &Defaults) -> Found<Self> {
        let mut meshes = HashMap::new();
        for element in model.named("asset").flat_map(|asset| asset.named("mesh")) {
            let element = defaults.of(element, MAIN)?;
            let Some(file) = element.attribute("file") else { continue };
            let file = if compiler.strip { file.rsplit('/').next().unwrap_or(file) } else { file };
            let last = file.rsplit('/').next().unwrap_or(file);
            let name = element.attribute("name").unwrap_or(last.rsplit_once('.').map_or(last, |(stem, _)| stem));
            if element.attribute("refpos").is_some() || element.attribute("refquat").is_some() {
                return Err(element.fault("refpos and refquat of a mesh are not read; apply them to the file"));
            }
            let address = match compiler.meshes.trim_end_matches('/') {
                folder if !folder.is_empty() && !file.starts_with('/') => format!("{folder}/{file}"),
                _ => file.to_owned(),
            };
            let scale = element.numbers("scale")?.unwrap_or([1.0; 3]);
            if meshes.insert(name.to_owned(), Shape::File { address, scale }).is_some() {
                return Err(element.fault(&format!("two meshes are named {}; rename one of them", shown(name))));
            }
        }
        Ok(Self { angles: compiler.angles.clone(), meshes, hulls: false })
    }

    /// The shape of a geom, and its frame.
    pub fn of(&mut self, geom: &Element) -> Found<(Shape, Pose)> {
        let kind = geom.attribute("type").unwrap_or("sphere");
        if kind == "mesh" {
            let name = geom.required("mesh")?;
            let shape = self.meshes.get(name);
            let shape = shape.ok_or_else(|| geom.fault(&format!("no mesh {} with a file", shown(name))))?;
            self.hulls = true;
            return Ok((shape.clone(), self.angles.pose(geom)?));
        }
        if geom.attribute("mesh").is_some() {
            return Err(geom.fault("a primitive that is fitted to a mesh is not read; give its size"));
        }
        let mut sizes = geom.list("size")?.unwrap_or_default();
        let frame = match geom.numbers::<6>("fromto")? {
            Some([a, b, c, d, e, f]) => {
                let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
                let half = (to - from).norm() / 2.0;
                let direction = (from - to).try_normalize(0.0);
                let direction = direction.ok_or_else(|| geom.fault("both points of fromto are the same"))?;
                let radius = *sizes.first().ok_or_else(|| geom.fault("size has no number"))?;
                sizes =
                    if kind == "box" || kind == "ellipsoid" { vec![radius, radius, half] } else { vec![radius, half] };
                Pose { linear: z_to(&direction), translation: (from + to) / 2.0 }
            }
            None => self.angles.pose(geom)?,
        };
        Ok((shape(geom, kind, &sizes)?, frame))
    }
}

fn shape(geom: &Element, kind: &str, sizes: &[f64]) -> Found<Shape> {
    let size = |place: usize| {
        let size = sizes.get(place).copied();
        size.ok_or_else(|| geom.fault(&format!("size needs {} number(s) for a {kind}", place + 1)))
    };
    Ok(Shape::Primitive(match kind {
        "sphere" => Geometry::Sphere { radius: size(0)? },
        "capsule" => Geometry::Capsule { radius: size(0)?, length: 2.0 * size(1)? },
        "cylinder" => Geometry::Cylinder { radius: size(0)?, length: 2.0 * size(1)? },
        "box" => Geometry::Box { size: [2.0 * size(0)?, 2.0 * size(1)?, 2.0 * size(2)?] },
        "ellipsoid" => return Shape::ellipsoid([size(0)?, size(1)?, size(2)?]).map_err(|why| geom.fault(&why)),
        other => return Err(geom.fault(&format!("geoms of the type {} are not read", shown(other)))),
    }))
}
