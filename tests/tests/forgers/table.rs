//! The ledger as a table.

use std::fmt::Write;

use crate::judge::{Entry, Ledger, Row, median, medians};
use crate::kit::is_honest;
use crate::plan::Question;

/// A line for each algorithm, class and condition, then the honest ones in all and how the twins compare.
pub fn of(ledger: &Ledger) -> String {
    let mut text = String::from(
        "forger             class  asked     machine        runs ranked   median gain           worst gain      build gain  otherwise\n",
    );
    for (row, entries) in &ledger.rows {
        line(&mut text, row, entries);
    }
    let honest: Vec<&Entry> = ledger.rows.iter().filter(|(row, _)| is_honest(&row.name)).flat_map(|(_, e)| e).collect();
    let ranked = honest.iter().filter(|e| e.ranked).count();
    writeln!(text, "honest algorithms: {ranked} of {} with a rank", honest.len()).expect("text");
    let [runs, apart] = ledger.twins;
    let share = if runs > 0 { 100.0 * apart as f64 / runs as f64 } else { 0.0 };
    writeln!(text, "one algorithm under two names: intervals apart in {apart} of {runs} runs ({share:.1} %)")
        .expect("text");
    text
}

fn line(text: &mut String, row: &Row, entries: &[Entry]) {
    let asked = if row.question == Question::Distance { "distance" } else { "collision" };
    let machine = format!(
        "{}, {}",
        if row.condition.one_cpu { "one CPU" } else { "two" },
        if row.condition.busy { "busy" } else { "quiet" }
    );
    let ranked = entries.iter().filter(|e| e.ranked).count();
    let [ns, share] = medians(entries, |e| e.gain);
    let worst = entries
        .iter()
        .filter_map(|e| e.gain)
        .fold([0.0f64; 2], |worst, gain| if gain[1] > worst[1] { gain } else { worst });
    let build = median(entries.iter().map(|e| e.build_gain.map_or(0.0, |gain| gain[0])).collect());
    let otherwise = entries.iter().map(|e| &e.ending).find(|ending| *ending != "Completed");
    let otherwise: String = otherwise.map_or("", |ending| ending.as_str()).chars().take(70).collect();
    writeln!(
        text,
        "{:<18} {:<6} {asked:<9} {machine:<14} {:>4} {ranked:>6} {:>6.1} % {:>10.2} us {:>6.1} % {:>10.2} us {build:>7.1} ms  {otherwise}",
        row.name,
        row.class.name(),
        entries.len(),
        100.0 * share,
        ns / 1000.0,
        100.0 * worst[1],
        worst[0] / 1000.0,
    )
    .expect("text");
}
