//! Progress as server-sent events.

use std::convert::Infallible;
use std::time::Duration;

use axum::extract::State;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures::{Stream, StreamExt};
use ocb_service::model::{RunEvent, State as RunState};
use tokio::sync::watch;

use crate::App;
use crate::extract::Path;
use crate::guest::Guest;
use crate::problem::{Problem, Result};

/// A comment at this distance keeps proxies from closing a quiet stream.
const HEARTBEAT: Duration = Duration::from_secs(15);

/// How long a browser waits before it connects again.
const RETRY: Duration = Duration::from_secs(2);

/// Progress of a run.
///
/// Each event has the run's sequence number as `id` and a `RunEvent` as `data`. With `Last-Event-ID` the stream begins
/// behind that event; without it, at the first. It ends with the run; who connects again then gets 204, which tells an
/// `EventSource` to stop. Events that are not kept (place in the queue, preliminary results) have the number of the event before them.
#[utoipa::path(get, path = "/runs/{id}/events", tag = "runs",
    params(
        ("id" = String, Path, description = "Run id"),
        ("Last-Event-ID" = Option<i64>, Header, description = "Sequence number of the last event seen"),
    ),
    responses(
        (status = 200, description = "The events", body = RunEvent, content_type = "text/event-stream"),
        (status = 204, description = "The run has ended and every event was seen"),
        (status = 400, description = "Last-Event-ID is not a number"),
        (status = 404, description = "No such run"),
    ))]
pub(crate) async fn follow_run(
    State(app): State<App>,
    Path(id): Path<String>,
    Guest(guest): Guest,
    headers: HeaderMap,
) -> Result<Response> {
    let after = last_event_id(&headers)?;
    let run = app.engine.run(&id, Some(&guest)).await?;
    if has_ended(run.state) && app.engine.events(&id, after).await?.is_empty() {
        return Ok(StatusCode::NO_CONTENT.into_response());
    }
    // What became private meanwhile ends: the event that comes then is not told any more.
    let (engine, run) = (app.engine.clone(), id.clone());
    let still_there = move |_: &_| {
        let (engine, run, guest) = (engine.clone(), run.clone(), guest.clone());
        async move { engine.run_is_for(&run, Some(&guest)).await.is_ok() }
    };
    let events = app.engine.follow(&id, after).await?.take_while(still_there).map(|event| match event {
        Ok(event) => as_sse(&event),
        Err(error) => failure(error),
    });
    // One `retry` at the start is enough: the browser remembers it.
    let first = futures::stream::iter([Event::default().retry(RETRY).comment("progress")]);
    let stream = first.chain(events).take_until(stopped(app.stopping.clone())).map(Ok::<_, Infallible>);
    let headers = [
        (header::CACHE_CONTROL, HeaderValue::from_static("no-store")),
        // Proxies that buffer would hold progress back.
        (HeaderName::from_static("x-accel-buffering"), HeaderValue::from_static("no")),
    ];
    Ok((headers, sse(stream)).into_response())
}

pub(crate) fn sse<S>(stream: S) -> impl IntoResponse
where
    S: Stream<Item = std::result::Result<Event, Infallible>> + Send + 'static,
{
    Sse::new(stream).keep_alive(KeepAlive::new().interval(HEARTBEAT).text("heartbeat"))
}

fn as_sse(event: &RunEvent) -> Event {
    match Event::default().id(event.seq.to_string()).json_data(event) {
        Ok(event) => event,
        Err(error) => failure(error),
    }
}

/// A fault in the middle of a stream: no status is left to say it with, so the browser is told to come back.
fn failure(error: impl std::fmt::Display) -> Event {
    tracing::error!(%error, "a progress stream failed: internal error");
    Event::default().comment("internal error; connect again")
}

fn has_ended(state: RunState) -> bool {
    matches!(state, RunState::Done | RunState::Failed | RunState::Cancelled)
}

fn last_event_id(headers: &HeaderMap) -> Result<i64> {
    let Some(value) = headers.get("last-event-id") else { return Ok(0) };
    let number = value.to_str().ok().and_then(|text| text.parse::<i64>().ok()).filter(|seq| *seq >= 0);
    number.ok_or_else(|| Problem::bad_request("Last-Event-ID must be the number of an event of this run."))
}

pub(crate) async fn stopped(mut stopping: watch::Receiver<bool>) {
    // An error means that the server is gone, which is the same.
    let _ = stopping.wait_for(|stop| *stop).await;
}
