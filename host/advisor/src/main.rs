//! `ocb-advisor`: started in a jail by the service and by `ocb advise`, and by nobody else.

fn main() {
    ocb_sandbox::inside::task::main(ocb_advisor::work)
}
