//! The network a request comes from. Limits by address hold for the whole /64 of IPv6, since every subscriber has one.

use std::convert::Infallible;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

use axum::extract::{ConnectInfo, FromRequestParts};
use axum::http::request::Parts;

/// The visitor's network: an IPv4 address, or the /64 of an IPv6 address. `X-Forwarded-For` is trusted from this machine only.
pub(crate) struct Address(pub String);

impl<S: Send + Sync> FromRequestParts<S> for Address {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Infallible> {
        let peer = parts.extensions.get::<ConnectInfo<SocketAddr>>().map_or(Ipv4Addr::LOCALHOST.into(), |c| c.0.ip());
        let forwarded = parts.headers.get_all("x-forwarded-for").iter().next_back().filter(|_| peer.is_loopback());
        Ok(Self(forwarded.map_or_else(|| network(peer), |list| last_of(list.to_str().unwrap_or_default()))))
    }
}

/// Shared by all visitors whose address the proxy reports in an unknown form.
const UNREADABLE: &str = "unreadable";

/// The network of the last address in the list, which the proxy on this machine has added.
fn last_of(list: &str) -> String {
    let text = list.rsplit(',').next().unwrap_or_default().trim();
    let with_port = |_| text.parse::<SocketAddr>().map(|address| address.ip());
    text.parse().or_else(with_port).map_or_else(|_| UNREADABLE.to_owned(), network)
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
    async fn the_address_is_the_visitors_and_an_ipv6_subnet_is_one() {
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
