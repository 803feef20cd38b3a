//! A private run is not there for others: one guard before every route of runs, also those that are still to come.

use axum::extract::{Request, State};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use crate::App;
use crate::guest::Guest;
use crate::problem::Problem;

/// Answers as if there were no such run when it is somebody else's private one.
pub(crate) async fn hide_private_runs(State(app): State<App>, request: Request, next: Next) -> Response {
    let id = run_of(request.uri().path()).map(str::to_owned);
    let guest = request.extensions().get::<Guest>().map(|guest| guest.0.clone()).unwrap_or_default();
    if let Some(id) = id {
        match app.engine.may_see_run(&id, &guest).await {
            Ok(true) => {}
            Ok(false) => return Problem::from(ocb_engine::no_run(&id)).into_response(),
            Err(e) => return Problem::from(e).into_response(),
        }
    }
    next.run(request).await
}

fn run_of(path: &str) -> Option<&str> {
    path.strip_prefix("/api/v1/runs/")?.split('/').next().filter(|id| !id.is_empty())
}

#[cfg(test)]
mod tests {
    use super::run_of;

    #[test]
    fn whatever_is_below_a_run_belongs_to_it() {
        assert_eq!(run_of("/api/v1/runs/x/events"), Some("x"));
        assert_eq!(run_of("/api/v1/runs/x"), Some("x"));
        assert_eq!(run_of("/api/v1/runs/"), None);
        assert_eq!(run_of("/api/v1/objects/x"), None);
    }
}
