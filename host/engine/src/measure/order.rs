//! The order in which configurations are measured.

use ocb_core::numbers::Numbers;

/// The numbers 0 to n-1 in an order that depends on nothing but the seed: all algorithms share it.
pub fn shuffled(n: u32, seed: u64) -> Vec<u32> {
    let mut order: Vec<u32> = (0..n).collect();
    Numbers::new(seed).shuffle(&mut order);
    order
}

/// Another order of the same prefix for a later round, so that no configuration always follows the same one.
pub fn reshuffled(prefix: &[u32], seed: u64, round: u32) -> Vec<u32> {
    let mut order = prefix.to_vec();
    Numbers::new(seed ^ (u64::from(round) << 32)).shuffle(&mut order);
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_holds_each_configuration_once_and_is_repeatable() {
        let order = shuffled(1000, 7);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..1000).collect::<Vec<u32>>());
        assert_ne!(order, sorted);
        assert_eq!(order, shuffled(1000, 7));
        assert_ne!(order, shuffled(1000, 8));
    }

    #[test]
    fn later_rounds_stay_within_the_prefix() {
        let base = shuffled(100, 3);
        let mut later = reshuffled(&base[..10], 3, 2);
        assert_ne!(later, base[..10]);
        later.sort_unstable();
        let mut prefix = base[..10].to_vec();
        prefix.sort_unstable();
        assert_eq!(later, prefix);
    }
}
