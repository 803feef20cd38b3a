//! SRDF, the Semantic Robot Description Format of MoveIt: which pairs of links are not asked.

use std::collections::{HashMap, HashSet};

use super::element::Element;
use super::pairs::LinkPairs;
use super::{Found, shown};

/// Reads `disable_collisions`, and `disable_default_collisions` with its exceptions `enable_collisions`.
///
/// Gives notes about pairs of links that the robot does not have: such files are made for several variants of a robot.
pub fn read(robot: &Element, links: &HashMap<&str, usize>, pairs: &mut LinkPairs) -> Found<Vec<String>> {
    if robot.name != "robot" {
        return Err(robot.fault(&format!("the root element is <{}>, and that of SRDF is <robot>", robot.name)));
    }
    let mut unknown = Vec::new();
    let mut of_two = |element: &Element| -> Found<Option<(usize, usize)>> {
        let mut ends = ["link1", "link2"].into_iter().map(|end| {
            let name = element.required(end)?;
            if !links.contains_key(name) {
                unknown.push(name.to_owned());
            }
            Found::Ok(links.get(name).copied())
        });
        let (a, b) = (ends.next().transpose()?.flatten(), ends.next().transpose()?.flatten());
        Ok(a.zip(b))
    };
    for element in robot.named("disable_collisions") {
        if let Some((a, b)) = of_two(element)? {
            pairs.disable(a, b, element.attribute("reason").filter(|it| !it.trim().is_empty()).unwrap_or("SRDF"))?;
        }
    }
    let mut enabled = HashSet::new();
    for element in robot.named("enable_collisions") {
        enabled.extend(of_two(element)?.map(|(a, b)| (a.min(b), a.max(b))));
    }
    let mut defaults = HashSet::new();
    for element in robot.named("disable_default_collisions") {
        let Some(&link) = links.get(element.required("link")?).filter(|&&link| defaults.insert(link)) else { continue };
        for other in (0..links.len()).filter(|&other| !enabled.contains(&(link.min(other), link.max(other)))) {
            pairs.disable(link, other, "disabled by default")?;
        }
    }
    unknown.sort_unstable();
    unknown.dedup();
    Ok(unknown
        .first()
        .map(|first| {
            format!(
                "The SRDF file names {} link(s) that the robot does not have, such as {}.",
                unknown.len(),
                shown(first)
            )
        })
        .into_iter()
        .collect())
}
