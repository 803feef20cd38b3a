//! What an account is told.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// Something that the service tells an account.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[schema(example = json!({
    "id": "0199f3a2-7c1e-7d40-9a55-0d6c2f1b8e11",
    "subject": "Your plugin Gauss map 1.2.0 is public",
    "text": "A curator approved it. Anyone may benchmark it now.",
    "link": "/p/0199f3a0-11aa-7c02-b1d4-5a0f9be2c377",
    "created_us": 1_793_000_000_000_000_i64,
    "read_us": null
}))]
pub struct NoticeInfo {
    /// Its id.
    pub id: String,
    /// What it is about, in one line.
    pub subject: String,
    /// What there is to know.
    pub text: String,
    /// The page to look at: a path within the service.
    pub link: String,
    /// When it was written.
    pub created_us: i64,
    /// When its account marked it as read.
    pub read_us: Option<i64>,
}
