//! Numbers and files of a run.

use axum::Json;
use axum::extract::State;
use axum::response::Response;
use ocb_service::model::Ecdf;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::App;
use crate::download::download;
use crate::extract::{Path, Query};
use crate::problem::Result;

/// Which algorithm of the run.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct OfAlgorithm {
    /// Algorithm id.
    pub(crate) algorithm: String,
}

/// Which records.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct OfSelection {
    /// Algorithm id.
    algorithm: String,
    /// Only the configurations of this selection, e.g. `time in [500us, 15ms] & near(vertex 8367, 0.05)`.
    #[serde(rename = "where")]
    #[param(rename = "where")]
    selection: Option<String>,
}

/// Empirical distribution of the time per query.
#[utoipa::path(get, path = "/runs/{id}/ecdf", tag = "results",
    params(("id" = String, Path, description = "Run id"), OfSelection),
    responses(
        (status = 200, body = Ecdf),
        (status = 404, description = "No such run, or no records of this algorithm"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn show_ecdf(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<OfSelection>,
) -> Result<Json<Ecdf>> {
    Ok(Json(app.engine.ecdf(&id, &of.algorithm, of.selection.as_deref()).await?))
}

/// The records of one algorithm as Parquet.
#[utoipa::path(get, path = "/runs/{id}/records.parquet", tag = "results",
    params(("id" = String, Path, description = "Run id"), OfSelection),
    responses(
        (status = 200, description = "One row per configuration", body = [u8], content_type = "application/vnd.apache.parquet"),
        (status = 404, description = "No such run, or no records of this algorithm"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn records_parquet(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<OfSelection>,
) -> Result<Response> {
    let bytes = match &of.selection {
        None => app.engine.records_parquet(&id, &of.algorithm).await?,
        Some(selection) => app.engine.selected_parquet(&id, &of.algorithm, selection).await?,
    };
    Ok(download(PARQUET, &format!("{id}-{}.parquet", of.algorithm), bytes))
}

/// In how many primitive tests of the counted queries each triangle took part, as Parquet.
#[utoipa::path(get, path = "/runs/{id}/triangles.parquet", tag = "results",
    params(("id" = String, Path, description = "Run id"), OfAlgorithm),
    responses(
        (status = 200, description = "One row per triangle of A, then of B", body = [u8], content_type = "application/vnd.apache.parquet"),
        (status = 404, description = "No such run, or no tests per triangle of this algorithm"),
    ))]
pub(crate) async fn triangle_tests_parquet(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<OfAlgorithm>,
) -> Result<Response> {
    let bytes = app.engine.triangle_tests_parquet(&id, &of.algorithm).await?;
    Ok(download(PARQUET, &format!("{id}-{}.triangles.parquet", of.algorithm), bytes))
}

/// The records of one algorithm as CSV with a header line.
#[utoipa::path(get, path = "/runs/{id}/records.csv", tag = "results",
    params(("id" = String, Path, description = "Run id"), OfSelection),
    responses(
        (status = 200, description = "One line per configuration", body = String, content_type = "text/csv"),
        (status = 404, description = "No such run, or no records of this algorithm"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn records_csv(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<OfSelection>,
) -> Result<Response> {
    let bytes = match &of.selection {
        None => app.engine.records_csv(&id, &of.algorithm).await?,
        Some(selection) => app.engine.selected_csv(&id, &of.algorithm, selection).await?,
    };
    Ok(download("text/csv; charset=utf-8", &format!("{id}-{}.csv", of.algorithm), bytes))
}

/// The run's configurations with their truth as Parquet; `ocb bench --configurations` reads it again.
#[utoipa::path(get, path = "/runs/{id}/configurations.parquet", tag = "results",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "One row per configuration", body = [u8], content_type = "application/vnd.apache.parquet"),
        (status = 404, description = "No such run, or no configurations yet"),
    ))]
pub(crate) async fn configurations_parquet(State(app): State<App>, Path(id): Path<String>) -> Result<Response> {
    let bytes = app.engine.configurations_parquet(&id).await?;
    Ok(download(PARQUET, &format!("{id}-configurations.parquet"), bytes))
}

/// The run with all that its answers follow from, as one file: `ocb replay` asks every question again. For a run that is not public a
/// token needs the scope for plugins.
#[utoipa::path(get, path = "/runs/{id}/repro.zip", tag = "results",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "recipe.json lists the files: configurations, answers, objects, and plugins under free licences", body = [u8], content_type = "application/zip"),
        (status = 404, description = "No such run, or no configurations"),
        (status = 409, description = "The run has not ended, or was measured by a version that is too old"),
        (status = 429, description = "Too many archives are being downloaded"),
    ))]
pub(crate) async fn repro_zip(State(app): State<App>, Path(id): Path<String>) -> Result<Response> {
    app.archives.send("application/zip", &format!("{id}-repro.zip"), app.engine.repro(&id)).await
}

pub(crate) const PARQUET: &str = "application/vnd.apache.parquet";
