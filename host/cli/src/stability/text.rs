//! What was found, as text.

use ocb_service::model::{
    CellState, FailingCase, FamilyResult, SearchResult, Stability, StabilityTable, Tally, TessellationResult,
};

use crate::{output, plugin};

/// A block per kind of test and algorithm.
pub fn text(table: &StabilityTable) -> String {
    let mut blocks = Vec::new();
    for method in &table.methods {
        blocks.push(format!("{} ({}), {} seeds per value", method.name, method.algorithm, method.seeds));
        if !method.families.is_empty() {
            blocks.push(families(table, &method.families));
        }
        if !method.relations.is_empty() {
            let row = |r: &ocb_service::model::RelationResult| {
                let numbers = [r.tried, r.decisions, r.distances, r.grazing].map(|n| n.to_string());
                [vec![r.relation.clone()], numbers.to_vec()].concat()
            };
            let headings = ["relation", "tried", "decisions differ", "distances differ", "within rounding"];
            blocks.push(output::table(&headings, method.relations.iter().map(row).collect(), &[1, 2, 3, 4]));
        }
        if !method.failures.is_empty() {
            let row = |f: &ocb_service::model::FailureResult| {
                vec![f.id.clone(), state(f.state).to_owned(), f.expected.clone(), f.got.clone()]
            };
            let headings = ["reported failure", "", "expected", "answered"];
            blocks.push(output::table(&headings, method.failures.iter().map(row).collect(), &[]));
        }
        if !method.tessellations.is_empty() {
            blocks.push(tessellations(&method.tessellations));
        }
        blocks.extend(method.search.as_ref().map(searched));
        blocks.extend(unit(method));
        if let Some(offset) = method.offset_safe {
            blocks.push(format!("No wrong answer up to {offset} lengths from the origin."));
        }
        let cases = method.families.iter().filter_map(|f| f.first.as_ref().map(|first| (&f.family, first)));
        blocks.extend(cases.map(|(family, first)| case(family, first)));
    }
    blocks.join("\n\n")
}

/// Does the method depend on the unit of length, and in which range does it not?
fn unit(method: &Stability) -> Option<String> {
    let tried = method.relations.iter().find(|found| found.relation == "unit")?;
    let range = method.unit_safe.map(|[low, high]| {
        format!(
            "The unit of length may change from 2^{low} to 2^{high} without a wrong answer, where triangles are about one unit \
             long."
        )
    });
    let depends = (tried.decisions + tried.distances > 0).then(|| {
        format!(
            "Depends on the unit of length: of {} scenes in another unit, {} decisions and {} distances differ.",
            tried.tried, tried.decisions, tried.distances
        )
    });
    let said: Vec<String> = [depends, range].into_iter().flatten().collect();
    (!said.is_empty()).then(|| said.join(" "))
}

fn families(table: &StabilityTable, found: &[FamilyResult]) -> String {
    let row = |f: &FamilyResult| {
        let info = table.families.iter().find(|info| info.id == f.family);
        let Tally { misses, false_alarms, distances, unsteady, broken, slow, .. } = f.tally;
        let from: Vec<String> = f.thresholds.iter().map(|t| format!("{:e}", t.fails)).collect();
        let counts = [f.tally.asked(), misses, false_alarms, distances, unsteady, broken, slow].map(|n| n.to_string());
        let mark = if info.is_some_and(|info| info.beyond) { "*" } else { "" };
        let parameter = info.map_or_else(String::new, |info| info.parameter.clone());
        let threshold = if from.is_empty() { String::new() } else { format!("{} ({parameter})", from.join(", ")) };
        [vec![format!("{}{mark}", f.family), state(f.state).to_owned()], counts.to_vec(), vec![threshold]].concat()
    };
    let headings =
        ["family", "", "queries", "misses", "false alarms", "distances", "unsteady", "broken", "slow", "fails from"];
    let rows = output::table(&headings, found.iter().map(row).collect(), &[2, 3, 4, 5, 6, 7, 8]);
    format!("{rows}\n* beyond what the plugin interface guarantees")
}

fn tessellations(found: &[TessellationResult]) -> String {
    let row = |t: &TessellationResult| {
        let texts = [&t.object, &t.cut, &plugin::query_name(t.query).to_owned()].map(String::clone);
        let time = format!("{:.1} us", t.median_ns / 1000.0);
        let numbers = [t.triangles.to_string(), time, format!("{:.2}", t.ratio), t.decisions.to_string()];
        [texts.to_vec(), numbers.to_vec(), vec![format!("{:.1e}", t.distance), t.wrong.to_string(), t.n.to_string()]]
            .concat()
    };
    let headings = [
        "surface",
        "cut",
        "query",
        "triangles",
        "median",
        "times original",
        "decisions differ",
        "largest distance change",
        "wrong",
        "n",
    ];
    output::table(&headings, found.iter().map(row).collect(), &[3, 4, 5, 6, 7, 8, 9])
}

fn searched(found: &SearchResult) -> String {
    let number = |first: Option<u32>| first.map_or_else(|| format!("none in {}", found.most), |n| format!("query {n}"));
    let us = |ns: f64| format!("{:.1} us", ns / 1000.0);
    format!(
        "First wrong answer: {} by climbing, {} by uniform sampling. Longest time in {} queries: {} by climbing, {} by \
         uniform sampling.",
        number(found.climbing),
        number(found.uniform),
        found.most,
        us(found.costliest_climbing_ns),
        us(found.costliest_uniform_ns)
    )
}

fn case(family: &str, first: &FailingCase) -> String {
    let [a, b] = first.triangles;
    let (expected, got, command) = (&first.expected, &first.got, &first.command);
    format!("{family}: {a} x {b} triangles; expected {expected}; answered {got}\n  {command}")
}

/// A state with its sign.
fn state(state: CellState) -> &'static str {
    match state {
        CellState::Agrees => "● agrees",
        CellState::Slow => "◔ slow",
        CellState::Wrong => "✕ wrong",
        CellState::Broken => "■ broken",
        CellState::Unsupported => "– unsupported",
        CellState::Refused => "⊘ refused",
    }
}
