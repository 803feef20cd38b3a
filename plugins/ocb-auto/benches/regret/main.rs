//! Is choosing worth it? `OCB_SHARED=… taskset -c 1 cargo bench -p ocb-auto`.
//!
//! Every method answers every configuration of a mixed set of scenes, in two runs. What is best, of all methods for the whole
//! set or for each pair of objects or for each configuration, is read off the first run and paid for in the second one. Means
//! are over configurations, in microseconds.

#[path = "../../../lib/triangles/tests/support/mod.rs"]
#[macro_use]
mod support;

mod measure;
mod scenes;
mod selection;

use measure::{METHODS, QUERIES, Row, feature_cost, rows};
use selection::{best_bounds, interval, leave_objects_out, mean, single_best, virtual_best};

fn main() {
    let settings = scenes::settings();
    let mut room = Vec::with_capacity(1 << 18);
    let all: Vec<Row> =
        settings.iter().enumerate().flat_map(|(number, setting)| rows(number, setting, &mut room)).collect();
    let features = feature_cost(&settings[0]);
    println!("{} settings; features take {features:.3} us", settings.len());
    println!("| query | n | {} | best of each pair | virtual best | other objects' bounds |", METHODS.join(" | "));
    println!("| --- |{}", " --- |".repeat(METHODS.len() + 4));
    for (query, name) in QUERIES {
        let rows: Vec<&Row> = all.iter().filter(|row| row.query == query).collect();
        let of = |cost: &dyn Fn(&Row) -> f64| mean(rows.iter().copied(), cost);
        let costs: Vec<f64> = (0..METHODS.len()).map(|method| of(&|row| row.runs[1][method])).collect();
        let of_pairs = (0..settings.len()).map(|number| {
            let own: Vec<&Row> = rows.iter().copied().filter(|row| row.setting == number).collect();
            let best = single_best(&own);
            mean(own, |row| row.runs[1][best])
        });
        let of_pairs = of_pairs.sum::<f64>() / settings.len() as f64;
        let best = of(&|row| virtual_best(row, features));
        let left_out = leave_objects_out(&rows, &settings, features);
        let columns: Vec<String> = costs.iter().map(|cost| format!("{cost:.2}")).collect();
        println!("| {name} | {} | {} | {of_pairs:.2} | {best:.2} | {left_out:.2} |", rows.len(), columns.join(" | "));
        verdict(&rows, settings.len(), &costs, best, features);
    }
}

/// Regret, and what is won over the single best method.
fn verdict(rows: &[&Row], settings: usize, costs: &[f64], best: f64, features: f64) {
    let single = single_best(rows);
    let mut regrets: Vec<f64> = rows.iter().map(|row| row.runs[1][0] - virtual_best(row, features)).collect();
    regrets.sort_by(f64::total_cmp);
    let [low, high] = interval(rows, settings, |row| row.runs[1][0], |row| row.runs[1][single]);
    let logs = mean(rows.iter().copied(), |row| (row.runs[1][0] / row.runs[1][single]).ln());
    let dearer = rows.iter().filter(|row| row.runs[1][0] > row.runs[1][single]).count();
    let [size_ratio, clearance] = best_bounds(rows, features);
    println!(
        "<!-- single best {}: regret {:.2} (99 of 100 below {:.2}), of the gap {:.0} % closed, mean {:.3} of the single \
         best's [{low:.3}, {high:.3}], geometric mean {:.3}; dearer in {:.0} % of the queries; best bounds here: SizeRatio {size_ratio}, \
         Clearance {clearance} -->",
        METHODS[single],
        costs[0] - best,
        regrets[regrets.len() * 99 / 100],
        100.0 * (costs[single] - costs[0]) / (costs[single] - best),
        costs[0] / costs[single],
        logs.exp(),
        100.0 * dearer as f64 / rows.len() as f64,
    );
}
