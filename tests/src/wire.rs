//! A network that can be cut: what is sent meanwhile arrives when it is mended, as over TCP.

use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// Another address of a service.
pub struct Wire {
    /// Where to reach it.
    pub address: String,
    cut: Arc<AtomicBool>,
}

impl Wire {
    /// To this address.
    pub fn to(address: &str) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let here = listener.local_addr().expect("an address").to_string();
        let (cut, to) = (Arc::new(AtomicBool::new(false)), address.to_owned());
        let its = cut.clone();
        thread::spawn(move || {
            for near in listener.incoming().flatten() {
                let (cut, to) = (its.clone(), to.clone());
                thread::spawn(move || {
                    wait_while(&cut);
                    // Nobody listens there: this end is closed, too.
                    let Ok(far) = TcpStream::connect(to) else { return };
                    let back = (far.try_clone().expect("a handle"), near.try_clone().expect("a handle"));
                    let its = cut.clone();
                    thread::spawn(move || pass_on(back.0, back.1, &its));
                    pass_on(near, far, &cut);
                });
            }
        });
        Self { address: here, cut }
    }

    /// From now on nothing passes.
    pub fn cut(&self) {
        self.cut.store(true, Ordering::Relaxed);
    }

    /// It is whole again.
    pub fn mend(&self) {
        self.cut.store(false, Ordering::Relaxed);
    }
}

fn wait_while(cut: &AtomicBool) {
    while cut.load(Ordering::Relaxed) {
        thread::sleep(Duration::from_millis(20));
    }
}

fn pass_on(mut from: TcpStream, mut to: TcpStream, cut: &AtomicBool) {
    let mut bytes = [0; 16384];
    while let Ok(n) = from.read(&mut bytes) {
        wait_while(cut);
        if n == 0 || to.write_all(&bytes[..n]).is_err() {
            break;
        }
    }
    let _ = to.shutdown(Shutdown::Write);
}
