//! Answers that extractors and layers give on every route of a kind, put into the OpenAPI document in one place.

use utoipa::openapi::path::Operation;
use utoipa::openapi::{ContentBuilder, OpenApi, Ref, RefOr, Response, ResponseBuilder};

/// The document with what no handler says of itself. What a route says stands.
pub(crate) fn completed(mut document: OpenApi) -> OpenApi {
    for item in document.paths.paths.values_mut() {
        for operation in [&mut item.get, &mut item.put, &mut item.post, &mut item.delete].into_iter().flatten() {
            for (status, description) in answers(operation) {
                let known = &mut operation.responses.responses;
                known.entry(status.to_owned()).or_insert_with(|| problem(description));
            }
        }
    }
    document
}

fn answers(operation: &Operation) -> Vec<(&'static str, &'static str)> {
    let mut all = Vec::new();
    if let Some(RefOr::T(body)) = &operation.request_body {
        all.extend([
            ("400", "The body or the address cannot be read"),
            ("408", "The body came too slowly"),
            ("413", "The body is too large"),
        ]);
        if body.content.contains_key("application/json") {
            all.extend([("415", "The body does not say that it is JSON"), ("422", "The body does not fit")]);
        }
    } else if operation.parameters.as_ref().is_some_and(|parameters| !parameters.is_empty()) {
        all.push(("400", "The address cannot be read"));
    }
    all
}

fn problem(description: &str) -> RefOr<Response> {
    let content = ContentBuilder::new().schema(Some(Ref::from_schema_name("Problem"))).build();
    RefOr::T(ResponseBuilder::new().description(description).content("application/problem+json", content).build())
}
