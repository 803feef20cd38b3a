//! `ocb record`: run a program unchanged, and keep what it asks of collision libraries.

mod recorders;

use std::ffi::{OsStr, OsString};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, ExitCode, ExitStatus, Stdio};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use ocb_service::LabError;
use ocb_service::recording::{Packed, Recording, from_json, from_pair, pack};
use serde_json::json;
use tempfile::TempDir;
use tokio::signal::unix::{SignalKind, signal};

use crate::args::RecordArgs;
use crate::failure::{BAD_INPUT, Failure, Result};
use crate::open::read_bounded;
use crate::output;
use recorders::Recorders;

/// Largest file of poses, bytes.
const MOST_POSES: usize = 1 << 30;
/// Bytes of the program's name in a recording.
const LONGEST_NAME: usize = 200;

/// Runs the program and packs what was recorded, also when it was killed. The exit code is the program's.
pub async fn record(args: &RecordArgs, json: bool) -> Result<ExitCode> {
    if let Some(spool) = &args.spool {
        say(&args.out, &pack(spool, &args.out)?, json)?;
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(poses) = &args.poses {
        let recording = of_poses(poses, args)?;
        recording.write(&args.out)?;
        say(&args.out, &recording.packed(), json)?;
        return Ok(ExitCode::SUCCESS);
    }
    let recorders = Recorders::find()?;
    let spool = spool(&args.out)?;
    let status = run(args, &recorders, spool.path(), json).await?;
    let code = status.code().unwrap_or_else(|| 128 + status.signal().unwrap_or_default());
    if let Some(signal) = status.signal() {
        eprintln!("ocb: The program was ended by signal {signal}; what it asked until then is kept.");
    }
    let recorded = match pack(spool.path(), &args.out) {
        Ok(packed) => {
            say(&args.out, &packed, json)?;
            true
        }
        Err(_) if is_empty(spool.path()) => {
            nothing(&recorders);
            false
        }
        Err(why) => {
            if !matches!(why, LabError::Invalid(_)) {
                eprintln!("ocb: What was recorded stays in {}; pack it with --spool.", spool.keep().display());
            }
            Failure::from(why).report();
            false
        }
    };
    Ok(ExitCode::from(if code == 0 && !recorded { BAD_INPUT } else { code as u8 }))
}

/// The recording of a file with poses.
fn of_poses(file: &Path, args: &RecordArgs) -> Result<Recording> {
    let bytes = read_bounded(file, MOST_POSES)?;
    match &args.object[..] {
        [] => Ok(from_json(&bytes, file.parent().unwrap_or(Path::new("")))?),
        [a, b] => Ok(from_pair([a, b], &bytes, args.query)?),
        _ => Err(Failure::Input(
            "A pair has two objects: give --object twice, also for an object and itself.".to_owned(),
        )),
    }
}

/// A folder beside the recording, so that it can be packed with `--spool` should we be killed.
fn spool(out: &Path) -> Result<TempDir> {
    let name = out.file_name().ok_or_else(|| Failure::Input(format!("{} names no file.", out.display())))?;
    let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = folder.canonicalize().map_err(|e| Failure::file("write into the folder", folder, &e))?;
    let made = tempfile::Builder::new().prefix(name).suffix(".spool").tempdir_in(&folder);
    made.map_err(|e| Failure::file("write into the folder", &folder, &e))
}

/// The program with its own input and output; with `--json` its output goes to stderr.
async fn run(args: &RecordArgs, recorders: &Recorders, spool: &Path, json: bool) -> Result<ExitStatus> {
    let [name, rest @ ..] = &args.program[..] else { return Err(Failure::Input("No program was named.".to_owned())) };
    #[expect(clippy::disallowed_methods, reason = "it is the visitor's own program, which is run as they would run it")]
    let mut program = Command::new(name);
    program.args(rest);
    for (variable, value) in recorders.environment() {
        program.env(variable, value);
    }
    program.env("OCB_RECORD", spool).env("OCB_RECORD_LIMIT", args.limit.to_string());
    program.env("OCB_RECORD_PROGRAM", called(&args.program));
    if json {
        program.stdout(Stdio::from(std::io::stderr()));
    }
    // Ctrl-C reaches the program by itself; signals sent to `ocb` alone are passed on.
    let listen = |kind| signal(kind).map_err(|e| Failure::Fault(format!("cannot listen for signals: {e}.")));
    let (mut interrupt, mut terminate) = (listen(SignalKind::interrupt())?, listen(SignalKind::terminate())?);
    let mut child = program.spawn().map_err(|e| Failure::file("run", Path::new(name), &e))?;
    let pid = Pid::from_raw(child.id().cast_signed());
    let ended = tokio::task::spawn_blocking(move || child.wait());
    tokio::pin!(ended);
    loop {
        tokio::select! {
            status = &mut ended => {
                let status = status.map_err(|e| Failure::Fault(format!("waiting for the program failed: {e}.")))?;
                return status.map_err(|e| Failure::Fault(format!("waiting for the program failed: {e}.")));
            }
            _ = interrupt.recv() => {}
            // It may have ended meanwhile.
            _ = terminate.recv() => drop(kill(pid, Signal::SIGTERM)),
        }
    }
}

/// The program and its arguments without their folders.
fn called(program: &[OsString]) -> String {
    let name = |word: &OsString| {
        Path::new(word).file_name().unwrap_or(OsStr::new("/")).to_string_lossy().replace(char::is_control, "?")
    };
    let mut text = program.iter().map(name).collect::<Vec<_>>().join(" ");
    while text.len() > LONGEST_NAME {
        text.pop();
    }
    text
}

fn is_empty(spool: &Path) -> bool {
    std::fs::read_dir(spool).is_ok_and(|mut entries| entries.next().is_none())
}

fn nothing(recorders: &Recorders) {
    eprintln!(
        "ocb: Nothing was recorded: the program asked none of {}. Calls that were inlined or linked statically are not seen.",
        recorders.seen()
    );
}

fn say(out: &Path, packed: &Packed, json: bool) -> Result<()> {
    if json {
        return output::print_json(&json!({
            "recording": out, "objects": packed.objects, "queries": packed.queries, "seen": packed.seen,
            "dropped": packed.dropped,
        }));
    }
    eprintln!(
        "{}: {} queries about {} objects, of {} that were seen.",
        out.display(),
        packed.queries,
        packed.objects,
        packed.seen
    );
    for dropped in &packed.dropped {
        eprintln!("  not recorded: {} queries ({})", dropped.count, dropped.reason);
    }
    eprintln!("Replay it with: ocb bench --workload {}", out.display());
    Ok(())
}
