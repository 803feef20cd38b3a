//! What is private is not there for others: one guard before every route of runs, objects and advice, also those that are
//! still to come.

use axum::extract::{Query, Request, State};
use axum::http::Uri;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use ocb_service::model::Role;
use percent_encoding::percent_decode_str;

use crate::App;
use crate::guest::{Guest, Person};
use crate::problem::Problem;

/// Something that a request names by its id.
#[derive(Debug, PartialEq, Eq)]
enum Named {
    Run(String),
    Object(String),
    Advice(String),
    Configurations(String),
    StabilityRun(String),
    Workload(String),
}

/// Answers as if there were no such thing when it is somebody else's private one, in the path or as what another is compared
/// with.
pub(crate) async fn hide_private_things(State(app): State<App>, request: Request, next: Next) -> Response {
    let named = named(request.uri());
    let guest = request.extensions().get::<Guest>().map(|guest| guest.0.clone());
    for thing in &named {
        // Curators end what keeps others waiting, and do not see what it found.
        let ends =
            matches!(thing, Named::StabilityRun(_) | Named::Workload(_)) && request.uri().path().ends_with("/cancel");
        if ends && request.extensions().get::<Person>().is_some_and(|Person(account)| account.role >= Role::Curator) {
            continue;
        }
        let there = match thing {
            Named::Run(id) => app.engine.run_is_for(id, guest.as_deref()).await,
            Named::Object(id) => app.engine.object_is_for(id, guest.as_deref()).await,
            Named::Advice(id) => app.engine.advice_is_for(id, guest.as_deref()).await,
            Named::Configurations(id) => app.engine.saved_are_for(id, guest.as_deref()).await,
            Named::StabilityRun(id) => app.engine.stability_run_is_for(id, guest.as_deref()).await,
            Named::Workload(id) => app.engine.workload_is_for(id, guest.as_deref()).await,
        };
        if let Err(e) = there {
            return Problem::from(e).into_response();
        }
    }
    next.run(request).await
}

/// What a request names, as the routes will read it: decoded.
fn named(uri: &Uri) -> Vec<Named> {
    let mut parts = uri.path().strip_prefix("/api/v1/").unwrap_or_default().split('/');
    let (resource, id) = (parts.next().unwrap_or_default(), parts.next().unwrap_or_default());
    let id = percent_decode_str(id).decode_utf8_lossy().into_owned();
    let of_path = match resource {
        _ if id.is_empty() => None,
        "runs" => Some(Named::Run(id)),
        "objects" => Some(Named::Object(id)),
        "advice" => Some(Named::Advice(id)),
        "configurations" => Some(Named::Configurations(id)),
        "stability-runs" => Some(Named::StabilityRun(id)),
        "workloads" => Some(Named::Workload(id)),
        _ => None,
    };
    let Query(pairs) = Query::<Vec<(String, String)>>::try_from_uri(uri).unwrap_or_default();
    let compared = pairs.into_iter().filter(|(name, _)| name == "against_run").map(|(_, id)| Named::Run(id));
    of_path.into_iter().chain(compared).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whatever_is_below_a_thing_belongs_to_it() {
        let named = |uri: &str| named(&uri.parse().unwrap());
        let run = |id: &str| Named::Run(id.into());
        assert_eq!(named("/api/v1/runs/x/events"), [run("x")]);
        assert_eq!(named("/api/v1/runs/x"), [run("x")]);
        assert_eq!(named("/api/v1/runs/%78/chart?kind=ecdf"), [run("x")]);
        assert_eq!(named("/api/v1/runs/x/heatmap?algorithm=a&against_run=%79"), [run("x"), run("y")]);
        assert_eq!(named("/api/v1/objects/x/mesh.glb"), [Named::Object("x".into())]);
        assert_eq!(named("/api/v1/advice/x/reduced.obj?side=a"), [Named::Advice("x".into())]);
        assert_eq!(named("/api/v1/stability-runs/x/cancel"), [Named::StabilityRun("x".into())]);
        assert!(named("/api/v1/runs/").is_empty() && named("/api/v1/plugins/x").is_empty());
    }
}
