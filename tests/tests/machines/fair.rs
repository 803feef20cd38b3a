//! Many visitors wait for machines that are killed again and again: nobody gets more turns than others, and no run is lost.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use nix::sys::signal::Signal;
use ocb_tests::service::{Guest, Service};
use serde_json::{Value, json};

use crate::Site;
use crate::machine::Machine;

/// So many runs a visitor has waiting, as long as there are more to ask for; a guest may have twenty.
const AHEAD: usize = 8;

struct Visitor {
    guest: Guest,
    /// Its runs that have not ended, and when it asked for them.
    open: Vec<(String, Instant)>,
}

impl Visitor {
    /// Asks for one more run; false when the service wants it to wait.
    fn ask(&mut self, service: &Service, spec: &Value) -> bool {
        let (status, run) = self.guest.post(service, "/runs", spec);
        assert!([201, 429].contains(&status), "{run}");
        if status == 201 {
            self.open.push((run["id"].as_str().expect("an id").to_owned(), Instant::now()));
        }
        status == 201
    }

    /// Has it had a run waiting all the time since, whatever the machines are at?
    fn has_waited(&self, since: Instant, machines: usize) -> bool {
        self.open.iter().filter(|(_, asked)| *asked <= since).count() > machines
    }

    /// Its runs that have ended since the last look: when each began to be measured, and how long it took from asking on. Those
    /// that were given up have begun three times.
    fn look(&mut self, service: &Service, ended: &mut Vec<(Vec<i64>, Duration)>) -> usize {
        let (guest, mut given_up) = (&self.guest, 0);
        self.open.retain(|(id, asked)| {
            let run = guest.get(service, &format!("/runs/{id}"));
            if ["queued", "running"].iter().any(|state| run["state"] == *state) {
                return true;
            }
            let turns = turns(guest, service, id);
            let found = (run["state"].as_str().expect("a state"), run["results"].as_array().map(Vec::len));
            match found {
                ("failed", Some(0)) if run["attempts"] == 3 && turns.len() == 3 => given_up += 1,
                _ => assert_eq!(
                    (found, run["attempts"].as_u64()),
                    (("done", Some(1)), Some(turns.len() as u64)),
                    "{run}"
                ),
            }
            ended.push((turns, asked.elapsed()));
            false
        });
        given_up
    }
}

/// When the attempts at measuring a run began, by its events: it is under way without a stage. The first such event is that of its
/// preparation.
fn turns(guest: &Guest, service: &Service, run: &str) -> Vec<i64> {
    let events = guest.look(service, &format!("/runs/{run}/events")).text().expect("events");
    let events = events.lines().filter_map(|line| line.strip_prefix("data:"));
    let events = events.map(|event| serde_json::from_str::<Value>(event).expect("JSON"));
    let mut begun = events.filter(|it| it["state"] == "running" && it["stage"].is_null() && it["result"].is_null());
    begun.next().expect("it was prepared");
    begun.map(|event| event["at_us"].as_i64().expect("a time")).collect()
}

fn now_us() -> i64 {
    SystemTime::now().duration_since(UNIX_EPOCH).expect("later than 1970").as_micros() as i64
}

/// As many as this variable says, or so many.
fn count(variable: &str, usual: usize) -> usize {
    std::env::var(variable).map_or(usual, |text| text.parse().unwrap_or_else(|_| panic!("{variable}={text:?}")))
}

/// The next of a sequence that looks random and is the same each time.
fn next(state: &mut u64) -> usize {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize
}

#[test]
fn many_runs_are_shared_fairly_while_machines_are_killed() {
    let (runs, kills) = (count("OCB_MACHINE_RUNS", 40), count("OCB_MACHINE_KILLS", 4));
    let campaign = runs > 100;
    let (many, names) = if campaign { (10, &["alpha", "beta", "gamma"][..]) } else { (5, &["alpha", "beta"][..]) };
    let mut site = Site::open();
    for name in names {
        site.token(name);
    }
    let mut machines: Vec<Machine> = names.iter().map(|name| site.machine(name)).collect();
    // Nobody may ask for runs as fast as these small ones are measured, so that those of a campaign take longer; on a busy
    // machine their processes may start slowly.
    let (passes, budget) = if campaign { (20, 60.0) } else { (6, 1.0) };
    let spec = json!({
        "object_a": "stock:torus-knot@600", "query": "collision_first", "passes": passes, "budget_seconds": budget,
        "method": { "kind": "sphere", "sampling": { "kind": "count", "count": 20 } }, "algorithms": ["box-tree"],
    });
    // Guests of one address share a turn.
    let guests = (1..=many).map(|n| Guest::from_address(&format!("10.0.{n}.1")));
    let mut visitors: Vec<Visitor> = guests.map(|guest| Visitor { guest, open: Vec::new() }).collect();
    let mut ended: Vec<Vec<(Vec<i64>, Duration)>> = vec![Vec::new(); many];
    let (mut asked, mut given_up, mut killed, mut chance) = (0, 0, 0, 1);
    let begun = Instant::now();
    // While all had runs waiting.
    let (mut since_us, mut until_us, mut last_look) = (None, None, begun);
    while ended.iter().map(Vec::len).sum::<usize>() < runs {
        for (visitor, ended) in visitors.iter_mut().zip(&mut ended) {
            while visitor.open.len() < AHEAD && asked < runs && visitor.ask(site.service(), &spec) {
                asked += 1;
            }
            given_up += visitor.look(site.service(), ended);
        }
        if since_us.is_some()
            && until_us.is_none()
            && !visitors.iter().all(|it| it.has_waited(last_look, machines.len()))
        {
            until_us = Some(now_us());
        }
        last_look = Instant::now();
        since_us = since_us.or(Some(now_us()));
        let over = ended.iter().map(Vec::len).sum::<usize>();
        if killed < kills && over * (kills + 1) > killed * runs {
            let victim = next(&mut chance) % machines.len();
            std::thread::sleep(Duration::from_millis(next(&mut chance) as u64 % 1500));
            machines[victim].signal(Signal::SIGKILL);
            machines[victim] = site.machine(names[victim]);
            killed += 1;
        }
        std::thread::sleep(Duration::from_millis(200));
        assert!(begun.elapsed() < Duration::from_secs(60 + 20 * runs as u64), "{over} of {runs} runs");
    }
    assert!(asked == runs && killed * 10 >= kills * 9, "{asked} of {runs} runs, {killed} kills");
    assert!(given_up * 3 <= killed, "{given_up} runs were given up after {killed} kills");
    let mut waits: Vec<f64> = ended.iter().flatten().map(|(_, wait)| wait.as_secs_f64()).collect();
    waits.sort_by(f64::total_cmp);
    println!(
        "{runs} runs of {many} visitors on {} machines that share one measuring CPU, {killed} kills, {given_up} given up: {:.0} \
         runs an hour; from asking to results, with up to seven of the same visitor before it: p50 {:.1} s, p95 {:.1} s",
        machines.len(),
        3600.0 * runs as f64 / begun.elapsed().as_secs_f64(),
        waits[waits.len() / 2],
        waits[waits.len() * 95 / 100],
    );
    let shared = since_us.expect("a look")..until_us.expect("the runs come to an end");
    let turns_of = |ended: &Vec<(Vec<i64>, Duration)>| {
        ended.iter().flat_map(|(turns, _)| turns).filter(|begun| shared.contains(begun)).count()
    };
    let turns: Vec<usize> = ended.iter().map(turns_of).collect();
    println!("turns while all had runs waiting: {turns:?}");
    assert!(2 * turns.iter().sum::<usize>() >= runs, "they had runs waiting for a part of the time only: {turns:?}");
    // A run whose machine was killed has had its turn.
    let (least, most) = (turns.iter().min().expect("visitors"), turns.iter().max().expect("visitors"));
    assert!(most - least <= 1, "{turns:?}");
}
