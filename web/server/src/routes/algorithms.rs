//! What the plugins offer.

use axum::Json;
use axum::extract::State;
use ocb_service::model::AlgorithmInfo;

use crate::App;
use crate::guest::Guest;

/// The installed and the public algorithms, and the visitor's own.
#[utoipa::path(get, path = "/algorithms", tag = "algorithms", responses((status = 200, body = Vec<AlgorithmInfo>)))]
pub(crate) async fn list_algorithms(State(app): State<App>, Guest(guest): Guest) -> Json<Vec<AlgorithmInfo>> {
    Json(app.engine.algorithms(Some(&guest)))
}
