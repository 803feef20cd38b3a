//! A private run is not there for others: one guard before every route of runs, also those that are still to come.

use axum::extract::{Query, Request, State};
use axum::http::Uri;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use percent_encoding::percent_decode_str;

use crate::App;
use crate::guest::Guest;
use crate::problem::Problem;

/// Answers as if there were no such run when it is somebody else's private one, in the path or as what another is compared
/// with.
pub(crate) async fn hide_private_runs(State(app): State<App>, request: Request, next: Next) -> Response {
    let named = runs_of(request.uri());
    let guest = request.extensions().get::<Guest>().map(|guest| guest.0.clone()).unwrap_or_default();
    for id in named {
        match app.engine.may_see_run(&id, &guest).await {
            Ok(true) => {}
            Ok(false) => return Problem::from(ocb_engine::no_run(&id)).into_response(),
            Err(e) => return Problem::from(e).into_response(),
        }
    }
    next.run(request).await
}

/// The runs that a request names, as the routes will read them: decoded.
fn runs_of(uri: &Uri) -> Vec<String> {
    let below = uri.path().strip_prefix("/api/v1/runs/").and_then(|rest| rest.split('/').next());
    let path = below.filter(|id| !id.is_empty()).map(|id| percent_decode_str(id).decode_utf8_lossy().into_owned());
    let Query(pairs) = Query::<Vec<(String, String)>>::try_from_uri(uri).unwrap_or_default();
    path.into_iter().chain(pairs.into_iter().filter(|(name, _)| name == "against_run").map(|(_, id)| id)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whatever_is_below_a_run_belongs_to_it() {
        let runs = |uri: &str| runs_of(&uri.parse().unwrap());
        assert_eq!(runs("/api/v1/runs/x/events"), ["x"]);
        assert_eq!(runs("/api/v1/runs/x"), ["x"]);
        assert_eq!(runs("/api/v1/runs/%78/chart?kind=ecdf"), ["x"]);
        assert_eq!(runs("/api/v1/runs/x/heatmap?algorithm=a&against_run=%79"), ["x", "y"]);
        assert!(runs("/api/v1/runs/").is_empty() && runs("/api/v1/objects/x").is_empty());
    }
}
