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
