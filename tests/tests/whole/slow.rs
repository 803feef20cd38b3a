//! Clients that are too slow or send too much are shown out; others go on meanwhile.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use ocb_tests::service::{Guest, Service};
use serde_json::json;

use crate::empty;

/// Longer than any time limit of the service.
const PATIENCE: Duration = Duration::from_secs(90);

/// All at once, because each mostly waits.
#[test]
fn who_is_slow_or_sends_too_much_is_shown_out() {
    let service = Service::start_with(&empty("slow"), &["libocb_box_tree.so", "libocb_brute_force.so"]);
    std::thread::scope(|scope| {
        scope.spawn(|| a_head_that_does_not_end_is_not_waited_for(&service));
        scope.spawn(|| a_body_that_drips_gets_a_408_and_uploads_go_on_meanwhile(&service));
        scope.spawn(|| an_answer_that_nobody_reads_is_given_up(&service));
        scope.spawn(|| what_is_too_large_is_refused_by_what_it_says_and_by_what_comes(&service));
    });
}

fn connect(service: &Service) -> TcpStream {
    let address = service.pages().trim_start_matches("http://");
    let stream = TcpStream::connect(address).expect("the service listens");
    stream.set_read_timeout(Some(PATIENCE)).expect("a time limit");
    stream
}

/// What comes until the service closes the connection, and after how long; bytes that are no letters as question marks.
fn until_closed(mut stream: &TcpStream, began: Instant) -> (String, Duration) {
    let mut bytes = Vec::new();
    if let Err(e) = stream.read_to_end(&mut bytes) {
        assert_eq!(
            e.kind(),
            std::io::ErrorKind::ConnectionReset,
            "the service holds the connection after {PATIENCE:?}"
        );
    }
    let letters = bytes.iter().map(|b| if b.is_ascii() { char::from(*b) } else { '?' });
    (letters.collect(), began.elapsed())
}

fn a_head_that_does_not_end_is_not_waited_for(service: &Service) {
    let (mut stream, began) = (connect(service), Instant::now());
    stream.write_all(b"GET /api/v1/status HTTP/1.1\r\nHost: localhost\r\nX-Slow: ").expect("the first half is taken");
    let mut drip = stream.try_clone().expect("a second handle");
    let dripping = std::thread::spawn(move || {
        while drip.write_all(b"a").is_ok() && began.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_secs(1));
        }
    });
    let (_, after) = until_closed(&stream, began);
    assert!(after > Duration::from_secs(10), "nobody is thrown out at once: {after:?}");
    drop(stream);
    dripping.join().expect("the drip ends with its connection");
}

fn a_body_that_drips_gets_a_408_and_uploads_go_on_meanwhile(service: &Service) {
    // Slow uploads arrive on disk and delay no other.
    let began = Instant::now();
    let slow = [connect(service), connect(service)];
    for mut stream in &slow {
        let head = "POST /api/v1/objects HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\
                    Content-Type: multipart/form-data; boundary=b\r\n\r\n";
        let part = "--b\r\nContent-Disposition: form-data; name=\"file\"; filename=\"slow.obj\"\r\n\r\nv 0 0 0\n";
        write!(stream, "{head}{:x}\r\n{part}\r\n", part.len()).expect("the first half is taken");
    }
    let object = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n".to_vec();
    let (status, told) = Guest::default().upload(service, "quick.obj", object);
    assert_eq!(status, 201, "{told}");
    assert!(began.elapsed() < Duration::from_secs(15), "a small upload waited for slow ones: {:?}", began.elapsed());
    for stream in &slow {
        let (answer, _) = until_closed(stream, began);
        assert!(answer.starts_with("HTTP/1.1 408 ") && answer.contains("too slowly"), "{answer}");
        assert!(answer.to_ascii_lowercase().contains("connection: close"), "{answer}");
    }
}

fn an_answer_that_nobody_reads_is_given_up(service: &Service) {
    let (mut stream, began) = (connect(service), Instant::now());
    // More than the kernel keeps for a reader.
    let request = "GET /api/v1/objects/stock:torus-knot@1000000/mesh.glb HTTP/1.1\r\nHost: localhost\r\n\r\n";
    stream.write_all(request.as_bytes()).expect("the request is taken");
    std::thread::sleep(Duration::from_secs(40));
    let (answer, after) = until_closed(&stream, began);
    assert!(answer.starts_with("HTTP/1.1 200 "), "{}", &answer[..answer.len().min(200)]);
    let lower = answer[..answer.len().min(2000)].to_ascii_lowercase();
    let length = lower.lines().find_map(|line| line.strip_prefix("content-length: ")).expect("a length");
    let length: usize = length.trim().parse().expect("a number");
    assert!(after < Duration::from_secs(60) && answer.len() < length, "all {length} bytes came after {after:?}");
}

fn what_is_too_large_is_refused_by_what_it_says_and_by_what_comes(service: &Service) {
    let told = |head: &str, body: &[u8]| {
        let mut stream = connect(service);
        stream.write_all(head.as_bytes()).expect("the head is taken");
        // The service may answer and close before all of it is there.
        let _ = stream.write_all(body);
        let _ = stream.shutdown(std::net::Shutdown::Write);
        until_closed(&stream, Instant::now()).0
    };
    let json = vec![b' '; 3 << 20];
    let head = |path: &str, length: usize, more: &str| {
        format!(
            "POST /api/v1{path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: {length}\r\n{more}\r\n"
        )
    };
    let answer = told(&head("/runs", json.len(), "Content-Type: application/json\r\n"), &json);
    assert!(answer.starts_with("HTTP/1.1 413 "), "{answer}");
    let multipart = "Content-Type: multipart/form-data; boundary=b\r\nExpect: 100-continue\r\n";
    let answer = told(&head("/objects", 1 << 40, multipart), b"");
    assert!(answer.starts_with("HTTP/1.1 413 ") && answer.contains("256 MiB"), "{answer}");
    // A head has an end, too.
    let answer = told(&format!("GET / HTTP/1.1\r\nHost: localhost\r\nX: {}\r\n\r\n", "a".repeat(2 << 20)), b"");
    assert!(answer.starts_with("HTTP/1.1 431 "), "{}", &answer[..answer.len().min(200)]);
    let manifest = json!({ "name": "n".repeat(100_000) });
    let (status, _) = Guest::default().send_plugin(service, &manifest, b"\x7fELF".to_vec()).expect("an answer");
    assert_eq!(status, 401, "who may not submit hears that first");
}
