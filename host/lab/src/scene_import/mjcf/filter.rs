//! Which pairs of geoms MuJoCo does not ask: those of one rigid body, of a body and its parent, of bodies that `<contact>` excludes,
//! and those whose bit masks do not match; but what `<pair>` names is asked.

use std::collections::HashMap;
use std::sync::Arc;

use ocb_core::scene::DisabledPair;

use super::bodies::Body;
use crate::scene_import::element::Element;
use crate::scene_import::pairs::{LinkPairs, ObjectPairs, objects_of};
use crate::scene_import::{Found, shown};

/// Most different pairs of `contype` and `conaffinity`.
const MOST_MASKS: usize = 1_000;

/// The two geoms of each `<pair>`.
pub fn explicit(model: &Element) -> Found<Vec<[&str; 2]>> {
    let pairs = model.named("contact").flat_map(|contact| contact.named("pair"));
    pairs.map(|pair| Ok([pair.required("geom1")?, pair.required("geom2")?])).collect()
}

/// `contype` and `conaffinity` of a geom.
pub fn masks(geom: &Element) -> Found<[u32; 2]> {
    let mask = |name: &str| {
        let Some(text) = geom.attribute(name) else { return Ok(1) };
        let number = text.trim().parse::<i64>().ok().and_then(|it| {
            // Negative numbers stand for their bits.
            u32::try_from(it).ok().or_else(|| i32::try_from(it).ok().map(i32::cast_unsigned))
        });
        number.ok_or_else(|| geom.fault(&format!("{name} is {}, and not a whole number of 32 bits", shown(text))))
    };
    Ok([mask("contype")?, mask("conaffinity")?])
}

/// The pairs that are not asked; `body_of` and `masks` are of each object, `by_name` are objects by the names of their geoms.
pub fn disabled(
    model: &Element,
    bodies: &[Body],
    body_of: &[usize],
    masks: &[[u32; 2]],
    by_name: &HashMap<String, u32>,
) -> Found<Vec<DisabledPair>> {
    let mut links = LinkPairs::default();
    let named: HashMap<&str, usize> =
        bodies.iter().enumerate().map(|(index, body)| (body.name.as_str(), index)).collect();
    for exclude in model.named("contact").flat_map(|contact| contact.named("exclude")) {
        let body = |end: &str| {
            let name = exclude.required(end)?;
            named.get(name).copied().ok_or_else(|| exclude.fault(&format!("the body {} is not there", shown(name))))
        };
        links.disable(body("body1")?, body("body2")?, "excluded in <contact>")?;
    }
    let mut pairs = ObjectPairs::of_links(&links, body_of)?;

    // Bodies without joints are one with their parent.
    let rigid: Vec<usize> = body_of.iter().map(|&body| bodies[body].welded).collect();
    let objects = objects_of(&rigid);
    let reason: Arc<str> = "rigidly joined".into();
    for some in objects.values() {
        pairs.disable_among(some, &reason)?;
    }
    if filters_parents(model) {
        let reason: Arc<str> = "adjacent links".into();
        for (&body, those) in objects.iter().filter(|(body, _)| **body != 0) {
            let parent = bodies[bodies[body].parent].welded;
            if let Some(these) = objects.get(&parent).filter(|_| parent != 0) {
                pairs.disable_between(these, those, &reason)?;
            }
        }
    }
    let kinds: Vec<([u32; 2], Vec<u32>)> = objects_of(masks).into_iter().collect();
    if kinds.len() > MOST_MASKS {
        return Err(format!("it has more than {MOST_MASKS} different masks of contype and conaffinity"));
    }
    let reason: Arc<str> = "contype and conaffinity".into();
    for (place, (mask, these)) in kinds.iter().enumerate() {
        if mask[0] & mask[1] == 0 {
            pairs.disable_among(these, &reason)?;
        }
        for (other, those) in &kinds[place + 1..] {
            if mask[0] & other[1] == 0 && other[0] & mask[1] == 0 {
                pairs.disable_between(these, those, &reason)?;
            }
        }
    }
    for [a, b] in explicit(model)? {
        if let (Some(&a), Some(&b)) = (by_name.get(a), by_name.get(b)) {
            pairs.enable(a, b);
        }
    }
    Ok(pairs.finish())
}

/// Is a body not asked against its parent? So it is unless a flag says otherwise; the world is asked against its children.
fn filters_parents(model: &Element) -> bool {
    let flags = model.named("option").flat_map(|option| option.named("flag"));
    flags.filter_map(|flag| flag.attribute("filterparent")).last() != Some("disable")
}
