//! Certified answers for people.

use ocb_core::configuration::{Class, Containment};
use ocb_service::model::TruthRow;
use ocb_service::truth::Depth;

use crate::output;

/// One row per answer, or per contact.
pub fn table(index: &str, rows: &[TruthRow], depth: Depth) -> String {
    if depth == Depth::Contacts {
        let contact = |r: &TruthRow| -> Vec<Vec<String>> {
            let row = |c: &ocb_service::model::ContactRow| {
                vec![r.index.to_string(), c.triangle_a.to_string(), c.triangle_b.to_string(), number(c.margin)]
            };
            r.contacts.iter().flatten().map(row).collect()
        };
        let headings = [index, "triangle A", "triangle B", "margin"];
        return output::table(&headings, rows.iter().flat_map(contact).collect(), &[0, 1, 2, 3]);
    }
    let row = |r: &TruthRow| {
        vec![
            r.index.to_string(),
            r.name.clone().unwrap_or_default(),
            if r.hit { "hit" } else { "apart" }.to_owned(),
            distance(r),
            number(r.margin),
            class(r.class64).to_owned(),
            class(r.class32).to_owned(),
            r.containment.map_or("", containment).to_owned(),
            r.triangles.map_or_else(String::new, |[a, b]| format!("{a} {b}")),
            if r.exact_used { "exact" } else { "f64" }.to_owned(),
        ]
    };
    let headings =
        [index, "name", "answer", "distance", "margin", "class f64", "class f32", "inside", "triangles", "by"];
    output::table(&headings, rows.iter().map(row).collect(), &[0])
}

fn distance(row: &TruthRow) -> String {
    match (row.distance_lo, row.distance_hi) {
        (Some(lo), Some(hi)) if lo == hi => number(lo),
        (Some(lo), Some(hi)) => format!("[{}, {}]", number(lo), number(hi)),
        _ => "-".to_owned(),
    }
}

fn number(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:e}") }
}

fn class(class: Class) -> &'static str {
    match class {
        Class::Clear => "clear",
        Class::Colliding => "colliding",
        Class::Grazing => "grazing",
    }
}

fn containment(containment: Containment) -> &'static str {
    match containment {
        Containment::Apart => "no",
        Containment::AInB => "A in B",
        Containment::BInA => "B in A",
        Containment::Both => "both",
    }
}

/// How many of what.
pub fn summary(rows: &[TruthRow]) -> String {
    let count = |of: &dyn Fn(&TruthRow) -> bool| rows.iter().filter(|r| of(r)).count();
    let mut parts = vec![
        format!("{} answers", rows.len()),
        format!("{} hits", count(&|r| r.hit)),
        format!("{} grazing in f64", count(&|r| r.class64 == Class::Grazing)),
        format!("{} in f32", count(&|r| r.class32 == Class::Grazing)),
        format!("{} by exact arithmetic", count(&|r| r.exact_used)),
    ];
    if rows.iter().any(|r| r.contacts.is_some()) {
        parts.push(format!("{} contacts", rows.iter().flat_map(|r| r.contacts.iter().flatten()).count()));
    }
    if rows.iter().any(|r| r.differs.is_some()) {
        let differs = |r: &TruthRow| r.differs.as_ref().is_some_and(|d| !d.is_empty());
        let listed = count(&|r| r.differs.is_some());
        parts.push(format!("{} of {listed} differ from the file", count(&differs)));
    }
    format!("{}.", parts.join(", "))
}
