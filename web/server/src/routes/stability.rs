//! Where methods fail.

use axum::Json;
use axum::extract::State;
use ocb_service::model::StabilityTable;

use crate::App;
use crate::problem::Result;

/// Families, relations and reported failures, with the newest result of every method that was tried.
#[utoipa::path(get, path = "/stability", tag = "results", responses((status = 200, body = StabilityTable)))]
pub(crate) async fn show_stability(State(app): State<App>) -> Result<Json<StabilityTable>> {
    Ok(Json(app.engine.stability().await?))
}
