//! What a set reaches of an object.

/// How the closest features are spread over the triangles of one object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// Share of the triangles that are a closest feature at least once.
    pub share: f64,
    /// Entropy of the closest features over the triangles, divided by its maximum; 1 when all are met equally often.
    pub evenness: f64,
}

impl Coverage {
    /// Of an object with so many triangles; `met` are the closest ones, one per configuration.
    pub fn new(triangles: usize, met: impl Iterator<Item = u32>) -> Self {
        let mut counts = vec![0u32; triangles];
        let mut all = 0u64;
        for triangle in met {
            counts[triangle as usize] += 1;
            all += 1;
        }
        let covered = counts.iter().filter(|count| **count > 0).count();
        let entropy: f64 = counts
            .iter()
            .filter(|count| **count > 0)
            .map(|count| f64::from(*count) / all as f64)
            .map(|share| -share * share.ln())
            .sum();
        let most = (triangles as f64).ln();
        Self {
            share: covered as f64 / triangles as f64,
            // A single triangle is always met equally often.
            evenness: if most > 0.0 { entropy / most } else { 1.0 },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coverage_counts_triangles_and_evenness_their_use() {
        let even = Coverage::new(4, [0, 1, 2, 3, 3, 2, 1, 0].into_iter());
        assert_eq!(even.share, 1.0);
        assert!((even.evenness - 1.0).abs() < 1e-15);
        assert_eq!(Coverage::new(4, [2, 2, 2].into_iter()), Coverage { share: 0.25, evenness: 0.0 });
        let half = Coverage::new(4, [0, 1].into_iter());
        assert!((half.evenness - 0.5).abs() < 1e-15);
        assert_eq!(Coverage::new(1, [0].into_iter()).evenness, 1.0);
    }
}
