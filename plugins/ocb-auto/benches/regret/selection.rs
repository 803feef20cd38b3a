//! How good are choices? Costs of fixed methods, of the best in hindsight, and of rules whose bounds other objects have set.

use ocb_auto::features::Feature;
use ocb_auto::rules::{Choice, Condition, Query, RULES, Rule, choose};

use super::measure::{METHODS, Row};
use super::scenes::Setting;
use super::support::Dice;

/// The mean of a cost over rows.
pub fn mean<'r>(rows: impl IntoIterator<Item = &'r Row>, cost: impl Fn(&Row) -> f64) -> f64 {
    let (sum, n) = rows.into_iter().fold((0.0, 0), |(sum, n), row| (sum + cost(row), n + 1));
    sum / f64::from(n.max(1))
}

/// What a choice costs in a run, features included.
pub fn cost(row: &Row, choice: Choice, run: usize, features: f64) -> f64 {
    let method = match choice {
        Choice::Nothing => return features,
        Choice::Fast => 1,
        Choice::SimDop => 2,
        Choice::CollisionFirst => 3,
    };
    row.runs[run][method] + features
}

/// The method that is best on average in the first run.
pub fn single_best(rows: &[&Row]) -> usize {
    let of = |method: usize| mean(rows.iter().copied(), |row| row.runs[0][method]);
    (1..METHODS.len()).min_by(|&i, &j| of(i).total_cmp(&of(j))).unwrap_or(1)
}

/// The best method of each configuration by the first run, in the second one: not by its luck. Balls that are apart need no
/// method, only features.
pub fn virtual_best(row: &Row, features: f64) -> f64 {
    if row.query != Query::Distance && row.features.get(Feature::Clearance) > 0.0 {
        return features;
    }
    let best = (1..METHODS.len()).min_by(|&i, &j| row.runs[0][i].total_cmp(&row.runs[0][j])).unwrap_or(1);
    row.runs[1][best]
}

/// The bounds that are tried for the rules' conditions.
const SIZE_RATIOS: [f64; 8] = [1.0, 1.5, 2.5, 4.0, 6.0, 8.0, 15.0, f64::INFINITY];
const CLEARANCES: [f64; 9] = [f64::NEG_INFINITY, -0.9, -0.8, -0.7, -0.6, -0.5, -0.4, -0.3, -0.2];

/// The mean cost in the second run, where the bounds for each setting were the best of the first run on all settings with
/// neither of its objects.
pub fn leave_objects_out(rows: &[&Row], settings: &[Setting], features: f64) -> f64 {
    let held_out = settings.iter().enumerate().map(|(number, setting)| {
        let shares = |other: &Setting| other.objects.iter().any(|object| setting.objects.contains(object));
        let known: Vec<&Row> = rows.iter().copied().filter(|row| !shares(&settings[row.setting])).collect();
        let bounds = best_bounds(&known, features);
        let own: Vec<&Row> = rows.iter().copied().filter(|row| row.setting == number).collect();
        with_bounds(&own, 1, features, bounds)
    });
    held_out.sum::<f64>() / settings.len() as f64
}

/// The bounds, of a size ratio and a clearance, whose rules cost least in the first run.
pub fn best_bounds(rows: &[&Row], features: f64) -> [f64; 2] {
    let mut best = (f64::INFINITY, [0.0; 2]);
    for size_ratio in SIZE_RATIOS {
        for clearance in CLEARANCES {
            let cost = with_bounds(rows, 0, features, [size_ratio, clearance]);
            best = if cost < best.0 { (cost, [size_ratio, clearance]) } else { best };
        }
    }
    best.1
}

/// The mean cost of the rules with other bounds.
fn with_bounds(rows: &[&Row], run: usize, features: f64, [size_ratio, clearance]: [f64; 2]) -> f64 {
    let conditions: Vec<Vec<Condition>> = RULES
        .iter()
        .map(|rule| {
            let other = |condition: &Condition| match *condition {
                Condition::Above(Feature::SizeRatio, _) => Condition::Above(Feature::SizeRatio, size_ratio),
                Condition::Below(Feature::Clearance, _) => Condition::Below(Feature::Clearance, clearance),
                same => same,
            };
            rule.when.iter().map(other).collect()
        })
        .collect();
    let rules: Vec<Rule<'_>> =
        RULES.iter().zip(&conditions).map(|(rule, when)| Rule { when, ..rule.clone() }).collect();
    mean(rows.iter().copied(), |row| cost(row, choose(&rules, row.query, &row.features), run, features))
}

/// The middle 95 of 100 ratios of two mean costs, settings drawn anew with replacement: configurations of one setting are
/// too alike to count each.
pub fn interval(rows: &[&Row], settings: usize, above: impl Fn(&Row) -> f64, below: impl Fn(&Row) -> f64) -> [f64; 2] {
    let mut sums = vec![[0.0; 2]; settings];
    for row in rows {
        sums[row.setting][0] += above(row);
        sums[row.setting][1] += below(row);
    }
    let mut dice = Dice(23);
    let mut ratios: Vec<f64> = (0..2000)
        .map(|_| {
            let drawn = (0..settings).map(|_| sums[dice.pick(0, settings as i32) as usize]);
            let [above, below] = drawn.fold([0.0; 2], |[x, y], [above, below]| [x + above, y + below]);
            above / below
        })
        .collect();
    ratios.sort_by(f64::total_cmp);
    [ratios[ratios.len() / 40], ratios[ratios.len() - 1 - ratios.len() / 40]]
}
