//! Axum's extractors with our problem documents instead of its plain texts.

use axum::extract::{FromRequest, FromRequestParts};

use crate::Problem;

/// A JSON body: 400 when it is no JSON, 415 when it does not say so, 422 when it does not fit.
#[derive(FromRequest)]
#[from_request(via(axum::Json), rejection(Problem))]
pub(crate) struct Json<T>(pub T);

/// The query string: 400 when it does not fit.
#[derive(FromRequestParts)]
#[from_request(via(axum::extract::Query), rejection(Problem))]
pub(crate) struct Query<T>(pub T);

/// The parts of the path: 400 when they do not fit.
#[derive(FromRequestParts)]
#[from_request(via(axum::extract::Path), rejection(Problem))]
pub(crate) struct Path<T>(pub T);
