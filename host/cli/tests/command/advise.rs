//! `ocb advise`: advice, its files, and certificates that hold or do not.

use std::io::{BufRead, BufReader, Read};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

use crate::support::Desk;

const SCENE: [&str; 3] = ["advise", "stock:torus-knot@1500", "stock:sphere@1000"];

#[test]
fn advice_comes_with_reduced_objects_whose_certificates_hold() {
    let desk = Desk::new();
    let folder = desk.path("advice");
    let out = folder.to_str().expect("text");
    let few = ["--tolerance", "5%", "--configurations", "40", "--held-out", "60", "--out", out];
    let advice = desk.json(&[&SCENE[..], &few].concat());
    let number = |of: &Value| of.as_u64().unwrap_or_else(|| panic!("no number: {of}"));
    assert!(number(&advice["triangles_after"]) * 2 <= number(&advice["triangles_before"]), "{}", advice["stages"]);
    let side = advice["longest_side"].as_f64().expect("a length");
    let length = |of: &Value| of.as_f64().unwrap_or_else(|| panic!("no length: {of}"));
    assert!(length(&advice["guaranteed_error"]) <= 0.05 * side, "{}", advice["guaranteed_error"]);
    let held = &advice["held_out"];
    assert_eq!((&held["wrong"]["seen"], &held["violations"]["seen"]), (&0.into(), &0.into()), "{held}");
    assert!(length(&held["observed_error"]) <= 0.05 * side, "{held}");
    let kinds: Vec<&str> =
        advice["points"].as_array().expect("points").iter().filter_map(|p| p["kind"].as_str()).collect();
    for kind in
        ["whole", "same_question", "levels", "advised", "yes_no", "hulls", "boxes", "convex_parts", "inner_spheres"]
    {
        assert!(kinds.contains(&kind), "{kind} of {kinds:?}");
    }

    let certificates: Vec<_> = std::fs::read_dir(&folder)
        .expect("the folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.to_string_lossy().ends_with(".certificate.json"))
        .collect();
    assert!(!certificates.is_empty());
    for certificate in &certificates {
        let file = certificate.to_str().expect("text");
        let said = desk.run(&["advise", "--verify", file]);
        assert_eq!(said.code, 0, "{said:?}");
        assert!(said.stdout.starts_with("The certificate holds"), "{said:?}");
        // Less deviation than there is.
        let mut planted: Value = serde_json::from_slice(&std::fs::read(certificate).expect("it")).expect("JSON");
        let deviations = planted["deviation"].as_array_mut().expect("a list");
        deviations.iter_mut().for_each(|g| *g = (0.5 * g.as_f64().expect("a length")).into());
        std::fs::write(certificate, planted.to_string()).expect("written");
        let said = desk.run(&["advise", "--verify", file]);
        assert_eq!(said.code, 3, "{said:?}");
        assert!(said.stdout.contains("does not hold: the point"), "{said:?}");
    }
    assert!(std::fs::metadata(folder.join("a-detail.ply")).is_ok_and(|file| file.len() > 1000));
}

#[test]
fn a_clearance_is_answered_exactly_and_told_as_a_card() {
    let desk = Desk::new();
    let few = ["--question", "clearance=0.2mm", "--configurations", "48", "--held-out", "96"];
    let said = desk.run(&[&SCENE[..], &few].concat());
    assert_eq!(said.code, 0, "{said:?}");
    for words in [
        "Query: distance greater than 2.0000e-1",
        "Held out: 0 of 96",
        "boxes (uncertified)",
        "ADVISED",
        "times faster",
        " spheres ",
        "Left out: voxmap-pointshell:voxel=0.01 (A: the clearance is",
        "in f32, parry-f32",
    ] {
        assert!(said.stdout.contains(words), "{words}: {}", said.stdout);
    }
}

#[test]
fn what_cannot_be_asked_is_refused_in_one_sentence() {
    let desk = Desk::new();
    for (args, word) in [
        (&["--tolerance", "0"][..], "tolerance"),
        (&["--tolerance", "much"], "much"),
        (&["--question", "touch"], "touch"),
        (&["--question", "clearance=-1"], "clearance"),
        (&["--distance", "0.1,-3"], "-3"),
        (&["--configurations", "2"], "configurations"),
    ] {
        let told = desk.refused(&[&SCENE[..], args].concat());
        assert!(told.contains(word), "{args:?}: {told}");
    }
    let no_certificate = desk.file("x.json", "{}");
    assert!(desk.refused(&["advise", "--verify", &no_certificate]).contains("is not a certificate"));
}

#[test]
fn ctrl_c_ends_it_and_nothing_is_written() {
    let desk = Desk::new();
    let folder = desk.path("advice");
    let args = ["advise", "stock:torus-knot@60000", "--out", folder.to_str().expect("text")];
    let mut child = desk.command(&args).spawn().expect("it starts");
    // The first line says that the work is under way. Somebody reads on until the end.
    let mut line = String::new();
    let mut stderr = BufReader::new(child.stderr.take().expect("stderr"));
    stderr.read_line(&mut line).expect("a line");
    assert!(line.contains('/'), "{line}");
    kill(Pid::from_raw(child.id() as i32), Signal::SIGINT).expect("it is there");
    let mut rest = String::new();
    stderr.read_to_string(&mut rest).expect("text");
    assert_eq!(child.wait().expect("it ends").code(), Some(130), "{rest}");
    assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 0);
}
