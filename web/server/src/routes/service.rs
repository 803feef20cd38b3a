//! The service itself: how busy it is, and the description of this API.

use std::sync::LazyLock;

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use ocb_service::model::Status;

use crate::App;
use crate::problem::{Problem, Result};

/// How busy the service is.
#[utoipa::path(get, path = "/status", tag = "service", responses((status = 200, body = Status)))]
pub(crate) async fn show_status(State(app): State<App>) -> Result<Json<Status>> {
    Ok(Json(app.engine.status().await?))
}

/// This document.
#[utoipa::path(get, path = "/openapi.json", tag = "service",
    responses((status = 200, description = "OpenAPI 3.1", content_type = "application/json")))]
pub(crate) async fn show_document() -> Json<&'static utoipa::openapi::OpenApi> {
    static DOCUMENT: LazyLock<utoipa::openapi::OpenApi> = LazyLock::new(super::document);
    Json(&DOCUMENT)
}

/// Answers a method that a route does not have.
pub(crate) async fn wrong_method() -> Problem {
    let detail = "This route does not support this method; /api/v1/openapi.json lists the supported methods.";
    Problem::new(StatusCode::METHOD_NOT_ALLOWED, detail)
}
