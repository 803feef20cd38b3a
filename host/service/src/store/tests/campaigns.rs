//! Campaigns and their runs, on both databases.

use super::super::*;
use super::people::account;
use super::rows::*;
use super::{add, begin, fresh_stages, run, spec};
use crate::model::{CampaignRuns, Cursor, NewChoices, RunSpec, State};
use crate::suite::Suite;

const NOTE: Note<'static> = Note { actor: "ada", action: "did", subject: "campaign:c", detail: "" };

pub(super) fn campaign(id: &str, created_us: i64, suite: &Suite) -> CampaignRow {
    CampaignRow {
        id: id.into(),
        reason: "why".into(),
        of_suite: true,
        of_people: false,
        created_by: "ada".into(),
        created_us,
        hardware_class: "h".into(),
        oracle: 5,
        suite: suite.sha256.clone(),
        queued_us: None,
        cancelled_us: None,
        ended_us: None,
    }
}

pub async fn a_campaign_repeats_a_run_once_and_takes_nobodys_turn(store: Store) {
    let suite = Suite::open(None).unwrap();
    store.keep_suite(&suite).await.unwrap();
    let first = campaign("c", 1, &suite);
    assert!(store.add_campaign(&first, NOTE).await.unwrap());
    assert!(!store.add_campaign(&campaign("c", 9, &suite), NOTE).await.unwrap());
    assert!(store.add_campaign(&campaign("d", 2, &suite), NOTE).await.unwrap());
    assert_eq!(store.notes_on("campaign:c").await.unwrap().len(), 2, "what did not happen is not noted");
    assert_eq!(store.campaign("c").await.unwrap(), Some(first.clone()));
    let ids = |rows: Vec<CampaignRow>| rows.into_iter().map(|row| row.id).collect::<Vec<_>>();
    assert_eq!(ids(store.campaigns(&Cursor::start(), 9).await.unwrap()), ["d", "c"]);
    assert_eq!(ids(store.campaigns(&Cursor::behind(2, "d"), 9).await.unwrap()), ["c"]);

    let again = |id: &str, campaign: &str, of: Option<&str>| RunRow {
        campaign: Some(campaign.into()),
        rerun_of: of.map(str::to_owned),
        turn: String::new(),
        ..run(id, Some("a"), 5, 3)
    };
    for (id, of) in [("1", Some("x")), ("2", Some("y")), ("3", None), ("4", None)] {
        add(&store, again(id, "c", of)).await;
    }
    assert!(!store.add_run(&again("5", "c", Some("x")), &[], None).await.unwrap(), "the same run twice");
    add(&store, again("6", "d", Some("x"))).await;
    assert_eq!(store.repeat_of("c", "y").await.unwrap().unwrap().id, "2");
    assert_eq!(store.campaign_runs("c").await.unwrap().len(), 4);
    assert_eq!(store.granted_to("a").await.unwrap().waiting, 0, "nobody asked for these");
    assert_eq!(store.waiting_in_all(5).await.unwrap().0, 5);

    // Whoever's run is repeated loses no turn by it: "a" has been served by the campaign alone.
    assert_eq!(begin(&store, "m").await.unwrap().job, "1");
    add(&store, run("7", Some("a"), 5, 9)).await;
    add(&store, run("8", Some("b"), 5, 10)).await;
    assert_eq!(begin(&store, "m").await.unwrap().job, "7");

    let less = RunSpec { algorithms: vec!["b".into()], ..spec() };
    assert!(store.ask_less("2", &less, &fresh_stages(&less.algorithms)).await.unwrap());
    assert!(!store.ask_less("1", &less, &[]).await.unwrap(), "it is at work");
    assert_eq!(store.run("2").await.unwrap().unwrap().spec, less);
    assert_eq!(store.stages("2").await.unwrap(), fresh_stages(&less.algorithms));
    assert_eq!(store.waiting_of_the_service().await.unwrap().len(), 4);

    assert!(store.end_waiting_run("3", State::Failed, Some("m")).await.unwrap());
    let counts = CampaignRuns { waiting: 2, running: 1, failed: 1, expected_seconds: 4.5, ..CampaignRuns::default() };
    assert_eq!(store.campaign_counts("c").await.unwrap(), counts);
    assert!(store.cancel_campaign("c", NOTE).await.unwrap() && !store.cancel_campaign("c", NOTE).await.unwrap());
    let mut ended = store.end_waiting_of_campaign("c").await.unwrap();
    ended.sort();
    assert_eq!(ended, ["2", "4"]);
    let counts = CampaignRuns { running: 1, failed: 1, cancelled: 2, expected_seconds: 1.5, ..CampaignRuns::default() };
    assert_eq!(store.campaign_counts("c").await.unwrap(), counts);
    store.campaign_is_queued("d").await.unwrap();
    store.end_campaign("c").await.unwrap();
    assert_eq!(ids(store.open_campaigns().await.unwrap()), ["d"]);
    assert!(!store.cancel_campaign("c", NOTE).await.unwrap());
    assert!(store.campaign("d").await.unwrap().unwrap().queued_us.is_some());
}

pub async fn only_runs_of_those_who_agree_are_measured_again(store: Store) {
    for (id, agrees) in [("1", Some(true)), ("2", Some(false)), ("3", None)] {
        assert!(store.add_account(&account(id, id), "hash").await.unwrap());
        store.choose(id, &NewChoices { agrees_to_reruns: agrees, ..NewChoices::default() }).await.unwrap();
    }
    let owners = [("a", "account:1"), ("b", "account:2"), ("c", "account:3"), ("d", "1"), ("failed", "account:1")];
    for (place, (id, owner)) in (1..).zip(owners) {
        add(&store, run(id, Some(owner), 1, place)).await;
    }
    add(&store, RunRow { featured: true, ..run("featured", Some("account:1"), 1, 9) }).await;
    add(&store, run("newer", Some("account:1"), 1, 8)).await;
    assert!(store.end_waiting_run("failed", State::Failed, None).await.unwrap());
    let ids: Vec<String> = store.runs_of_the_agreeing().await.unwrap().into_iter().map(|row| row.id).collect();
    assert_eq!(ids, ["newer", "a"]);
}
