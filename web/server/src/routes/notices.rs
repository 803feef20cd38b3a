//! What the service tells an account. Nobody else sees it, programs with tokens included.

use axum::Json as Answer;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::Response;
use ocb_service::model::{NoticeInfo, Page};

use crate::App;
use crate::extract::{Path, Query};
use crate::guest::Member;
use crate::list;
use crate::problem::Result;

/// What the account was told, newest first; the 500 newest are kept.
#[utoipa::path(get, path = "/notices", tag = "account", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<NoticeInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 401, description = "Not authenticated"),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_notices(
    State(app): State<App>,
    Member(account): Member,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/notices", &page, app.engine.notices(&account, &page).await?))
}

/// Marks a notice as read; the first time stands.
#[utoipa::path(post, path = "/notices/{id}/read", tag = "account",
    params(("id" = String, Path, description = "Notice id")),
    responses(
        (status = 200, description = "The updated notice", body = NoticeInfo),
        (status = 401, description = "Not authenticated"),
        (status = 404, description = "No such notice of this account"),
    ))]
pub(crate) async fn read_notice(
    State(app): State<App>,
    Member(account): Member,
    Path(id): Path<String>,
) -> Result<Answer<NoticeInfo>> {
    Ok(Answer(app.engine.read_notice(&account, &id).await?))
}

/// Takes a notice away, and the mail of it that has not gone yet.
#[utoipa::path(delete, path = "/notices/{id}", tag = "account",
    params(("id" = String, Path, description = "Notice id")),
    responses(
        (status = 204, description = "Deleted"),
        (status = 401, description = "Not authenticated"),
        (status = 404, description = "No such notice of this account"),
    ))]
pub(crate) async fn remove_notice(
    State(app): State<App>,
    Member(account): Member,
    Path(id): Path<String>,
) -> Result<StatusCode> {
    app.engine.remove_notice(&account, &id).await?;
    Ok(StatusCode::NO_CONTENT)
}
