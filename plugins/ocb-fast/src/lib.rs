#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

/// Oriented boxes, sixteen pairs at once.
pub type Fast = ocb_wide::Wide<ocb_wide::fast::Fast>;

opencollbench_plugin::export!(Fast: distance contacts counts parameters scene);
