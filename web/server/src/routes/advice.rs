//! Advice: how much of two objects a question needs.

use axum::Json as Answer;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use ocb_service::Visitor;
use ocb_service::model::{AdviceInfo, AdviceSpec, Side};
use serde::Deserialize;
use utoipa::IntoParams;

use crate::App;
use crate::address::Address;
use crate::download::download;
use crate::extract::{Json, Path, Query};
use crate::guest::Guest;
use crate::limits::ASK_ADVICE;
use crate::problem::Result;
use crate::request_key::{IdempotencyKey, RequestKey};

/// Asks for advice; it is worked on when its turn comes.
#[utoipa::path(post, path = "/advice", tag = "advice", request_body = AdviceSpec, params(IdempotencyKey),
    responses(
        (status = 200, description = "Already requested with this key", body = AdviceInfo),
        (status = 201, description = "Queued; its address is in `Location`", body = AdviceInfo),
        (status = 400, description = "Not JSON"),
        (status = 404, description = "No such object"),
        (status = 422, description = "The question is not valid"),
        (status = 429, description = "Too many requests are queued; `Retry-After` says when to try again"),
    ))]
pub(crate) async fn ask_advice(
    State(app): State<App>,
    Guest(guest): Guest,
    Address(address): Address,
    key: RequestKey,
    Json(spec): Json<AdviceSpec>,
) -> Result<Response> {
    app.count(ASK_ADVICE, &address).await?;
    let visitor = Visitor { owner: guest, address: Some(address) };
    let (info, new) = app.engine.ask_advice(spec, &visitor, key.as_deref()).await?;
    let location = format!("/api/v1/advice/{}", info.id);
    let status = if new { StatusCode::CREATED } else { StatusCode::OK };
    Ok((status, [(header::LOCATION, location)], Answer(info)).into_response())
}

/// How far it is, and the advice when it is done.
#[utoipa::path(get, path = "/advice/{id}", tag = "advice",
    params(("id" = String, Path, description = "Advice id")),
    responses(
        (status = 200, body = AdviceInfo),
        (status = 404, description = "No such advice"),
    ))]
pub(crate) async fn show_advice(State(app): State<App>, Path(id): Path<String>) -> Result<Answer<AdviceInfo>> {
    Ok(Answer(app.engine.advice(&id).await?))
}

/// Ends it; what has ended stays as it is.
#[utoipa::path(post, path = "/advice/{id}/cancel", tag = "advice",
    params(("id" = String, Path, description = "Advice id")),
    responses(
        (status = 200, description = "The updated advice", body = AdviceInfo),
        (status = 403, description = "It belongs to someone else"),
        (status = 404, description = "No such advice"),
    ))]
pub(crate) async fn cancel_advice(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Answer<AdviceInfo>> {
    Ok(Answer(app.engine.cancel_advice(&id, Some(&guest)).await?))
}

/// Which reduced object.
#[derive(Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(crate) struct OfObject {
    /// Of which object.
    side: Side,
    /// Which of its reduced objects, from 0: the coarsest first.
    #[serde(default)]
    stage: usize,
}

/// A reduced object as OBJ.
#[utoipa::path(get, path = "/advice/{id}/reduced.obj", tag = "advice",
    params(("id" = String, Path, description = "Advice id"), OfObject),
    responses(
        (status = 200, description = "The mesh", body = String, content_type = "model/obj"),
        (status = 404, description = "No such advice, or it reduces nothing there"),
    ))]
pub(crate) async fn reduced_obj(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<OfObject>,
) -> Result<Response> {
    let (bytes, file) = app.engine.reduced(&id, of.side, of.stage).await?;
    Ok(download("model/obj", &file, bytes))
}

/// The certificate of a reduced object; `ocb advise --verify` checks it beside the OBJ file.
#[utoipa::path(get, path = "/advice/{id}/certificate.json", tag = "advice",
    params(("id" = String, Path, description = "Advice id"), OfObject),
    responses(
        (status = 200, description = "Content hashes, thickness and deviation of every triangle", body = String, content_type = "application/json"),
        (status = 404, description = "No such advice, or it reduces nothing there"),
    ))]
pub(crate) async fn reduced_certificate(
    State(app): State<App>,
    Path(id): Path<String>,
    Query(of): Query<OfObject>,
) -> Result<Response> {
    let (bytes, file) = app.engine.certificate(&id, of.side, of.stage).await?;
    Ok(download("application/json", &file, bytes))
}
