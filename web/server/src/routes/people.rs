//! Accounts, as curators see them.

use axum::Json as Answer;
use axum::extract::State;
use axum::response::Response;
use ocb_service::model::{AccountInfo, NewRole, Page};

use crate::App;
use crate::extract::{Json, Path, Query};
use crate::guest::Curator;
use crate::list;
use crate::problem::Result;

/// Accounts, newest first; those that want to be developers say why.
#[utoipa::path(get, path = "/accounts", tag = "curation", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<AccountInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
    ))]
pub(crate) async fn list_accounts(
    State(app): State<App>,
    Curator(_): Curator,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/accounts", &page, app.engine.accounts(&page).await?))
}

/// Gives an account a role. Curators decide about users and developers, administrators about all.
#[utoipa::path(post, path = "/accounts/{id}/role", tag = "curation", request_body = NewRole,
    params(("id" = String, Path, description = "Account id")),
    responses(
        (status = 200, description = "The updated account", body = AccountInfo),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not permitted for this curator"),
        (status = 404, description = "No such account"),
        (status = 422, description = "Not a role"),
    ))]
pub(crate) async fn change_role(
    State(app): State<App>,
    Curator(curator): Curator,
    Path(id): Path<String>,
    Json(asked): Json<NewRole>,
) -> Result<Answer<AccountInfo>> {
    Ok(Answer(app.engine.set_role(&curator, &id, asked.role).await?))
}
