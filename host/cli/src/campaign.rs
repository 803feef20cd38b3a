//! `ocb campaign`: stored benchmarks measured again, side by side with what they gave before.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use ocb_service::model::{
    CampaignInfo, CampaignPreview, CampaignRequest, Compared, ComparedResult, Estimated, OutcomeName, Page, State,
};
use ocb_service::{Engine, EngineError, campaign_csv};

use crate::args::{CampaignArgs, CampaignCommand, CampaignOf, Store};
use crate::failure::{Failure, INTERRUPTED, NOT_ALL_WELL, Result};
use crate::open::{self, OWNER, Purpose};
use crate::{output, run, serve, units};

/// How often it is looked whether a campaign has ended.
const LOOK: Duration = Duration::from_millis(500);

/// Makes, lists, shows or cancels.
pub async fn campaign(store: &Store, command: &CampaignCommand, json: bool) -> Result<ExitCode> {
    let measures = matches!(command, CampaignCommand::Create(args) if args.measure);
    let engine = open::open(store, if measures { Purpose::Measure } else { Purpose::Look }).await?;
    let done = match command {
        CampaignCommand::Create(args) => create(&engine, args, json).await,
        CampaignCommand::List => list(&engine, json).await.map(|()| ExitCode::SUCCESS),
        CampaignCommand::Show { campaign, out } => {
            show(&engine, campaign, out.as_deref(), json).await.map(|()| ExitCode::SUCCESS)
        }
        CampaignCommand::Cancel { campaign } => cancel(&engine, campaign, json).await.map(|()| ExitCode::SUCCESS),
    };
    engine.shutdown().await;
    done
}

async fn create(engine: &Engine, args: &CampaignArgs, json: bool) -> Result<ExitCode> {
    let (suite, people) = (args.only != Some(CampaignOf::People), args.only != Some(CampaignOf::Suite));
    if args.dry_run {
        let preview = engine.preview_campaign(suite, people, None).await?;
        if json {
            output::print_json(&preview)?
        } else {
            output::print(&would_queue(&preview))?
        }
        return Ok(ExitCode::SUCCESS);
    }
    let stop = serve::stop_signal()?;
    let asked =
        CampaignRequest { reason: args.reason.clone().unwrap_or_default(), suite, people, hardware_class: None };
    let (made, _) = engine.create_campaign(None, asked, None).await?;
    if args.measure {
        let interrupted = tokio::select! {
            watched = watch(engine, &made.id) => { watched?; false }
            () = stop => true,
        };
        if interrupted {
            eprintln!("ocb: Stopped; the other runs of the campaign stay queued, and `ocb serve` continues with them.");
            return Ok(ExitCode::from(INTERRUPTED));
        }
    }
    let made = engine.campaign(&made.id, Some(OWNER)).await?;
    if json {
        output::print_json(&made)?
    } else {
        output::print(&text(&made))?
    }
    let well =
        |row: &Compared| row.new.as_ref().is_some_and(|new| new.outcome == OutcomeName::Completed && new.wrong == 0);
    let all_well = !args.measure || made.results.iter().all(well);
    Ok(if all_well { ExitCode::SUCCESS } else { ExitCode::from(NOT_ALL_WELL) })
}

/// Tells of each run that ends, until nothing of the campaign waits.
async fn watch(engine: &Engine, id: &str) -> Result<()> {
    let mut told = 0;
    loop {
        let campaign = engine.campaign(id, Some(OWNER)).await?;
        let runs = campaign.runs;
        let ended = runs.done + runs.failed + runs.cancelled;
        if ended > told {
            let left = if campaign.state == State::Running {
                format!("; the others take about {}", units::wait(runs.expected_seconds))
            } else {
                String::new()
            };
            eprintln!("{ended} of {} runs have ended{left}", ended + runs.waiting + runs.running);
            told = ended;
        }
        if campaign.state != State::Running {
            return Ok(());
        }
        tokio::time::sleep(LOOK).await;
    }
}

fn would_queue(preview: &CampaignPreview) -> String {
    format!(
        "{} runs of suite {} ({} of them repeat an earlier run) and {} public user runs would be queued, for hardware class {} \
         and oracle {}. Measuring them is expected to take {}.",
        preview.suite_runs,
        preview.suite_version,
        preview.suite_repeats,
        preview.peoples_runs,
        preview.hardware_class,
        preview.oracle,
        units::wait(preview.expected_seconds)
    )
}

async fn all(engine: &Engine) -> Result<Vec<CampaignInfo>> {
    let (mut all, mut page) = (Vec::new(), Page::default());
    loop {
        let part = engine.campaigns(&page).await?;
        all.extend(part.entries);
        let Some(next) = part.next else { return Ok(all) };
        page = page.behind(&next);
    }
}

async fn list(engine: &Engine, json: bool) -> Result<()> {
    let all = all(engine).await?;
    if json {
        return output::print_json(&all);
    }
    if all.is_empty() {
        return output::print("No campaigns yet; `ocb campaign create` makes one.");
    }
    let row = |one: &CampaignInfo| {
        let runs = one.runs;
        let counts = [runs.waiting, runs.running, runs.done, runs.failed].map(|count| count.to_string());
        let words = [one.id.clone(), run::state_name(one.state).to_owned(), one.hardware_class.clone()];
        words.into_iter().chain(counts).chain([one.reason.clone()]).collect()
    };
    let headings = ["campaign", "state", "hardware class", "waiting", "running", "done", "failed", "reason"];
    output::print(&output::table(&headings, all.iter().map(row).collect(), &[3, 4, 5, 6]))
}

/// The campaign of that id; `latest` is the newest.
async fn find(engine: &Engine, id: &str) -> Result<CampaignInfo> {
    if id != "latest" {
        return Ok(engine.campaign(id, Some(OWNER)).await?);
    }
    let newest = engine.campaigns(&Page { limit: 1, cursor: None }).await?.entries.into_iter().next();
    let none = || EngineError::NotFound("There is no campaign yet; `ocb campaign create` makes one.".to_owned());
    Ok(engine.campaign(&newest.ok_or_else(none)?.id, Some(OWNER)).await?)
}

async fn show(engine: &Engine, id: &str, out: Option<&Path>, json: bool) -> Result<()> {
    let kind = out.map(|file| file.extension().and_then(|e| e.to_str()).unwrap_or_default().to_owned());
    if kind.as_deref().is_some_and(|kind| !matches!(kind, "csv" | "json")) {
        return Err(Failure::Input("The result file of a campaign must end in .csv or .json.".to_owned()));
    }
    let campaign = find(engine, id).await?;
    if let (Some(file), Some(kind)) = (out, kind) {
        let bytes = if kind == "csv" {
            campaign_csv(&campaign.results)?
        } else {
            output::to_json(&campaign.results)?.into_bytes()
        };
        std::fs::write(file, &bytes).map_err(|e| Failure::file("write", file, &e))?;
    }
    if json { output::print_json(&campaign) } else { output::print(&text(&campaign)) }
}

async fn cancel(engine: &Engine, id: &str, json: bool) -> Result<()> {
    let id = find(engine, id).await?.id;
    let campaign = engine.cancel_campaign(None, &id).await?;
    if json { output::print_json(&campaign) } else { output::print(&text(&campaign)) }
}

/// A campaign as lines of text.
fn text(campaign: &CampaignInfo) -> String {
    let runs = campaign.runs;
    let mut lines = vec![
        format!("Campaign {}: {}", campaign.id, campaign.reason),
        format!(
            "by {}, hardware class {}, oracle {}, suite {} ({})",
            campaign.created_by,
            campaign.hardware_class,
            campaign.oracle,
            campaign.suite_version,
            &campaign.suite_sha256[..12]
        ),
        format!(
            "{}: {} runs queued, {} running, {} done, {} failed, {} cancelled",
            run::state_name(campaign.state),
            runs.waiting,
            runs.running,
            runs.done,
            runs.failed,
            runs.cancelled
        ),
    ];
    if !campaign.results.is_empty() {
        let headings =
            ["algorithm", "query", "objects", "distance", "old", "new", "new / old", "wrong", "old on", "new on"];
        lines.push(output::table(&headings, campaign.results.iter().map(row).collect(), &[4, 5, 6, 7]));
        lines.push(
            "Median time per query with its 95 % interval; the interval of new / old follows from both.".to_owned(),
        );
    }
    lines.join("\n")
}

fn row(row: &Compared) -> Vec<String> {
    let (old, new) = (row.old.as_ref(), row.new.as_ref());
    let wrong = [old, new].map(|side| side.map_or_else(|| "-".to_owned(), |side| side.wrong.to_string()));
    vec![
        row.algorithm.clone(),
        row.question.clone(),
        row.scene.clone(),
        row.distance.clone(),
        median(old, "-"),
        median(new, run::state_name(row.state)),
        row.ratio.map_or_else(|| "-".to_owned(), |r| format!("{:.3} [{:.3}, {:.3}]", r.value, r.lo, r.hi)),
        wrong.join(" / "),
        place(old),
        place(new),
    ]
}

fn median(side: Option<&ComparedResult>, otherwise: &str) -> String {
    let Some(side) = side else { return otherwise.to_owned() };
    let time = |Estimated { value, lo, hi }: Estimated| {
        format!("{} [{}, {}]", units::time(value), units::time(lo), units::time(hi))
    };
    side.median_ns.map_or_else(|| side.outcome.to_string(), time)
}

/// Hardware class and oracle.
fn place(side: Option<&ComparedResult>) -> String {
    let oracle = |side: &ComparedResult| side.oracle.map_or_else(|| "?".to_owned(), |oracle| oracle.to_string());
    side.map_or_else(|| "-".to_owned(), |side| format!("{}, oracle {}", side.hardware_class, oracle(side)))
}
