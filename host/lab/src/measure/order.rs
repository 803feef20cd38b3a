//! The order in which configurations are measured.
//!
//! Every prefix of it is a fair sample: an algorithm whose budget ends, and a run whose comparison is settled, have
//! measured easy and hard configurations in the proportion in which the set has them (proportional stratified sampling,
//! W. G. Cochran, *Sampling Techniques*, 1977, chapter 5; its variance is never above that of a plain sample, so that
//! intervals for plain samples hold).

use ocb_core::configuration::Placed;
use ocb_core::numbers::Numbers;

/// Parts of about equal hardness.
const STRATA: usize = 50;

/// What makes a configuration hard, as far as the truth tells: whether the objects meet, how near the decision is (by
/// powers of two), and where on A.
pub fn hardness(placed: &Placed) -> (bool, i32, u32) {
    let truth = &placed.truth;
    let near = if truth.hit { truth.margin } else { truth.distance_hi };
    (truth.hit, near.log2().floor() as i32, truth.witness.triangle_a)
}

/// The numbers of all configurations, of which these are the hardnesses, in an order that depends on nothing else but the
/// seed: sorted by hardness, cut into strata of equal size, and one of each stratum drawn in turn. All algorithms share it.
pub fn stratified<K: Ord>(hardness: &[K], seed: u64) -> Vec<u32> {
    let n = hardness.len();
    let mut numbers = Numbers::new(seed);
    let mut sorted: Vec<u32> = (0..n as u32).collect();
    // The sort is stable, so that equally hard ones stay in the order in which they were drawn.
    numbers.shuffle(&mut sorted);
    sorted.sort_by_key(|i| &hardness[*i as usize]);
    let mut strata: Vec<&mut [u32]> = Vec::new();
    let mut rest = sorted.as_mut_slice();
    for left in (1..=STRATA.min(n)).rev() {
        let (stratum, others) = rest.split_at_mut(rest.len() / left);
        numbers.shuffle(stratum);
        strata.push(stratum);
        rest = others;
    }
    let mut order = Vec::with_capacity(n);
    for turn in 0..n.div_ceil(STRATA) {
        let begun = order.len();
        order.extend(strata.iter().filter_map(|stratum| stratum.get(turn)));
        numbers.shuffle(&mut order[begun..]);
    }
    order
}

/// Another order of the same part for a later process, so that no configuration always follows the same one.
pub fn reshuffled(part: &[u32], seed: u64, process: u32) -> Vec<u32> {
    let mut order = part.to_vec();
    Numbers::new(seed ^ (u64::from(process) << 32)).shuffle(&mut order);
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_holds_each_configuration_once_and_is_repeatable() {
        for n in [0, 1, 7, 50, 51, 1013] {
            let hardness: Vec<u32> = (0..n).map(|i| i % 13).collect();
            let order = stratified(&hardness, 7);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, (0..n).collect::<Vec<u32>>());
            assert_eq!(order, stratified(&hardness, 7));
            assert!(n < 3 || order != sorted && order != stratified(&hardness, 8));
        }
    }

    #[test]
    fn every_prefix_has_its_share_of_the_hard_ones() {
        // A tenth is hard; of a plain sample of 100 it may be a twentieth or a seventh.
        let hardness: Vec<bool> = (0..5000).map(|i| i % 10 == 3).collect();
        for seed in 0..20 {
            let order = stratified(&hardness, seed);
            for n in [50, 100, 500, 1500] {
                let hard = order[..n].iter().filter(|i| hardness[**i as usize]).count();
                assert_eq!(hard, n / 10, "seed {seed}");
            }
        }
    }

    #[test]
    fn later_rounds_stay_within_the_prefix() {
        let base = stratified(&[0; 100], 3);
        let mut later = reshuffled(&base[..10], 3, 2);
        assert_ne!(later, base[..10]);
        later.sort_unstable();
        let mut prefix = base[..10].to_vec();
        prefix.sort_unstable();
        assert_eq!(later, prefix);
    }
}
