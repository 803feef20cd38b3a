//! The board, and the charts of a run.

use axum::Json;
use axum::extract::State;
use axum::response::Response;
use ocb_service::chart::Chart;
use ocb_service::model::{Board, BoardRequest, ChartRequest};
use ocb_service::{board_csv, chart_csv, chart_parquet};

use crate::App;
use crate::download::download;
use crate::extract::{Path, Query};
use crate::guest::Guest;
use crate::problem::Result;
use crate::routes::records::PARQUET;

const CSV: &str = "text/csv; charset=utf-8";

/// Speed against accuracy over the finished runs that the service shows to everybody and the visitor's own.
#[utoipa::path(get, path = "/board", tag = "results",
    params(BoardRequest),
    responses(
        (status = 200, body = Board),
        (status = 400, description = "Unknown measure of accuracy"),
        (status = 422, description = "The precision is not valid"),
    ))]
pub(crate) async fn show_board(
    State(app): State<App>,
    Guest(guest): Guest,
    Query(request): Query<BoardRequest>,
) -> Result<Json<Board>> {
    Ok(Json(app.engine.board(&request, Some(&guest)).await?))
}

/// The rows of the board as CSV with a header line.
#[utoipa::path(get, path = "/board.csv", tag = "results",
    params(BoardRequest),
    responses(
        (status = 200, description = "One line per algorithm with its settings", body = String, content_type = "text/csv"),
        (status = 422, description = "The precision is not valid"),
    ))]
pub(crate) async fn show_board_csv(
    State(app): State<App>,
    Guest(guest): Guest,
    Query(request): Query<BoardRequest>,
) -> Result<Response> {
    let board = app.engine.board(&request, Some(&guest)).await?;
    Ok(download(CSV, "board.csv", board_csv(&board)?))
}

/// A chart of a run: its series with n and intervals.
#[utoipa::path(get, path = "/runs/{id}/chart", tag = "results",
    params(("id" = String, Path, description = "Run id"), ChartRequest),
    responses(
        (status = 200, body = Chart),
        (status = 400, description = "Unknown kind"),
        (status = 404, description = "No such run, or nothing to chart"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn show_chart(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
    Query(request): Query<ChartRequest>,
) -> Result<Json<Chart>> {
    Ok(Json(app.engine.chart(&id, request, Some(&guest)).await?))
}

/// The points of a chart as CSV with a header line.
#[utoipa::path(get, path = "/runs/{id}/chart.csv", tag = "results",
    params(("id" = String, Path, description = "Run id"), ChartRequest),
    responses(
        (status = 200, description = "One line per point", body = String, content_type = "text/csv"),
        (status = 404, description = "No such run, or nothing to chart"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn chart_as_csv(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
    Query(request): Query<ChartRequest>,
) -> Result<Response> {
    let chart = app.engine.chart(&id, request, Some(&guest)).await?;
    Ok(download(CSV, &format!("{id}-{}.csv", chart.kind), chart_csv(&chart)?))
}

/// The points of a chart as Parquet.
#[utoipa::path(get, path = "/runs/{id}/chart.parquet", tag = "results",
    params(("id" = String, Path, description = "Run id"), ChartRequest),
    responses(
        (status = 200, description = "One row per point", body = [u8], content_type = "application/vnd.apache.parquet"),
        (status = 404, description = "No such run, or nothing to chart"),
        (status = 422, description = "The selection is not valid or cannot be applied"),
    ))]
pub(crate) async fn chart_as_parquet(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
    Query(request): Query<ChartRequest>,
) -> Result<Response> {
    let chart = app.engine.chart(&id, request, Some(&guest)).await?;
    Ok(download(PARQUET, &format!("{id}-{}.parquet", chart.kind), chart_parquet(&chart)?))
}
