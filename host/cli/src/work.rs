//! `ocb work`: this machine measures for a service that runs elsewhere.

mod job;
mod link;
mod reports;

use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ocb_service::doctor::examine;
use ocb_service::model::{Ended, NextWork, OrderedAlgorithm, Sentinel};
use ocb_service::worker::{Handed, Worker};
use ocb_service::{LabError, Runner, Stop, in_time};
use tokio::runtime::Handle;
use tokio::sync::watch;

use crate::args::{Store, WorkArgs};
use crate::failure::{Failure, Result};
use crate::open;
use crate::serve::stop_signal;
use job::Job;
use link::{Link, Refused};
use reports::Reports;

/// After something went wrong.
const PAUSE: Duration = Duration::from_secs(2);
/// A service that is not reached for so long, or has a fault for so long, does not get what it is asked for.
const PATIENCE: Duration = Duration::from_secs(600);
/// A service that has a fault so many times when results are handed in will have it again.
const MOST_FAULTS: u32 = 10;
/// A job of a cluster rests for so long at most.
const REST: Duration = Duration::from_secs(60);

/// Takes work of the service and does it, one piece after the other, until it is stopped; with `--once`, the next one alone.
pub async fn work(store: &Store, args: &WorkArgs) -> Result<ExitCode> {
    let runner = Runner { program: open::runner(store), profile: store.profile() };
    if !examine(&runner.program).allows(runner.profile) {
        let told = "This machine cannot run third-party plugins in the jail; `ocb doctor` says what is missing.";
        return Err(Failure::Input(told.to_owned()));
    }
    let plugins = open::plugins(store);
    let link = Arc::new(Link::new(&args.server, &args.token)?);
    let stopped = stopped()?;
    let mut said = None;
    while !*stopped.borrow() {
        // Anew each time: what has changed since must be noticed.
        let worker = Worker::observe(runner.clone(), &plugins, store.machine_note.as_deref())?;
        let mut end = stopped.clone();
        let next = tokio::select! {
            next = link.next(worker.facts()) => next,
            _ = end.wait_for(|stopped| *stopped) => break,
        };
        match next {
            Ok(NextWork::Run(order)) => {
                said = None;
                carry_out(worker, &link, Job::run(*order), &stopped).await?;
            }
            Ok(NextWork::Errand(errand)) => {
                said = None;
                carry_out(worker, &link, Job::errand(*errand), &stopped).await?;
            }
            Ok(NextWork::Sentinel(algorithm)) => {
                sentinel(worker, &link, *algorithm, &stopped).await?;
                continue;
            }
            Ok(NextWork::Nothing) => said = None,
            Err(Refused::For(sentence)) => return Err(Failure::Input(sentence)),
            Err(refused) => {
                let rest = refused.rest().unwrap_or(PAUSE);
                let sentence = refused.to_string();
                if said.as_ref() != Some(&sentence) {
                    eprintln!("ocb: {sentence} Trying again.");
                }
                said = Some(sentence);
                pause(if args.once { rest.min(REST) } else { rest }, &stopped).await;
                if refused.rest().is_none() {
                    continue;
                }
            }
        }
        if args.once {
            break;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// True from the moment this process is asked to stop.
fn stopped() -> Result<watch::Receiver<bool>> {
    let (sender, receiver) = watch::channel(false);
    let signal = stop_signal()?;
    tokio::spawn(async move {
        signal.await;
        let _ = sender.send(true);
        // Nobody looks any more when the command has ended.
        sender.closed().await;
    });
    Ok(receiver)
}

async fn pause(time: Duration, stopped: &watch::Receiver<bool>) {
    let mut stopped = stopped.clone();
    let _ = tokio::time::timeout(time, stopped.wait_for(|stopped| *stopped)).await;
}

/// Measures the sentinel. Whether it arrives is seen when this machine asks for its next run.
async fn sentinel(
    worker: Worker,
    link: &Link,
    algorithm: OrderedAlgorithm,
    stopped: &watch::Receiver<bool>,
) -> Result<()> {
    let stop = Stop::default();
    let watching = tokio::spawn(watch_over(stop.clone(), stopped.clone()));
    let waits = || eprintln!("ocb: waiting for another process that measures on this machine");
    let measured = tokio::task::spawn_blocking(move || worker.sentinel(&algorithm, &stop, waits)).await;
    watching.abort();
    let sentinel = match measured.map_err(|e| Failure::Fault(format!("the measuring thread ended: {e}.")))? {
        Ok(Some(median_ns)) => Sentinel::Measured { median_ns },
        Ok(None) => return Ok(()),
        Err(e) => Sentinel::Failed { message: e.to_string() },
    };
    match &sentinel {
        Sentinel::Measured { median_ns } => eprintln!("ocb: a query of the sentinel takes {:.2} us", median_ns / 1e3),
        Sentinel::Failed { message } => eprintln!("ocb: the sentinel could not be measured. {message}"),
    }
    if let Err(refused) = link.sentinel(&sentinel).await {
        eprintln!("ocb: {refused}");
        pause(PAUSE, stopped).await;
    }
    Ok(())
}

/// Does one job and hands it in.
async fn carry_out(worker: Worker, link: &Arc<Link>, job: Job, stopped: &watch::Receiver<bool>) -> Result<()> {
    let (stop, reports) = (Stop::default(), Reports::default());
    let Job { attempt, name, most_seconds, doing } = job;
    eprintln!("ocb: at work on {name}");
    let measuring = {
        let (link, attempt, stop, reports) = (link.clone(), attempt.clone(), stop.clone(), reports.clone());
        let (handle, stopped) = (Handle::current(), stopped.clone());
        tokio::task::spawn_blocking(move || {
            let fetch = |name: &str| {
                let fetched = handle.block_on(fetched(&link, &attempt, name, &stopped));
                fetched.map_err(|e| LabError::Fault(format!("The file {name:?} cannot be had. {e}")))
            };
            doing(&worker, &stop, &fetch, &mut |report| reports.note(report))
        })
    };
    let beating = tokio::spawn(reports.clone().beat(link.clone(), attempt.clone(), stop.clone()));
    let showing = tokio::spawn(reports.clone().show(link.clone(), attempt.clone()));
    let watching = tokio::spawn(watch_over(stop.clone(), stopped.clone()));
    let limit = most_seconds.map(|most| (Duration::from_secs_f64(most), "Its time is over.".to_owned()));
    let measured = in_time(measuring, &stop, limit)
        .await
        .map_err(|e| Failure::Fault(format!("the measuring thread ended: {e}.")))?;
    watching.abort();
    showing.abort();
    reports.end();
    let Handed { ended, files } = match measured {
        Ok(Some(handed)) => handed,
        _ if *stopped.borrow() => plain(Ended::PutBack),
        Ok(None) if stop.reason().is_some() => plain(Ended::TooLong),
        // The service has ended the attempt.
        Ok(None) => {
            beating.abort();
            eprintln!("ocb: {name} was ended by the service");
            return Ok(());
        }
        Err(LabError::Invalid(message) | LabError::Ended(message)) => {
            eprintln!("ocb: {name} is not possible: {message}");
            plain(Ended::Impossible { message })
        }
        Err(e) => {
            eprintln!("ocb: {name} failed: {e}");
            plain(Ended::Failed { message: e.to_string() })
        }
    };
    let handed = match hand_in(link, &attempt, &ended, &files, stopped).await {
        Err(refused) => {
            eprintln!("ocb: {name} cannot be handed in: {refused}");
            let ended = Ended::Failed { message: format!("The results could not be handed in. {refused}") };
            link.end(&attempt, &ended, &[]).await
        }
        handed => handed,
    };
    beating.abort();
    match handed {
        Ok(true) => eprintln!("ocb: {name} is handed in"),
        Ok(false) => eprintln!("ocb: {name} comes too late: it was cancelled, or another machine has it"),
        Err(refused) => eprintln!("ocb: {name} is given up: {refused}"),
    }
    Ok(())
}

/// A file of the run; a service that is started again is waited for.
async fn fetched(
    link: &Link,
    attempt: &str,
    name: &str,
    stopped: &watch::Receiver<bool>,
) -> std::result::Result<Vec<u8>, Refused> {
    let asked = Instant::now();
    loop {
        match link.file(attempt, name).await {
            Err(Refused::Unreached(_) | Refused::Fault(_)) if !*stopped.borrow() && asked.elapsed() < PATIENCE => {
                pause(PAUSE, stopped).await;
            }
            answer => return answer,
        }
    }
}

fn plain(ended: Ended) -> Handed {
    Handed { ended, files: Vec::new() }
}

/// Stops the work when this process is asked to stop.
async fn watch_over(stop: Stop, mut stopped: watch::Receiver<bool>) {
    let _ = stopped.wait_for(|stopped| *stopped).await;
    stop.stop();
}

/// Hands in, again and again while the service is not reached or has a fault. Whoever stops this process waits for one try.
async fn hand_in(
    link: &Link,
    attempt: &str,
    ended: &Ended,
    files: &[Vec<u8>],
    stopped: &watch::Receiver<bool>,
) -> std::result::Result<bool, Refused> {
    let mut faults = 0;
    let asked = Instant::now();
    loop {
        let answer = link.end(attempt, ended, files).await;
        match &answer {
            Err(Refused::Fault(_)) if faults < MOST_FAULTS => faults += 1,
            Err(Refused::Unreached(_)) if asked.elapsed() < PATIENCE => {}
            _ => return answer,
        }
        if *stopped.borrow() {
            return answer;
        }
        pause(PAUSE, stopped).await;
    }
}
