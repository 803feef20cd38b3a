//! The request of a run as it is stored, also by older versions.

use serde_json::{Map, Value, json};

use crate::model::RunSpec;
use crate::store::from_json;
use crate::{EngineError, Result};

/// Reads a stored request. Older versions had three fields instead of one separation.
pub fn read_spec(text: &str) -> Result<RunSpec> {
    let mut fields: Map<String, Value> = from_json(text)?;
    let [distance, step, ladder] = ["relative_distance", "step", "ladder"].map(|name| fields.remove(name));
    fields.entry("separation").or_insert_with(|| match (step, ladder) {
        (_, Some(Value::Bool(true))) => json!({ "kind": "ladder" }),
        (Some(of_size @ Value::Number(_)), _) => json!({ "kind": "step", "of_size": of_size }),
        _ => json!({ "kind": "relative", "distance": distance.unwrap_or(json!(0.0)) }),
    });
    serde_json::from_value(Value::Object(fields)).map_err(|e| EngineError::fault("Reading a stored request failed", e))
}

#[cfg(test)]
mod tests {
    use ocb_core::configuration::Separation;

    use super::*;

    #[test]
    fn requests_of_older_versions_are_read() {
        let of = |fields: &str| {
            let text = format!(
                r#"{{ "object_a": "x", "query": "proximity", "method": {{ "kind": "grid",
                "sampling": {{ "kind": "count", "count": 9 }} }}{fields} }}"#
            );
            read_spec(&text).unwrap().separation
        };
        assert_eq!(of(""), Separation::Relative { distance: 0.0 });
        assert_eq!(of(r#", "relative_distance": 0.1"#), Separation::Relative { distance: 0.1 });
        assert_eq!(of(r#", "relative_distance": 0.0, "step": -1e-6"#), Separation::Step { of_size: -1e-6 });
        assert_eq!(of(r#", "relative_distance": 0.0, "ladder": true"#), Separation::Ladder);
        assert_eq!(of(r#", "separation": { "kind": "step", "of_size": 0.01 }"#), Separation::Step { of_size: 0.01 });
    }
}
