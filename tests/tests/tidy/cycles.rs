//! No module of the service imports, directly or through others, a module that imports it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use ocb_tests::place::{text, tracked};

const SERVICE: &str = "host/service/src";

/// A module by its path below the crate; the crate itself is the empty path.
type Module = Vec<String>;

/// Modules with those that they import.
type Imports = BTreeMap<Module, BTreeSet<Module>>;

/// The modules of the service with their sources, without those that only tests see.
fn sources() -> BTreeMap<Module, String> {
    let files = tracked().into_iter().filter_map(|path| {
        let module = path.strip_prefix(SERVICE).ok()?.with_extension("");
        let names: Module = module.iter().map(|name| name.to_string_lossy().into_owned()).collect();
        let rust = path.extension().is_some_and(|e| e == "rs");
        (rust && !names.iter().any(|name| name == "tests" || name == "lib")).then(|| (names, sound(&path)))
    });
    files.collect()
}

/// The text of a file without its comments and its module of tests.
fn sound(path: &Path) -> String {
    let text = text(path).expect("a text");
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    code.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// Every path of a `use` tree: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn flattened(tree: &str, before: &[String], found: &mut Vec<Module>) {
    let (head, inner) = tree.split_once('{').unwrap_or((tree, ""));
    let names =
        head.split(" as ").next().unwrap_or_default().split("::").map(str::trim).filter(|name| !name.is_empty());
    let path: Module = before.iter().cloned().chain(names.map(str::to_owned)).collect();
    let Some(inner) = inner.trim_end().strip_suffix('}') else { return found.push(path) };
    let (mut depth, mut start) = (0_usize, 0);
    for (at, letter) in inner.char_indices().chain([(inner.len(), ',')]) {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                let part = inner[start..at].trim();
                (!part.is_empty()).then(|| flattened(part, &path, found));
                start = at + 1;
            }
            _ => {}
        }
    }
}

/// The paths behind each `crate::` or `super::`, in imports and elsewhere.
fn named(source: &str) -> Vec<Module> {
    let mut found = Vec::new();
    for statement in source.split(';') {
        let import = statement
            .rsplit_once("use ")
            .filter(|(before, _)| before.trim_end().is_empty() || before.ends_with("pub "));
        match import.or_else(|| statement.rsplit_once("\nuse ")).or_else(|| statement.rsplit_once("\npub use ")) {
            Some((_, tree)) => flattened(tree.trim(), &[], &mut found),
            None => {
                let word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
                let paths =
                    statement.split(|c| !word(c)).filter(|p| p.starts_with("crate::") || p.starts_with("super::"));
                paths.for_each(|path| flattened(path, &[], &mut found));
            }
        }
    }
    found
}

fn imports(sources: &BTreeMap<Module, String>) -> Imports {
    let of = |module: &Module, source: &str| {
        let whole = |path: Module| -> Module {
            let up = path.iter().take_while(|name| *name == "super").count();
            match path[0].as_str() {
                "crate" => path[1..].to_vec(),
                "super" => [&module[..module.len().saturating_sub(up)], &path[up..]].concat(),
                _ => [&module[..], &path[..]].concat(),
            }
        };
        let modules = named(source).into_iter().filter(|path| !path.is_empty()).map(whole);
        // The longest beginning of the path that is a module.
        let modules = modules
            .filter_map(|path| (1..=path.len()).rev().map(|n| path[..n].to_vec()).find(|p| sources.contains_key(p)));
        modules.filter(|other| other != module).collect()
    };
    sources.iter().map(|(module, source)| (module.clone(), of(module, source))).collect()
}

/// A way from a module back to itself, as text.
fn cycle(imports: &Imports) -> Option<String> {
    let mut known = imports.clone();
    // Modules that import nothing that is left are in no cycle.
    loop {
        let left: BTreeSet<Module> = known.keys().cloned().collect();
        known.retain(|_, others| others.iter().any(|other| left.contains(other)));
        if known.len() == left.len() {
            break;
        }
    }
    let (mut way, mut at) = (Vec::new(), known.keys().next()?.clone());
    while !way.contains(&at) {
        way.push(at.clone());
        at = known[&at].iter().find(|other| known.contains_key(*other)).expect("it imports one that is left").clone();
    }
    way.push(at);
    Some(way.iter().map(|module| module.join("::")).collect::<Vec<_>>().join(" -> "))
}

#[test]
fn no_module_of_the_service_imports_itself_through_others() {
    let sources = sources();
    assert!(sources.len() > 80, "only {} modules: has the service moved?", sources.len());
    let imports = imports(&sources);
    let edges: usize = imports.values().map(BTreeSet::len).sum();
    assert!(edges > 200, "only {edges} imports are seen");
    let found = cycle(&imports);
    assert!(found.is_none(), "{}", found.unwrap_or_default());
}

#[test]
fn a_cycle_of_imports_is_found() {
    let mut sources = sources();
    let planted = |module: &str, line: &str, sources: &mut BTreeMap<Module, String>| {
        sources.get_mut(&vec![module.to_owned()]).expect("a module").push_str(line);
    };
    planted("store", "\nuse crate::{Result, runs::{self, queue::Granted}};\n", &mut sources);
    let found = cycle(&imports(&sources)).expect("a planted cycle");
    assert!(found.contains("store"), "{found}");
    let mut sources = self::sources();
    planted("audit", "\nfn f() { super::accounts::log_in(); }\n", &mut sources);
    assert!(cycle(&imports(&sources)).expect("a planted cycle").contains("audit"));
}
