//! `ocb visibility`: who sees a run or an object of yours on a service.

use std::process::ExitCode;

use ocb_service::model::{ObjectInfo, RunInfo, Visibility};
use serde_json::json;

use crate::args::{Shown, VisibilityArgs};
use crate::failure::Result;
use crate::output;

/// Tells the service, and says how it is then.
pub async fn visibility(args: &VisibilityArgs, json: bool) -> Result<ExitCode> {
    let resource = match args.what {
        Shown::Run => "runs",
        Shown::Object => "objects",
    };
    let path = format!("/api/v1/{resource}/{}/visibility", args.id);
    let asked = json!({ "visibility": Visibility::from(args.to) });
    let service = args.service.service();
    match args.what {
        Shown::Run => {
            let run: RunInfo = service.put(&path, &asked).await?;
            let name = format!("{} x {}", run.object_a_name, run.object_b_name);
            tell(&run, &name, run.visibility, json)
        }
        Shown::Object => {
            let object: ObjectInfo = service.put(&path, &asked).await?;
            tell(&object, &object.name, object.visibility, json)
        }
    }
}

fn tell(info: &impl serde::Serialize, name: &str, visibility: Visibility, json: bool) -> Result<ExitCode> {
    if json {
        output::print_json(info)?;
    } else {
        let who = match visibility {
            Visibility::Private => "visible only to you",
            Visibility::Unlisted => "visible to everyone who has the link",
            Visibility::Public => "visible to everyone",
        };
        output::print(&format!("{name}: {who}"))?;
    }
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::ServiceArgs;
    use crate::choice::VisibilityArg;
    use crate::failure::Failure;

    #[tokio::test]
    async fn the_sentence_of_the_service_is_told() {
        let listener = tokio::net::TcpListener::bind("127.0.0.1:0").await.unwrap();
        let server = format!("http://{}/", listener.local_addr().unwrap());
        let asked = tokio::spawn(async move {
            use tokio::io::{AsyncReadExt, AsyncWriteExt};
            let (mut stream, _) = listener.accept().await.unwrap();
            let mut request = vec![0; 4096];
            let mut length = 0;
            while !String::from_utf8_lossy(&request[..length]).contains('}') {
                length += stream.read(&mut request[length..]).await.unwrap();
            }
            let body = r#"{"detail": "There is no run \"x\"; check the link."}"#;
            let head = format!("HTTP/1.1 404 Not Found\r\ncontent-length: {}\r\n\r\n", body.len());
            stream.write_all(format!("{head}{body}").as_bytes()).await.unwrap();
            String::from_utf8_lossy(&request[..length]).into_owned()
        });
        let service = ServiceArgs { server, token: "t".into() };
        let args = VisibilityArgs { what: Shown::Run, id: "x".into(), to: VisibilityArg::Private, service };
        let Err(Failure::Input(told)) = visibility(&args, false).await else { panic!("it was told otherwise") };
        assert_eq!(told, "There is no run \"x\"; check the link.");
        let request = asked.await.unwrap();
        assert!(request.starts_with("PUT /api/v1/runs/x/visibility HTTP/1.1"), "{request}");
        assert!(request.contains("Bearer t") && request.contains(r#"{"visibility":"private"}"#), "{request}");
    }
}
