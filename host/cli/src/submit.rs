//! `ocb submit`: sends a plugin to a service and tells what its check finds.

use std::process::ExitCode;
use std::time::Duration;

use ocb_service::MAX_PLUGIN_BYTES;
use ocb_service::model::{Manifest, PluginInfo};

use crate::args::SubmitArgs;
use crate::failure::{BAD_INPUT, Result};
use crate::service::Upload;
use crate::{open, output, plugin};

/// The most that a file with a signature has.
const MAX_SIGNATURE_BYTES: usize = 4 << 10;

/// How often the report is looked at.
const LOOK: Duration = Duration::from_secs(1);

/// Sends, then follows the check to its end.
pub async fn submit(args: &SubmitArgs, json: bool) -> Result<ExitCode> {
    let bytes = open::read_bounded(&args.file, MAX_PLUGIN_BYTES)?;
    // Read here first: a slip in it is told before anything is sent.
    let manifest: Manifest = plugin::json_file(&args.manifest)?;
    let service = args.service.service();
    let name = args.file.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let mut fields = vec![("manifest", output::to_json(&manifest)?)];
    if let Some(file) = &args.signature {
        let signature = open::read_bounded(file, MAX_SIGNATURE_BYTES)?;
        fields.push(("signature", String::from_utf8_lossy(&signature).into_owned()));
    }
    let upload = Upload { fields, file: (name, bytes) };
    let mut info: PluginInfo = service.upload("/api/v1/plugins", upload).await?;
    let mut told = 0;
    while info.state.is_checking() && !args.no_wait {
        told = tell(&info, told, json)?;
        tokio::time::sleep(LOOK).await;
        info = service.get(&format!("/api/v1/plugins/{}", info.id)).await?;
    }
    tell(&info, told, json)?;
    let page = service.address(&format!("/p/{}", info.id));
    if json {
        output::print_json(&info)?;
    } else {
        output::print(&format!("{}: {} {}", info.state.name(), info.reason, page))?;
    }
    let well = info.state.is_checking() || info.state.is_usable();
    Ok(if well { ExitCode::SUCCESS } else { ExitCode::from(BAD_INPUT) })
}

/// Prints the lines that are new; gives how many there are.
fn tell(info: &PluginInfo, told: usize, json: bool) -> Result<usize> {
    for line in info.lines.iter().skip(told).filter(|_| !json) {
        output::print(&plugin::line_text(line))?;
    }
    Ok(info.lines.len())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::args::ServiceArgs;
    use crate::failure::Failure;

    #[tokio::test]
    async fn a_service_that_is_not_there_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let (file, manifest) = (folder.path().join("x.so"), folder.path().join("m.json"));
        std::fs::write(&file, b"\x7fELF").unwrap();
        let said = r#"{"name": "x", "version": "1", "authors": "me", "license": "MIT", "queries": ["proximity"]}"#;
        std::fs::write(&manifest, said).unwrap();
        let service = ServiceArgs { server: "http://127.0.0.1:1".to_owned(), token: "t".into() };
        let mut args = SubmitArgs { file, manifest, signature: None, service, no_wait: true };
        let Err(Failure::Input(told)) = submit(&args, false).await else { panic!("it was sent") };
        assert!(told.contains("127.0.0.1:1"), "{told}");
        args.manifest = Path::new("/nonexistent").into();
        let Err(Failure::Input(told)) = submit(&args, false).await else { panic!("it was sent") };
        assert!(told.contains("/nonexistent"), "{told}");
    }
}
