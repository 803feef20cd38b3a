//! Where a request comes from: what is limited by address must not be escaped with another cookie, or another of the addresses
//! that every subscriber has.

use std::convert::Infallible;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

use axum::extract::{ConnectInfo, FromRequestParts};
use axum::http::request::Parts;

/// The network of who asks: an address of version 4, the 64 first bits of one of version 6. A proxy on the same machine says
/// whose request it passes on; nobody else is believed.
pub(crate) struct Address(pub String);

impl<S: Send + Sync> FromRequestParts<S> for Address {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        let (peer, told) = asker(parts);
        Ok(Self(told.unwrap_or_else(|| network(peer))))
    }
}

/// What all share whose address a proxy does not tell readably.
const UNREADABLE: &str = "unreadable";

/// The other end of the connection, and the network of whom a proxy at this machine says that it speaks for.
fn asker(parts: &Parts) -> (IpAddr, Option<String>) {
    let peer = parts.extensions.get::<ConnectInfo<SocketAddr>>().map_or(Ipv4Addr::LOCALHOST.into(), |c| c.0.ip());
    let told = parts.headers.get_all("x-forwarded-for").iter().next_back().filter(|_| peer.is_loopback());
    let last = told.map(|list| list.to_str().unwrap_or_default().rsplit(',').next().unwrap_or_default().trim());
    let with_port = |text: &str| text.parse::<SocketAddr>().map(|address| address.ip());
    (peer, last.map(|text| text.parse().or_else(|_| with_port(text)).map_or_else(|_| UNREADABLE.to_owned(), network)))
}

fn network(address: IpAddr) -> String {
    match address.to_canonical() {
        IpAddr::V4(address) => address.to_string(),
        IpAddr::V6(address) => {
            let [a, b, c, d, ..] = address.segments();
            format!("{}/64", Ipv6Addr::new(a, b, c, d, 0, 0, 0, 0))
        }
    }
}

#[cfg(test)]
mod tests {
    use axum::http::Request;

    use super::*;

    async fn of(peer: &str, forwarded: Option<&str>) -> String {
        let mut request = Request::builder();
        if let Some(forwarded) = forwarded {
            request = request.header("x-forwarded-for", forwarded);
        }
        let (mut parts, ()) = request.body(()).unwrap().into_parts();
        parts.extensions.insert(ConnectInfo(SocketAddr::new(peer.parse().unwrap(), 1)));
        let Ok(Address(address)) = Address::from_request_parts(&mut parts, &()).await;
        address
    }

    #[tokio::test]
    async fn an_address_is_that_of_the_visitor_and_a_subscriber_has_one() {
        assert_eq!(of("127.0.0.1", None).await, "127.0.0.1");
        assert_eq!(of("127.0.0.1", Some("198.51.100.1, 203.0.113.7")).await, "203.0.113.7");
        assert_eq!(of("203.0.113.9", Some("198.51.100.1")).await, "203.0.113.9", "it is no proxy of ours");
        assert_eq!(of("::1", Some("2001:db8:1:2:3:4:5:6")).await, "2001:db8:1:2::/64");
        assert_eq!(of("2001:db8:1:2:ffff::1", None).await, "2001:db8:1:2::/64");
        assert_eq!(of("::ffff:203.0.113.7", None).await, "203.0.113.7");
        assert_eq!(of("127.0.0.1", Some("203.0.113.7:4711")).await, "203.0.113.7");
        assert_eq!(of("127.0.0.1", Some("[2001:db8::1]:4711")).await, "2001:db8::/64");
        assert_eq!(of("127.0.0.1", Some("nonsense")).await, "unreadable");
    }
}
