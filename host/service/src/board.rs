//! The board: results of many runs, filtered until they may be compared, and charted speed against accuracy.
//!
//! Two algorithms are compared on the same pairs of objects at the same distances, on one hardware class, with the same
//! thing delivered; what was measured on a part of that only has no place. Where several runs hold the same, the newest
//! plugin file counts, and of its runs the one with the most configurations (of a suite: the one judged by the newest
//! oracle). The results of a suite are never mixed with other runs, nor with those of another version. Over several scenarios counts are added,
//! eps* and the error of distances are the worst, and the time is the mean with every scenario asked equally often.

pub mod ask;
pub mod columns;
mod family;
mod filter;
mod frontier;
mod keys;
mod picture;
mod row;
pub mod runs;
mod suite;

use ocb_chart::Chart;

use crate::model::{
    Accuracy, AlgorithmResult, Board, BoardRequest, BoardRow, CellState, FamilyResult, Preview, RunSpec, SetInfo,
    Stability, StabilityPassed, StabilityTable,
};
use crate::suite::Suite;
use crate::{EngineError, Result};

/// A value of a filter, for programs and for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// For programs.
    pub value: String,
    /// For people.
    pub words: String,
}

/// One algorithm in one run.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The run.
    pub run: String,
    /// When it ended.
    pub finished_us: i64,
    /// The machine's hardware class.
    pub hardware: Named,
    /// Under all layers of the jail, so that it may be ranked.
    pub ranked: bool,
    /// The suite that the run belongs to.
    pub suite: Option<Named>,
    /// Why its plugin has no place any more, if so.
    pub standing: Option<String>,
    /// Of how many configurations these are a preview: measured, and in all.
    pub preview: Option<(u32, u64)>,
    /// The question.
    pub question: Named,
    /// The pair of objects.
    pub scene: Named,
    /// How far apart.
    pub distance: Named,
    /// Version of the oracle.
    pub oracle: Option<u32>,
    /// SHA-256 of the plugin file.
    pub plugin_sha256: String,
    /// The numbers.
    pub result: AlgorithmResult,
}

/// A suite as the filters name it.
pub fn suite(suite: &Suite) -> Named {
    let Suite { document, sha256, .. } = suite;
    Named { value: document.version.to_string(), words: format!("suite {} ({})", document.version, &sha256[..12]) }
}

/// Question, pair of objects and distance of a run, in words.
pub(crate) fn scenario_words(spec: &RunSpec, names: [&str; 2]) -> [String; 3] {
    [keys::question(spec).words, keys::scene(spec, names).words, keys::distance(spec).words]
}

/// Where and when one run was measured.
pub struct Circumstances<'a> {
    /// Id of the run.
    pub run: &'a str,
    /// When it ended.
    pub finished_us: i64,
    /// What was asked.
    pub spec: &'a RunSpec,
    /// Names of the objects.
    pub names: [&'a str; 2],
    /// CPU and hardware class.
    pub machine: [&'a str; 2],
    /// Measured under all layers of the jail.
    pub ranked: bool,
    /// What the results are a preview of.
    pub preview: Option<&'a Preview>,
    /// The configurations.
    pub set: Option<&'a SetInfo>,
}

impl Measured {
    /// One result of a run.
    pub fn of(run: &Circumstances, plugin_sha256: &str, result: AlgorithmResult) -> Self {
        let [cpu, class] = run.machine;
        let short: String = class.chars().take(12).collect();
        Self {
            run: run.run.to_owned(),
            finished_us: run.finished_us,
            hardware: Named { value: class.to_owned(), words: format!("{cpu} ({short})") },
            ranked: run.ranked,
            suite: None,
            standing: None,
            preview: run.preview.map(|preview| (preview.n, preview.of)),
            question: keys::question(run.spec),
            scene: keys::scene(run.spec, run.names),
            distance: keys::distance(run.spec),
            oracle: run.set.and_then(|set| set.oracle),
            plugin_sha256: plugin_sha256.to_owned(),
            result,
        }
    }
}

/// The board over these results.
///
/// # Errors
/// `Invalid` when the precision that is asked for is neither a word nor a number that makes sense.
pub fn board(measured: Vec<Measured>, request: &BoardRequest, suites: &[Suite]) -> Result<Board> {
    let needed = Needed::parse(request.precision.as_deref())?;
    let results = measured.len() as u32;
    let (left, mut filters) = filter::narrowed(measured, request);
    let expected = suite::expected(suites, &filters);
    let mut rows = row::rows(&left, expected.as_ref().map_or(&[], |(_, scenarios)| scenarios));
    let suite = expected.and_then(|(suite, scenarios)| suite::shown(suite, scenarios.len(), &left));
    let precision = filter::precise(&mut rows, &needed, request.precision.as_deref());
    filters.push(precision);
    frontier::place(&mut rows, request.accuracy);
    let finding = frontier::finding(&rows);
    let chart = picture::chart(&rows, request.accuracy, "board", &finding);
    Ok(Board { filters, results, suite, rows, finding, chart })
}

/// Speed against accuracy of the algorithms of one run, each contract class with a frontier of its own. Among themselves
/// those of a preview compare as well as any.
pub fn of_run(measured: &[Measured], accuracy: Accuracy) -> Chart {
    let mut rows: Vec<BoardRow> = Vec::new();
    for class in filter::classes(measured) {
        let members = measured.iter().filter(|m| m.result.class == class);
        let members: Vec<Measured> = members.map(|m| Measured { preview: None, ..m.clone() }).collect();
        let mut own = row::rows(&members, &[]);
        frontier::place(&mut own, accuracy);
        rows.append(&mut own);
    }
    let finding = frontier::finding(&rows);
    picture::chart(&rows, accuracy, "accuracy", &finding)
}

/// Says of every row how many stress families the same plugin file got through.
pub fn add_stability(rows: &mut [BoardRow], table: &StabilityTable) {
    for row in rows {
        let same = |tried: &&Stability| tried.algorithm == row.algorithm && tried.plugin_sha256 == row.plugin_sha256;
        row.stability = table.methods.iter().find(same).map(|tried| passed(tried, table));
    }
}

fn passed(tried: &Stability, table: &StabilityTable) -> StabilityPassed {
    let beyond = |id: &str| table.families.iter().any(|family| family.id == id && family.beyond);
    let sound = |family: &&FamilyResult| match family.state {
        CellState::Agrees | CellState::Slow => true,
        // Beyond what the interface promises, a wrong answer is no fault.
        CellState::Wrong => beyond(&family.family),
        CellState::Broken | CellState::Unsupported | CellState::Refused => false,
    };
    let asked = |family: &&FamilyResult| !matches!(family.state, CellState::Unsupported | CellState::Refused);
    let count = |these: &dyn Fn(&&FamilyResult) -> bool| tried.families.iter().filter(these).count() as u32;
    StabilityPassed { passed: count(&sound), of: count(&asked) }
}

/// How right an algorithm has to be to stay on the board.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Needed {
    Any,
    /// No wrong answer.
    NoneSeen,
    /// eps* at most this.
    Eps(f64),
}

impl Needed {
    fn parse(text: Option<&str>) -> Result<Self> {
        match text {
            None | Some("any") => Ok(Self::Any),
            Some("none_seen") => Ok(Self::NoneSeen),
            Some(number) => match number.parse::<f64>() {
                Ok(eps) if eps > 0.0 && eps <= 1.0 => Ok(Self::Eps(eps)),
                _ => Err(EngineError::Invalid(format!(
                    "The precision {number:?} is not valid; use any, none_seen, or the largest accepted eps*, such as \
                     1e-6."
                ))),
            },
        }
    }
}
