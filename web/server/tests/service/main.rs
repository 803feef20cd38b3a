//! The service over HTTP, with a real engine in a temporary folder.
//!
//! The engine starts the runner and asks plugins, so `cargo build --release` must have built them before; `make test`
//! does so.

mod account_deletion;
mod advice;
mod authority;
mod campaigns;
mod citations;
mod configurations;
mod errors;
mod invitations;
mod lists;
mod mail;
mod mail_server;
mod mail_tls;
mod mails_off;
mod notices;
mod objects;
mod owned;
mod pages;
mod people;
mod privacy;
mod publishing;
mod repro;
mod requests;
mod runs;
mod stream;
mod suite;
mod support;
mod uploads;
mod visitors;
mod workloads;
