//! Whether a relation holds.

use super::{Breach, Relation, Said};
use crate::Posed;

/// Distances that follow from each other may differ by so many bands.
const SLACK: f64 = 2.0;

pub fn breach(
    relation: Relation,
    base: &Posed,
    said: &Said,
    at: f64,
    derived: &[Posed],
    answers: &[Said],
    tau: f64,
) -> Option<Breach> {
    let slack = SLACK * tau;
    let first = answers.first();
    match relation {
        Relation::Unit => {
            let factor = 2f64.powi(at as i32);
            // The band is that of the wider scene: bring the distance back to the base's unit.
            let back = Said { distance: first?.distance.map(|d| d / factor), ..*first? };
            same(said, &back, SLACK * tau / factor.max(1.0))
        }
        Relation::Again => {
            let same_bits = |x: &Said| {
                x.hit == said.hit
                    && x.contacts == said.contacts
                    && x.distance.map(f64::to_bits) == said.distance.map(f64::to_bits)
            };
            match answers.iter().find(|answer| !same_bits(answer))? {
                other if other.hit == said.hit => Some(Breach::Distance),
                _ => Some(Breach::Decision),
            }
        }
        Relation::Swap
        | Relation::Axes
        | Relation::Translation
        | Relation::Rotation
        | Relation::Numbering
        | Relation::Subdivision => same(&Said { contacts: None, ..*said }, first?, slack),
        Relation::Subset => {
            let part = first?;
            let nearer = part.distance.zip(said.distance).is_some_and(|(part, whole)| part < whole - slack);
            decision(part.hit == Some(true) && said.hit == Some(false)).or(distance(nearer))
        }
        Relation::Union => {
            let [one, two] = answers else { return None };
            let any = one.hit.zip(two.hit).map(|(one, two)| one || two);
            let nearest = one.distance.zip(two.distance).map(|(one, two)| one.min(two));
            same(said, &Said { hit: any, distance: nearest, ..Said::default() }, slack)
        }
        Relation::Moved | Relation::Turned => {
            let most = match relation {
                Relation::Moved => at,
                // Of a point that is farthest from the axis.
                _ => {
                    let reach = derived.first()?.b.positions().iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
                    2.0 * (at / 2.0).sin() * reach
                }
            };
            let (before, after) = (reported(said)?, reported(first?)?);
            distance((before - after).abs() > most * (1.0 + 1e-9) + slack)
        }
        Relation::Away => {
            let (before, after) = (said.distance?, reported(first?)?);
            distance(before > slack && (after - before - at).abs() > slack + 1e-9 * at && after < before + at - slack)
        }
        Relation::Approach => {
            let (before, after) = (said.distance?, reported(first?)?);
            distance(before > slack && after > before * (1.0 - at) + slack)
        }
        Relation::Consistency => {
            let (hit, apart) = (said.hit?, said.distance?);
            decision(if hit { apart > slack } else { apart == 0.0 })
        }
        Relation::FirstAndAll => decision(said.hit? != (said.contacts? > 0)),
        Relation::Witness => {
            let ([p, q], apart) = (said.points?, said.distance?);
            let scene = base.configuration.pose_b.translation.amax();
            let wrong = !(p - q).norm().is_finite() || ((p - q).norm() - apart).abs() > slack + 1e-15 * scene;
            distance(wrong)
        }
    }
}

/// The distance that follows from what was said: 0 for a collision.
fn reported(said: &Said) -> Option<f64> {
    said.distance.filter(|d| d.is_finite())
}

fn same(one: &Said, other: &Said, slack: f64) -> Option<Breach> {
    let decided = one.hit.zip(other.hit).is_some_and(|(one, other)| one != other);
    let far = one.distance.zip(other.distance).is_some_and(|(one, other)| {
        // A number against none is a difference as well.
        (one - other).abs() > slack || one.is_finite() != other.is_finite()
    });
    decision(decided).or(distance(far))
}

fn decision(broken: bool) -> Option<Breach> {
    broken.then_some(Breach::Decision)
}

fn distance(broken: bool) -> Option<Breach> {
    broken.then_some(Breach::Distance)
}
