//! Keeps `openapi.json`, from which the pages generate their client, equal to what the server serves.

use serde_json::Value;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/openapi.json");

#[test]
fn the_document_is_current() {
    let mut generated = serde_json::to_string_pretty(&ocb_server::document()).expect("it is JSON");
    generated.push('\n');
    if std::env::var_os("UPDATE_OPENAPI").is_some() {
        std::fs::write(FILE, &generated).expect("openapi.json is writable");
    }
    let stored = std::fs::read_to_string(FILE).unwrap_or_default();
    assert!(
        stored == generated,
        "web/server/openapi.json is out of date; UPDATE_OPENAPI=1 cargo test --release -p ocb-server --test openapi writes it"
    );
}

/// `nullable` belongs to OpenAPI 3.0; in 3.1 a client generator ignores it and types come out wrong.
#[test]
fn nothing_says_nullable() {
    fn search(value: &Value) -> bool {
        match value {
            Value::Object(map) => map.contains_key("nullable") || map.values().any(search),
            Value::Array(items) => items.iter().any(search),
            _ => false,
        }
    }
    let document = serde_json::to_value(ocb_server::document()).expect("it is JSON");
    assert_eq!(document["openapi"], "3.1.0");
    assert!(!search(&document));
}

/// Every schema that is named must be there.
#[test]
fn every_reference_leads_somewhere() {
    fn references<'a>(value: &'a Value, found: &mut Vec<&'a str>) {
        match value {
            Value::Object(map) => {
                found.extend(map.get("$ref").and_then(Value::as_str));
                map.values().for_each(|inner| references(inner, found));
            }
            Value::Array(items) => items.iter().for_each(|inner| references(inner, found)),
            _ => {}
        }
    }
    let document = serde_json::to_value(ocb_server::document()).expect("it is JSON");
    let mut found = Vec::new();
    references(&document, &mut found);
    assert!(found.len() > 20, "only {} references", found.len());
    for reference in found {
        let pointer = reference.trim_start_matches('#');
        assert!(document.pointer(pointer).is_some(), "{reference} leads nowhere");
    }
}
