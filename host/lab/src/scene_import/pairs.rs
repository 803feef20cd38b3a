//! The pairs of objects that are not asked, from what a description says of links and objects.

use std::collections::BTreeMap;
use std::sync::Arc;

use ocb_core::scene::{DisabledPair, MOST_DISABLED};
use ocb_sandbox::text;

use super::Found;

/// Most pairs of links.
const MOST_OF_LINKS: usize = 1_000_000;

/// Pairs of links by their indices, the smaller first, and why they are not asked.
#[derive(Debug, Default)]
pub struct LinkPairs {
    reasons: BTreeMap<(usize, usize), Arc<str>>,
}

impl LinkPairs {
    /// Two links are not asked. The first reason stays.
    pub fn disable(&mut self, a: usize, b: usize, reason: &str) -> Found<()> {
        if a != b {
            self.reasons.entry((a.min(b), a.max(b))).or_insert_with(|| text::one_line(reason, 200).into());
        }
        if self.reasons.len() > MOST_OF_LINKS {
            return Err(format!("more than {MOST_OF_LINKS} pairs of links are disabled"));
        }
        Ok(())
    }
}

/// Pairs of objects by their indices, the smaller first, and why they are not asked.
#[derive(Debug, Default)]
pub struct ObjectPairs {
    reasons: BTreeMap<(u32, u32), Arc<str>>,
}

impl ObjectPairs {
    /// The objects of one link, and those of disabled pairs of links. `link_of` is the link of each object.
    pub fn of_links(pairs: &LinkPairs, link_of: &[usize]) -> Found<Self> {
        let objects = objects_of(link_of);
        let mut found = Self::default();
        let same: Arc<str> = "same link".into();
        for some in objects.values() {
            found.disable_among(some, &same)?;
        }
        for ((a, b), reason) in &pairs.reasons {
            if let (Some(a), Some(b)) = (objects.get(a), objects.get(b)) {
                found.disable_between(a, b, reason)?;
            }
        }
        Ok(found)
    }

    /// All pairs among these.
    pub fn disable_among(&mut self, objects: &[u32], reason: &Arc<str>) -> Found<()> {
        for (place, &a) in objects.iter().enumerate() {
            self.disable_between(&[a], &objects[place + 1..], reason)?;
        }
        Ok(())
    }

    /// All pairs of one of these and one of those. The first reason stays.
    pub fn disable_between(&mut self, these: &[u32], those: &[u32], reason: &Arc<str>) -> Found<()> {
        for &a in these {
            for &b in those {
                self.reasons.entry((a.min(b), a.max(b))).or_insert_with(|| reason.clone());
            }
            if self.reasons.len() > MOST_DISABLED {
                return Err(format!(
                    "more than {MOST_DISABLED} pairs of objects would be disabled; join the geometry of links"
                ));
            }
        }
        Ok(())
    }

    /// A pair is asked after all.
    pub fn enable(&mut self, a: u32, b: u32) {
        self.reasons.remove(&(a.min(b), a.max(b)));
    }

    /// In the order of their objects.
    pub fn finish(self) -> Vec<DisabledPair> {
        let pair = |((a, b), reason): ((u32, u32), Arc<str>)| DisabledPair { a, b, reason: reason.to_string() };
        self.reasons.into_iter().map(pair).collect()
    }
}

/// The objects of each group that has some; `group_of` is the group of each object.
pub fn objects_of<G: Ord + Copy>(group_of: &[G]) -> BTreeMap<G, Vec<u32>> {
    let mut objects: BTreeMap<G, Vec<u32>> = BTreeMap::new();
    for (object, &group) in group_of.iter().enumerate() {
        objects.entry(group).or_default().push(object as u32);
    }
    objects
}
