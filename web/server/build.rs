//! Lets the server compile before the pages are built.

fn main() {
    // rust-embed reads the folder while compiling. Watching it makes a new build of the pages reach the binary: their
    // files carry hashes in their names, so a changed page is a new file that nothing else would notice.
    println!("cargo::rerun-if-changed=../app/dist");
    println!("cargo::rerun-if-changed=build.rs");
    if let Err(e) = std::fs::create_dir_all("../app/dist") {
        println!("cargo::error=cannot make the folder web/app/dist for the built pages: {e}");
    }
}
