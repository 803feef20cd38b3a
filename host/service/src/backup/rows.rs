//! Rows of any table as JSON objects.

use futures::TryStreamExt;
use serde_json::{Map, Value};
use sqlx::any::{AnyRow, AnyTypeInfoKind};
use sqlx::{Any, AssertSqlSafe, Column, Row, Transaction, ValueRef};

use crate::{EngineError, Result};

/// All tables; one that refers to another stands behind it.
pub(crate) const TABLES: [&str; 35] = [
    "blobs",
    "objects",
    "plugins",
    "sets",
    "suites",
    "accounts",
    "campaigns",
    "runs",
    "served",
    "run_stages",
    "run_events",
    "results",
    "keys",
    "audit",
    "submissions",
    "submission_lines",
    "stability",
    "advice",
    "kept",
    "invitations",
    "requests",
    "notices",
    "confirmations",
    "mails",
    "off_links",
    "devices",
    "saved_configurations",
    "stability_runs",
    "workloads",
    "idle_tried",
    "attempts",
    "machines",
    "sentinels",
    "rate_limits",
    "rate_limit_key",
];

/// Hands each row of a table to `each`; gives their number.
pub async fn read(
    moment: &mut Transaction<'_, Any>,
    table: &str,
    mut each: impl FnMut(&Map<String, Value>) -> Result<()>,
) -> Result<u64> {
    let text = format!("SELECT * FROM {table}");
    let mut rows = sqlx::query(AssertSqlSafe(text)).fetch(&mut **moment);
    let mut count = 0;
    while let Some(row) = rows.try_next().await? {
        each(&object(&row)?)?;
        count += 1;
    }
    Ok(count)
}

/// A row without its NULL columns.
fn object(row: &AnyRow) -> Result<Map<String, Value>> {
    let mut object = Map::new();
    for (i, column) in row.columns().iter().enumerate() {
        let raw = row.try_get_raw(i)?;
        if raw.is_null() {
            continue;
        }
        let value = match raw.type_info().kind() {
            AnyTypeInfoKind::Text => row.try_get::<String, _>(i)?.into(),
            AnyTypeInfoKind::SmallInt | AnyTypeInfoKind::Integer | AnyTypeInfoKind::BigInt => {
                row.try_get::<i64, _>(i)?.into()
            }
            AnyTypeInfoKind::Real | AnyTypeInfoKind::Double => row.try_get::<f64, _>(i)?.into(),
            other => return Err(EngineError::Fault(format!("The column {} is of type {other:?}.", column.name()))),
        };
        object.insert(column.name().to_owned(), value);
    }
    Ok(object)
}

/// Adds a row.
pub async fn add(transaction: &mut Transaction<'_, Any>, table: &str, row: &Map<String, Value>) -> Result<()> {
    let names: Vec<&str> = row.keys().map(String::as_str).collect();
    if let Some(name) =
        names.iter().find(|name| !name.bytes().all(|c| c.is_ascii_lowercase() || b"_0123456789".contains(&c)))
    {
        return Err(EngineError::Invalid(format!("The backup has a row with a column {name:?} in {table}.")));
    }
    let places: Vec<String> = (1..=names.len()).map(|i| format!("${i}")).collect();
    let text = format!("INSERT INTO {table} ({}) VALUES ({})", names.join(", "), places.join(", "));
    let mut query = sqlx::query(AssertSqlSafe(text));
    for value in row.values() {
        query = match value {
            Value::String(text) => query.bind(text.as_str()),
            Value::Number(number) => match number.as_i64() {
                Some(whole) => query.bind(whole),
                None => query.bind(number.as_f64()),
            },
            other => return Err(EngineError::Invalid(format!("The backup has {other} in a row of {table}."))),
        };
    }
    query.execute(&mut **transaction).await?;
    Ok(())
}

/// Has any table a row?
pub async fn any(transaction: &mut Transaction<'_, Any>) -> Result<bool> {
    for table in TABLES {
        let text = format!("SELECT COUNT(*) FROM {table}");
        let count: i64 = sqlx::query_scalar(AssertSqlSafe(text)).fetch_one(&mut **transaction).await?;
        if count > 0 {
            return Ok(true);
        }
    }
    Ok(false)
}
