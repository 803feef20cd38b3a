//! What a visitor has made: how long it stays, and taking it away.

use axum::extract::State;
use axum::response::Response;
use axum::{Extension, Json};
use ocb_service::Contents;
use ocb_service::model::{OwnedItems, Scope};

use crate::App;
use crate::extract::Path;
use crate::guest::{Guest, Token};
use crate::problem::Result;

/// Everything that the visitor has made, which is what `DELETE` takes away, and until when it stays.
#[utoipa::path(get, path = "/data", tag = "data", responses((status = 200, body = OwnedItems)))]
pub(crate) async fn show_data(State(app): State<App>, Guest(guest): Guest) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.owned_items(&guest).await?))
}

/// Takes away everything that the visitor has made, with the stored files that nobody else uses; runs under way end. Plugins
/// stay, because results belong to them.
#[utoipa::path(delete, path = "/data", tag = "data",
    responses(
        (status = 200, description = "What was deleted", body = OwnedItems),
        (status = 409, description = "A run is just ending"),
    ))]
pub(crate) async fn delete_all(State(app): State<App>, Guest(guest): Guest) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.delete_all(&guest).await?))
}

/// Keeps what a guest has made for as long again, from now on.
#[utoipa::path(post, path = "/data/keep", tag = "data", responses((status = 200, body = OwnedItems)))]
pub(crate) async fn keep_longer(State(app): State<App>, Guest(guest): Guest) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.keep_longer(&guest).await?))
}

/// Everything that the visitor has made, to take along: objects, runs with their configurations and records, advice with its
/// reduced objects, plugins with their reports, the account and its notices. A token gets no account data, and plugins only with their
/// scope.
#[utoipa::path(get, path = "/data.tar", tag = "data",
    responses(
        (status = 200, description = "A folder per item, with JSON, OBJ and Parquet files", body = [u8], content_type = "application/x-tar"),
        (status = 429, description = "Too many archives are being downloaded"),
    ))]
pub(crate) async fn export_data(
    State(app): State<App>,
    Guest(guest): Guest,
    token: Option<Extension<Token>>,
) -> Result<Response> {
    let contents = token.map_or(Contents::ALL, |Extension(Token(scopes))| Contents {
        plugins: scopes.contains(&Scope::Plugins),
        account: false,
    });
    app.archives.send("application/x-tar", "opencollbench.tar", app.engine.archive(&guest, contents)).await
}

/// What goes with a run.
#[utoipa::path(get, path = "/runs/{id}/deletion-preview", tag = "data",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "What DELETE of the run deletes", body = OwnedItems),
        (status = 403, description = "The run belongs to someone else"),
        (status = 404, description = "No such run"),
    ))]
pub(crate) async fn deletion_preview_of_run(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.deletion_preview_of_run(&id, &guest).await?))
}

/// Takes away a run with its results and the stored files that nobody else uses; one under way ends.
#[utoipa::path(delete, path = "/runs/{id}", tag = "data",
    params(("id" = String, Path, description = "Run id")),
    responses(
        (status = 200, description = "What was deleted", body = OwnedItems),
        (status = 403, description = "The run belongs to someone else"),
        (status = 404, description = "No such run"),
        (status = 409, description = "The run is just ending"),
    ))]
pub(crate) async fn remove_run(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.remove_run(&id, &guest).await?))
}

/// What goes with an object: the visitor's runs and advice with it.
#[utoipa::path(get, path = "/objects/{id}/deletion-preview", tag = "data",
    params(("id" = String, Path, description = "Object id")),
    responses(
        (status = 200, description = "What DELETE of the object deletes", body = OwnedItems),
        (status = 403, description = "The object belongs to someone else"),
        (status = 404, description = "No such object"),
    ))]
pub(crate) async fn deletion_preview_of_object(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.deletion_preview_of_object(&id, &guest).await?))
}

/// Takes away an object, and the visitor's runs and advice with it; runs of others keep their numbers, and show no object.
#[utoipa::path(delete, path = "/objects/{id}", tag = "data",
    params(("id" = String, Path, description = "Object id")),
    responses(
        (status = 200, description = "What was deleted", body = OwnedItems),
        (status = 403, description = "The object belongs to someone else"),
        (status = 404, description = "No such object"),
        (status = 409, description = "A run with this object is just ending"),
    ))]
pub(crate) async fn remove_object(
    State(app): State<App>,
    Guest(guest): Guest,
    Path(id): Path<String>,
) -> Result<Json<OwnedItems>> {
    Ok(Json(app.engine.remove_object(&id, &guest).await?))
}
