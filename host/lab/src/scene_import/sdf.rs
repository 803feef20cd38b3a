//! SDF, the format of Gazebo: models with links where the file puts them, and the collision geometry of these.
//!
//! Joints only say which links are adjacent. Poses are read where they are relative to the enclosing element or to another link.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};
use ocb_core::pose::Pose;
use ocb_core::scene::{Geometry, MOST_OBJECTS};

use super::assembly::{Assembly, Part, Shape};
use super::element::Element;
use super::kinematics::{roll_pitch_yaw, within};
use super::packages::Packages;
use super::pairs::{LinkPairs, ObjectPairs};
use super::{Found, Imported, Wanted, shown};

/// A link of one of the models.
struct Link<'a> {
    element: &'a Element,
    name: String,
    pose: Pose,
}

/// Imports the models of this element.
pub fn import(root: &Element, wanted: &Wanted, packages: Packages) -> Found<Imported> {
    if !wanted.joints.is_empty() {
        return Err("values of joints are for URDF and MJCF; SDF says where each link is".to_owned());
    }
    let around: Vec<&Element> = std::iter::once(root).chain(root.named("world")).collect();
    if let Some(include) = around.iter().find_map(|it| it.child("include")) {
        return Err(include.fault("<include> is not read; import the included model itself"));
    }
    let models: Vec<&Element> = around.iter().flat_map(|it| it.named("model")).collect();
    let (mut links, mut pairs) = (Vec::new(), LinkPairs::default());
    for model in &models {
        read_model(model, models.len() > 1, &mut links, &mut pairs)?;
    }
    let mut assembly = Assembly::new(packages, links.iter().map(|link| link.name.clone()).collect());
    let mut left_out: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, link) in links.iter().enumerate() {
        for (number, collision) in link.element.named("collision").enumerate() {
            let geometry = collision.child("geometry");
            let geometry = geometry.ok_or_else(|| collision.fault("its collision has no geometry"))?;
            let Some(kind) = geometry.children.first() else { continue };
            if ["plane", "heightmap", "empty"].contains(&kind.name.as_str()) {
                *left_out.entry(&kind.name).or_default() += 1;
                continue;
            }
            let own = link.element.required("name")?;
            let pose = within(&link.pose, &pose(collision, &["", own])?.0);
            let part = Part { link: index, name: format!("{}_{number}", link.name), shape: shape(kind)?, pose };
            assembly.add(part).map_err(|why| collision.fault(&format!("link {}: {why}", shown(&link.name))))?;
        }
    }
    for (kind, count) in left_out {
        assembly.note(format!("{count} collision geometries of the kind {kind} were left out."));
    }
    let disabled = ObjectPairs::of_links(&pairs, assembly.link_of())?;
    let name = root.child("world").or(models.first().copied()).and_then(|it| it.attribute("name"));
    assembly.finish(name.unwrap_or("SDF"), disabled.finish())
}

/// Adds the links of a model, and which of them are adjacent.
fn read_model<'a>(model: &'a Element, several: bool, links: &mut Vec<Link<'a>>, pairs: &mut LinkPairs) -> Found<()> {
    if let Some(inner) = model.children.iter().find(|it| it.name == "model" || it.name == "include") {
        return Err(inner.fault("a model in a model is not read; flatten it first"));
    }
    if model.attribute("placement_frame").is_some() {
        return Err(model.fault("placement_frame is not read; state the pose of the model"));
    }
    let (in_world, _) = pose(model, &["", "world"])?;
    let first = links.len();
    let mut named = HashMap::new();
    let (mut local, mut relative) = (Vec::new(), Vec::new());
    for element in model.named("link") {
        let name = element.required("name")?;
        if named.insert(name, named.len()).is_some() || links.len() + local.len() >= MOST_OBJECTS {
            return Err(element.fault(&format!("the link {} is there twice, or is one too many", shown(name))));
        }
        let (pose, to) = pose(element, &[])?;
        local.push((element, pose));
        relative.push(to);
    }
    for (index, &(element, pose)) in local.iter().enumerate() {
        // From the link up to the model; each step is to another link.
        let (mut pose, mut at, mut steps) = (pose, index, 0);
        while !["", "__model__"].contains(&relative[at]) {
            at = *named.get(relative[at]).ok_or_else(|| {
                element.fault(&format!("a pose relative to {}, which is no link, is not read", shown(relative[at])))
            })?;
            pose = within(&local[at].1, &pose);
            steps += 1;
            if steps > 1_000 {
                return Err(element.fault("its pose is relative to itself, or to a chain of more than 1000 links"));
            }
        }
        let own = element.required("name")?;
        let name = if several { format!("{}::{own}", model.required("name")?) } else { own.to_owned() };
        links.push(Link { element, name, pose: within(&in_world, &pose) });
    }
    for joint in model.named("joint") {
        let end = |end: &str| {
            let end = joint.child(end).ok_or_else(|| joint.fault(&format!("a joint has no {end}")))?;
            let known = named.get(end.text.as_str()).map(|index| first + index);
            if known.is_none() && end.text != "world" {
                return Err(end.fault(&format!("a joint names {}, which is no link of its model", shown(&end.text))));
            }
            Ok(known)
        };
        if let (Some(parent), Some(child)) = (end("parent")?, end("child")?) {
            pairs.disable(parent, child, "adjacent links")?;
        }
    }
    Ok(())
}

/// The pose of an element, and what it is relative to: one of these, if there are any.
fn pose<'a>(of: &'a Element, allowed: &[&str]) -> Found<(Pose, &'a str)> {
    let Some(pose) = of.child("pose") else { return Ok((Pose::identity(), "")) };
    let relative = pose.attribute("relative_to").unwrap_or_default();
    if !allowed.is_empty() && !allowed.contains(&relative) {
        return Err(pose.fault(&format!("a pose of <{}> relative to {} is not read", of.name, shown(relative))));
    }
    let identity = pose.text.is_empty();
    let (xyz, linear) = match pose.attribute("rotation_format").unwrap_or("euler_rpy") {
        _ if identity => ([0.0; 3], Pose::identity().linear),
        "quat_xyzw" => {
            let [x, y, z, a, b, c, w] = pose.text_numbers()?;
            let turn = UnitQuaternion::try_new(Quaternion::new(w, a, b, c), 0.0);
            let turn = turn.ok_or_else(|| pose.fault("the quaternion of the pose is 0 0 0 0"))?;
            ([x, y, z], Rotation3::from(turn).into_inner())
        }
        "euler_rpy" => {
            let [x, y, z, a, b, c] = pose.text_numbers()?;
            let unit = if pose.attribute("degrees") == Some("true") { 1f64.to_radians() } else { 1.0 };
            ([x, y, z], roll_pitch_yaw([a, b, c].map(|angle| angle * unit)))
        }
        other => return Err(pose.fault(&format!("the rotation_format {} is not known", shown(other)))),
    };
    Ok((Pose { linear, translation: Vector3::from(xyz) }, relative))
}

fn shape(kind: &Element) -> Found<Shape> {
    let stated = |name: &str| kind.child(name).ok_or_else(|| kind.fault(&format!("<{}> has no {name}", kind.name)));
    let number = |name: &str| stated(name)?.text_numbers::<1>().map(|[x]| x);
    Ok(Shape::Primitive(match kind.name.as_str() {
        "mesh" => {
            if let Some(part) = kind.child("submesh") {
                return Err(part.fault("a part of a mesh is not read; save it as a file of its own"));
            }
            let scale = kind.child("scale").map(Element::text_numbers).transpose()?.unwrap_or([1.0; 3]);
            return Ok(Shape::File { address: stated("uri")?.text.clone(), scale });
        }
        "box" => Geometry::Box { size: stated("size")?.text_numbers()? },
        "sphere" => Geometry::Sphere { radius: number("radius")? },
        "cylinder" => Geometry::Cylinder { radius: number("radius")?, length: number("length")? },
        "capsule" => Geometry::Capsule { radius: number("radius")?, length: number("length")? },
        "ellipsoid" => return Shape::ellipsoid(stated("radii")?.text_numbers()?).map_err(|why| kind.fault(&why)),
        other => return Err(kind.fault(&format!("geometry of the kind {} is not read", shown(other)))),
    }))
}
