//! Progress of a run on stderr: bars on a terminal, plain lines elsewhere.

use std::collections::HashMap;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use ocb_service::model::{RunEvent, RunInfo, Stage, StageKind, State};

use crate::units;

/// Between two plain lines of one stage.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// Shows the stages of one run.
pub enum Progress {
    /// One bar per stage.
    Bars { all: MultiProgress, bars: HashMap<String, ProgressBar> },
    /// One line per change, and now and then.
    Lines { last: HashMap<String, Printed> },
}

/// The last line of one stage.
pub struct Printed {
    state: State,
    said: bool,
    at: Instant,
}

impl Progress {
    /// For the stages that the run has now; further ones appear as they come.
    pub fn new(run: &RunInfo) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self::Lines { last: HashMap::new() };
        }
        let mut progress = Self::Bars { all: MultiProgress::new(), bars: HashMap::new() };
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
        let name = stage_name(stage);
        match self {
            Self::Bars { all, bars } => {
                let bar = bars.entry(name).or_insert_with_key(|name| {
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
                let at = Instant::now();
                if is_due(last.get(&name), stage, at) {
                    eprintln!("{}", line(&name, stage));
                    last.insert(name, Printed { state: stage.state, said: stage.message.is_some(), at });
                }
            }
        }
    }

    /// Leaves the terminal as it should be.
    pub fn finish(self) {
        if let Self::Bars { bars, .. } = self {
            bars.values().filter(|bar| !bar.is_finished()).for_each(ProgressBar::abandon);
        }
    }
}

fn style() -> ProgressStyle {
    // The template is ours, so it parses; were it broken, the plain bar would do.
    ProgressStyle::with_template("{prefix:>24} {bar:30} {pos}/{len} {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// A stage that waits is worth a line only when there is something to say, such as what it waits for.
fn is_due(last: Option<&Printed>, stage: &Stage, now: Instant) -> bool {
    let says = stage.message.is_some();
    if stage.state == State::Queued && !says {
        return false;
    }
    let Some(last) = last else { return true };
    last.state != stage.state || (says && !last.said) || now.duration_since(last.at) >= LINE_EVERY
}

fn stage_name(stage: &Stage) -> String {
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
        (State::Queued | State::Running, Some(message), _) => message.clone(),
        (State::Queued, None, _) => "waiting".to_owned(),
        (State::Running, None, Some(left)) => format!("{:.0}/s, {} left", stage.rate, units::wait(left)),
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

#[cfg(test)]
mod tests {
    use super::*;

    fn stage(state: State, message: Option<&str>) -> Stage {
        let (kind, algorithm, message) = (StageKind::Measuring, Some("parry".to_owned()), message.map(str::to_owned));
        Stage { kind, algorithm, state, done: 300, total: 1000, rate: 100.0, seconds_left: Some(7.0), message }
    }

    #[test]
    fn a_stage_says_what_it_waits_for() {
        let now = Instant::now();
        let mut printed = Printed { state: State::Queued, said: false, at: now };
        let due = |printed: Option<&Printed>, stage: &Stage| is_due(printed, stage, now);
        assert!(!due(None, &stage(State::Queued, None)));
        let waiting = stage(State::Queued, Some("Waiting: another process is measuring on this machine."));
        assert!(due(None, &waiting) && due(Some(&printed), &waiting));
        assert!(line("parry", &waiting).ends_with("Waiting: another process is measuring on this machine."));
        printed.said = true;
        assert!(!due(Some(&printed), &waiting), "once");
        assert!(due(Some(&printed), &stage(State::Running, None)));
    }

    #[test]
    fn a_stage_says_whose_turn_it_is() {
        let now = Instant::now();
        let printed = Printed { state: State::Running, said: false, at: now };
        let other = stage(State::Running, Some("Now the reference algorithm, Box tree: 5 questions."));
        assert!(is_due(Some(&printed), &other, now) && line("parry", &other).contains("Box tree"));
        assert!(!is_due(Some(&printed), &stage(State::Running, None), now));
        assert!(is_due(Some(&printed), &stage(State::Running, None), now + LINE_EVERY));
        assert_eq!(line("parry", &stage(State::Running, None)), "parry: 300/1000 100/s, 7 s left");
    }
}
