//! `ocb-advisor`: started in a jail by the service and by `ocb advise`, and never otherwise.

fn main() {
    ocb_sandbox::inside::task::main(ocb_advisor::work)
}
