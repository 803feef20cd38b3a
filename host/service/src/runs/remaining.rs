//! How long a run will still take, from what it has measured itself.
//!
//! Algorithms work in turns, so their remaining times add up. Before an algorithm has begun, its time comes from the first look;
//! before that, from earlier runs.

/// Successive estimates differ by at most this factor, however the run turns out.
const FACTOR: f64 = 1.9;
/// So long anything may be told: nothing has been measured yet.
const SETTLING: f64 = 5.0;
/// Less is not told apart.
const LEAST: f64 = 1.0;

/// The estimate of one run.
#[derive(Debug)]
pub struct Remaining {
    /// Seconds until its configurations are found.
    finding: f64,
    /// Of each algorithm, and of the reference where it is none of them.
    algorithms: Vec<f64>,
    told: Option<f64>,
}

impl Remaining {
    /// So many algorithms take turns, and earlier runs would have taken so long.
    pub fn new(algorithms: usize, expected: f64) -> Self {
        Self { finding: 0.0, algorithms: vec![expected / algorithms.max(1) as f64; algorithms], told: None }
    }

    /// Configurations are being found for so long.
    pub fn finding(&mut self, done: u64, total: u64, worked: f64) {
        if done > 0 {
            self.finding = left(done, total, worked);
        }
    }

    /// A first look says how long an algorithm will take.
    pub fn looked(&mut self, index: usize, seconds: f64) {
        if let Some(left) = self.algorithms.get_mut(index) {
            *left = seconds;
        }
    }

    /// An algorithm has answered so many queries of a total, which is 0 while it is not known, in so much time.
    pub fn progress(&mut self, index: usize, done: u64, total: u64, worked: f64) {
        if let (Some(known), true) = (self.algorithms.get_mut(index), done > 0 && total > 0) {
            *known = left(done, total, worked);
        }
    }

    /// Seconds left, `elapsed` after the run has begun.
    pub fn tell(&mut self, elapsed: f64) -> f64 {
        let now = (self.finding + self.algorithms.iter().sum::<f64>()).max(LEAST);
        let told = match self.told {
            Some(told) if elapsed > SETTLING => now.clamp(told / FACTOR, told * FACTOR),
            _ => now,
        };
        *self.told.insert(told.max(LEAST))
    }
}

fn left(done: u64, total: u64, worked: f64) -> f64 {
    worked * total.saturating_sub(done) as f64 / done as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measured_times_replace_expected_ones() {
        let mut remaining = Remaining::new(2, 40.0);
        assert_eq!(remaining.tell(0.0), 40.0);
        remaining.finding(100, 400, 1.0);
        assert_eq!(remaining.tell(1.0), 43.0);
        remaining.finding(400, 400, 4.0);
        remaining.looked(0, 6.0);
        remaining.looked(1, 90.0);
        assert_eq!(remaining.tell(4.0), 96.0);
        remaining.progress(0, 10, 0, 1.0);
        remaining.progress(0, 250, 1000, 2.0);
        assert_eq!(remaining.tell(6.0), 96.0);
    }

    #[test]
    fn after_five_seconds_it_never_jumps() {
        let mut remaining = Remaining::new(1, 10.0);
        let mut told = remaining.tell(4.9);
        for (i, left) in [10.0, 500.0, 500.0, 500.0, 2.0, 0.0, 0.0, 0.0, 900.0, 0.0].into_iter().enumerate() {
            remaining.looked(0, left);
            let next = remaining.tell(5.1 + i as f64);
            assert!((0.5..2.0).contains(&(next / told)), "{told} and then {next}");
            told = next;
        }
        for i in 0..20 {
            told = remaining.tell(20.0 + f64::from(i));
        }
        assert_eq!(told, LEAST);
    }
}
