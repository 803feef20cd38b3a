//! How a command ends when it cannot do what was asked: one sentence on stderr, and an exit code that says whose fault.

use std::path::Path;
use std::process::ExitCode;

use ocb_service::{EngineError, LabError};

/// Exit code: ours or the machine's fault.
pub const OUR_FAULT: u8 = 1;
/// Exit code: the input is bad; nothing was kept.
pub const BAD_INPUT: u8 = 2;
/// Exit code: the run finished, but some algorithm failed or gave wrong answers.
pub const NOT_ALL_WELL: u8 = 3;
/// Exit code: stopped by Ctrl-C, as shells count it.
pub const INTERRUPTED: u8 = 130;

/// Why a command stops.
#[derive(Debug)]
pub enum Failure {
    /// The caller's input, one sentence.
    Input(String),
    /// Ours, one sentence.
    Fault(String),
    /// The reader of our output has gone, as with `ocb object list | head -1`: nothing is wrong.
    ReaderGone,
}

/// What a command returns.
pub type Result<T> = std::result::Result<T, Failure>;

impl Failure {
    /// A file that could not be read or written.
    pub fn file(verb: &str, path: &Path, error: &std::io::Error) -> Self {
        Self::Input(format!("Cannot {verb} {}: {}.", path.display(), reason(error)))
    }

    /// Says the sentence and gives the exit code.
    pub fn report(self) -> ExitCode {
        let (sentence, code) = match self {
            Self::Input(sentence) => (sentence, BAD_INPUT),
            Self::Fault(sentence) => (format!("Internal error: {sentence}"), OUR_FAULT),
            Self::ReaderGone => return ExitCode::SUCCESS,
        };
        eprintln!("ocb: {sentence}");
        ExitCode::from(code)
    }
}

/// What the system says, without its number.
fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or(&text).to_lowercase()
}

impl From<LabError> for Failure {
    fn from(error: LabError) -> Self {
        EngineError::from(error).into()
    }
}

impl From<EngineError> for Failure {
    fn from(error: EngineError) -> Self {
        match error {
            EngineError::Fault(sentence) | EngineError::Ended(sentence) => Self::Fault(sentence),
            EngineError::NotFound(sentence)
            | EngineError::Invalid(sentence)
            | EngineError::Forbidden(sentence)
            | EngineError::Busy(sentence)
            | EngineError::TooMuch { message: sentence, .. } => Self::Input(sentence),
        }
    }
}

/// Answers `--help` and `--version`, or says in one line what is wrong with the arguments.
pub fn usage(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // Help was asked for; a reader that has gone does not want it.
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let text = error.render().to_string();
    let parts: Vec<&str> = text
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage:"))
        .filter(|line| !line.is_empty())
        .collect();
    let told =
        parts.iter().filter(|line| !line.starts_with("For more information")).copied().collect::<Vec<_>>().join(" ");
    let told = told.trim_start_matches("error: ");
    if told.is_empty() || error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        eprintln!("ocb: No command given; `ocb --help` lists the commands.");
    } else {
        eprintln!("ocb: {told}; see `ocb --help`.");
    }
    ExitCode::from(BAD_INPUT)
}
