//! Ids of objects.

use std::fmt;

/// An object's id: `stock:NAME`, `stock:NAME@TRIANGLES`, or the id under which an added object is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectId<'a> {
    /// A stock object.
    Stock {
        /// Its name.
        name: &'a str,
        /// With how many triangles, as it was written; the default number when absent.
        triangles: Option<&'a str>,
    },
    /// An object that somebody added.
    Added(&'a str),
}

const STOCK: &str = "stock:";

impl<'a> ObjectId<'a> {
    /// What this text names.
    pub fn of(text: &'a str) -> Self {
        match text.strip_prefix(STOCK).map(|rest| rest.split_once('@').map_or((rest, None), |(a, b)| (a, Some(b)))) {
            Some((name, triangles)) => Self::Stock { name, triangles },
            None => Self::Added(text),
        }
    }

    /// Is it a stock object?
    pub fn is_stock(self) -> bool {
        matches!(self, Self::Stock { .. })
    }
}

impl fmt::Display for ObjectId<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stock { name, triangles: Some(triangles) } => write!(f, "{STOCK}{name}@{triangles}"),
            Self::Stock { name, triangles: None } => write!(f, "{STOCK}{name}"),
            Self::Added(id) => f.write_str(id),
        }
    }
}

/// The id of a stock object with so many triangles.
pub fn stock_id(name: &str, triangles: u32) -> String {
    ObjectId::Stock { name, triangles: Some(&triangles.to_string()) }.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_object_id_is_the_same_as_text_and_back() {
        let castle = ObjectId::Stock { name: "castle", triangles: None };
        assert_eq!(ObjectId::of("stock:castle"), castle);
        assert_eq!(ObjectId::of("stock:castle@20"), ObjectId::Stock { name: "castle", triangles: Some("20") });
        for text in ["stock:castle", "stock:castle@", "stock:castle@20", "stock:", "0192c3a4", "castle@20", ""] {
            assert_eq!(ObjectId::of(text).to_string(), text);
            assert_eq!(ObjectId::of(text).is_stock(), text.starts_with("stock:"));
        }
        assert_eq!(stock_id("castle", 20), "stock:castle@20");
    }
}
