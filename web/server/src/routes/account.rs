//! One's own account: making, entering, leaving and deleting it; tokens for programs.

use axum::Json as Answer;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{AppendHeaders, IntoResponse, Response};
use axum_extra::extract::CookieJar;
use ocb_service::model::{
    AccountInfo, Credentials, DeleteAccount, DeletionPreview, DeveloperRequest, Identity, NewPassword, NewToken, Role,
    SigningKey, TokenInfo, TokenRequest,
};

use crate::App;
use crate::address::Address;
use crate::extract::{Json, Path};
use crate::guest::{Browser, Member, SESSION, cookie, is_secure};
use crate::limits::{CHANGE_PASSWORD, LOG_IN, LOG_IN_ANYWHERE, LOG_IN_AS, MAKE_ACCOUNT};
use crate::problem::Result;
use crate::request_key::{IdempotencyKey, RequestKey};

/// Who is logged in; a guest has no account.
#[utoipa::path(get, path = "/account", tag = "account", responses((status = 200, body = Identity)))]
pub(crate) async fn show_account(member: Option<axum::Extension<Member>>) -> Answer<Identity> {
    Answer(Identity { account: member.map(|member| member.0.0) })
}

/// Makes an account and enters it. A name that is taken gets 409: names stand beside plugins, so they are no secret.
#[utoipa::path(post, path = "/account", tag = "account", request_body = Credentials,
    responses(
        (status = 201, description = "Created and logged in", body = Identity),
        (status = 409, description = "The name is taken"),
        (status = 422, description = "No name or no password"),
        (status = 429, description = "Too many accounts"),
    ))]
pub(crate) async fn make_account(
    State(app): State<App>,
    Address(address): Address,
    Browser(guest): Browser,
    headers: HeaderMap,
    Json(asked): Json<Credentials>,
) -> Result<Response> {
    app.count(MAKE_ACCOUNT, &address).await?;
    let account = app.engine.add_account(&asked.name, &asked.password, Role::User).await?;
    let entered = enter(&app, &guest, &headers, account, asked.keep).await?;
    Ok((StatusCode::CREATED, entered).into_response())
}

/// Enters an account. A wrong name and a wrong password get the same answer, in the same time.
#[utoipa::path(post, path = "/account/login", tag = "account", request_body = Credentials,
    responses(
        (status = 200, description = "Logged in", body = Identity),
        (status = 403, description = "Wrong user name or password"),
        (status = 422, description = "A field is missing"),
        (status = 429, description = "Too many attempts"),
    ))]
pub(crate) async fn log_in(
    State(app): State<App>,
    Address(address): Address,
    Browser(guest): Browser,
    headers: HeaderMap,
    Json(asked): Json<Credentials>,
) -> Result<Response> {
    app.count(LOG_IN, &address).await?;
    let name = asked.name.trim();
    app.count(LOG_IN_AS, &format!("{address} {name}")).await?;
    if !app.engine.knows_device(name, &guest).await? {
        app.count(LOG_IN_ANYWHERE, name).await?;
    }
    let account = app.engine.account_with(name, &asked.password).await?;
    enter(&app, &guest, &headers, account, asked.keep).await
}

async fn enter(app: &App, guest: &str, headers: &HeaderMap, account: AccountInfo, keep: bool) -> Result<Response> {
    if keep {
        app.engine.keep_things(guest, &account).await?;
    }
    app.engine.remember_device(&account, guest).await?;
    let secret = app.engine.add_session(&account).await?;
    let session = cookie(SESSION, &secret, ocb_service::SESSION.as_secs(), is_secure(headers));
    let identity = Identity { account: Some(account) };
    Ok((AppendHeaders([(header::SET_COOKIE, session)]), Answer(identity)).into_response())
}

/// Leaves the account in this browser.
#[utoipa::path(post, path = "/account/logout", tag = "account", responses((status = 204, description = "Logged out")))]
pub(crate) async fn log_out(State(app): State<App>, headers: HeaderMap) -> Result<Response> {
    if let Some(session) = CookieJar::from_headers(&headers).get(SESSION) {
        app.engine.end_session(session.value()).await?;
    }
    Ok(left(&headers))
}

/// Leaves the account in every browser; tokens stay.
#[utoipa::path(post, path = "/account/logout-everywhere", tag = "account",
    responses(
        (status = 204, description = "Logged out everywhere"),
        (status = 401, description = "Not authenticated"),
    ))]
pub(crate) async fn log_out_everywhere(
    State(app): State<App>,
    Member(account): Member,
    headers: HeaderMap,
) -> Result<Response> {
    app.engine.end_sessions(&account).await?;
    Ok(left(&headers))
}

fn left(headers: &HeaderMap) -> Response {
    let gone = cookie(SESSION, "", 0, is_secure(headers));
    (StatusCode::NO_CONTENT, AppendHeaders([(header::SET_COOKIE, gone)])).into_response()
}

/// Changes the password and leaves the account in every browser.
#[utoipa::path(post, path = "/account/password", tag = "account", request_body = NewPassword,
    responses(
        (status = 204, description = "Changed; log in again"),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "The old password is wrong"),
        (status = 422, description = "The new password is too short"),
    ))]
pub(crate) async fn change_password(
    State(app): State<App>,
    Member(account): Member,
    headers: HeaderMap,
    Json(asked): Json<NewPassword>,
) -> Result<Response> {
    app.count(CHANGE_PASSWORD, &account.name).await?;
    app.engine.change_password(&account, &asked.old, &asked.new).await?;
    Ok(left(&headers))
}

/// What would go with the account and what would stay, and why it cannot be deleted, if so.
#[utoipa::path(get, path = "/account/deletion-preview", tag = "account",
    responses(
        (status = 200, body = DeletionPreview),
        (status = 401, description = "Not authenticated"),
    ))]
pub(crate) async fn show_deletion_preview(
    State(app): State<App>,
    Member(account): Member,
) -> Result<Answer<DeletionPreview>> {
    Ok(Answer(app.engine.deletion_preview(&account).await?))
}

/// Deletes the account for good: how it is entered, what it was told and has chosen, its tokens, and whatever of its things is
/// not public. What is public stays, because it is cited, and belongs to a former account without a name. Nobody gets the name
/// again. `GET /data.tar` takes everything along first.
#[utoipa::path(delete, path = "/account", tag = "account", request_body = DeleteAccount,
    responses(
        (status = 200, description = "What was deleted and what stays; all sessions are closed", body = DeletionPreview),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Wrong password"),
        (status = 409, description = "The account is the last curator or administrator, or a run is just ending"),
        (status = 422, description = "No password"),
        (status = 429, description = "Too many attempts"),
    ))]
pub(crate) async fn delete_account(
    State(app): State<App>,
    Member(account): Member,
    headers: HeaderMap,
    Json(asked): Json<DeleteAccount>,
) -> Result<Response> {
    app.count(LOG_IN, &account.name).await?;
    let told = app.engine.delete_account(&account, &asked.password).await?;
    let gone = cookie(SESSION, "", 0, is_secure(&headers));
    Ok((AppendHeaders([(header::SET_COOKIE, gone)]), Answer(told)).into_response())
}

/// Asks the curators to be made a developer, who submits plugins.
#[utoipa::path(post, path = "/account/developer", tag = "account", request_body = DeveloperRequest,
    responses(
        (status = 204, description = "Requested"),
        (status = 401, description = "Not authenticated"),
        (status = 409, description = "Already a developer"),
        (status = 422, description = "No reason given"),
    ))]
pub(crate) async fn ask_to_develop(
    State(app): State<App>,
    Member(account): Member,
    Json(request): Json<DeveloperRequest>,
) -> Result<StatusCode> {
    app.engine.request_developer_role(&account, &request.reason).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Registers the key that plugins of this account are signed with, in the place of an earlier one.
#[utoipa::path(post, path = "/account/signing-key", tag = "account", request_body = SigningKey,
    responses(
        (status = 200, description = "The updated account", body = AccountInfo),
        (status = 401, description = "Not authenticated"),
        (status = 422, description = "Not a minisign public key"),
    ))]
pub(crate) async fn register_key(
    State(app): State<App>,
    Member(account): Member,
    Json(asked): Json<SigningKey>,
) -> Result<Answer<AccountInfo>> {
    Ok(Answer(app.engine.set_signing_key(&account, Some(&asked.public_key)).await?))
}

/// Forgets the key; plugins that were signed with it stay signed.
#[utoipa::path(delete, path = "/account/signing-key", tag = "account",
    responses(
        (status = 204, description = "The key was removed"),
        (status = 401, description = "Not authenticated"),
    ))]
pub(crate) async fn forget_key(State(app): State<App>, Member(account): Member) -> Result<StatusCode> {
    app.engine.set_signing_key(&account, None).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Tokens for programs, without their secrets.
#[utoipa::path(get, path = "/account/tokens", tag = "account",
    responses(
        (status = 200, body = Vec<TokenInfo>),
        (status = 401, description = "Not authenticated"),
    ))]
pub(crate) async fn list_tokens(State(app): State<App>, Member(account): Member) -> Result<Answer<Vec<TokenInfo>>> {
    Ok(Answer(app.engine.tokens(&account).await?))
}

/// Makes a token; its secret is in this answer and nowhere else. Asked again under the same `Idempotency-Key`, it is the same token
/// with another secret.
#[utoipa::path(post, path = "/account/tokens", tag = "account", request_body = TokenRequest, params(IdempotencyKey),
    responses(
        (status = 201, body = NewToken),
        (status = 401, description = "Not authenticated"),
        (status = 409, description = "Too many tokens"),
        (status = 422, description = "No name or no scope"),
    ))]
pub(crate) async fn make_token(
    State(app): State<App>,
    Member(account): Member,
    key: RequestKey,
    Json(asked): Json<TokenRequest>,
) -> Result<Response> {
    Ok((StatusCode::CREATED, Answer(app.engine.add_token(&account, asked, key.as_deref()).await?)).into_response())
}

/// Ends a token.
#[utoipa::path(delete, path = "/account/tokens/{id}", tag = "account",
    params(("id" = String, Path, description = "Token id")),
    responses(
        (status = 204, description = "The token was revoked"),
        (status = 401, description = "Not authenticated"),
        (status = 404, description = "No such token"),
    ))]
pub(crate) async fn end_token(
    State(app): State<App>,
    Member(account): Member,
    Path(id): Path<String>,
) -> Result<StatusCode> {
    app.engine.end_token(&account, &id).await?;
    Ok(StatusCode::NO_CONTENT)
}
