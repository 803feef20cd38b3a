//! Values that may stand in a file, so that no secret is in a command line, which all users of the machine can read, or in the
//! environment, which child processes get.

use std::path::Path;

use ocb_service::given;

/// Nothing that is read this way is longer.
const MOST: u64 = 16 << 10;

/// The value itself, or with `@FILE` what stands in the file, without the spaces and line breaks around it.
pub fn value(text: &str) -> Result<String, String> {
    let Some(file) = text.strip_prefix('@') else { return Ok(text.to_owned()) };
    let bytes = given::read(Path::new(file), MOST).map_err(|e| format!("cannot read {file}: {e}"))?;
    let text = String::from_utf8(bytes).map_err(|_| format!("{file} holds no text"))?;
    match text.trim() {
        "" => Err(format!("{file} is empty")),
        value => Ok(value.to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_stands_for_itself_or_in_a_file() {
        assert_eq!(value("postgres://a@b/c"), Ok("postgres://a@b/c".to_owned()));
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("database");
        let named = format!("@{}", file.display());
        assert!(value(&named).unwrap_err().starts_with("cannot read"));
        for (content, expected) in
            [("postgres://u:p@h/d\n", Some("postgres://u:p@h/d")), (" \n", None), ("\u{0}\u{0}", Some("\0\0"))]
        {
            std::fs::write(&file, content).unwrap();
            assert_eq!(value(&named).ok().as_deref(), expected, "{content:?}");
        }
        std::fs::write(&file, [b'x'; 20_000]).unwrap();
        assert!(value(&named).unwrap_err().contains("more than 16384 bytes"));
        std::fs::write(&file, [0xff]).unwrap();
        assert!(value(&named).unwrap_err().ends_with("holds no text"));
    }
}
