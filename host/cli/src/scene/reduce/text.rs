//! A reduced scene as text.

use std::path::PathBuf;

use ocb_service::chart::Chart;
use ocb_service::model::{BodyKind, LaterQueries, ReducedObject, ReducedScene, ReducedSpeed, Reduction};

use crate::{output, units};

/// Changed answers that are listed.
const LISTED: usize = 5;

/// Everything that a terminal shows.
pub fn text(report: &ReducedScene, names: &[&str], written: &[PathBuf]) -> String {
    let ReducedScene { reduction, speed, .. } = report;
    let mut text = vec![objects(reduction), String::new()];
    text.extend(certified(reduction));
    text.extend(reduction.held_out.as_ref().map(|held_out| held(held_out, reduction, names)));
    if !speed.is_empty() {
        let row = |it: &ReducedSpeed| {
            let time = |ns: Option<f64>| ns.map_or_else(|| "incomplete".to_owned(), units::time);
            let faster = it.faster.map(|[x, y]| format!("{:.2} to {:.2}", x.min(y), x.max(y)));
            vec![
                it.algorithm.clone(),
                time(it.before_ns),
                time(it.after_ns),
                faster.unwrap_or_default(),
                it.wrong.to_string(),
            ]
        };
        let headings = ["algorithm", "before", "after", "times faster", "wrong"];
        text.push(output::table(&headings, speed.iter().map(row).collect(), &[1, 2, 3, 4]));
        text.push(
            "Means of a query, each scene replayed twice in turn. Algorithms know only triangles, so that curved bodies and boxes \
             are given to them as polyhedra. Incomplete: not every query was answered within the budget."
                .to_owned(),
        );
    }
    text.extend(report.frontier.as_ref().map(frontier));
    text.extend(written.iter().map(|path| path.display().to_string()));
    text.join("\n")
}

/// A row for each tolerance, a column for each algorithm.
fn frontier(chart: &Chart) -> String {
    let mut at: Vec<Option<f64>> = chart.series.iter().flat_map(|it| &it.points).map(|point| point.x).collect();
    at.sort_by(|x, y| x.unwrap_or(0.0).total_cmp(&y.unwrap_or(0.0)));
    at.dedup();
    let row = |x: &Option<f64>| {
        let times = chart.series.iter().map(|it| it.points.iter().find(|point| point.x == *x));
        let times = times.map(|point| point.map_or_else(|| "-".to_owned(), |point| units::time(point.y)));
        [x.map_or_else(|| "objects".to_owned(), |x| format!("{x}"))].into_iter().chain(times).collect()
    };
    let names = chart.series.iter().map(|it| it.name.as_str());
    let headings: Vec<&str> = ["tolerance"].into_iter().chain(names).collect();
    let right: Vec<usize> = (1..headings.len()).collect();
    format!("{}:\n{}", chart.title, output::table(&headings, at.iter().map(row).collect(), &right))
}

fn objects(reduction: &Reduction) -> String {
    let row = |it: &ReducedObject| {
        let body = match it.body {
            BodyKind::Object => "unchanged",
            BodyKind::Sphere => "sphere",
            BodyKind::Capsule => "capsule",
            BodyKind::Box => "box",
            BodyKind::Hull => "convex hull",
            BodyKind::Hulls => "convex hulls",
            BodyKind::Level => "fewer triangles",
        };
        vec![it.name.clone(), body.to_owned(), it.before.to_string(), it.after.to_string(), it.queries.to_string()]
    };
    let headings = ["object", "replaced by", "elements before", "after", "queries"];
    output::table(&headings, reduction.objects.iter().map(row).collect(), &[2, 3, 4])
}

fn certified(reduction: &Reduction) -> Vec<String> {
    let Reduction { tolerance, near, outside_only, queries, left_out, hits, grazing, largest_change, .. } = reduction;
    let sum = |of: fn(&ReducedObject) -> u64| reduction.objects.iter().map(of).sum::<u64>();
    let around = if *near > 0.0 {
        format!(", and wherever one object, with its body, is moved relative to the other by less than {near}")
    } else {
        String::new()
    };
    let mut text = vec![format!(
        "{} elements became {}. Certified for each of {queries} recorded queries{around}: the answer is right for a distance within \
         {tolerance} of the true one.",
        sum(|it| it.before),
        sum(|it| it.after)
    )];
    text.push(match outside_only {
        true => format!(
            "Every body contains its object, so that none of the {hits} recorded collisions is missed, nor any other."
        ),
        false => format!("Of {hits} recorded collisions, {grazing} became gaps smaller than that."),
    });
    text.extend(
        largest_change.map(|change| format!("No distance that was asked for changed by more than {change:.3e}.")),
    );
    if *left_out > 0 {
        text.push(format!("Left out: {left_out} queries, because a pose is no rotation."));
    }
    text
}

fn held(held_out: &LaterQueries, reduction: &Reduction, names: &[&str]) -> String {
    let LaterQueries { queries, changed, missed, examples } = held_out;
    let mut text = format!(
        "Chosen without the last {queries} queries, the bodies change {} of them by more than the tolerance: {:.3} % [{:.3}, {:.3}], \
         {missed} of them missed collisions.",
        changed.seen,
        100.0 * changed.value(),
        100.0 * changed.lo,
        100.0 * changed.hi
    );
    if changed.seen > 0 {
        text.push_str(" So queries that were not recorded are not covered");
        text.push_str(if reduction.near > 0.0 {
            " outside of the neighbourhoods."
        } else {
            "; --near asks for a neighbourhood."
        });
    }
    for it in examples.iter().take(LISTED) {
        let [a, b] = it.objects.map(|object| names[object as usize]);
        let [lo, hi] = it.distance;
        let [below, above] = it.reduced;
        text.push_str(&format!(
            "\n  query {} of the recording, {a} and {b}: the distance {lo:.6} to {hi:.6} became {below:.6} to {above:.6}",
            it.row
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use ocb_service::chart::{Axis, Form, Point, Scale, Series};
    use ocb_service::model::ChangedAnswer;

    use super::*;

    fn report(changed: u32) -> ReducedScene {
        let object =
            |name: &str, body, after| ReducedObject { name: name.into(), body, before: 300, after, queries: 50 };
        let example = ChangedAnswer { row: 45, objects: [0, 1], distance: [0.0; 2], reduced: [0.25; 2], missed: true };
        let held_out = LaterQueries {
            queries: 10,
            changed: ocb_advice::Share::of(changed, 10),
            missed: 1,
            examples: vec![example; changed as usize],
        };
        let reduction = Reduction {
            tolerance: 0.001,
            near: 0.0,
            outside_only: false,
            objects: vec![object("arm", BodyKind::Capsule, 2), object("hand", BodyKind::Object, 300)],
            queries: 50,
            left_out: 0,
            hits: 7,
            grazing: 2,
            largest_change: None,
            held_out: Some(held_out),
        };
        let speed =
            ReducedSpeed { algorithm: "box-tree".into(), before_ns: None, after_ns: None, faster: None, wrong: 0 };
        let points = [Point { x: None, ..Point::at(0.0, 900.0, 50) }, Point::at(0.001, 300.0, 50)];
        let frontier = chart(&[("box-tree", &points), ("fcl", &points[..1])]);
        ReducedScene { reduction, speed: vec![speed], frontier: Some(frontier) }
    }

    fn chart(series: &[(&str, &[Point])]) -> Chart {
        let axis = || Axis::new("", "", Scale::Log);
        let series = series.iter().map(|(name, points)| Series {
            name: (*name).to_owned(),
            style: None,
            form: Form::Line,
            points: points.to_vec(),
        });
        Chart {
            kind: "frontier".into(),
            title: "Time against tolerance".into(),
            finding: String::new(),
            x: axis(),
            y: axis(),
            series: series.collect(),
            notes: Vec::new(),
            preliminary: false,
        }
    }

    #[test]
    fn the_frontier_has_a_row_for_each_tolerance() {
        let text = text(&report(0), &["arm", "hand"], &[]);
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        let at = rows.iter().position(|row| row == &["tolerance", "box-tree", "fcl"]).expect("a heading");
        let of = |word: &str| rows[at..].iter().find(|row| row.first() == Some(&word)).expect("a row").len();
        assert_eq!((of("objects"), of("0.001")), (5, 4), "900 ns twice, then 300 ns and nothing: {text}");
    }

    #[test]
    fn the_text_says_what_is_certified_and_what_is_not() {
        let told = |report: &ReducedScene| text(report, &["arm", "hand"], &[]);
        let both = told(&report(1));
        assert!(both.contains("600 elements became 302. Certified for each of 50 recorded queries:"), "{both}");
        assert!(both.contains("Of 7 recorded collisions, 2 became gaps") && both.contains("incomplete"), "{both}");
        assert!(both.contains("change 1 of them") && both.contains("not covered; --near asks"), "{both}");
        assert!(both.contains("query 45 of the recording, arm and hand"), "{both}");
        let none = told(&report(0));
        assert!(none.contains("change 0 of them") && !none.contains("not covered"), "{none}");
        let mut outside = report(1);
        (outside.reduction.outside_only, outside.reduction.near) = (true, 0.0001);
        let outside = told(&outside);
        assert!(outside.contains("none of the 7 recorded collisions is missed"), "{outside}");
        assert!(outside.contains("moved relative to the other by less than 0.0001"), "{outside}");
    }
}
