//! One answer against the truth: the verdicts.
//!
//! Every check takes constant time (a pair of triangles, a point on a triangle), except that a complete list of contacts
//! is compared with the complete list.
//!
//! `tau` is `32 u S` for the precision that the algorithm declares. An answer is right when it is the exact answer of
//! *some* scene whose coordinates differ by no more than that, so:
//!
//! * a collision answer is wrong only when the configuration is further than `tau` from the other answer; within the
//!   band the verdict is [`Verdict::Undecidable`];
//! * a distance may miss the certified interval by `tau`, and so may witness points miss the triangles they are claimed
//!   to lie on, and their distance the claimed one;
//! * a number that is not finite, or negative, and a triangle that does not exist are never taken for anything.

use nalgebra::Point3;

use crate::configuration::{Class, Placed};
use crate::oracle::{Pair, Side, U32, U64};
use crate::query::{Answer, Query};
use crate::record::Verdict;

/// The arithmetic an algorithm declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// f32.
    Single,
    /// f64.
    Double,
}

/// Judges one answer to `query` on a configuration whose truth is known.
pub fn judge(pair: &Pair, placed: &Placed, query: Query, answer: &Answer, precision: Precision) -> Verdict {
    let (class, unit_roundoff) = match precision {
        Precision::Single => (placed.truth.class32, U32),
        Precision::Double => (placed.truth.class64, U64),
    };
    let judge = Judge { pair, placed, class, tau: pair.tau(&placed.configuration, unit_roundoff) };
    match (answer, query) {
        (Answer::GaveUp, _) => Verdict::GaveUp,
        (Answer::Unsupported, _) => Verdict::Unsupported,
        (Answer::Collision { hit, pair }, Query::CollisionFirst) => {
            judge.collision(*hit, pair.as_slice()).unwrap_or_else(|wrong| wrong)
        }
        (Answer::Contacts { total, pairs }, Query::CollisionAll) => {
            judge.contacts(*total, pairs).unwrap_or_else(|wrong| wrong)
        }
        (Answer::Distance { distance, points, triangles }, Query::Proximity) => {
            judge.distance(*distance, points.as_ref(), *triangles).unwrap_or_else(|wrong| wrong)
        }
        // An answer to a question that was not asked.
        (Answer::Collision { .. } | Answer::Contacts { .. } | Answer::Distance { .. }, _) => Verdict::Invalid,
    }
}

struct Judge<'j> {
    pair: &'j Pair<'j>,
    placed: &'j Placed,
    class: Class,
    tau: f64,
}

/// The final verdict, or the first thing that is wrong.
type Judgement = Result<Verdict, Verdict>;

impl Judge<'_> {
    /// A collision answer; `claimed` are the pairs of triangles said to meet.
    fn collision(&self, hit: bool, claimed: &[[u32; 2]]) -> Judgement {
        for &pair in claimed {
            self.exists(pair)?;
        }
        match (hit, self.class) {
            (true, Class::Clear) => return Err(Verdict::FalsePositive),
            (false, Class::Colliding) => return Err(Verdict::FalseNegative),
            // A pair that meets and an answer that denies it.
            (false, _) if !claimed.is_empty() => return Err(Verdict::Invalid),
            _ => {}
        }
        for &pair in claimed {
            let (apart, _) = self.pair.triangle_distance(&self.placed.configuration, pair);
            if apart > self.tau {
                return Err(Verdict::WrongWitness);
            }
        }
        Ok(if self.class == Class::Grazing { Verdict::Undecidable } else { Verdict::Correct })
    }

    /// A list of contacts: none invented, and none missing that crosses by more than tau.
    fn contacts(&self, total: u64, pairs: &[[u32; 2]]) -> Judgement {
        if total < pairs.len() as u64 {
            return Err(Verdict::Invalid);
        }
        let verdict = self.collision(total > 0, pairs)?;
        let mut listed = pairs.to_vec();
        listed.sort_unstable();
        if listed.windows(2).any(|w| w[0] == w[1]) {
            return Err(Verdict::Invalid); // each pair is counted once
        }
        if self.class == Class::Clear {
            return Ok(verdict);
        }
        let contacts = self.pair.contact_margins(&self.placed.configuration);
        let robust = || contacts.iter().filter(|c| c.margin > self.tau);
        // A list cut short by the host's buffer can only be counted.
        let missing = if total == pairs.len() as u64 {
            robust().any(|c| listed.binary_search(&c.pair).is_err())
        } else {
            total < robust().count() as u64
        };
        if missing { Err(Verdict::FalseNegative) } else { Ok(verdict) }
    }

    fn distance(&self, distance: f64, points: Option<&[Point3<f64>; 2]>, triangles: Option<[u32; 2]>) -> Judgement {
        if !distance.is_finite() || distance < 0.0 {
            return Err(Verdict::Invalid);
        }
        if points.is_some_and(|points| points.iter().any(|p| p.iter().any(|x| !x.is_finite()))) {
            return Err(Verdict::Invalid);
        }
        if let Some(pair) = triangles {
            self.exists(pair)?;
        }
        let truth = &self.placed.truth;
        if distance > truth.distance_hi + self.tau {
            // Saying that colliding objects are apart is a missed collision, whatever the query was called.
            let missed = self.class == Class::Colliding;
            return Err(if missed { Verdict::FalseNegative } else { Verdict::DistanceOver });
        }
        if distance < truth.distance_lo - self.tau {
            return Err(Verdict::DistanceUnder);
        }
        let off = |x: f64| x > self.tau;
        let configuration = &self.placed.configuration;
        if let Some([a, b]) = points {
            if off(((a - b).norm() - distance).abs()) {
                return Err(Verdict::WrongWitness);
            }
            if let Some([i, j]) = triangles
                && (off(self.pair.off_triangle(configuration, Side::A, i, a))
                    || off(self.pair.off_triangle(configuration, Side::B, j, b)))
            {
                return Err(Verdict::WrongWitness);
            }
        } else if let Some(pair) = triangles {
            let (lo, hi) = self.pair.triangle_distance(configuration, pair);
            if off(lo - distance) || off(distance - hi) {
                return Err(Verdict::WrongWitness);
            }
        }
        Ok(Verdict::Correct)
    }

    fn exists(&self, [i, j]: [u32; 2]) -> Result<(), Verdict> {
        let in_range = |t: u32, n: usize| (t as usize) < n;
        let known = in_range(i, self.pair.a().triangles().len()) && in_range(j, self.pair.b().triangles().len());
        if known { Ok(()) } else { Err(Verdict::Invalid) }
    }
}
