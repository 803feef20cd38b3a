//! Campaigns: curators have stored benchmarks measured again, everybody looks at old and new.

use axum::Json as Answer;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use ocb_service::model::{CampaignInfo, CampaignPreview, CampaignRequest, Page};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::App;
use crate::extract::{Json, Path, Query};
use crate::guest::{Curator, Guest};
use crate::list;
use crate::problem::Result;
use crate::request_key::{IdempotencyKey, RequestKey};

/// What a campaign is to measure.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct What {
    /// The suite.
    #[serde(default = "yes")]
    #[param(default = true)]
    suite: bool,
    /// Public runs whose accounts agree.
    #[serde(default = "yes")]
    #[param(default = true)]
    people: bool,
    /// The hardware class that it would measure on; the usual one when absent.
    hardware_class: Option<String>,
}

fn yes() -> bool {
    true
}

/// How many runs a campaign would queue now, and how long they take. Nothing is queued.
#[utoipa::path(get, path = "/campaigns/preview", tag = "curation", params(What),
    responses(
        (status = 200, body = CampaignPreview, example = json!({ "suite_runs": 150, "suite_repeats": 144, "peoples_runs": 12, "expected_seconds": 5400.0, "hardware_class": "0d52c1f3b7a96e48", "oracle": 5, "suite_version": 1 })),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
        (status = 422, description = "No machine has this hardware class"),
    ))]
pub(crate) async fn preview_campaign(
    State(app): State<App>,
    Curator(_): Curator,
    Query(what): Query<What>,
) -> Result<Answer<CampaignPreview>> {
    Ok(Answer(app.engine.preview_campaign(what.suite, what.people, what.hardware_class.as_deref()).await?))
}

/// Has stored benchmarks measured again on a hardware class, by this suite and oracle, after whatever anybody waits for. With an
/// `Idempotency-Key` the same request, sent again because its answer was lost, gives the same campaign.
#[utoipa::path(post, path = "/campaigns", tag = "curation", params(IdempotencyKey), request_body = CampaignRequest,
    responses(
        (status = 200, description = "Already requested with this key", body = CampaignInfo),
        (status = 201, description = "Queued; its address is in `Location`", body = CampaignInfo),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
        (status = 409, description = "There is nothing to measure again"),
        (status = 422, description = "No reason, neither suite nor people, or no machine has this hardware class"),
    ))]
pub(crate) async fn create_campaign(
    State(app): State<App>,
    Curator(curator): Curator,
    key: RequestKey,
    Json(asked): Json<CampaignRequest>,
) -> Result<Response> {
    let (campaign, new) = app.engine.create_campaign(Some(&curator), asked, key.as_deref()).await?;
    let location = format!("/api/v1/campaigns/{}", campaign.id);
    let status = if new { StatusCode::CREATED } else { StatusCode::OK };
    Ok((status, [(header::LOCATION, location)], Answer(campaign)).into_response())
}

/// Campaigns, newest first, without their results.
#[utoipa::path(get, path = "/campaigns", tag = "results", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<CampaignInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_campaigns(State(app): State<App>, Query(page): Query<Page>) -> Result<Response> {
    Ok(list::answer("/api/v1/campaigns", &page, app.engine.campaigns(&page).await?))
}

/// One campaign: how far it is, with old and new results side by side.
#[utoipa::path(get, path = "/campaigns/{id}", tag = "results",
    params(("id" = String, Path, description = "Campaign id")),
    responses(
        (status = 200, body = CampaignInfo),
        (status = 404, description = "No such campaign"),
    ))]
pub(crate) async fn show_campaign(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Answer<CampaignInfo>> {
    Ok(Answer(app.engine.campaign(&id, Some(&guest)).await?))
}

/// Ends what waits of a campaign; the run at work comes to its end, and one that has ended stays as it is.
#[utoipa::path(post, path = "/campaigns/{id}/cancel", tag = "curation",
    params(("id" = String, Path, description = "Campaign id")),
    responses(
        (status = 200, description = "The updated campaign", body = CampaignInfo),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
        (status = 404, description = "No such campaign"),
    ))]
pub(crate) async fn cancel_campaign(
    State(app): State<App>,
    Curator(curator): Curator,
    Path(id): Path<String>,
) -> Result<Answer<CampaignInfo>> {
    Ok(Answer(app.engine.cancel_campaign(Some(&curator), &id).await?))
}
