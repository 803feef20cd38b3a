//! Each header compiles alone, as every standard that it promises.

mod support;

fn headers(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the include folder").map(|entry| entry.expect("an entry").path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let below = folders.iter().flat_map(|folder| headers(folder));
    files.into_iter().filter(|path| path.extension().is_some_and(|end| end == "h")).chain(below).collect()
}

/// The phases that `plugin.h` names; the host quotes them in its reports.
const PHASES: [&str; 5] = ["[load]", "[build]", "[query]", "[end]", "[any]"];

#[test]
fn every_function_says_its_phase_in_the_words_of_the_header() {
    let include = support::package().join("include");
    let mut functions = 0;
    for header in headers(&include) {
        let text = std::fs::read_to_string(&header).expect("a header");
        // A function, or a pointer to one, and the comment before it.
        for (at, _) in text.match_indices(")(").chain(text.match_indices("OCB_EXPORT const")) {
            let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
            let comment = text[..line].rfind("/*").map_or("", |start| &text[start..line]);
            let words = comment.match_indices('[').map(|(open, _)| word(&comment[open..]));
            let marks: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            assert!(
                marks.len() == 1 && PHASES.contains(&marks[0]),
                "{}: {:?} has {marks:?}",
                header.display(),
                text[line..].lines().next()
            );
            functions += 1;
        }
    }
    assert!(functions >= 12, "{functions} functions found");
}

/// `[word]` at the beginning of a text, if it is one.
fn word(text: &str) -> &str {
    let end = text.find(']').unwrap_or(0);
    let letters = end > 1 && text[1..end].chars().all(|c| c.is_ascii_lowercase());
    if letters { &text[..=end] } else { "" }
}

#[test]
fn every_header_compiles_alone() {
    let include = support::package().join("include");
    let headers = headers(&include);
    assert!(headers.len() >= 4, "{headers:?}");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for header in headers {
        let name = header.strip_prefix(&include).expect("below include").display().to_string();
        let source = folder.path().join("alone.c");
        // Twice: the guards work.
        std::fs::write(&source, format!("#include <{name}>\n#include <{name}>\n")).expect("written");
        support::compile_as_every_standard(&source);
    }
}

#[test]
fn the_cpp_header_compiles_alone() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let source = folder.path().join("alone.cpp");
    std::fs::write(&source, "#include <opencollbench/plugin.hpp>\n#include <opencollbench/plugin.hpp>\n")
        .expect("written");
    support::compile_as(&[("c++", "c++17"), ("c++", "c++20")], &source);
}
