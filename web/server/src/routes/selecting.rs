//! Selections of configurations, the worst of them, and the columns that pages select by.

use axum::Json;
use axum::extract::State;
use axum::response::Response;
use ocb_service::model::{Meeting, Selected, WorstCase, WorstRequest};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::App;
use crate::download::download;
use crate::extract::{Path, Query};
use crate::problem::Result;
use crate::routes::records::OfAlgorithm;

/// Which configurations.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct Where {
    /// Algorithm whose columns are meant where the selection names none.
    algorithm: String,
    /// The selection, e.g. `time in [500us, 15ms] & bv of parry in [1200, 35000] & near(vertex 8367, 0.05)`.
    #[serde(rename = "where")]
    #[param(rename = "where")]
    selection: String,
}

/// How many configurations a selection holds, and what they cost each algorithm.
#[utoipa::path(get, path = "/runs/{id}/selection", tag = "results",
    params(("id" = String, Path, description = "Run id"), Where),
    responses(
        (status = 200, body = Selected),
        (status = 404, description = "No such run, or no records of an algorithm"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn show_selection(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<Where>,
) -> Result<Json<Selected>> {
    Ok(Json(app.engine.selected(&id, &of.algorithm, &of.selection).await?))
}

/// Which configurations a selection holds, one value per configuration of the set, as an Arrow IPC stream.
#[utoipa::path(get, path = "/runs/{id}/selection.arrow", tag = "results",
    params(("id" = String, Path, description = "Run id"), Where),
    responses(
        (status = 200, description = "chosen: true or false", body = [u8], content_type = "application/vnd.apache.arrow.stream"),
        (status = 404, description = "No such run, or no records of an algorithm"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn selection_arrow(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<Where>,
) -> Result<Response> {
    let bytes = app.engine.selection_arrow(&id, &of.algorithm, &of.selection).await?;
    Ok(download(ARROW, &format!("{id}-selection.arrow"), bytes))
}

/// The worst configurations of an algorithm: wrong answers first, missed collisions before all.
#[utoipa::path(get, path = "/runs/{id}/worst", tag = "results",
    params(("id" = String, Path, description = "Run id"), WorstRequest),
    responses(
        (status = 200, body = Vec<WorstCase>),
        (status = 404, description = "No such run, or no records of this algorithm"),
        (status = 422, description = "No such list: errors of a run without distance queries, an invalid selection"),
    ))]
pub(crate) async fn list_worst(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(request): Query<WorstRequest>,
) -> Result<Json<Vec<WorstCase>>> {
    Ok(Json(app.engine.worst(&id, &request).await?))
}

/// In which numbers the objects are meant.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct Numbers {
    /// With their coordinates rounded to single precision, as algorithms that compute in it get them.
    #[serde(default)]
    rounded: bool,
}

/// All pairs of triangles that meet in one configuration, by the oracle.
#[utoipa::path(get, path = "/runs/{id}/configurations/{configuration}/contacts", tag = "results",
    params(
        ("id" = String, Path, description = "Run id"),
        ("configuration" = u32, Path, description = "Index in the set, from 0"),
        Numbers,
    ),
    responses(
        (status = 200, body = Meeting),
        (status = 404, description = "No such run or configuration"),
    ))]
pub(crate) async fn show_meeting(
    State(app): State<App>,
    Path((id, configuration)): Path<(String, u32)>,
    Query(of): Query<Numbers>,
) -> Result<Json<Meeting>> {
    Ok(Json(app.engine.meeting(&id, configuration, of.rounded).await?))
}

/// The columns of one algorithm that selections test by a range, one value per configuration of the set (NaN where there is
/// none), as an Arrow IPC stream. Columns that cannot be had are left out.
#[utoipa::path(get, path = "/runs/{id}/columns.arrow", tag = "results",
    params(("id" = String, Path, description = "Run id"), OfAlgorithm),
    responses(
        (status = 200, description = "The columns by their names in selections, each with the `axis` and `unit` that a chart shows", body = [u8], content_type = "application/vnd.apache.arrow.stream"),
        (status = 404, description = "No such run, or no records of this algorithm"),
    ))]
pub(crate) async fn columns_arrow(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<OfAlgorithm>,
) -> Result<Response> {
    let bytes = app.engine.columns_arrow(&id, &of.algorithm).await?;
    Ok(download(ARROW, &format!("{id}-{}.arrow", of.algorithm), bytes))
}

/// Where every configuration has its witness points, in the objects' own frames, the triangles that hold them, and the
/// certified distance, as an Arrow IPC stream.
#[utoipa::path(get, path = "/runs/{id}/witnesses.arrow", tag = "results",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "distance, triangle_a, triangle_b, a_x .. b_z", body = [u8], content_type = "application/vnd.apache.arrow.stream"),
        (status = 404, description = "No such run, or no configurations yet"),
    ))]
pub(crate) async fn witnesses_arrow(State(app): State<App>, Path(id): Path<String>) -> Result<Response> {
    let bytes = app.engine.witnesses_arrow(&id).await?;
    Ok(download(ARROW, &format!("{id}-witnesses.arrow"), bytes))
}

const ARROW: &str = "application/vnd.apache.arrow.stream";
