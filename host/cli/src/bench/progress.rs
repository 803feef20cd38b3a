//! Progress of a run on stderr: bars on a terminal, plain lines elsewhere.

use std::collections::HashMap;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use ocb_engine::model::{RunEvent, RunInfo, Stage, StageKind, State};

use crate::units;

/// Between two plain lines of one lane.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// Shows the lanes of one run.
pub enum Progress {
    /// One bar per lane.
    Bars { all: MultiProgress, lanes: HashMap<String, ProgressBar> },
    /// One line per change, and now and then.
    Lines { last: HashMap<String, (State, Instant)> },
}

impl Progress {
    /// For the lanes that the run has now; further ones appear as they come.
    pub fn new(run: &RunInfo) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self::Lines { last: HashMap::new() };
        }
        let mut progress = Self::Bars { all: MultiProgress::new(), lanes: HashMap::new() };
        run.stages.iter().for_each(|stage| progress.stage(stage));
        progress
    }

    /// Shows what an event says.
    pub fn show(&mut self, event: &RunEvent) {
        if let Some(stage) = &event.stage {
            self.stage(stage);
        }
    }

    fn stage(&mut self, stage: &Stage) {
        let name = lane_name(stage);
        match self {
            Self::Bars { all, lanes } => {
                let bar = lanes.entry(name).or_insert_with_key(|name| {
                    all.add(ProgressBar::new(stage.total).with_style(style()).with_prefix(name.clone()))
                });
                bar.set_length(stage.total);
                bar.set_position(stage.done);
                bar.set_message(note(stage));
                if has_ended(stage.state) {
                    bar.abandon();
                }
            }
            Self::Lines { last } => {
                let now = Instant::now();
                let due = match last.get(&name) {
                    Some((state, at)) => *state != stage.state || now.duration_since(*at) >= LINE_EVERY,
                    None => stage.state != State::Queued,
                };
                if due {
                    eprintln!("{}", line(&name, stage));
                    last.insert(name, (stage.state, now));
                }
            }
        }
    }

    /// Leaves the terminal as it should be.
    pub fn finish(self) {
        if let Self::Bars { lanes, .. } = self {
            lanes.values().filter(|bar| !bar.is_finished()).for_each(ProgressBar::abandon);
        }
    }
}

fn style() -> ProgressStyle {
    // The template is ours, so it parses; were it broken, the plain bar would do.
    ProgressStyle::with_template("{prefix:>24} {bar:30} {pos}/{len} {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

fn lane_name(stage: &Stage) -> String {
    match (stage.kind, &stage.algorithm) {
        (StageKind::Object, _) => "object".to_owned(),
        (StageKind::Configurations, _) => "configurations".to_owned(),
        (StageKind::Measuring, Some(algorithm)) => algorithm.clone(),
        (StageKind::Measuring, None) => "measuring".to_owned(),
        (StageKind::Heatmap, _) => "heatmap".to_owned(),
    }
}

fn note(stage: &Stage) -> String {
    match (stage.state, &stage.message, stage.seconds_left) {
        (State::Queued, ..) => "waits".to_owned(),
        (State::Running, _, Some(left)) => format!("{:.0}/s, {} left", stage.rate, units::wait(left)),
        (State::Running, Some(message), None) => message.clone(),
        (State::Running, None, None) => String::new(),
        (state, Some(message), _) => format!("{}: {message}", crate::run::state_name(state)),
        (state, None, _) => crate::run::state_name(state).to_owned(),
    }
}

fn line(name: &str, stage: &Stage) -> String {
    let count = if stage.total > 0 { format!(" {}/{}", stage.done, stage.total) } else { String::new() };
    let note = note(stage);
    let note = if note.is_empty() { "running".to_owned() } else { note };
    format!("{name}:{count} {note}")
}

fn has_ended(state: State) -> bool {
    matches!(state, State::Done | State::Failed | State::Cancelled)
}
