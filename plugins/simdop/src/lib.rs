#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

/// k-DOPs, sixteen children at once.
pub type SimDop = ocb_wide::Wide<ocb_wide::simdop::SimDop>;

opencollbench_plugin::export!(SimDop: distance contacts counts parameters);
