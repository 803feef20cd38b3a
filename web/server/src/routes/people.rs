//! Accounts, as curators see them.

use axum::Json as Answer;
use axum::extract::State;
use ocb_engine::model::{AccountInfo, NewRole};

use crate::App;
use crate::extract::{Json, Path};
use crate::guest::Curator;
use crate::problem::{Problem, Result};

/// All accounts by name; those that want to be developers say why.
#[utoipa::path(get, path = "/accounts", tag = "curation",
    responses(
        (status = 200, body = Vec<AccountInfo>),
        (status = 401, description = "Nobody is logged in", body = Problem, content_type = "application/problem+json"),
        (status = 403, description = "No curator", body = Problem, content_type = "application/problem+json"),
    ))]
pub(crate) async fn list_accounts(State(app): State<App>, Curator(_): Curator) -> Result<Answer<Vec<AccountInfo>>> {
    Ok(Answer(app.engine.accounts().await?))
}

/// Gives an account a role. Curators decide about users and developers, administrators about all.
#[utoipa::path(post, path = "/accounts/{id}/role", tag = "curation", request_body = NewRole,
    params(("id" = String, Path, description = "Account id")),
    responses(
        (status = 200, description = "The account as it is now", body = AccountInfo),
        (status = 401, description = "Nobody is logged in", body = Problem, content_type = "application/problem+json"),
        (status = 403, description = "Not for this curator to decide", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "No such account", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "No role", body = Problem, content_type = "application/problem+json"),
    ))]
pub(crate) async fn change_role(
    State(app): State<App>,
    Curator(curator): Curator,
    Path(id): Path<String>,
    Json(asked): Json<NewRole>,
) -> Result<Answer<AccountInfo>> {
    Ok(Answer(app.engine.set_role(&curator, &id, asked.role).await?))
}
