//! The public benchmark: what every public plugin is measured on.

use axum::Json;
use axum::extract::State;
use ocb_service::model::SuiteInfo;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::App;
use crate::extract::Query;
use crate::problem::Result;

/// Where it is measured.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct Where {
    /// The hardware class for which the progress is told; the usual one when absent.
    hardware_class: Option<String>,
}

/// The suite of this service, and how far each public algorithm has come with it on a hardware class.
#[utoipa::path(get, path = "/suite", tag = "results", params(Where),
    responses((status = 200, body = SuiteInfo), (status = 422, description = "No machine has this hardware class")))]
pub(crate) async fn show_suite(State(app): State<App>, Query(on): Query<Where>) -> Result<Json<SuiteInfo>> {
    Ok(Json(app.engine.suite(on.hardware_class.as_deref()).await?))
}
