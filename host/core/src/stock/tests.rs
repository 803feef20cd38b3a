use super::*;

/// Triangle counts from coarse to fine.
const LADDER: [u32; 9] = [500, 700, 1_000, 2_100, 5_000, 12_000, 30_000, 80_000, 200_000];

fn check(object: &StockObject, wish: u32) {
    let what = format!("{} with {wish} triangles", object.name);
    let mesh = generate(object.name, wish).unwrap();
    let got = mesh.triangles().len() as f64;
    assert!((got / f64::from(wish) - 1.0).abs() <= 0.1, "{what}: got {got}");
    assert!(mesh.is_closed(), "{what}: open");
    assert_eq!(mesh.degenerate_triangles(), 0, "{what}: degenerate triangles");
    assert!((mesh.bounds().diagonal() - 1.0).abs() < 1e-6, "{what}: size");
    assert!(mesh.bounds().center().coords.amax() < 1e-6, "{what}: not centred");
    assert!(
        mesh.positions().iter().flat_map(|p| p.coords.iter()).all(|&x| x == f64::from(x as f32)),
        "{what}: not f32"
    );
    assert!(every_vertex_used(&mesh), "{what}: unused vertices");
    assert!(wound_alike(&mesh), "{what}: winding");
}

fn every_vertex_used(mesh: &Mesh) -> bool {
    let mut used = vec![false; mesh.positions().len()];
    mesh.triangles().iter().flatten().for_each(|&i| used[i as usize] = true);
    used.into_iter().all(|u| u)
}

/// In a closed, consistently wound surface every edge runs once in each direction.
fn wound_alike(mesh: &Mesh) -> bool {
    let mut edges: Vec<(u32, u32)> = mesh.triangles().iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
    edges.sort_unstable();
    edges.windows(2).all(|w| w[0] != w[1]) && edges.iter().all(|&(a, b)| edges.binary_search(&(b, a)).is_ok())
}

#[test]
fn counts_shape_and_winding_hold_over_the_whole_range() {
    for object in list() {
        for wish in LADDER {
            check(object, wish);
        }
    }
}

#[test]
fn counts_between_the_steps_are_met_too() {
    for object in list() {
        for k in 0..80 {
            let wish = (500.0 * 1.04f64.powi(k)) as u32;
            let got = generate(object.name, wish).unwrap().triangles().len() as f64;
            assert!((got / f64::from(wish) - 1.0).abs() <= 0.1, "{}@{wish}: {got}", object.name);
        }
    }
}

#[test]
fn what_it_does_not_know_it_does_not_make() {
    assert!(generate("teapot", 1_000).is_none());
    assert!(generate("sphere", 499).is_none());
    assert!(generate("sphere", MAX_TRIANGLES + 1).is_none());
    for object in list() {
        assert!((object.lowest_triangles..=MAX_TRIANGLES).contains(&object.default_triangles), "{}", object.name);
    }
}

/// The same on every machine: a changed hash means other objects, and results no longer comparable to older ones.
#[test]
fn objects_never_change() {
    let hashes: Vec<String> = list()
        .iter()
        .flat_map(|o| [1_000, 20_000].map(|n| (o.name, n)))
        .map(|(name, n)| {
            let mesh = generate(name, n).unwrap();
            format!("{name}@{n}: {} triangles, {}", mesh.triangles().len(), &mesh.sha256()[..16])
        })
        .collect();
    insta::assert_snapshot!(hashes.join("\n"), @"
    castle@1000: 996 triangles, 80547124d1d10560
    castle@20000: 19906 triangles, 1a0fc3d835e7ef1f
    sponge@1000: 992 triangles, f13a72b57518eaa9
    sponge@20000: 19816 triangles, 7a47efcd7337193b
    pipes@1000: 1000 triangles, 6861e97f3a5632a6
    pipes@20000: 20020 triangles, 9bee9ffdf2debc9d
    lustre@1000: 994 triangles, fbb9801afa037fc2
    lustre@20000: 19986 triangles, 333ee4d647f88abd
    chair@1000: 1002 triangles, 288047fc6ba20a1c
    chair@20000: 19978 triangles, dcf3071e5502db79
    wreath@1000: 996 triangles, abdcbbde113faa25
    wreath@20000: 20044 triangles, cbaf9ee9f90a5ed2
    torus-knot@1000: 996 triangles, f8fc1dc7265585df
    torus-knot@20000: 20072 triangles, cd11658339325145
    gear@1000: 1024 triangles, 232a945b3eedca13
    gear@20000: 20094 triangles, e2a76bfe375f06d6
    sphere@1000: 1004 triangles, 6dbf9f637d3ed0f2
    sphere@20000: 20088 triangles, ec3c20dcac441440
    box@1000: 1020 triangles, cc92bd67fadf440b
    box@20000: 20060 triangles, 6ca875062815dc65
    ");
}
