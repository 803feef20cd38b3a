//! What the author says against what the file says.

use ocb_core::query::Query;
use ocb_sandbox::text::is_label;

use super::{Checking, query_name};
use crate::model::{CheckVerdict, Manifest};
use crate::{LabError, Result};

/// Letters of a manifest's texts.
const WORDS: usize = 500;
const VERSION: usize = 32;

/// A manifest that can be taken.
pub fn check_manifest(manifest: &Manifest) -> Result<()> {
    let bad = |what: String| Err(LabError::Invalid(format!("The manifest is not valid: {what}.")));
    let Manifest { name, version, authors, license, paper, source, queries, .. } = manifest;
    for (field, text) in [("name", name), ("authors", authors), ("license", license), ("version", version)] {
        if text.trim().is_empty() {
            return bad(format!("{field:?} is empty"));
        }
    }
    for (field, text) in
        [("name", name), ("authors", authors), ("license", license), ("paper", paper), ("source", source)]
    {
        if text.chars().count() > WORDS || !is_label(text) {
            return bad(format!(
                "{field:?} must be one line of at most {WORDS} characters, without < and > and without invisible \
                 characters"
            ));
        }
    }
    if version.len() > VERSION || !version.chars().all(|c| c.is_ascii_alphanumeric() || ".+-_".contains(c)) {
        return bad(format!("\"version\" has at most {VERSION} letters, digits and . + - _"));
    }
    if let Err(e) = spdx::Expression::parse(license) {
        return bad(format!("{license:?} is not an SPDX licence expression ({}), such as MIT OR Apache-2.0", e.reason));
    }
    if !source.is_empty() && !source.starts_with("https://") && !source.starts_with("http://") {
        return bad("\"source\" must be an address that begins with https://".into());
    }
    if queries.is_empty() {
        return bad("\"queries\" is empty; list the queries that the plugin answers".into());
    }
    Ok(())
}

/// Is one of the licences that the Open Source Initiative or the Free Software Foundation approves enough to use it?
pub fn is_free(license: &str) -> bool {
    let free = |requirement: &spdx::LicenseReq| {
        requirement.license.id().is_some_and(|id| id.is_osi_approved() || id.is_fsf_free_libre())
    };
    spdx::Expression::parse(license).is_ok_and(|expression| expression.evaluate(free))
}

impl Checking<'_> {
    /// Do manifest and descriptor say the same?
    pub(super) fn manifest(&mut self, manifest: &Manifest) {
        if let Err(e) = check_manifest(manifest) {
            self.line("manifest", CheckVerdict::Fail, e.to_string(), None);
            return;
        }
        let algorithms = &self.report.algorithms;
        let answered = |query: &Query| algorithms.iter().any(|a| a.queries.contains(query));
        let all = [Query::CollisionFirst, Query::CollisionAll, Query::Proximity];
        let odd = |said: bool| {
            let odd = all.iter().filter(|query| manifest.queries.contains(query) == said && answered(query) != said);
            odd.map(|query| query_name(*query)).collect::<Vec<_>>().join(", ")
        };
        let (missing, unsaid) = (odd(true), odd(false));
        let mut differs = Vec::new();
        if !unsaid.is_empty() {
            differs.push(format!("the file also answers {unsaid}"));
        }
        if algorithms.iter().any(|a| a.license != manifest.license) {
            differs.push("the file names another licence".to_owned());
        }
        if manifest.threads != algorithms.iter().any(|a| a.threads) {
            differs.push("manifest and file disagree about the multi-threaded track".to_owned());
        }
        if !missing.is_empty() {
            let evidence = format!("The manifest lists queries that the file does not answer: {missing}.");
            self.line("manifest", CheckVerdict::Fail, evidence, Some("Correct \"queries\" in the manifest."));
        } else if differs.is_empty() {
            self.line("manifest", CheckVerdict::Pass, "Manifest and descriptor agree.".into(), None);
        } else {
            let evidence = format!("Manifest and descriptor differ: {}.", differs.join("; "));
            self.line("manifest", CheckVerdict::Note, evidence, Some("Make them agree; a curator will ask."));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn manifest(change: impl Fn(&mut Manifest)) -> Manifest {
        let said =
            r#"{"name": "Zoë's tree", "version": "1.0", "authors": "Zoë", "license": "MIT", "queries": ["proximity"]}"#;
        let mut manifest = serde_json::from_str(said).expect("a manifest");
        change(&mut manifest);
        manifest
    }

    #[test]
    fn text_for_people_holds_no_markup_and_nothing_unseen() {
        assert!(check_manifest(&manifest(|_| {})).is_ok());
        let fields: [fn(&mut Manifest, &str); 5] = [
            |m, odd| m.name += odd,
            |m, odd| m.authors += odd,
            |m, odd| m.license += odd,
            |m, odd| m.paper += odd,
            |m, odd| m.source += odd,
        ];
        for set in fields {
            for odd in ["<b>", "\u{202e}", "\u{200b}", "\u{feff}", "\u{e000}", "\u{2028}", "\n"] {
                let refused = check_manifest(&manifest(|m| set(m, odd))).unwrap_err().to_string();
                assert!(refused.contains("without < and >"), "{odd:?}: {refused}");
            }
        }
    }
}
