//! `ocb generate`.

use crate::support::Desk;

#[test]
fn a_set_is_found_written_and_used_again() {
    let desk = Desk::new();
    for (method, arguments) in [
        ("sphere", &["--count", "30", "--distance", "0.1"][..]),
        ("sphere", &["--paper-compat", "--rotate", "90", "--move", "120", "--step=-1e-6"]),
        ("grid", &["--count", "30", "--ladder", "--seed", "3"]),
        ("trajectory", &["--count", "30", "--center-distance", "0.8"]),
        ("random", &["--count", "30", "--hit-share", "0.4"]),
    ] {
        let file = desk.path("set.parquet").display().to_string();
        let all =
            [&["generate", "stock:chair@500", "stock:box@500", "-o", &file, "--method", method], arguments].concat();
        let first = desk.json(&all);
        let n = first["set"]["configurations"].as_u64().expect("a number");
        assert!((10..=200).contains(&n), "{first:#}");
        assert_eq!(first["reused"], false);
        assert!(first["per_second_and_core"].as_f64().is_some_and(|rate| rate > 0.0), "{first:#}");
        let written = std::fs::read(&file).expect("the file");
        assert!(written.starts_with(b"PAR1"));
        let again = desk.json(&all);
        assert_eq!((&again["reused"], &again["seconds"]), (&true.into(), &serde_json::Value::Null));
        assert_eq!(again["set"]["sha256"], first["set"]["sha256"]);
        assert_eq!(std::fs::read(&file).expect("the file"), written);
        let text = desk.run(&all).stdout;
        let sha256 = first["set"]["sha256"].as_str().expect("a hash");
        assert!(text.contains(sha256) && text.contains(method) && text.contains("closest features cover"), "{text}");
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let desk = Desk::new();
    let file = desk.path("set.parquet").display().to_string();
    let refused =
        |arguments: &[&str]| desk.refused(&[&["generate", "stock:chair@500", "-o", &file], arguments].concat());
    assert!(
        refused(&["--method", "random", "--distance", "1"]).contains("--distance does not belong to --method random")
    );
    assert!(refused(&["--method", "trajectory", "--seed", "1"]).contains("--seed does not belong"));
    assert!(refused(&["--hit-share", "0.5"]).contains("--hit-share does not belong"));
    assert!(refused(&["--step", "0.5"]).contains("a step must be"));
    assert!(refused(&["--step", "0.01", "--ladder"]).contains("cannot be used with"));
    assert!(refused(&["--count", "0"]).contains("number of configurations"));
    let nowhere = desk.path("no-folder/set.parquet").display().to_string();
    assert!(desk.refused(&["generate", "stock:chair@500", "-o", &nowhere]).contains("no such folder"));
    assert!(!desk.path("data").exists() && !desk.path("set.parquet").exists());
}

#[test]
fn poses_come_from_text_files() {
    let desk = Desk::new();
    let csv = desk.file("poses.csv", "# B in A's frame\n1,0,0,3,0,1,0,0,0,0,1,0\n1,0,0,0.1,0,1,0,0,0,0,1,0\n");
    let run =
        desk.json(&["bench", "stock:box@500", "--configurations", &csv, "--passes", "1", "--algorithm", "box-tree"]);
    assert_eq!(run["set"]["configurations"], 2, "{run:#}");
    assert_eq!(run["results"][0]["wrong"], 0, "{run:#}");
    let bad = desk.file("bad.csv", "1,0,0,3,0,1,0,0,0,0,1,0\n1,2\n");
    assert!(desk.refused(&["bench", "stock:box@500", "--configurations", &bad]).contains("line 2"));
}
