//! `/internal/v1`, at an address of its own: what measuring machines ask and hand in. Each request carries the token of a machine,
//! which opens the attempt of that machine alone.

use std::time::Duration;

use axum::extract::{DefaultBodyLimit, FromRequestParts, Multipart, Path, State};
use axum::http::request::Parts;
use axum::http::{StatusCode, header};
use axum::routing::{get, post};
use axum::{Json, Router};
use ocb_service::Handing;
use ocb_service::model::{Beat, Ended, GoOn, MachineFacts, NextWork, Sentinel};
use ocb_service::worker::Seen;
use tokio::sync::Semaphore;

use crate::App;
use crate::problem::{Problem, Result};

/// How long a machine waits for work before it asks again.
const WAIT: Duration = Duration::from_secs(15);
/// Largest results of one run: those of all algorithms.
const MAX_RESULTS: usize = 1 << 30;
/// So many results are taken at a time; others wait.
static TAKING: Semaphore = Semaphore::const_new(2);
/// Largest preliminary result: the records of ten thousand configurations.
const MAX_SEEN: usize = 16 << 20;
/// Largest of the other requests.
const MAX_JSON: usize = 1 << 20;

/// The routes for machines.
pub(crate) fn router(app: App) -> Router {
    let large =
        Router::new().route("/internal/v1/attempts/{id}/end", post(end)).layer(DefaultBodyLimit::max(MAX_RESULTS));
    let shown =
        Router::new().route("/internal/v1/attempts/{id}/seen", post(seen)).layer(DefaultBodyLimit::max(MAX_SEEN));
    Router::new()
        .route("/internal/v1/attempts", post(begin))
        .route("/internal/v1/sentinel", post(sentinel))
        .route("/internal/v1/attempts/{id}/beat", post(beat))
        .route("/internal/v1/attempts/{id}/files/{name}", get(file))
        .layer(DefaultBodyLimit::max(MAX_JSON))
        .merge(large)
        .merge(shown)
        .with_state(app)
}

/// The machine whose token a request carries.
struct Machine(String);

impl FromRequestParts<App> for Machine {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, app: &App) -> Result<Self> {
        let given = parts.headers.get(header::AUTHORIZATION).and_then(|value| value.to_str().ok());
        let known = match given.and_then(|value| value.strip_prefix("Bearer ")) {
            Some(token) => app.engine.machine_of(token.trim()).await?,
            None => None,
        };
        let refused = "The token of this machine is not valid: it was revoked, or it is another service's. `ocb admin machine NAME` \
                       makes a new one.";
        known.map(Self).ok_or_else(|| Problem::new(StatusCode::UNAUTHORIZED, refused))
    }
}

/// What the machine has to do next.
async fn begin(
    State(app): State<App>,
    Machine(name): Machine,
    Json(facts): Json<MachineFacts>,
) -> Result<Json<NextWork>> {
    Ok(Json(app.engine.next_order(&name, &facts, WAIT).await?))
}

/// What the sentinel took.
async fn sentinel(
    State(app): State<App>,
    Machine(name): Machine,
    Json(sentinel): Json<Sentinel>,
) -> Result<StatusCode> {
    app.engine.sentinel_of(&name, sentinel).await?;
    Ok(StatusCode::NO_CONTENT)
}

async fn beat(
    State(app): State<App>,
    Machine(name): Machine,
    Path(attempt): Path<String>,
    Json(beat): Json<Beat>,
) -> Result<Json<GoOn>> {
    let current = app.engine.beat_of(&name, &attempt, beat.steps).await?;
    Ok(Json(GoOn { current }))
}

/// What an algorithm has found so far.
async fn seen(
    State(app): State<App>,
    Machine(name): Machine,
    Path(attempt): Path<String>,
    Json(seen): Json<Seen>,
) -> Result<Json<GoOn>> {
    let current = app.engine.seen_of(&name, &attempt, seen).await?;
    Ok(Json(GoOn { current }))
}

async fn file(
    State(app): State<App>,
    Machine(name): Machine,
    Path((attempt, file)): Path<(String, String)>,
) -> Result<Vec<u8>> {
    Ok(app.engine.file_of_order(&name, &attempt, &file).await?)
}

/// How an attempt ended: the part `ended`, then the files.
async fn end(
    State(app): State<App>,
    Machine(name): Machine,
    Path(attempt): Path<String>,
    mut form: Multipart,
) -> Result<Json<GoOn>> {
    if !app.engine.is_at_work(&name, &attempt).await? {
        return Ok(Json(GoOn { current: false }));
    }
    let _one = TAKING.acquire().await.map_err(Problem::fault)?;
    let bad = |e: &dyn std::fmt::Display| Problem::bad_request(format!("These results cannot be read: {e}."));
    let (mut ended, mut files): (Option<Ended>, _) = (None, Vec::new());
    while let Some(field) = form.next_field().await.map_err(|e| bad(&e))? {
        let is_file = field.name() == Some("file");
        let bytes = field.bytes().await.map_err(|e| bad(&e))?;
        match is_file {
            true => files.push(bytes.into()),
            false => ended = Some(serde_json::from_slice(&bytes).map_err(|e| bad(&e))?),
        }
    }
    let ended = ended.ok_or_else(|| bad(&"the part `ended` is missing"))?;
    // On a task of its own, so that it is done to its end when the machine hangs up.
    let taking = async move { app.engine.hand_in(&name, &attempt, Handing { ended, files }).await };
    let current = tokio::spawn(taking).await.map_err(Problem::fault)??;
    Ok(Json(GoOn { current }))
}
