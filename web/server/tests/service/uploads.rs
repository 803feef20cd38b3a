//! Slow uploads do not delay others, and every part of a form has a limit.

use std::time::{Duration, Instant};

use reqwest::StatusCode;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;

use crate::support::{Service, problem};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Sends a large upload at 40 KB a second until it is dropped.
async fn slowly(address: String) {
    let mut stream = TcpStream::connect(address).await.expect("a connection");
    let head = "POST /api/v1/objects HTTP/1.1\r\nHost: localhost\r\nContent-Length: 200000000\r\n\
                Content-Type: multipart/form-data; boundary=X\r\n\r\n\
                --X\r\nContent-Disposition: form-data; name=\"file\"; filename=\"slow.obj\"\r\n\r\n";
    stream.write_all(head.as_bytes()).await.expect("sent");
    loop {
        if stream.write_all(&[b'#'; 4096]).await.is_err() {
            return;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
}

#[tokio::test]
async fn fifty_slow_uploads_do_not_stop_a_quick_one() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let address = service.url.trim_start_matches("http://").to_owned();
    let slow: Vec<_> = (0..50).map(|_| tokio::spawn(slowly(address.clone()))).collect();
    tokio::time::sleep(Duration::from_millis(500)).await;
    let large = format!("{TRIANGLE}{}", "# a line that says nothing of the object\n".repeat(220_000));
    assert!(large.len() > 9_000_000);
    let begun = Instant::now();
    let done = tokio::time::timeout(Duration::from_secs(60), service.guest().upload("large.obj", large)).await;
    assert_eq!(done.expect("in time, however busy the machine is").status(), StatusCode::CREATED);
    println!("9 MB beside fifty slow uploads: {:.1} s", begun.elapsed().as_secs_f64());
    assert!(slow.iter().all(|one| !one.is_finished()), "they are still coming");
    slow.iter().for_each(tokio::task::JoinHandle::abort);
    service.stop().await;
}

#[tokio::test]
async fn one_address_has_some_uploads_at_a_time() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let address = service.url.trim_start_matches("http://").to_owned();
    let mut coming = Vec::new();
    for _ in 0..101 {
        let mut stream = TcpStream::connect(&address).await.expect("a connection");
        let head = "POST /api/v1/objects HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n\
                    X-Forwarded-For: 203.0.113.7\r\nContent-Type: multipart/form-data; boundary=X\r\n\r\n--X\r\n";
        stream.write_all(head.as_bytes()).await.expect("sent");
        tokio::time::sleep(Duration::from_millis(5)).await;
        coming.push(stream);
    }
    let mut refused = coming.pop().expect("the last");
    refused.write_all(&[b'#'; 1000]).await.expect("sent");
    let mut answer = vec![0; 12];
    refused.read_exact(&mut answer).await.expect("an answer");
    assert_eq!(String::from_utf8_lossy(&answer), "HTTP/1.1 429");
    service.stop().await;
}

#[tokio::test]
async fn other_parts_of_the_form_are_limited() {
    let service = Service::start_with(&["libocb_box_tree.so"]).await;
    let guest = service.guest();
    let form = |other: usize| {
        let part = reqwest::multipart::Part::bytes(TRIANGLE.as_bytes()).file_name("own.obj");
        reqwest::multipart::Form::new().text("note", "x".repeat(other)).part("file", part)
    };
    let send = |other| guest.post("/api/v1/objects").multipart(form(other)).send();
    assert_eq!(send(60_000).await.expect("an answer").status(), StatusCode::CREATED);
    assert!(problem(send(100_000).await.expect("an answer"), 413).await.contains("64 KiB"));
    service.stop().await;
}
