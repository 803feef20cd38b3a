//! URDF, the Unified Robot Description Format of ROS: links with collision geometry, and the joints between them.
//!
//! Lengths are metres and angles radians. Meshes are taken as their numbers stand, but for the unit that a COLLADA file states; the
//! up axis of COLLADA is not applied, as in ROS.

use std::collections::{HashMap, HashSet};

use nalgebra::Vector3;
use ocb_core::pose::Pose;
use ocb_core::scene::{Geometry, MOST_OBJECTS};

use super::assembly::{Assembly, Part, Shape};
use super::element::Element;
use super::kinematics::{self, Joint, Mimic, Motion, within};
use super::packages::Packages;
use super::pairs::{LinkPairs, ObjectPairs};
use super::{Found, Imported, Wanted, shown, srdf};

/// Imports the robot of this element.
pub fn import(robot: &Element, srdf: Option<&Element>, wanted: &Wanted, packages: Packages) -> Found<Imported> {
    if let Some(macros) = robot.children.iter().find(|it| ["macro", "property", "include"].contains(&it.name.as_str()))
    {
        return Err(macros.fault("this is a xacro file; expand it with `xacro FILE > ROBOT.urdf`"));
    }
    let links: Vec<&Element> = robot.named("link").collect();
    if links.is_empty() || links.len() > MOST_OBJECTS {
        return Err(format!("it has {} links, and 1 to {MOST_OBJECTS} are read", links.len()));
    }
    let mut names = Vec::with_capacity(links.len());
    let mut indices = HashMap::with_capacity(links.len());
    for link in &links {
        let name = link.required("name")?;
        if indices.insert(name, names.len()).is_some() {
            return Err(link.fault(&format!("two links are named {}; rename one of them", shown(name))));
        }
        names.push(name.to_owned());
    }
    let mut joints = robot.named("joint").map(|it| joint(it, &indices)).collect::<Found<Vec<Joint>>>()?;
    let lost = free_of_missing(&mut joints);
    let poses = kinematics::place(&names, &joints, &wanted.joints)?;

    let mut assembly = Assembly::new(packages, names);
    lost.into_iter().for_each(|note| assembly.note(note));
    for (index, (link, pose)) in links.iter().zip(&poses).enumerate() {
        let name = link.required("name")?;
        for (number, collision) in link.named("collision").enumerate() {
            // As Pinocchio names them; no two links give the same name.
            let shape = shape(collision);
            let part = shape.and_then(|shape| {
                let pose = within(pose, &origin(collision)?);
                assembly.add(Part { link: index, name: format!("{name}_{number}"), shape, pose })
            });
            part.map_err(|why| format!("link {}: {why}", shown(name)))?;
        }
    }
    let mut pairs = LinkPairs::default();
    if let Some(srdf) = srdf {
        srdf::read(srdf, &indices, &mut pairs)?.into_iter().for_each(|note| assembly.note(note));
    }
    for joint in &joints {
        pairs.disable(joint.parent, joint.child, "adjacent links")?;
    }
    let disabled = ObjectPairs::of_links(&pairs, assembly.link_of())?;
    assembly.finish(robot.required("name")?, disabled.finish())
}

/// Joints that follow one which is not there, as in files cut out of others, do not follow it; says which.
fn free_of_missing(joints: &mut [Joint]) -> Vec<String> {
    let names: HashSet<String> = joints.iter().map(|joint| joint.name.clone()).collect();
    let missing = joints.iter_mut().filter_map(|joint| {
        let mimic = joint.mimic.take_if(|mimic| !names.contains(&mimic.of))?;
        Some(format!("The joint {} follows {}, which is not there.", shown(&joint.name), shown(&mimic.of)))
    });
    missing.collect()
}

/// The frame that an element has in the one around it.
fn origin(of: &Element) -> Found<Pose> {
    let Some(origin) = of.child("origin") else { return Ok(Pose::identity()) };
    let xyz = origin.numbers("xyz")?.unwrap_or_default();
    let rpy = origin.numbers("rpy")?.unwrap_or_default();
    Ok(Pose { linear: kinematics::roll_pitch_yaw(rpy), translation: Vector3::from(xyz) })
}

fn joint(element: &Element, links: &HashMap<&str, usize>) -> Found<Joint> {
    let name = element.required("name")?.to_owned();
    let link = |end: &str| {
        let end = element.child(end).ok_or_else(|| element.fault(&format!("joint {} has no {end}", shown(&name))))?;
        let link = end.required("link")?;
        let index = links.get(link).copied();
        index.ok_or_else(|| {
            end.fault(&format!("joint {} names the link {}, which is not there", shown(&name), shown(link)))
        })
    };
    let (parent, child) = (link("parent")?, link("child")?);
    let axis = || {
        let axis = element.child("axis").map(|axis| axis.numbers::<3>("xyz")).transpose()?.flatten();
        let axis = Vector3::from(axis.unwrap_or([1.0, 0.0, 0.0]));
        axis.try_normalize(0.0).ok_or_else(|| element.fault(&format!("the axis of joint {} is 0 0 0", shown(&name))))
    };
    let motion = match element.required("type")? {
        "fixed" | "floating" | "planar" => Motion::None,
        "revolute" | "continuous" => Motion::Turn(axis()?),
        "prismatic" => Motion::Slide(axis()?),
        other => return Err(element.fault(&format!("joint {} is of the unknown type {}", shown(&name), shown(other)))),
    };
    let mimic = element.child("mimic").map(|mimic| {
        let factor = mimic.number("multiplier")?.unwrap_or(1.0);
        let offset = mimic.number("offset")?.unwrap_or(0.0);
        Found::Ok(Mimic { of: mimic.required("joint")?.to_owned(), factor, offset })
    });
    Ok(Joint { parent, child, origin: origin(element)?, motion, mimic: mimic.transpose()?, name })
}

fn shape(collision: &Element) -> Found<Shape> {
    let geometry = collision.child("geometry").ok_or_else(|| collision.fault("its collision has no geometry"))?;
    let known = geometry.children.iter().find_map(|it| kind(it).transpose());
    known.unwrap_or_else(|| {
        let what = geometry.children.first().map_or("nothing", |it| it.name.as_str());
        Err(geometry.fault(&format!(
            "its geometry is {}, and only mesh, box, sphere, cylinder and capsule are read",
            shown(what)
        )))
    })
}

fn kind(of: &Element) -> Found<Option<Shape>> {
    let radius = || of.required_number("radius");
    let length = || of.required_number("length");
    Ok(Some(Shape::Primitive(match of.name.as_str() {
        "mesh" => {
            let address = of.required("filename")?.to_owned();
            return Ok(Some(Shape::File { address, scale: of.numbers("scale")?.unwrap_or([1.0; 3]) }));
        }
        "box" => {
            of.required("size")?;
            Geometry::Box { size: of.numbers("size")?.unwrap_or_default() }
        }
        "sphere" => Geometry::Sphere { radius: radius()? },
        "cylinder" => Geometry::Cylinder { radius: radius()?, length: length()? },
        "capsule" => Geometry::Capsule { radius: radius()?, length: length()? },
        _ => return Ok(None),
    })))
}
