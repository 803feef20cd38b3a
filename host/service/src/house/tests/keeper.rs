//! One service keeps house, and another takes over.

use std::sync::{Arc, Mutex};

use tokio::io::{AsyncBufReadExt, AsyncWriteExt, BufReader};
use tokio::net::{TcpListener, TcpStream};

use super::*;
use crate::house::Door;

/// Whom the mails were to that a server got.
type Got = Arc<Mutex<Vec<String>>>;

/// A mail server that takes everything.
async fn mail_server() -> (MailServer, Got) {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let url = format!("smtp://{}", listener.local_addr().unwrap());
    let got = Got::default();
    let all = got.clone();
    tokio::spawn(async move {
        while let Ok((stream, _)) = listener.accept().await {
            tokio::spawn(take(stream, all.clone()));
        }
    });
    (MailServer::new(&url, "bench@example.org", "https://bench.example.org").unwrap(), got)
}

async fn take(mut stream: TcpStream, got: Got) {
    let (reader, mut writer) = stream.split();
    let (mut lines, mut to, mut in_mail) = (BufReader::new(reader).lines(), String::new(), false);
    let mut answer = "220 ready";
    loop {
        if writer.write_all(format!("{answer}\r\n").as_bytes()).await.is_err() {
            return;
        }
        let line = loop {
            match lines.next_line().await {
                Ok(Some(line)) if in_mail && line != "." => {}
                Ok(Some(line)) => break line,
                _ => return,
            }
        };
        answer = "250 ok";
        if in_mail {
            in_mail = false;
            got.lock().unwrap().push(std::mem::take(&mut to));
        } else if line.starts_with("DATA") {
            (in_mail, answer) = (true, "354 go on");
        } else if let Some(recipient) = line.strip_prefix("RCPT TO:") {
            to = recipient.to_owned();
        }
    }
}

/// Asks for a mail at this service, and waits until it has arrived and waits nowhere any more; gives all that have arrived.
async fn mailed(engine: &Engine, name: &str, got: &Got) -> Vec<String> {
    let account = engine.add_account(name, "a long password", Role::User).await.unwrap();
    engine.set_address(&account, &format!("{name}@example.org"), true).await.unwrap();
    until("a mail waits", async || engine.inner.store.next_mail_us().await.unwrap().is_none()).await;
    got.lock().unwrap().clone()
}

fn keeps_house(engine: &Engine) -> bool {
    engine.inner.house.is_here()
}

#[tokio::test(flavor = "multi_thread")]
async fn one_service_sends_a_mail_and_another_takes_over() {
    let (server, got) = mail_server().await;
    let pair = Pair::open_with(true, Some(server)).await;
    let Pair { first, second, .. } = &pair;
    assert!(keeps_house(first) && !keeps_house(second));
    // Whichever service was asked, the mail goes out once, and at once.
    assert_eq!(mailed(second, "ada", &got).await, ["<ada@example.org>"]);

    // The connection of the first is terminated again and again, so that the second is quicker.
    let name = format!("ocb {}", first.inner.work.worker.machine);
    until("the second did not take over", async || {
        pair.terminate("", &name).await;
        keeps_house(second)
    })
    .await;
    until("the first did not notice", async || !keeps_house(first)).await;
    assert_eq!(mailed(first, "bob", &got).await.len(), 2);

    // The second ends.
    second.shutdown().await;
    until("the first did not take over", async || keeps_house(first)).await;
    let all = ["<ada@example.org>", "<bob@example.org>", "<eve@example.org>"];
    assert_eq!(mailed(first, "eve", &got).await, all);
    pair.close().await;
}

/// A process that stands still, or whose machine is gone, uses its connection no more.
#[tokio::test(flavor = "multi_thread")]
async fn a_silent_housekeeper_loses_its_lock() {
    let pair = Pair::open().await;
    let door = async |engine: &Engine| {
        let session = engine.inner.store.locks.session().await.unwrap().unwrap();
        Door::of(session, &engine.inner.work.worker).await.unwrap()
    };
    let (mut silent, mut waiting) = (door(&pair.first).await, door(&pair.second).await);
    sqlx::query("SET idle_session_timeout = '100ms'").execute(&mut silent.session).await.unwrap();
    assert!(silent.look().await.unwrap());
    let begun = Instant::now();
    while !waiting.look().await.unwrap() {
        assert!(begun.elapsed() < Duration::from_secs(60), "the lock of a silent service was not taken from it");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    silent.look().await.unwrap_err();
    pair.close().await;
}
