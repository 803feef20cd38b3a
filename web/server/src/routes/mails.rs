//! Turning mails off by the link that stands in each of them.

use axum::extract::State;
use axum::http::StatusCode;
use ocb_service::EngineError;

use crate::App;
use crate::address::Address;
use crate::extract::Path;
use crate::limits::TURN_OFF;
use crate::problem::Result;

/// Turns off the mails of the account that a mail with this link went to, without logging in, and nothing else; doing it again changes
/// nothing. Mail programs send the same to the link itself, which `List-Unsubscribe` names (RFC 8058); what they send along is not
/// read. Whoever opens the link sees a page with a button.
#[utoipa::path(post, path = "/mails/off/{secret}", tag = "account",
    params(("secret" = String, Path, description = "The part of the link after the last `/`",
        example = "5d0c4b7e9f1a4c6e8b3d2f1a0c9e8d7b6a5f4e3d2c1b40a98f7e6d5c4b3a2918")),
    responses(
        (status = 204, description = "Mail is turned off"),
        (status = 404, description = "The link is not valid or has expired; the answer does not say which"),
        (status = 429, description = "Too many wrong links"),
    ))]
pub(crate) async fn turn_mails_off(
    State(app): State<App>,
    Address(from): Address,
    Path(secret): Path<String>,
) -> Result<StatusCode> {
    let done = app.engine.turn_mails_off(&secret).await;
    // Only wrong ones: the clicks of many people come from the few addresses of their mail programs.
    if matches!(done, Err(EngineError::NotFound(_))) {
        app.count(TURN_OFF, &from).await?;
    }
    done?;
    Ok(StatusCode::NO_CONTENT)
}
