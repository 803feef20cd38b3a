//! A failing question, made as small as it still fails, with everything that is needed to ask it again.

use ocb_core::mesh::obj;
use ocb_core::pose::Pose;
use ocb_core::query::{Query, Semantics};
use ocb_stability::minimise::minimise;
use ocb_stability::{Posed, Question};

use super::ask::{Asker, Got};
use super::judge::{Known, told};
use crate::Result;
use crate::model::FailingCase;

/// Processes that are started to make one case smaller.
const ATTEMPTS: u32 = 40;

/// Where a question comes from.
pub struct Place<'a> {
    /// Family or relation.
    pub part: &'a str,
    /// The value of its parameter.
    pub at: f64,
    /// Its seed.
    pub seed: u32,
}

/// Smaller, if it fails alone and quickly: what needs other questions before it, or hangs, stays as it is.
pub fn repro(
    asker: &mut Asker,
    question: &Question,
    query: Query,
    got: &Got,
    unsteady: bool,
    place: &Place,
) -> Result<FailingCase> {
    let semantics = if question.solid { Semantics::Solid } else { Semantics::Surface };
    let hangs = matches!(got, Got::Hung(_));
    let mut last = got.clone();
    let fails = |posed: &Posed| -> Result<bool> {
        let got = asker.ask(&posed.a, &posed.b, semantics, &[(query, posed.configuration)])?.remove(0);
        let tally = Known::of(posed).tally(&got, query, question.solid, question.rule, asker.precision, None);
        if tally.failed() {
            last = got;
        }
        Ok(tally.failed())
    };
    let small = if hangs || unsteady { None } else { minimise(&question.posed, ATTEMPTS, fails)? };
    let small = small.unwrap_or_else(|| question.posed.clone());
    let before = size(&question.posed);
    Ok(written(asker, &small, before, Known::of(&small).expected(semantics), told(&last), place))
}

fn size(posed: &Posed) -> [u32; 2] {
    [&posed.a, &posed.b].map(|mesh| mesh.triangles().len() as u32)
}

/// All numbers as text.
pub fn written(
    asker: &Asker,
    posed: &Posed,
    before: [u32; 2],
    expected: String,
    got: String,
    place: &Place,
) -> FailingCase {
    let Place { part, at, seed } = place;
    let numbers = |pose: &Pose| pose.to_row_major().iter().map(f64::to_string).collect();
    FailingCase {
        at: *at,
        seed: *seed,
        expected,
        got,
        triangles_before: before,
        triangles: size(posed),
        a: obj::write(&posed.a),
        b: obj::write(&posed.b),
        pose_a: numbers(&posed.configuration.pose_a),
        pose_b: numbers(&posed.configuration.pose_b),
        command: format!("ocb stability {} --family {part} --at {at} --seed {seed}", asker.algorithm.info.id),
    }
}
