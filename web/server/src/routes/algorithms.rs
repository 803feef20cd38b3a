//! What the plugins offer.

use axum::Json;
use axum::extract::State;
use ocb_engine::model::AlgorithmInfo;

use crate::App;

/// All algorithms.
#[utoipa::path(get, path = "/algorithms", tag = "algorithms", responses((status = 200, body = Vec<AlgorithmInfo>)))]
pub(crate) async fn list_algorithms(State(app): State<App>) -> Json<Vec<AlgorithmInfo>> {
    Json(app.engine.algorithms())
}
