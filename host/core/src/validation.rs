//! One answer against the truth: the verdicts.
//!
//! Every check takes constant time (a pair of triangles, a point on a triangle), except that a list of contacts is
//! compared with the complete list.
//!
//! `tau` is `32 u S` for the precision that the algorithm declares. An answer is right when it is the exact answer of
//! *some* scene whose coordinates differ by no more than that, so:
//!
//! * a collision answer is wrong only when the configuration is further than `tau` from the other answer; within the
//!   band the verdict is [`Verdict::Undecidable`];
//! * a distance may miss the certified interval by `tau`, and so may witness points miss the triangles they are claimed
//!   to lie on, and their distance the claimed one;
//! * a closed object inside another one is a collision at distance 0 where the scene asks for solid bodies, and no
//!   pair of triangles can be named for it;
//! * a number that is not finite, or negative, and a triangle that does not exist are never taken for anything.

use nalgebra::Point3;

use crate::configuration::{Class, Placed, Truth};
use crate::oracle::{Pair, Side, U32, U64};
use crate::query::{Answer, Query, Semantics};
use crate::record::{ContactScore, Verdict};

/// The arithmetic an algorithm declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// f32.
    Single,
    /// f64.
    Double,
}

impl Precision {
    /// What one rounding may change, relatively.
    pub fn unit_roundoff(self) -> f64 {
        match self {
            Self::Single => U32,
            Self::Double => U64,
        }
    }
}

/// What is asked of an algorithm, and what it says of itself.
#[derive(Clone, Copy, Debug)]
pub struct Terms {
    /// The question.
    pub query: Query,
    /// What counts as an object.
    pub semantics: Semantics,
    /// The arithmetic of the algorithm.
    pub precision: Precision,
}

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Right, wrong, or none.
    pub verdict: Verdict,
    /// For a list of contacts whose numbers make sense.
    pub contacts: Option<ContactScore>,
}

/// Judges one answer on a configuration whose truth is known.
pub fn judge(pair: &Pair, placed: &Placed, terms: Terms, answer: &Answer) -> Judged {
    let truth = pair.asked(&placed.configuration, &placed.truth, terms.semantics);
    let class = match terms.precision {
        Precision::Single => truth.class32,
        Precision::Double => truth.class64,
    };
    let tau = pair.tau(&placed.configuration, terms.precision.unit_roundoff());
    let judge = Judge { pair, placed, truth, class, tau };
    let plain = |judgement: Judgement| Judged { verdict: judgement.unwrap_or_else(|wrong| wrong), contacts: None };
    match (answer, terms.query) {
        (Answer::GaveUp, _) => plain(Ok(Verdict::GaveUp)),
        (Answer::Unsupported, _) => plain(Ok(Verdict::Unsupported)),
        (Answer::Collision { hit, pair }, Query::CollisionFirst) => plain(judge.collision(*hit, pair.as_slice())),
        (Answer::Contacts { total, pairs }, Query::CollisionAll) => judge.contacts(*total, pairs),
        (Answer::Distance { distance, points, triangles }, Query::Proximity) => {
            plain(judge.distance(*distance, points.as_ref(), *triangles))
        }
        // An answer to a question that was not asked.
        (Answer::Collision { .. } | Answer::Contacts { .. } | Answer::Distance { .. }, _) => {
            plain(Err(Verdict::Invalid))
        }
    }
}

struct Judge<'j> {
    pair: &'j Pair<'j>,
    placed: &'j Placed,
    /// Of what the scene asks.
    truth: Truth,
    class: Class,
    tau: f64,
}

/// The final verdict, or the first thing that is wrong.
type Judgement = Result<Verdict, Verdict>;

impl Judge<'_> {
    /// A collision answer; `claimed` are the pairs of triangles said to meet.
    fn collision(&self, hit: bool, claimed: &[[u32; 2]]) -> Judgement {
        let verdict = self.decision(hit, claimed)?;
        // A pair that meets is a proof, found by one exact test at most.
        if claimed.iter().all(|&pair| self.is_contact(pair)) { Ok(verdict) } else { Err(Verdict::WrongWitness) }
    }

    /// Yes or no, before the claimed pairs are looked at.
    fn decision(&self, hit: bool, claimed: &[[u32; 2]]) -> Judgement {
        for &pair in claimed {
            self.exists(pair)?;
        }
        match (hit, self.class) {
            (true, Class::Clear) => Err(Verdict::FalsePositive),
            (false, Class::Colliding) => Err(Verdict::FalseNegative),
            // A pair that meets and an answer that denies it.
            (false, _) if !claimed.is_empty() => Err(Verdict::Invalid),
            (_, Class::Grazing) => Ok(Verdict::Undecidable),
            _ => Ok(Verdict::Correct),
        }
    }

    /// Do two triangles meet, up to the precision?
    fn is_contact(&self, pair: [u32; 2]) -> bool {
        self.pair.triangle_distance(&self.placed.configuration, pair).0 <= self.tau
    }

    /// A list of contacts: none invented, and none missing that crosses by more than tau.
    fn contacts(&self, total: u64, pairs: &[[u32; 2]]) -> Judged {
        let mut listed = pairs.to_vec();
        listed.sort_unstable();
        let twice = listed.windows(2).any(|w| w[0] == w[1]); // each pair is counted once
        if total < pairs.len() as u64 || twice || listed.iter().any(|&pair| self.exists(pair).is_err()) {
            return Judged { verdict: Verdict::Invalid, contacts: None };
        }
        let score = self.score(total, &listed);
        // A list cut short by the host's buffer can only be counted.
        let missing = score.found.unwrap_or(total) < score.robust;
        // Contacts that are counted but not listed must exist as well.
        let invented = total > score.listed && total > self.pair.most_contacts(&self.placed.configuration, self.tau);
        let verdict = match self.decision(total > 0, pairs) {
            Ok(_) if score.genuine < score.listed || invented => Verdict::WrongWitness,
            Ok(_) if missing => Verdict::FalseNegative,
            Ok(verdict) | Err(verdict) => verdict,
        };
        Judged { verdict, contacts: Some(score) }
    }

    /// Compares a sorted list with the complete one.
    fn score(&self, total: u64, listed: &[[u32; 2]]) -> ContactScore {
        let genuine = listed.iter().filter(|&&pair| self.is_contact(pair)).count() as u64;
        // Only surfaces that meet have contacts; the search would find that out again.
        let contacts =
            if self.placed.truth.hit { self.pair.contact_margins(&self.placed.configuration) } else { Vec::new() };
        let robust = || contacts.iter().filter(|c| c.margin > self.tau);
        let found = robust().filter(|c| listed.binary_search(&c.pair).is_ok()).count() as u64;
        ContactScore {
            listed: listed.len() as u64,
            genuine,
            robust: robust().count() as u64,
            found: (total == listed.len() as u64).then_some(found),
        }
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
        let truth = &self.truth;
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
