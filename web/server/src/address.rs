//! The network a request comes from. Limits by address hold for the whole /64 of IPv6, since every subscriber has one.

use std::convert::Infallible;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::str::FromStr;

use axum::extract::{ConnectInfo, FromRequestParts};
use axum::http::HeaderMap;
use axum::http::request::Parts;
use ipnet::IpNet;

use crate::App;

/// A network of proxies, or a single one: `10.1.0.0/16`, `2001:db8::1`.
#[derive(Clone, Copy, Debug)]
pub struct ProxyNetwork(IpNet);

impl FromStr for ProxyNetwork {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let one = |_| text.parse::<IpAddr>().map(IpNet::from);
        let network = text.parse().or_else(one);
        network.map(Self).map_err(|_| "not an IP address or a network such as 10.1.0.0/16".to_owned())
    }
}

/// The machines whose `X-Forwarded-For` is trusted, in addition to this one.
#[derive(Clone, Debug, Default)]
pub struct Proxies(Vec<ProxyNetwork>);

impl Proxies {
    /// Those in these networks.
    pub fn new(networks: impl IntoIterator<Item = ProxyNetwork>) -> Self {
        Self(networks.into_iter().collect())
    }

    fn trust(&self, address: IpAddr) -> bool {
        let address = address.to_canonical();
        address.is_loopback() || self.0.iter().any(|ProxyNetwork(network)| network.contains(&address))
    }

    /// The visitor's address: each proxy appends the one that it was called from, so it is the last that is no proxy's.
    fn visitor(&self, peer: IpAddr, headers: &HeaderMap) -> Option<IpAddr> {
        let lists = headers.get_all("x-forwarded-for").iter();
        let lists: Vec<&str> = lists.map(|list| list.to_str().unwrap_or("unreadable")).collect();
        let mut visitor = peer;
        for entry in lists.iter().flat_map(|list| list.split(',')).rev() {
            if !self.trust(visitor) {
                break;
            }
            visitor = address_of(entry.trim())?;
        }
        Some(visitor)
    }
}

/// The visitor's network: an IPv4 address, or the /64 of an IPv6 address.
pub(crate) struct Address(pub String);

impl FromRequestParts<App> for Address {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, app: &App) -> Result<Self, Infallible> {
        let peer = parts.extensions.get::<ConnectInfo<SocketAddr>>().map_or(Ipv4Addr::LOCALHOST.into(), |c| c.0.ip());
        let visitor = app.network.proxies.visitor(peer, &parts.headers);
        Ok(Self(visitor.map_or_else(|| UNREADABLE.to_owned(), network)))
    }
}

/// Shared by all visitors whose address the proxy reports in an unknown form.
const UNREADABLE: &str = "unreadable";

/// An address as proxies write it, with or without a port.
fn address_of(text: &str) -> Option<IpAddr> {
    text.parse().or_else(|_| text.parse::<SocketAddr>().map(|address| address.ip())).ok()
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
    use axum::http::HeaderValue;

    use super::*;

    fn of(proxies: &Proxies, peer: &str, forwarded: &[&'static str]) -> Option<String> {
        let mut headers = HeaderMap::new();
        for list in forwarded {
            headers.append("x-forwarded-for", HeaderValue::from_static(list));
        }
        proxies.visitor(peer.parse().unwrap(), &headers).map(network)
    }

    #[test]
    fn the_address_is_the_visitors_and_an_ipv6_subnet_is_one() {
        let of = |peer, forwarded| of(&Proxies::default(), peer, forwarded).unwrap_or_default();
        assert_eq!(of("127.0.0.1", &[]), "127.0.0.1");
        assert_eq!(of("127.0.0.1", &["198.51.100.1, 203.0.113.7"]), "203.0.113.7");
        assert_eq!(of("203.0.113.9", &["198.51.100.1"]), "203.0.113.9", "it is no proxy of ours");
        assert_eq!(of("::1", &["2001:db8:1:2:3:4:5:6"]), "2001:db8:1:2::/64");
        assert_eq!(of("2001:db8:1:2:ffff::1", &[]), "2001:db8:1:2::/64");
        assert_eq!(of("::ffff:203.0.113.7", &[]), "203.0.113.7");
        assert_eq!(of("127.0.0.1", &["203.0.113.7:4711"]), "203.0.113.7");
        assert_eq!(of("127.0.0.1", &["[2001:db8::1]:4711"]), "2001:db8::/64");
        assert_eq!(of("127.0.0.1", &["203.0.113.7, nonsense"]), "", "unreadable");
    }

    #[test]
    fn proxies_on_other_machines_are_trusted_when_they_are_named() {
        let proxies =
            Proxies::new(["10.1.0.0/16", "2001:db8:ff::/48", "192.0.2.1"].map(|network| network.parse().unwrap()));
        let of = |peer, forwarded| of(&proxies, peer, forwarded).unwrap_or_default();
        assert_eq!(of("10.1.2.3", &["203.0.113.7"]), "203.0.113.7");
        assert_eq!(of("::ffff:10.1.2.3", &["203.0.113.7"]), "203.0.113.7");
        assert_eq!(of("2001:db8:ff::2", &["203.0.113.7"]), "203.0.113.7");
        assert_eq!(of("192.0.2.1", &["203.0.113.7"]), "203.0.113.7");
        assert_eq!(of("10.2.0.1", &["203.0.113.7"]), "10.2.0.1");
        // Two proxies in a row, in one header or two. What a visitor wrote in front of them does not count.
        assert_eq!(of("127.0.0.1", &["198.51.100.1, 203.0.113.7, 10.1.9.9"]), "203.0.113.7");
        assert_eq!(of("10.1.2.3", &["198.51.100.1", "203.0.113.7", "10.1.9.9"]), "203.0.113.7");
    }
}
