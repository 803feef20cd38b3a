//! Old and new results of a campaign.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{ArrayRef, BooleanArray, Float64Array, StringArray, UInt32Array};

use crate::columns::{SCHEMA_VERSION, batch, to_parquet};
use ocb_lab::Result;

use crate::model::{Compared, ComparedResult, Estimated};

/// One row per algorithm in each run, with `old_` and `new_` in front of what both have.
pub fn campaign_parquet(rows: &[Compared]) -> Result<Vec<u8>> {
    let text = |of: &dyn Fn(&Compared) -> Option<String>| -> ArrayRef {
        Arc::new(rows.iter().map(of).collect::<StringArray>())
    };
    let number =
        |of: &dyn Fn(&Compared) -> Option<f64>| -> ArrayRef { Arc::new(rows.iter().map(of).collect::<Float64Array>()) };
    let count =
        |of: &dyn Fn(&Compared) -> Option<u32>| -> ArrayRef { Arc::new(rows.iter().map(of).collect::<UInt32Array>()) };
    let flag = |of: fn(&Compared) -> bool| -> ArrayRef {
        Arc::new(rows.iter().map(|row| Some(of(row))).collect::<BooleanArray>())
    };
    let mut columns: Vec<(String, ArrayRef)> = Vec::new();
    let mut put = |name: &str, column: ArrayRef| columns.push((name.to_owned(), column));
    put("algorithm", text(&|r| Some(r.algorithm.clone())));
    put("question", text(&|r| Some(r.question.clone())));
    put("scene", text(&|r| Some(r.scene.clone())));
    put("distance", text(&|r| Some(r.distance.clone())));
    put("of_suite", flag(|r| r.of_suite));
    type Side = fn(&Compared) -> Option<&ComparedResult>;
    let sides: [(&str, Side); 2] = [("old", |r| r.old.as_ref()), ("new", |r| r.new.as_ref())];
    for (name, side) in sides {
        let median = |of: fn(Estimated) -> f64| number(&|r| side(r)?.median_ns.map(of));
        put(&format!("{name}_median_ns"), median(|e| e.value));
        put(&format!("{name}_median_ns_lo"), median(|e| e.lo));
        put(&format!("{name}_median_ns_hi"), median(|e| e.hi));
        put(&format!("{name}_n"), count(&|r| side(r).map(|s| s.n)));
        put(&format!("{name}_wrong"), count(&|r| side(r).map(|s| s.wrong)));
        put(&format!("{name}_outcome"), text(&|r| side(r).map(|s| s.outcome.to_string())));
        put(&format!("{name}_run"), text(&|r| side(r).map(|s| s.run.clone())));
        put(&format!("{name}_cpu"), text(&|r| side(r).map(|s| s.cpu.clone())));
        put(&format!("{name}_hardware_class"), text(&|r| side(r).map(|s| s.hardware_class.clone())));
        put(&format!("{name}_version"), text(&|r| side(r).map(|s| s.version.clone())));
        put(&format!("{name}_oracle"), count(&|r| side(r)?.oracle));
        put(&format!("{name}_plugin_sha256"), text(&|r| side(r).map(|s| s.plugin_sha256.clone())));
    }
    put("ratio", number(&|r| r.ratio.map(|e| e.value)));
    put("ratio_lo", number(&|r| r.ratio.map(|e| e.lo)));
    put("ratio_hi", number(&|r| r.ratio.map(|e| e.hi)));
    let metadata = HashMap::from([("opencollbench.schema".to_owned(), SCHEMA_VERSION.to_owned())]);
    to_parquet(&batch(metadata, columns.iter().map(|(name, column)| (name.as_str(), column.clone())).collect())?)
}
