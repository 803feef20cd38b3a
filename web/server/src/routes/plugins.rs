//! Plugins that developers bring: sending, looking, following their check, deciding.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::time::Duration;

use axum::Extension;
use axum::Json as Answer;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::sse::Event;
use axum::response::{IntoResponse, Response};
use futures::stream;
use ocb_service::model::{AccountInfo, Decision, Page, PluginInfo};
use ocb_service::{Engine, Made, sha256_hex};
use utoipa::ToSchema;

use crate::App;
use crate::address::Address;
use crate::events::{sse, stopped};
use crate::extract::{Json, Path, Query};
use crate::guest::{Curator, Member};
use crate::limits::SUBMIT;
use crate::list;
use crate::problem::Result;
use crate::request_key::{IdempotencyKey, RequestKey};
use crate::upload::PluginUpload;

/// How often a report under way is looked at.
const LOOK: Duration = Duration::from_millis(300);

/// Whoever is logged in, if anybody is.
type Viewer = Option<Extension<Member>>;

fn account(viewer: &Viewer) -> Option<&AccountInfo> {
    viewer.as_ref().map(|Extension(Member(account))| account)
}

/// The public plugins and those of the visitor, newest first; each one's report and history stand on its own page.
#[utoipa::path(get, path = "/plugins", tag = "plugins", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<PluginInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
    ))]
pub(crate) async fn list_plugins(State(app): State<App>, viewer: Viewer, Query(page): Query<Page>) -> Result<Response> {
    Ok(list::answer("/api/v1/plugins", &page, app.engine.plugins(account(&viewer), &page).await?))
}

/// The form of a submitted plugin.
#[derive(ToSchema)]
#[expect(dead_code, reason = "only described; the form is read as a stream")]
struct PluginForm {
    /// A `Manifest` as JSON; it comes before the file.
    manifest: String,
    /// The content of a `.minisig` file, by the key that the account has registered; it comes before the file, too.
    signature: Option<String>,
    /// A shared library of at most 64 MiB.
    #[schema(value_type = String, format = Binary)]
    file: Vec<u8>,
}

/// Sends a plugin, which is then checked. The same bytes twice are one.
#[utoipa::path(post, path = "/plugins", tag = "plugins",
    request_body(content = inline(PluginForm), content_type = "multipart/form-data"), params(IdempotencyKey),
    responses(
        (status = 201, description = "Stored; its check is queued", body = PluginInfo),
        (status = 200, description = "Already submitted", body = PluginInfo),
        (status = 400, description = "The form is not valid"),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a developer"),
        (status = 409, description = "Too many plugins are waiting, or the quota is used up"),
        (status = 413, description = "Too large"),
        (status = 422, description = "No plugin, no manifest, or a signature that does not match"),
        (status = 429, description = "Too many uploads"),
    ))]
pub(crate) async fn submit_plugin(
    State(app): State<App>,
    Member(account): Member,
    Address(address): Address,
    key: RequestKey,
    request: axum::extract::Request,
) -> Result<Response> {
    app.count(SUBMIT, &account.name).await?;
    // Before anything is read: who may not submit need not send 64 MiB to hear it.
    app.engine.may_submit(&account)?;
    let PluginUpload { name, file, manifest, signature } = {
        let _coming = app.uploads.begin(&address)?;
        PluginUpload::read(request, &app, &address).await?
    };
    let _turn = app.uploads.take(&file).await?;
    let bytes = file.read().await?;
    let asked = (sha256_hex(&bytes), &manifest, &signature);
    app.engine.id_of_request(&account.owner(), Made::Plugin, key.as_deref(), &asked).await?;
    let _alone = app.submitting.lock().await;
    let (plugin, new) = app.engine.submit_plugin(&account, &name, bytes, manifest, signature.as_deref()).await?;
    let status = if new { StatusCode::CREATED } else { StatusCode::OK };
    let location = format!("/api/v1/plugins/{}", plugin.id);
    Ok((status, [(header::LOCATION, location)], Answer(plugin)).into_response())
}

/// One plugin with its report and its history. One that was never public is shown to its author and to curators; to others
/// it is not there.
#[utoipa::path(get, path = "/plugins/{id}", tag = "plugins",
    params(("id" = String, Path, description = "Plugin id")),
    responses(
        (status = 200, body = PluginInfo),
        (status = 404, description = "No such plugin"),
    ))]
pub(crate) async fn show_plugin(
    State(app): State<App>,
    viewer: Viewer,
    Path(id): Path<String>,
) -> Result<Answer<PluginInfo>> {
    Ok(Answer(app.engine.plugin(&id, account(&viewer)).await?))
}

/// The plugin after every line of its report, as server-sent events; ends with the check.
#[utoipa::path(get, path = "/plugins/{id}/events", tag = "plugins",
    params(("id" = String, Path, description = "Plugin id")),
    responses(
        (status = 200, description = "The events", body = PluginInfo, content_type = "text/event-stream"),
        (status = 204, description = "The check has ended"),
        (status = 404, description = "No such plugin"),
    ))]
pub(crate) async fn follow_plugin(State(app): State<App>, viewer: Viewer, Path(id): Path<String>) -> Result<Response> {
    let viewer = account(&viewer).cloned();
    let first = app.engine.plugin(&id, viewer.as_ref()).await?;
    if !first.state.is_checking() {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    let follower = Follower { engine: app.engine.clone(), viewer, id, told: None, ready: VecDeque::from([first]) };
    let events = stream::unfold(follower, async |mut follower| Some((follower.next().await?, follower)));
    let events = futures::StreamExt::take_until(events, stopped(app.stopping.clone()));
    Ok(sse(futures::StreamExt::map(events, Ok::<_, Infallible>)).into_response())
}

struct Follower {
    engine: Engine,
    viewer: Option<AccountInfo>,
    id: String,
    /// Lines and state that were told last.
    told: Option<PluginInfo>,
    ready: VecDeque<PluginInfo>,
}

impl Follower {
    async fn next(&mut self) -> Option<Event> {
        while self.ready.is_empty() {
            if self.told.as_ref().is_some_and(|told| !told.state.is_checking()) {
                return None;
            }
            tokio::time::sleep(LOOK).await;
            // Who may not see it any more hears nothing more.
            let now = self.engine.plugin(&self.id, self.viewer.as_ref()).await.ok()?;
            if self.told.as_ref().is_none_or(|told| told.lines.len() != now.lines.len() || told.state != now.state) {
                self.ready.push_back(now);
            }
        }
        let info = self.ready.pop_front()?;
        let event = Event::default().id(info.lines.len().to_string()).json_data(&info).ok()?;
        self.told = Some(info);
        Some(event)
    }
}

/// Takes a step on a plugin's way. The author offers, answers and withdraws; curators decide, but not about their own; either
/// ends its check.
#[utoipa::path(post, path = "/plugins/{id}/decisions", tag = "plugins", request_body = Decision,
    params(("id" = String, Path, description = "Plugin id")),
    responses(
        (status = 200, description = "The updated plugin", body = PluginInfo),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not permitted for this account"),
        (status = 404, description = "No such plugin"),
        (status = 409, description = "Not possible in the plugin's current state"),
        (status = 422, description = "Unknown action, or no reason"),
    ))]
pub(crate) async fn decide(
    State(app): State<App>,
    Member(account): Member,
    Path(id): Path<String>,
    Json(decision): Json<Decision>,
) -> Result<Answer<PluginInfo>> {
    Ok(Answer(app.engine.decide(&id, &account, decision).await?))
}

/// Everything that waits for a curator, oldest first.
#[utoipa::path(get, path = "/curation", tag = "curation", params(Page),
    responses(
        (status = 200, description = "A page of the list", body = Vec<PluginInfo>, headers(("Link" = String, description = "The next page: `<...>; rel=\"next\"`; absent on the last page"))),
        (status = 422, description = "Invalid page parameters"),
        (status = 401, description = "Not authenticated"),
        (status = 403, description = "Not a curator"),
    ))]
pub(crate) async fn list_curation(
    State(app): State<App>,
    Curator(curator): Curator,
    Query(page): Query<Page>,
) -> Result<Response> {
    Ok(list::answer("/api/v1/curation", &page, app.engine.curation(&curator, &page).await?))
}
