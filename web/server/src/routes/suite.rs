//! The public benchmark: what every public plugin is measured on.

use axum::Json;
use axum::extract::State;
use ocb_service::model::SuiteInfo;

use crate::App;
use crate::problem::Result;

/// The suite of this service, and how far each public algorithm has come with it on this machine.
#[utoipa::path(get, path = "/suite", tag = "results", responses((status = 200, body = SuiteInfo)))]
pub(crate) async fn show_suite(State(app): State<App>) -> Result<Json<SuiteInfo>> {
    Ok(Json(app.engine.suite().await?))
}
