//! Stable links, and how they are cited.

use axum::extract::State;
use axum::http::HeaderMap;
use axum::{Extension, Json};
use ocb_service::model::Citation;

use crate::App;
use crate::extract::Path;
use crate::guest::Member;
use crate::origin::own_origin;
use crate::problem::Result;

/// The stable link of a run that has ended, and how it is cited: BibTeX and CFF.
#[utoipa::path(get, path = "/runs/{id}/citation", tag = "results",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, body = Citation),
        (status = 404, description = "No such run, or nothing measured"),
        (status = 409, description = "The run has not ended"),
    ))]
pub(crate) async fn cite_run(
    State(app): State<App>,
    headers: HeaderMap,
    Path(id): Path<String>,
) -> Result<Json<Citation>> {
    Ok(Json(app.engine.cite_run(&id, &own_origin(&headers)?).await?))
}

/// The stable link of a plugin, and how it is cited: BibTeX and CFF.
#[utoipa::path(get, path = "/plugins/{id}/citation", tag = "plugins",
    params(("id" = String, Path, description = "Plugin id")),
    responses(
        (status = 200, body = Citation),
        (status = 404, description = "No such plugin"),
    ))]
pub(crate) async fn cite_plugin(
    State(app): State<App>,
    viewer: Option<Extension<Member>>,
    headers: HeaderMap,
    Path(id): Path<String>,
) -> Result<Json<Citation>> {
    let viewer = viewer.as_ref().map(|Extension(Member(account))| account);
    Ok(Json(app.engine.cite_plugin(&id, viewer, &own_origin(&headers)?).await?))
}
