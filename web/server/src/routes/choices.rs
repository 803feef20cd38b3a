//! What an account chooses, and the address that its mails go to.

use axum::Json as Answer;
use axum::extract::State;
use ocb_service::model::{Choices, NewAddress, NewChoices, OpenedLink};

use crate::App;
use crate::address::Address;
use crate::extract::Json;
use crate::guest::Member;
use crate::limits::{CONFIRM, GIVE_ADDRESS, MAIL_TO};
use crate::problem::Result;

/// What the account has chosen, and where its mails go.
#[utoipa::path(get, path = "/account/choices", tag = "account",
    responses(
        (status = 200, body = Choices),
        (status = 401, description = "Not authenticated"),
    ))]
pub(crate) async fn show_choices(State(app): State<App>, Member(account): Member) -> Result<Answer<Choices>> {
    Ok(Answer(app.engine.choices(&account).await?))
}

/// Changes choices; what is absent stays as it is.
#[utoipa::path(put, path = "/account/choices", tag = "account", request_body = NewChoices,
    responses(
        (status = 200, description = "All current choices", body = Choices),
        (status = 401, description = "Not authenticated"),
    ))]
pub(crate) async fn choose(
    State(app): State<App>,
    Member(account): Member,
    Json(new): Json<NewChoices>,
) -> Result<Answer<Choices>> {
    Ok(Answer(app.engine.choose(&account, &new).await?))
}

/// Gives the account an address for its mails. A link goes there, and the address counts once it was opened; another address counts
/// no more. The answer is the same whoever else has this address.
#[utoipa::path(put, path = "/account/address", tag = "account", request_body = NewAddress,
    responses(
        (status = 200, description = "All current choices", body = Choices),
        (status = 401, description = "Not authenticated"),
        (status = 422, description = "Not an address"),
        (status = 429, description = "Too many attempts"),
    ))]
pub(crate) async fn give_address(
    State(app): State<App>,
    Address(from): Address,
    Member(account): Member,
    Json(asked): Json<NewAddress>,
) -> Result<Answer<Choices>> {
    app.count(GIVE_ADDRESS, &from).await?;
    app.count(GIVE_ADDRESS, &account.id).await?;
    // That others had mails sent there is not told: nobody learns by this who has an account.
    let asking = match app.count(MAIL_TO, asked.address.trim()).await {
        Err(refused) if refused.status != 429 => return Err(refused),
        asking => asking.is_ok(),
    };
    Ok(Answer(app.engine.set_address(&account, &asked.address, asking).await?))
}

/// Forgets the account's address, with all mails that wait to go there.
#[utoipa::path(delete, path = "/account/address", tag = "account",
    responses(
        (status = 200, description = "All current choices", body = Choices),
        (status = 401, description = "Not authenticated"),
    ))]
pub(crate) async fn forget_address(State(app): State<App>, Member(account): Member) -> Result<Answer<Choices>> {
    Ok(Answer(app.engine.forget_address(&account).await?))
}

/// Confirms the account's address by the secret of the link that went there.
#[utoipa::path(post, path = "/account/address/confirmation", tag = "account", request_body = OpenedLink,
    responses(
        (status = 200, description = "All current choices", body = Choices),
        (status = 401, description = "Not authenticated"),
        (status = 404, description = "The link is not valid for this account or has expired; the answer does not say which"),
        (status = 429, description = "Too many attempts"),
    ))]
pub(crate) async fn confirm_address(
    State(app): State<App>,
    Address(from): Address,
    Member(account): Member,
    Json(opened): Json<OpenedLink>,
) -> Result<Answer<Choices>> {
    app.count(CONFIRM, &from).await?;
    app.count(CONFIRM, &account.id).await?;
    Ok(Answer(app.engine.confirm_address(&account, &opened.secret).await?))
}
