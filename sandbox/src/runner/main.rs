//! `ocb-runner`: started by the sandbox and by nobody else, in three shapes.
//!
//! * `launch`: a small process that builds the jail and waits for its end ([`ocb_sandbox::inside`]).
//! * `probe`: tells what this machine's kernel has ([`probe`]).
//! * `run`: started fresh inside the jail; closes itself off, loads the plugin and answers ([`serve`]).

mod library;
mod measure;
mod probe;
mod serve;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments.as_slice() {
        [_, "launch"] => ocb_sandbox::inside::launch(),
        [_, "probe"] => probe::probe(),
        [_, "run", mode, plugin, libraries @ ..] => serve::run(mode, plugin, libraries),
        _ => {
            eprintln!("OpenCollBench starts ocb-runner to run one plugin in a jail; it cannot be used by hand.");
            std::process::exit(2);
        }
    }
}
