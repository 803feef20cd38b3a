//! Each header compiles alone, as every standard that it promises.

mod support;

fn headers(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the include folder").map(|entry| entry.expect("an entry").path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let below = folders.iter().flat_map(|folder| headers(folder));
    files.into_iter().filter(|path| path.extension().is_some_and(|end| end == "h")).chain(below).collect()
}

#[test]
fn every_header_compiles_alone() {
    let include = support::package().join("include");
    let headers = headers(&include);
    assert!(headers.len() >= 5, "{headers:?}");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for header in headers {
        let name = header.strip_prefix(&include).expect("below include").display().to_string();
        let source = folder.path().join("alone.c");
        // Twice: the guards work.
        std::fs::write(&source, format!("#include <{name}>\n#include <{name}>\n")).expect("written");
        support::compile_as_every_standard(&source);
    }
}
