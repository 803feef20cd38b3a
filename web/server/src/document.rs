//! Answers that extractors and layers give on every route of a kind, put into the OpenAPI document in one place.

use utoipa::openapi::path::Operation;
use utoipa::openapi::security::{ApiKey, ApiKeyValue, Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};
use utoipa::openapi::{ContentBuilder, OpenApi, Ref, RefOr, Response, ResponseBuilder};

use crate::guest::{SESSION, anybody_reads};

/// The document with what no handler says of itself. What a route says stands.
pub(crate) fn completed(mut document: OpenApi) -> OpenApi {
    for (path, item) in &mut document.paths.paths {
        let reading = item.get.iter_mut().map(|operation| (true, operation));
        let changing = [&mut item.put, &mut item.post, &mut item.delete].into_iter().flatten();
        for (reads, operation) in reading.chain(changing.map(|operation| (false, operation))) {
            for (status, description) in answers(operation).into_iter().chain(to_tokens(path, reads)) {
                let known = &mut operation.responses.responses;
                known.entry(status.to_owned()).or_insert_with(|| problem(description));
            }
            // Whatever is refused is refused with a problem.
            let refused = operation.responses.responses.iter_mut().filter(|(status, _)| status.starts_with(['4', '5']));
            for (_, response) in refused {
                if let RefOr::T(Response { content, description, .. }) = response
                    && content.is_empty()
                {
                    *response = problem(&description.clone());
                }
            }
        }
    }
    let schemes = &mut document.components.get_or_insert_default().security_schemes;
    schemes.insert("token".to_owned(), RefOr::T(SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer))));
    let cookie = ApiKey::Cookie(ApiKeyValue::new(SESSION));
    schemes.insert("session".to_owned(), RefOr::T(SecurityScheme::ApiKey(cookie)));
    // Nobody needs either, except where the answer 401 says so.
    let none = SecurityRequirement::default();
    let of = |name: &str| SecurityRequirement::new(name, Vec::<String>::new());
    document.security = Some(vec![none, of("token"), of("session")]);
    document
}

/// What a token hears that opens nothing, or is not for that.
fn to_tokens(path: &str, reads: bool) -> Vec<(&'static str, &'static str)> {
    let mut all = vec![("401", "The token in `Authorization` is not valid")];
    // What is there for everybody may be read with any token.
    if !(reads && anybody_reads(path)) {
        all.push((
            "403",
            "The token in `Authorization` does not have the required scope, or the request was sent by a page of \
             another site",
        ));
    }
    all
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
            all.extend([("415", "The content type of the body is not JSON"), ("422", "The body is not valid")]);
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
