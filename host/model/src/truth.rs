//! Certified answers, for whoever asks the oracle alone.

use ocb_core::configuration::{Class, Containment, Truth};
use ocb_core::oracle::Contact;
use serde::Serialize;

/// The certified answer about one configuration. Lengths are the objects' own, points are in the world.
#[derive(Clone, Debug, Serialize)]
pub struct TruthRow {
    /// Line of the file of pairs (from 1), or position in the set of configurations (from 0).
    pub index: u64,
    /// Name of the case, in a file of pairs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its family.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub family: Option<String>,
    /// Do the surfaces meet?
    pub hit: bool,
    /// The distance is certainly no less; absent when it was not asked for.
    pub distance_lo: Option<f64>,
    /// The distance is certainly no more.
    pub distance_hi: Option<f64>,
    /// How far every vertex may move and the surfaces still cross (lower bound).
    pub margin: f64,
    /// Part of one closed object inside the other; absent when the surfaces meet or one is not closed.
    pub containment: Option<Containment>,
    /// What may be asked of an algorithm in double precision.
    pub class64: Class,
    /// In single precision.
    pub class32: Class,
    /// The nearest or a meeting pair of triangles.
    pub triangles: Option<[u32; 2]>,
    /// Points on them that realise the distance: on A, on B.
    pub points: Option<[[f64; 3]; 2]>,
    /// Whether exact arithmetic was needed.
    pub exact_used: bool,
    /// All pairs of triangles that meet, when asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contacts: Option<Vec<ContactRow>>,
    /// In what it differs from the truth given in the file; empty when it does not, absent when none is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub differs: Option<String>,
}

/// One pair of triangles that meet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ContactRow {
    /// Triangle of A.
    pub triangle_a: u32,
    /// Triangle of B.
    pub triangle_b: u32,
    /// How far every vertex may move and the two still cross (lower bound); 0 when they only touch.
    pub margin: f64,
}

impl TruthRow {
    /// Everything that is known.
    pub fn of(index: u64, truth: &Truth) -> Self {
        let (w, finite) = (&truth.witness, |x: f64| Some(x).filter(|x| x.is_finite()));
        Self {
            index,
            name: None,
            family: None,
            hit: truth.hit,
            distance_lo: finite(truth.distance_lo),
            distance_hi: finite(truth.distance_hi),
            margin: truth.margin,
            containment: truth.containment,
            class64: truth.class64,
            class32: truth.class32,
            triangles: Some([w.triangle_a, w.triangle_b]),
            points: Some([w.point_a.coords.into(), w.point_b.coords.into()]),
            exact_used: truth.exact_used,
            contacts: None,
            differs: None,
        }
    }

    /// Certainly apart, and nothing else is asked.
    pub fn clear(index: u64, containment: Option<Containment>) -> Self {
        Self {
            index,
            name: None,
            family: None,
            hit: false,
            distance_lo: None,
            distance_hi: None,
            margin: 0.0,
            containment,
            class64: Class::Clear,
            class32: Class::Clear,
            triangles: None,
            points: None,
            exact_used: false,
            contacts: None,
            differs: None,
        }
    }
}

impl From<&Contact> for ContactRow {
    fn from(contact: &Contact) -> Self {
        let [triangle_a, triangle_b] = contact.pair;
        Self { triangle_a, triangle_b, margin: contact.margin }
    }
}
