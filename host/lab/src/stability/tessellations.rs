//! The same surface cut into other triangles: change of time and answer.

use std::sync::Arc;

use ocb_core::configuration::Configuration;
use ocb_core::pose::Pose;
use ocb_core::query::{Answer, Query, Semantics};
use ocb_core::statistics::Statistic;
use ocb_core::stock;
use ocb_stability::draw::Draw;
use ocb_stability::tessellations::Cut;
use ocb_stability::{Posed, Rule};

use super::ask::{Asker, Got};
use super::judge::Known;
use crate::Result;
use crate::model::TessellationResult;

/// Flat sides, where much can be cut otherwise, and a surface without any.
const OBJECTS: [&str; 2] = ["box", "torus-knot"];
const TRIANGLES: u32 = 500;
/// Questions per object.
const POSES: usize = 12;

/// Every cut of every object against itself.
pub fn tessellations(asker: &mut Asker) -> Result<Vec<TessellationResult>> {
    let mut all = Vec::new();
    for name in OBJECTS {
        let Some(mesh) = stock::generate(name, TRIANGLES).map(Arc::new) else { continue };
        let mut draw = Draw::new(1);
        let poses: Vec<Pose> = (0..POSES)
            .map(|_| Pose { linear: draw.rotation(), translation: draw.direction() * draw.between(0.2, 1.2) })
            .collect();
        let poses = &poses;
        let cuts = Cut::ALL.map(|cut| {
            let cut_mesh = cut.of(&mesh);
            let posed: Vec<Posed> = poses.iter().map(|pose| Posed::new(&cut_mesh, &cut_mesh, *pose)).collect();
            let known: Vec<Known> = posed.iter().map(Known::of).collect();
            (cut, cut_mesh, posed, known)
        });
        for query in [Query::CollisionFirst, Query::Proximity] {
            if !asker.offers(query, Semantics::Surface) {
                continue;
            }
            let mut original: Vec<Got> = Vec::new();
            for (cut, cut_mesh, posed, known) in &cuts {
                let questions: Vec<(Query, Configuration)> = posed.iter().map(|p| (query, p.configuration)).collect();
                let got = asker.ask(cut_mesh, cut_mesh, Semantics::Surface, &questions)?;
                if *cut == Cut::Original {
                    original = got.clone();
                }
                let tally =
                    |(known, got): (&Known, &Got)| known.tally(got, query, false, Rule::Judged, asker.precision, None);
                let wrong = known.iter().zip(&got).map(tally).filter(|tally| tally.failed()).count() as u32;
                let mut found = compared(&original, &got, mesh.longest_side());
                (found.object, found.cut, found.query, found.wrong) = (name.into(), cut.name().into(), query, wrong);
                found.triangles = cut_mesh.triangles().len() as u32;
                all.push(found);
            }
        }
    }
    Ok(all)
}

/// Times and answers beside those for the original.
fn compared(original: &[Got], got: &[Got], size: f64) -> TessellationResult {
    let (mut times, mut ratios, mut decisions, mut distance) = (Vec::new(), Vec::new(), 0, 0.0f64);
    for (before, after) in original.iter().zip(got) {
        let (Got::Answer(before, ns_before), Got::Answer(after, ns)) = (before, after) else { continue };
        times.push(*ns);
        ratios.push(ns / ns_before);
        match (before, after) {
            (Answer::Collision { hit: one, .. }, Answer::Collision { hit: other, .. }) => {
                decisions += u32::from(one != other)
            }
            (Answer::Distance { distance: one, .. }, Answer::Distance { distance: other, .. }) => {
                distance = distance.max((one - other).abs() / size);
            }
            _ => {}
        }
    }
    let median = |values: &mut [f64]| Statistic::Median.of(values).unwrap_or(0.0);
    TessellationResult {
        object: String::new(),
        cut: String::new(),
        triangles: 0,
        query: Query::CollisionFirst,
        n: times.len() as u32,
        median_ns: median(&mut times),
        ratio: median(&mut ratios),
        decisions,
        distance,
        wrong: 0,
    }
}
