//! The tables that users take away of what the service knows: boards, campaigns, charts.

mod board;
mod campaigns;
mod charts;

pub use board::board_parquet;
pub use campaigns::campaign_parquet;
pub use charts::chart_parquet;
pub use ocb_lab::columns::*;
