//! A comparison that stops when it is settled names the winner of the whole one, at a small part of its questions.
//!
//! Times are drawn as runners give them, only worse: hardness over three decades, questions that one method finds thirty
//! times as hard as the others do, processes that differ by 1.5 %, single disturbances of ten times. The same in real
//! processes: `host/service/tests/early.rs`.

use ocb_core::numbers::Numbers;
use ocb_core::sequential::{self, Look, Standing, contest};

const CONFIGURATIONS: usize = 20_000;
const ROUNDS: u32 = 5;
/// Of each difference that matters; a quarter of that for the others, for which nearly everything may be measured.
const REPETITIONS: u64 = 100;

/// Four methods.
struct Scene {
    /// Time of each configuration without what the process adds, nanoseconds, by method.
    costs: Vec<Vec<f64>>,
}

fn uniform(numbers: &mut Numbers) -> f64 {
    (numbers.bits() >> 11) as f64 / (1u64 << 53) as f64
}

/// Normal, by Box and Muller.
fn normal(numbers: &mut Numbers) -> f64 {
    let (u, v) = (1.0 - uniform(numbers), uniform(numbers));
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

impl Scene {
    /// The second method takes `ahead` times as long as the first, on average over the logarithms.
    fn new(ahead: f64) -> Self {
        let mut numbers = Numbers::new(ahead.to_bits());
        let hardness: Vec<f64> = (0..CONFIGURATIONS).map(|_| 1000.0 * uniform(&mut numbers).powf(-0.8)).collect();
        let method = |speed: f64| {
            let one = |hard: &f64| {
                let spike = if uniform(&mut numbers) < 0.01 { 30.0 } else { 1.0 };
                speed * hard * spike * (0.4 * normal(&mut numbers)).exp()
            };
            hardness.iter().map(one).collect::<Vec<f64>>()
        };
        let mut costs: Vec<Vec<f64>> = [1.0, ahead, 1.5 * ahead, 4.0].map(method).into();
        // The means of what was drawn are not quite those that were meant.
        let mean = |costs: &[f64]| costs.iter().map(|x| x.ln()).sum::<f64>() / costs.len() as f64;
        let shift = (ahead.ln() + mean(&costs[0]) - mean(&costs[1])).exp();
        costs[1].iter_mut().for_each(|x| *x *= shift);
        Self { costs }
    }

    /// Measures these configurations in fresh processes and adds the times.
    fn measure(&self, part: &[u32], times: &mut [Vec<Vec<(u32, f64)>>], numbers: &mut Numbers) {
        for (costs, times) in self.costs.iter().zip(times) {
            let processes: Vec<f64> = (0..ROUNDS).map(|_| (0.015 * normal(numbers)).exp()).collect();
            for i in part {
                let mut time = |(round, process): (usize, &f64)| {
                    let disturbed = if uniform(numbers) < 0.003 { 10.0 } else { 1.0 };
                    (round as u32, costs[*i as usize] * process * disturbed * (0.03 * normal(numbers)).exp())
                };
                times.push(processes.iter().enumerate().map(&mut time).collect());
            }
        }
    }

    fn look(&self, number: u32) -> Look {
        let comparisons = self.costs.len() - 1;
        Look { number, comparisons, precision: 0.05, rounds: ROUNDS, of: CONFIGURATIONS as u64 }
    }

    /// Who wins when everything is measured.
    fn winner(&self) -> usize {
        let mut times = vec![Vec::new(); self.costs.len()];
        let all: Vec<u32> = (0..CONFIGURATIONS as u32).collect();
        self.measure(&all, &mut times, &mut Numbers::new(1));
        let times: Vec<_> = times.iter().map(Vec::as_slice).collect();
        contest(&times, &self.look(1)).expect("four methods").fastest
    }

    /// One early run: what it says of the winner of the whole, nothing when it names the same, and how many it asked.
    fn early(&self, seed: u64, whole: usize) -> (Option<Standing>, usize) {
        let mut numbers = Numbers::new(seed);
        let mut order: Vec<u32> = (0..CONFIGURATIONS as u32).collect();
        numbers.shuffle(&mut order);
        let mut times = vec![Vec::new(); self.costs.len()];
        let (mut begun, mut found) = (0, None);
        for (number, end) in (1..).zip(sequential::looks(CONFIGURATIONS)) {
            self.measure(&order[begun..end], &mut times, &mut numbers);
            begun = end;
            let times: Vec<_> = times.iter().map(Vec::as_slice).collect();
            let contest = contest(&times, &self.look(number)).expect("four methods");
            let settled = contest.settled();
            found = Some(contest);
            if settled {
                break;
            }
        }
        let contest = found.expect("at least one look");
        (contest.rivals.iter().find(|rival| rival.index == whole).map(|rival| rival.standing), begun)
    }
}

#[test]
fn the_same_winner_at_a_small_part_of_the_questions() {
    println!("{CONFIGURATIONS} configurations in {ROUNDS} rounds");
    println!(
        "times as long | repetitions | same winner | calls it equal | leaves it open | calls it slower | asked: mean, most"
    );
    let mut shares = Vec::new();
    for ahead in [3.0, 1.5, 1.2, 1.1, 1.05, 1.02, 1.0] {
        let scene = Scene::new(ahead);
        let whole = scene.winner();
        let matters = ahead > 1.05;
        let repetitions = if matters { REPETITIONS } else { REPETITIONS / 4 };
        let runs: Vec<(Option<Standing>, usize)> =
            (0..repetitions).map(|seed| scene.early(1000 + seed, whole)).collect();
        let count = |said: Option<Standing>| runs.iter().filter(|(found, _)| *found == said).count();
        let (same, slower) = (count(None), count(Some(Standing::Slower)));
        let (equal, open) = (count(Some(Standing::Equal)), count(Some(Standing::Open)));
        let share = |n: usize| 100.0 * n as f64 / CONFIGURATIONS as f64;
        let mean = runs.iter().map(|(_, n)| share(*n)).sum::<f64>() / runs.len() as f64;
        let most = runs.iter().map(|(_, n)| share(*n)).fold(0.0, f64::max);
        println!(
            "{ahead:13} | {repetitions:11} | {same:11} | {equal:14} | {open:14} | {slower:15} | {mean:.1} %, {most:.1} %"
        );
        // Statements are false in two of a hundred runs at most, whatever the truth; two methods that are the same have
        // no winner that could be missed.
        let allowed = (sequential::ERROR * repetitions as f64).ceil() as usize;
        assert!(slower <= allowed, "{ahead}: {slower} of {repetitions} call the winner slower");
        // Differences above the precision are found, and cheaply.
        if matters {
            assert!(same >= 98, "{ahead}: {same} of {repetitions}");
            shares.push(mean);
        }
    }
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    println!("Differences above the precision: {mean:.1} % of the questions on average.");
    assert!(mean < 10.0, "{mean} %");
}
