//! What others read out of our citations is what was put in, whatever that was.

use biblatex::{Bibliography, ChunksExt};
use ocb_citation::{Kind, Work, bibtex, cff};
use saphyr::{LoadableYamlNode, Yaml};

/// Titles and names that somebody would use to break out of the entry, or that a parser could misread.
const HOSTILE: [&str; 16] = [
    "A plain title",
    "}, author = {Mallory}}\n@book{other, title = {x}",
    "unbalanced { brace",
    "unbalanced } brace",
    "\\} behind a backslash \\{",
    "50 % of $x_1 ~ #1 & more^2",
    "\"quoted\" and 'quoted'",
    "@misc{x,",
    "key: value # no comment",
    "- a list\n- of two",
    "%YAML 1.2\n---\nauthors: []",
    "null",
    "2026-11-22",
    "!!python/object/apply:os.system [x]",
    "tab\there, bell\u{7}, line\u{2028}end, \u{feff}mark",
    "Zoë Ångström, 日本語, 🦀",
];

fn work(text: &str) -> Work {
    Work {
        kind: Kind::Software,
        key: "opencollbench-plugin-1".into(),
        title: text.into(),
        authors: vec!["Ada Lovelace".into(), text.into()],
        at_us: 1_795_305_599_000_000,
        url: "https://bench.example/p/1".into(),
        version: Some("1.2+b_3".into()),
        license: Some("MIT".into()),
        source: Some("https://code.example/x?a=1&b=%20".into()),
        summary: text.into(),
    }
}

/// As it may be seen: one line, and what cannot be printed is a space.
fn shown(text: &str) -> String {
    let odd = |c: char| c.is_control() || "\u{2028}\u{feff}".contains(c);
    text.chars().map(|c| if odd(c) { ' ' } else { c }).collect()
}

/// The commands that we write, back.
fn read(tex: &str) -> String {
    let commands = [
        ("textbraceleft", "{"),
        ("textbraceright", "}"),
        ("textasciitilde", "~"),
        ("textasciicircum", "^"),
        ("textbackslash", "\\"),
    ];
    let mut text = tex.to_owned();
    for (command, character) in commands {
        text = text.replace(&format!("\\{command}{{}}"), character);
    }
    for character in ["$", "&", "#", "_", "%"] {
        text = text.replace(&format!("\\{character}"), character);
    }
    text
}

#[test]
fn a_bibtex_entry_stays_one_with_its_fields() {
    for text in HOSTILE {
        let written = bibtex(&work(text));
        let parsed = Bibliography::parse(&written).unwrap_or_else(|e| panic!("{e}: {written}"));
        let keys: Vec<&str> = parsed.keys().collect();
        assert_eq!(keys, ["opencollbench-plugin-1"], "{written}");
        let entry = parsed.get("opencollbench-plugin-1").expect("the entry");
        let mut fields: Vec<&str> = entry.fields.keys().map(String::as_str).collect();
        fields.sort_unstable();
        assert_eq!(fields, ["author", "month", "note", "title", "url", "version", "year"], "{written}");
        assert_eq!(entry.author().expect("authors").len(), 2, "{written}");
        assert_eq!(entry.author().expect("authors")[0].name, "Lovelace");
        assert_eq!(entry.get("year").expect("a year").format_verbatim(), "2026");
        // Everything that a brace could end is there as it was written, in braces that balance.
        let title =
            written.lines().find_map(|line| line.strip_prefix("  title = {{")?.strip_suffix("}},")).expect("a title");
        let depth = title.chars().try_fold(0i32, |depth, c| {
            let depth = depth + i32::from(c == '{') - i32::from(c == '}');
            (depth >= 0).then_some(depth)
        });
        assert_eq!((depth, read(title)), (Some(0), shown(text)), "{written}");
    }
}

#[test]
fn a_cff_file_says_what_was_put_in() {
    for text in HOSTILE {
        let written = cff(&work(text));
        let documents = Yaml::load_from_str(&written).unwrap_or_else(|e| panic!("{e}: {written}"));
        assert_eq!(documents.len(), 1, "{written}");
        let file = &documents[0];
        let of = |field: &str| file[field].as_str().map(str::to_owned);
        assert_eq!(of("title").as_deref(), Some(&*shown(text)), "{written}");
        assert_eq!(of("abstract").as_deref(), Some(&*shown(text)), "{written}");
        assert_eq!(of("date-released").as_deref(), Some("2026-11-21"));
        assert_eq!(of("type").as_deref(), Some("software"));
        assert_eq!(of("repository-code").as_deref(), Some("https://code.example/x?a=1&b=%20"));
        let authors = file["authors"].as_sequence().expect("a list");
        let names: Vec<_> = authors.iter().map(|author| author["name"].as_str().expect("a name").to_owned()).collect();
        assert_eq!(names, ["Ada Lovelace".to_owned(), shown(text)], "{written}");
        assert_eq!(file.as_mapping().expect("a mapping").len(), 11, "{written}");
    }
}
