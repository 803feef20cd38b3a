//! Accounts on the data folder.

use crate::support::{Desk, Ended};

#[test]
fn an_account_is_made_and_deleted_and_its_name_is_given_to_nobody() {
    let desk = Desk::new();
    let create = |name: &str, role: &str| {
        let args = ["admin", "create", name, "--role", role, "--json"];
        desk.command(&args).env("OCB_PASSWORD", "a long enough password").output().expect("it starts")
    };
    assert!(create("ada", "developer").status.success() && create("root", "administrator").status.success());

    // Without a terminal and without --yes nothing goes, and it is told what would.
    let Ended { code, stdout, stderr } = desk.run(&["admin", "delete", "ada"]);
    assert_eq!((code, stdout.as_str()), (2, ""), "{stderr}");
    assert!(stderr.contains("runs: 0") && stderr.contains("Nothing was deleted; add --yes"), "{stderr}");
    let nothing = serde_json::json!({ "runs": 0, "objects": 0, "configurations": 0, "advice": 0, "stability": 0,
                            "workloads": 0, "plugins": 0 });
    let gone = desk.json(&["admin", "delete", "ADA", "--yes"]);
    assert_eq!((&gone["goes"], &gone["stays"], &gone["blocked_by"]), (&nothing, &nothing, &serde_json::Value::Null));
    assert!(desk.refused(&["admin", "delete", "ada", "--yes"]).contains("There is no account"));
    let again = create("Ada", "user");
    assert!(!again.status.success() && String::from_utf8_lossy(&again.stderr).contains("taken"), "{again:?}");

    let told = desk.refused(&["admin", "delete", "root", "--yes"]);
    assert!(told.contains("last administrator") && told.contains("ocb admin create"), "{told}");
    assert!(create("next", "administrator").status.success());
    let said = desk.run(&["admin", "delete", "root", "--yes"]).stdout;
    assert!(said.starts_with("The account root is deleted.") && said.contains("kept:    runs: 0"), "{said}");
    assert_eq!(desk.json(&["admin", "audit"])["whole"], true);
}
