//! The bodies of a model and where they are, and the geoms in them.

use std::collections::{HashMap, HashSet};

use nalgebra::{Matrix3, Vector3};
use ocb_core::pose::Pose;
use ocb_core::scene::MOST_OBJECTS;

use super::defaults::{Defaults, MAIN};
use super::orientation::{Angles, turned_about};
use crate::scene_import::element::Element;
use crate::scene_import::kinematics::within;
use crate::scene_import::{Found, shown};

/// A body; the first one is the world.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name, made up if it has none.
    pub name: String,
    /// The body around it; of the world itself.
    pub parent: usize,
    /// The first body that moves with it: itself if it has joints, and else that of its parent.
    pub welded: usize,
    /// In the frame of the world.
    pub pose: Pose,
}

/// A geom with what it takes from its classes.
#[derive(Clone, Debug)]
pub struct Geom {
    /// The element.
    pub element: Element,
    /// Its body.
    pub body: usize,
    /// The frames around it in its body.
    pub frame: Pose,
}

/// The content of `<worldbody>`.
pub struct Bodies {
    /// The world first, each before those in it.
    pub bodies: Vec<Body>,
    /// In the order of the file.
    pub geoms: Vec<Geom>,
}

/// The surroundings of an element: its parents and defaults.
#[derive(Clone, Copy)]
struct Around<'a> {
    body: usize,
    frame: Pose,
    class: &'a str,
}

struct Reading<'a> {
    angles: &'a Angles,
    defaults: &'a Defaults,
    values: HashMap<&'a str, f64>,
    joints: HashSet<String>,
    names: HashSet<String>,
    found: Bodies,
}

impl Bodies {
    /// Reads them, with these values of joints in radians or lengths.
    pub fn read(model: &Element, angles: &Angles, defaults: &Defaults, joints: &[(String, f64)]) -> Found<Self> {
        let world = Body { name: "world".to_owned(), parent: 0, welded: 0, pose: Pose::identity() };
        let found = Self { bodies: vec![world], geoms: Vec::new() };
        let values = joints.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let names = HashSet::from(["world".to_owned()]);
        let mut reading = Reading { angles, defaults, values, joints: HashSet::new(), names, found };
        for world in model.named("worldbody") {
            reading.inside(world, Around { body: 0, frame: Pose::identity(), class: MAIN })?;
        }
        if let Some((name, _)) = joints.iter().find(|(name, _)| !reading.joints.contains(name)) {
            return Err(format!("it has no turning or sliding joint {}", shown(name)));
        }
        Ok(reading.found)
    }
}

impl Reading<'_> {
    fn inside(&mut self, element: &Element, around: Around) -> Found<()> {
        for child in &element.children {
            let class = child.attribute("childclass").unwrap_or(around.class);
            match child.name.as_str() {
                "geom" => {
                    let element = self.defaults.of(child, around.class)?;
                    self.found.geoms.push(Geom { element, body: around.body, frame: around.frame });
                }
                "frame" => {
                    let frame = within(&around.frame, &self.angles.pose(child)?);
                    self.inside(child, Around { frame, class, ..around })?;
                }
                "body" => {
                    let body = self.body(child, &around, class)?;
                    self.inside(child, Around { body, frame: Pose::identity(), class })?;
                }
                "replicate" | "composite" | "flexcomp" | "attach" => {
                    return Err(child.fault(&format!(
                        "<{}> is not read; save the compiled model with mj_saveLastXML and import that",
                        child.name
                    )));
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn body(&mut self, element: &Element, around: &Around, class: &str) -> Found<usize> {
        let index = self.found.bodies.len();
        if index > MOST_OBJECTS {
            return Err(element.fault(&format!("more than {MOST_OBJECTS} bodies")));
        }
        let name = element.attribute("name").map_or_else(|| format!("body{index}"), str::to_owned);
        if !self.names.insert(name.clone()) {
            return Err(element.fault(&format!("two bodies are named {}; rename one of them", shown(&name))));
        }
        let frame = within(&around.frame, &self.angles.pose(element)?);
        let mut pose = within(&self.found.bodies[around.body].pose, &frame);
        let mut jointed = false;
        for joint in element.children.iter().filter(|it| it.name == "joint" || it.name == "freejoint") {
            jointed = true;
            pose = within(&pose, &self.moved(joint, class)?);
        }
        let welded = if jointed { index } else { self.found.bodies[around.body].welded };
        self.found.bodies.push(Body { name, parent: around.body, welded, pose });
        Ok(index)
    }

    /// By how much a joint moves its body from where the file has it.
    fn moved(&mut self, joint: &Element, class: &str) -> Found<Pose> {
        let joint = self.defaults.of(joint, class)?;
        let (Some(name), false) = (joint.attribute("name"), joint.name == "freejoint") else {
            return Ok(Pose::identity());
        };
        let turns = match joint.attribute("type").unwrap_or("hinge") {
            "hinge" => true,
            "slide" => false,
            _ => return Ok(Pose::identity()),
        };
        if !self.joints.insert(name.to_owned()) {
            return Err(joint.fault(&format!("two joints are named {}; rename one of them", shown(name))));
        }
        let Some(value) = self.values.get(name) else { return Ok(Pose::identity()) };
        let axis = Vector3::from(joint.numbers("axis")?.unwrap_or([0.0, 0.0, 1.0])).try_normalize(0.0);
        let axis = axis.ok_or_else(|| joint.fault("its axis is 0 0 0"))?;
        let reference = joint.number("ref")?.unwrap_or_default();
        let place = Vector3::from(joint.numbers::<3>("pos")?.unwrap_or_default());
        Ok(if turns {
            turned_about(&place, &axis, value - reference * self.angles.unit)
        } else {
            Pose { linear: Matrix3::identity(), translation: (value - reference) * axis }
        })
    }
}
