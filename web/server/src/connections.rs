//! Connections: accepting them, and ending those whose other side is too slow.

use std::convert::Infallible;
use std::io::ErrorKind;
use std::net::SocketAddr;
use std::pin::pin;
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::extract::ConnectInfo;
use axum::http::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use socket2::SockRef;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tower::ServiceExt;

use crate::events::stopped;

/// How long the head of a request may take, counted from the moment that the connection is ready for it.
const HEAD: Duration = Duration::from_secs(15);

/// How long an answer may wait for its reader without one byte being taken.
const UNREAD: Duration = Duration::from_secs(20);

/// How long nothing is accepted after the machine had nothing left to accept with, such as descriptors.
const REST: Duration = Duration::from_millis(200);

/// Answers connections until `stopping`, then waits for the requests that are under way.
///
/// `axum::serve` has no time limits; bodies have theirs in [`crate::pace`].
pub(crate) async fn serve(listener: TcpListener, app: Router, stopping: watch::Receiver<bool>) {
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(HEAD);
    // Each connection holds a receiver, so that the sender sees when the last one has ended.
    let (all, one) = watch::channel(());
    loop {
        let (stream, peer) = tokio::select! {
            accepted = accept(&listener) => accepted,
            () = stopped(stopping.clone()) => break,
        };
        let app = app.clone();
        let service = service_fn(move |mut request: Request<Incoming>| {
            request.extensions_mut().insert(ConnectInfo::<SocketAddr>(peer));
            let answer = app.clone().oneshot(request.map(Body::new));
            async move { Ok::<_, Infallible>(answer.await.unwrap_or_else(|never| match never {})) }
        });
        let connection = http.serve_connection(TokioIo::new(stream), service);
        let (stop, open) = (stopped(stopping.clone()), one.clone());
        tokio::spawn(async move {
            let mut connection = pin!(connection);
            let ended = tokio::select! {
                ended = connection.as_mut() => ended,
                () = stop => {
                    connection.as_mut().graceful_shutdown();
                    connection.await
                }
            };
            if let Err(error) = ended {
                tracing::debug!(%error, %peer, "a connection ended early");
            }
            drop(open);
        });
    }
    drop(one);
    all.closed().await;
}

async fn accept(listener: &TcpListener) -> (TcpStream, SocketAddr) {
    loop {
        match listener.accept().await {
            Ok((stream, peer)) => {
                // The kernel keeps the time; a socket that it cannot be told for is answered all the same.
                let _ = SockRef::from(&stream).set_tcp_user_timeout(Some(UNREAD));
                return (stream, peer);
            }
            // Gone again before it was accepted.
            Err(e) if matches!(e.kind(), ErrorKind::ConnectionAborted | ErrorKind::ConnectionReset) => {}
            Err(error) => {
                tracing::warn!(%error, "no connection can be accepted for now");
                tokio::time::sleep(REST).await;
            }
        }
    }
}
