//! Objects: lists, meshes, uploads good and bad.

use futures::stream;
use reqwest::{Body, StatusCode};
use serde_json::Value;

use crate::support::{Guest, Service, header, problem};

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

#[tokio::test]
async fn stock_objects_are_listed_and_drawn() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let objects = guest.json("/api/v1/objects").await;
    let ids: Vec<&str> =
        objects.as_array().expect("a list").iter().filter_map(|object| object["id"].as_str()).collect();
    assert!(ids.iter().any(|id| id.starts_with("stock:torus-knot")), "{ids:?}");

    let object = guest.json("/api/v1/objects/stock:sphere@500").await;
    assert_eq!(object["stock"], true);
    let (glb, media_type) = guest.bytes("/api/v1/objects/stock:sphere@500/mesh.glb").await;
    assert_eq!((&glb[..4], media_type.as_str()), (&b"glTF"[..], "model/gltf-binary"));

    let tag = format!("\"{}\"", object["sha256"].as_str().expect("a hash"));
    let again = guest.get("/api/v1/objects/stock:sphere@500/mesh.glb").header("if-none-match", tag).send().await;
    assert_eq!(again.expect("an answer").status(), StatusCode::NOT_MODIFIED);
    service.stop().await;
}

#[tokio::test]
async fn an_upload_belongs_to_its_guest() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let (guest, other) = (service.guest(), service.guest());
    let response = guest.upload("../../my\u{202e}shape.obj", TETRAHEDRON).await;
    assert_eq!(response.status(), StatusCode::CREATED);
    let object: Value = response.json().await.expect("JSON");
    assert_eq!(object["name"], "myshape");
    assert_eq!((&object["triangles"], &object["closed"]), (&4.into(), &true.into()));

    let id = object["id"].as_str().expect("an id");
    assert!(own_objects(&guest).await.contains(&id.to_owned()));
    assert!(own_objects(&other).await.is_empty());
    assert_eq!(other.json(&format!("/api/v1/objects/{id}")).await["triangles"], 4);
    service.stop().await;
}

async fn own_objects(guest: &Guest) -> Vec<String> {
    let objects = guest.json("/api/v1/objects").await;
    let own = objects.as_array().expect("a list").iter().filter(|object| object["stock"] == false);
    own.filter_map(|object| object["id"].as_str().map(str::to_owned)).collect()
}

#[tokio::test]
async fn bad_files_get_a_sentence_and_leave_nothing() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let cases: [(&str, Vec<u8>, &str); 9] = [
        ("empty.obj", Vec::new(), "empty"),
        ("junk.obj", (0..4096u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect(), ""),
        ("nan.obj", TETRAHEDRON.replace("v 1 0 0", "v nan 0 0").into(), "line 2"),
        ("range.obj", TETRAHEDRON.replace("f 1 3 2", "f 1 3 99").into(), "line 5"),
        ("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n".into(), "face"),
        ("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".into(), "area"),
        ("huge.obj", TETRAHEDRON.replace("v 1 0 0", "v 1e300 0 0").into(), "line 2"),
        ("note.txt", "No format that is read.\n".into(), "OBJ, STL, PLY, OFF, glTF, GLB, COLLADA"),
        ("cut.ply", "ply\nformat ascii 1.0\nelement vertex 8\n".into(), "line 4"),
    ];
    for (name, bytes, expected) in cases {
        let detail = problem(guest.upload(name, bytes).await, 422).await;
        assert!(detail.contains(expected), "{name}: {detail}");
    }
    assert!(own_objects(&guest).await.is_empty());
    service.stop().await;
}

#[tokio::test]
async fn a_form_without_a_file_is_refused() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    let other_field = reqwest::multipart::Form::new().text("name", "x");
    let response = guest.post("/api/v1/objects").multipart(other_field).send().await.expect("an answer");
    assert!(problem(response, 400).await.contains("\"file\""));
    let response = guest.post("/api/v1/objects").body(TETRAHEDRON).send().await.expect("an answer");
    assert!(problem(response, 400).await.contains("multipart/form-data"));
    let cut = guest.post("/api/v1/objects").header("content-type", "multipart/form-data; boundary=x");
    let cut =
        cut.body("--x\r\nContent-Disposition: form-data; name=\"file\"\r\n\r\nv 0").send().await.expect("an answer");
    problem(cut, 400).await;
    service.stop().await;
}

/// The client sends all of it and only then reads: it must find the answer, not a reset connection.
#[tokio::test]
async fn three_hundred_megabytes_get_a_413() {
    let service = Service::start_with(&["libocb_box_tree.so", "libocb_brute_force.so"]).await;
    let guest = service.guest();
    const CHUNK: usize = 1 << 20;
    let head = "--x\r\nContent-Disposition: form-data; name=\"file\"; filename=\"big.obj\"\r\n\r\n";
    let total = head.len() + 300 * CHUNK;
    let body = || {
        let chunks = std::iter::once(head.as_bytes().to_vec()).chain((0..300).map(|_| vec![b'#'; CHUNK]));
        Body::wrap_stream(stream::iter(chunks.map(Ok::<_, std::io::Error>)))
    };
    for declared in [true, false] {
        let mut request = guest.post("/api/v1/objects").header("content-type", "multipart/form-data; boundary=x");
        if declared {
            request = request.header("content-length", total);
        }
        let response = request.body(body()).send().await.expect("an answer, not a reset");
        assert_ne!(header(&response, "content-security-policy"), "");
        assert!(problem(response, 413).await.contains("256 MiB"));
    }
    assert!(own_objects(&guest).await.is_empty());
    service.stop().await;
}
