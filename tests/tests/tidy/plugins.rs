//! What the page of a plugin must tell.

use std::path::Path;

use ocb_tests::place::{root, text, tracked};

/// As headings or in bold, in any order.
const TOLD: [&str; 6] = ["method", "paper", "licence", "parameter", "good at", "known wrong answers"];

/// A folder that becomes a plugin: it exports an entry point, or holds a wrapper of its name in C++.
fn is_plugin(folder: &Path) -> bool {
    let name = folder.file_name().unwrap_or_default();
    let exports = text_of(&folder.join("src/lib.rs")).is_some_and(|text| text.contains("export!("));
    exports || text_of(&folder.join(name).with_extension("cpp")).is_some()
}

fn text_of(path: &Path) -> Option<String> {
    root().join(path).is_file().then(|| text(path)).flatten()
}

/// Headings and what is in bold, without what markup adds, in lower case.
fn told(page: &str) -> String {
    let headings = page.lines().filter_map(|line| line.strip_prefix("## "));
    let whole = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let bold = whole.split("**").skip(1).step_by(2);
    headings.chain(bold).collect::<Vec<_>>().join("; ").to_lowercase()
}

/// Numbers with points between them, like `5.5.1`.
fn is_version(word: &str) -> bool {
    let mut numbers = word.trim_end_matches(['.', ':']).split('.');
    word.contains('.') && numbers.all(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
}

#[test]
fn the_page_of_every_plugin_tells_what_it_is_good_and_bad_at_and_where_it_is_wrong() {
    let mut untold = Vec::new();
    let mut count = 0;
    for page in tracked().iter().filter(|path| path.ends_with("README.md") && path.starts_with("plugins")) {
        if !is_plugin(page.parent().expect("a folder")) {
            continue;
        }
        count += 1;
        let text = text_of(page).expect("a text");
        let told = told(&text);
        // Of a library that is wrapped, its first sentence says it; numbers further down are something else.
        let first = text.split("\n* ").next().unwrap_or_default();
        let version = told.contains("version") || first.split([' ', ',', '\n']).any(is_version);
        let missing = TOLD.into_iter().chain(["bad at"]).filter(|topic| !told.contains(topic));
        untold.extend(missing.map(|topic| format!("{}: {topic}", page.display())));
        untold.extend((!version).then(|| format!("{}: version", page.display())));
    }
    assert!(count >= 25, "{count} plugins");
    assert!(untold.is_empty(), "{untold:#?}");
}
