//! `ocb work`: this machine measures for a service that runs elsewhere.

mod link;

use std::process::ExitCode;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use ocb_service::model::{Ended, Told, WorkOrder};
use ocb_service::worker::{Handed, Worker};
use ocb_service::{LabError, Runner, Stop};
use tokio::runtime::Handle;
use tokio::sync::watch;

use crate::args::{Store, WorkArgs};
use crate::failure::{Failure, Result};
use crate::open;
use crate::serve::stop_signal;
use link::{Link, Refused};

/// How often the service hears that the work goes on.
const BEAT: Duration = Duration::from_secs(2);
/// A service that was not reached for so long has given the run to another machine.
const LOST: Duration = Duration::from_secs(20);
/// After something went wrong.
const PAUSE: Duration = Duration::from_secs(2);
/// After a failure of this machine: others may have more luck with the run.
const LONG_PAUSE: Duration = Duration::from_secs(15);

/// Takes runs of the service and measures them, one after the other, until it is stopped; with `--once`, the next one alone.
pub async fn work(store: &Store, args: &WorkArgs) -> Result<ExitCode> {
    let runner = Runner { program: open::runner(store), profile: store.profile() };
    let plugins = open::plugins(store);
    let worker = Arc::new(Worker::observe(runner, &plugins, store.machine_note.as_deref())?);
    let link = Arc::new(Link::new(&args.server, &args.token)?);
    let stopped = stopped()?;
    let mut unreached = false;
    while !*stopped.borrow() {
        let mut end = stopped.clone();
        let next = tokio::select! {
            next = link.next(worker.facts()) => next,
            _ = end.wait_for(|stopped| *stopped) => break,
        };
        match next {
            Ok(Some(order)) => {
                unreached = false;
                let failed = carry_out(&worker, &link, order, &stopped).await?;
                if failed && !args.once {
                    pause(LONG_PAUSE, &stopped).await;
                }
            }
            Ok(None) => unreached = false,
            Err(Refused::For(sentence)) => return Err(Failure::Input(sentence)),
            Err(Refused::Unreached(sentence)) => {
                if !unreached {
                    eprintln!("ocb: {sentence} Trying again.");
                }
                unreached = true;
                pause(PAUSE, &stopped).await;
                continue;
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

/// Measures one run and hands it in; true when this machine failed.
async fn carry_out(
    worker: &Arc<Worker>,
    link: &Arc<Link>,
    order: WorkOrder,
    stopped: &watch::Receiver<bool>,
) -> Result<bool> {
    let (stop, steps, order) = (Stop::default(), Arc::new(Mutex::new(Vec::new())), Arc::new(order));
    eprintln!("ocb: measuring the run {}", order.run);
    let begun = Instant::now();
    let measuring = {
        let (worker, link, order, stop, steps) =
            (worker.clone(), link.clone(), order.clone(), stop.clone(), steps.clone());
        let handle = Handle::current();
        tokio::task::spawn_blocking(move || {
            let fetch = |name: &str| {
                let fetched = handle.block_on(link.file(&order.attempt, name));
                fetched.map_err(|e| LabError::Fault(format!("The file {name:?} of the run cannot be had. {e}")))
            };
            worker.measure(&order, &stop, &fetch, &mut |told| note(&steps, told))
        })
    };
    let beating = tokio::spawn(beat(link.clone(), order.clone(), stop.clone(), steps));
    let watching = tokio::spawn(watch_over(stop.clone(), stopped.clone(), order.most_seconds));
    let measured = measuring.await.map_err(|e| Failure::Fault(format!("the measuring thread ended: {e}.")))?;
    watching.abort();
    let (Handed { ended, files }, failed) = match measured {
        Ok(Some(handed)) => (handed, false),
        Ok(None) if *stopped.borrow() => (plain(Ended::PutBack), false),
        Ok(None) if order.most_seconds.is_some_and(|most| begun.elapsed().as_secs_f64() >= most) => {
            (plain(Ended::TooLong), false)
        }
        // The service has ended the attempt, or was not reached for so long that it has.
        Ok(None) => {
            beating.abort();
            eprintln!("ocb: the run {} was ended by the service", order.run);
            return Ok(false);
        }
        Err(e) => {
            eprintln!("ocb: the run {} could not be measured: {e}", order.run);
            (plain(Ended::Failed { message: e.to_string() }), true)
        }
    };
    let handed = hand_in(link, &order.attempt, &ended, &files, stopped).await;
    beating.abort();
    match handed {
        Ok(true) => eprintln!("ocb: the run {} is handed in", order.run),
        Ok(false) => {
            eprintln!("ocb: the run {} comes too late: it was cancelled, or another machine has it", order.run)
        }
        Err(sentence) => return Err(Failure::Fault(format!("the run {} cannot be handed in: {sentence}", order.run))),
    }
    Ok(failed)
}

fn plain(ended: Ended) -> Handed {
    Handed { ended, files: Vec::new() }
}

/// Keeps a step for the next beat; of the progress of an algorithm the newest alone.
fn note(steps: &Mutex<Vec<Told>>, told: Told) {
    let mut steps = steps.lock().unwrap_or_else(PoisonError::into_inner);
    if let Told::Progress { place: of, .. } = &told {
        steps.retain(|known| !matches!(known, Told::Progress { place, .. } if place == of));
    }
    steps.push(told);
}

/// Tells the service every two seconds that the work goes on, and how far it is; stops the work when the service has ended it.
async fn beat(link: Arc<Link>, order: Arc<WorkOrder>, stop: Stop, steps: Arc<Mutex<Vec<Told>>>) {
    let mut reached = Instant::now();
    let mut ticks = tokio::time::interval(BEAT);
    loop {
        ticks.tick().await;
        let told = std::mem::take(&mut *steps.lock().unwrap_or_else(PoisonError::into_inner));
        match link.beat(&order.attempt, told).await {
            Ok(true) => reached = Instant::now(),
            Ok(false) | Err(Refused::For(_)) => return stop.stop(),
            Err(Refused::Unreached(_)) if reached.elapsed() > LOST => return stop.stop(),
            Err(Refused::Unreached(_)) => {}
        }
    }
}

/// Stops the work when this process is asked to stop, or when the time limit of the run is over.
async fn watch_over(stop: Stop, mut stopped: watch::Receiver<bool>, most_seconds: Option<f64>) {
    let limit = async {
        match most_seconds {
            Some(most) => tokio::time::sleep(Duration::from_secs_f64(most)).await,
            None => std::future::pending().await,
        }
    };
    tokio::select! {
        _ = stopped.wait_for(|stopped| *stopped) => {}
        () = limit => {}
    }
    stop.stop();
}

/// Hands in, again and again while the service is not reached; whoever stops this process does not wait for that.
async fn hand_in(
    link: &Link,
    attempt: &str,
    ended: &Ended,
    files: &[Vec<u8>],
    stopped: &watch::Receiver<bool>,
) -> std::result::Result<bool, String> {
    let mut tries_left = None;
    loop {
        match link.end(attempt, ended, files).await {
            Ok(current) => return Ok(current),
            Err(Refused::For(sentence)) => return Err(sentence),
            Err(Refused::Unreached(sentence)) => {
                let left = tries_left.get_or_insert(3);
                if *stopped.borrow() {
                    *left -= 1;
                }
                if *left == 0 {
                    return Err(sentence);
                }
            }
        }
        tokio::time::sleep(PAUSE).await;
    }
}
