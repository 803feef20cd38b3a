//! The board and the charts: what they compare, and that every number in them is one that was measured.

mod charts;
mod compare;
