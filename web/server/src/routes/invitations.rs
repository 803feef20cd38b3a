//! Invitations to be a developer: curators make and withdraw them, whoever has the link accepts.

use axum::Json as Answer;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use ocb_service::model::{Acceptance, AccountInfo, InvitationInfo, InvitationRequest, NewInvitation, Page};

use crate::App;
use crate::address::Address;
use crate::extract::{Json, Path, Query};
use crate::guest::{Curator, Member};
use crate::limits::ACCEPT;
use crate::list;
use crate::origin::own_origin;
use crate::problem::Result;
use crate::request_key::{IdempotencyKey, RequestKey};

/// Invites somebody to be a developer. The link is in this answer and nowhere else; whoever has it may accept, once. Asked again
/// under the same `Idempotency-Key`, it is the same invitation with another link.
#[utoipa::path(post, path = "/invitations", tag = "curation",
    params(IdempotencyKey), request_body(content = InvitationRequest, example = json!({ "recipient": "Ada, of the GJK paper", "days": 14 })),
    responses(
        (status = 201, body = NewInvitation),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
        (status = 409, description = "Too many invitations are open"),
        (status = 422, description = "No recipient, or valid for too long"),
    ))]
pub(crate) async fn invite(
    State(app): State<App>,
    Curator(curator): Curator,
    headers: HeaderMap,
    key: RequestKey,
    Json(asked): Json<InvitationRequest>,
) -> Result<Response> {
    let made = app.engine.invite(Some(&curator), asked, &own_origin(&headers)?, key.as_deref()).await?;
    Ok((StatusCode::CREATED, Answer(made)).into_response())
}

/// Invitations, newest first, without their secrets.
#[utoipa::path(get, path = "/invitations", tag = "curation", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<InvitationInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_invitations(
    State(app): State<App>,
    Curator(_): Curator,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/invitations", &page, app.engine.invitations(&page).await?))
}

/// Withdraws an invitation that nobody has accepted.
#[utoipa::path(delete, path = "/invitations/{id}", tag = "curation",
    params(("id" = String, Path, description = "Invitation id")),
    responses(
        (status = 200, description = "The updated invitation", body = InvitationInfo),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
        (status = 404, description = "No such invitation"),
        (status = 409, description = "Already accepted or withdrawn"),
    ))]
pub(crate) async fn revoke_invitation(
    State(app): State<App>,
    Curator(curator): Curator,
    Path(id): Path<String>,
) -> Result<Answer<InvitationInfo>> {
    Ok(Answer(app.engine.revoke_invitation(Some(&curator), &id).await?))
}

/// Accepts an invitation for the account that is logged in, which is a developer from then on.
#[utoipa::path(post, path = "/account/invitation", tag = "account", request_body = Acceptance,
    responses(
        (status = 200, description = "The updated account", body = AccountInfo),
        (status = 401, description = "Not authenticated"),
        (status = 404, description = "The invitation does not exist or has expired; the answer does not say which"),
        (status = 409, description = "Already a developer"),
        (status = 429, description = "Too many attempts"),
    ))]
pub(crate) async fn accept_invitation(
    State(app): State<App>,
    Address(address): Address,
    Member(account): Member,
    Json(asked): Json<Acceptance>,
) -> Result<Answer<AccountInfo>> {
    app.count(ACCEPT, &address).await?;
    Ok(Answer(app.engine.accept_invitation(&account, &asked.secret).await?))
}
