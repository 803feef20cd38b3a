//! The columns of the oracle's answers: one truth, or two where rounding to single precision changes the objects.

use std::sync::Arc;

use arrow_array::{Array, ArrayRef, BooleanArray, Float64Array, RecordBatch, StringArray, UInt32Array};
use ocb_core::configuration::{Class, Containment, Truth, Witness};

use super::column;
use super::lists::{Points, lists};
use crate::Result;

/// The names of a truth's columns.
pub struct TruthNames {
    pub hit: &'static str,
    distance_lo: &'static str,
    distance_hi: &'static str,
    margin: &'static str,
    containment: &'static str,
    class64: &'static str,
    class32: &'static str,
    point_a: &'static str,
    point_b: &'static str,
    triangle_a: &'static str,
    triangle_b: &'static str,
    exact_used: &'static str,
}

/// About the objects of the files.
pub const EXACT: TruthNames = TruthNames {
    hit: "hit",
    distance_lo: "distance_lo",
    distance_hi: "distance_hi",
    margin: "margin",
    containment: "containment",
    class64: "class64",
    class32: "class32",
    point_a: "point_a",
    point_b: "point_b",
    triangle_a: "triangle_a",
    triangle_b: "triangle_b",
    exact_used: "exact_used",
};

/// About the same with coordinates rounded to single precision.
pub const ROUNDED: TruthNames = TruthNames {
    hit: "rounded_hit",
    distance_lo: "rounded_distance_lo",
    distance_hi: "rounded_distance_hi",
    margin: "rounded_margin",
    containment: "rounded_containment",
    class64: "rounded_class64",
    class32: "rounded_class32",
    point_a: "rounded_point_a",
    point_b: "rounded_point_b",
    triangle_a: "rounded_triangle_a",
    triangle_b: "rounded_triangle_b",
    exact_used: "rounded_exact_used",
};

/// The columns of these truths.
pub fn truth_columns(names: &TruthNames, truths: &[Truth]) -> Result<Vec<(&'static str, ArrayRef)>> {
    let f64s = |of: fn(&Truth) -> f64| -> ArrayRef { Arc::new(truths.iter().map(of).collect::<Float64Array>()) };
    let u32s = |of: fn(&Truth) -> u32| -> ArrayRef { Arc::new(truths.iter().map(of).collect::<UInt32Array>()) };
    let flags =
        |of: fn(&Truth) -> bool| -> ArrayRef { Arc::new(truths.iter().map(|t| Some(of(t))).collect::<BooleanArray>()) };
    let classes = |of: fn(&Truth) -> Class| -> ArrayRef {
        Arc::new(truths.iter().map(|t| Some(class_name(of(t)))).collect::<StringArray>())
    };
    let containment = truths.iter().map(|t| t.containment.map(Containment::name)).collect::<StringArray>();
    Ok(vec![
        (names.hit, flags(|t| t.hit)),
        (names.distance_lo, f64s(|t| t.distance_lo)),
        (names.distance_hi, f64s(|t| t.distance_hi)),
        (names.margin, f64s(|t| t.margin)),
        (names.containment, Arc::new(containment)),
        (names.class64, classes(|t| t.class64)),
        (names.class32, classes(|t| t.class32)),
        (names.point_a, lists(truths, 3, |t| t.witness.point_a.coords.as_slice().to_vec())?),
        (names.point_b, lists(truths, 3, |t| t.witness.point_b.coords.as_slice().to_vec())?),
        (names.triangle_a, u32s(|t| t.witness.triangle_a)),
        (names.triangle_b, u32s(|t| t.witness.triangle_b)),
        (names.exact_used, flags(|t| t.exact_used)),
    ])
}

/// Reads back what [`truth_columns`] made.
pub fn read_truths(batch: &RecordBatch, names: &TruthNames) -> std::result::Result<Vec<Truth>, String> {
    let flag = |name| column::<BooleanArray>(batch, name);
    let real = |name| column::<Float64Array>(batch, name);
    let whole = |name| column::<UInt32Array>(batch, name);
    let text = |name| column::<StringArray>(batch, name);
    let (hit, exact_used) = (flag(names.hit)?, flag(names.exact_used)?);
    let (lo, hi, margin) = (real(names.distance_lo)?, real(names.distance_hi)?, real(names.margin)?);
    let (class64, class32, containment) = (text(names.class64)?, text(names.class32)?, text(names.containment)?);
    let (triangle_a, triangle_b) = (whole(names.triangle_a)?, whole(names.triangle_b)?);
    let (point_a, point_b) = (Points::of(batch, names.point_a)?, Points::of(batch, names.point_b)?);
    let truth = |row: usize| {
        Ok(Truth {
            hit: hit.value(row),
            distance_lo: lo.value(row),
            distance_hi: hi.value(row),
            margin: margin.value(row),
            containment: containment.is_valid(row).then(|| named_containment(containment.value(row))).transpose()?,
            class64: named_class(class64.value(row))?,
            class32: named_class(class32.value(row))?,
            witness: Witness {
                point_a: point_a.row(row)?,
                point_b: point_b.row(row)?,
                triangle_a: triangle_a.value(row),
                triangle_b: triangle_b.value(row),
            },
            exact_used: exact_used.value(row),
        })
    };
    (0..batch.num_rows()).map(truth).collect()
}

fn named_containment(name: &str) -> std::result::Result<Containment, String> {
    let known = Containment::NAMES.iter().find(|(_, known)| *known == name).map(|(containment, _)| *containment);
    known.ok_or_else(|| format!("{name:?} is not a containment"))
}

pub fn class_name(class: Class) -> &'static str {
    match class {
        Class::Clear => "clear",
        Class::Colliding => "colliding",
        Class::Grazing => "grazing",
    }
}

fn named_class(name: &str) -> std::result::Result<Class, String> {
    match name {
        "clear" => Ok(Class::Clear),
        "colliding" => Ok(Class::Colliding),
        "grazing" => Ok(Class::Grazing),
        other => Err(format!("{other:?} is not a class")),
    }
}
