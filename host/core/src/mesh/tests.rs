use super::*;

fn p(x: f64, y: f64, z: f64) -> Point3<f64> {
    Point3::new(x, y, z)
}

fn tetrahedron() -> (Vec<Point3<f64>>, Vec<[u32; 3]>) {
    let positions = vec![p(0., 0., 0.), p(1., 0., 0.), p(0., 2., 0.), p(0., 0., 3.)];
    (positions, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
}

#[test]
fn a_tetrahedron_is_closed_and_knows_its_box() {
    let (positions, triangles) = tetrahedron();
    let mesh = Mesh::new(positions, triangles).unwrap();
    assert!(mesh.is_closed());
    assert_eq!(mesh.bounds(), Aabb { min: p(0., 0., 0.), max: p(1., 2., 3.) });
    assert_eq!(mesh.longest_side(), 3.0);
    assert_eq!(mesh.degenerate_triangles(), 0);
}

#[test]
fn a_missing_triangle_opens_it() {
    let (positions, mut triangles) = tetrahedron();
    triangles.pop();
    assert!(!Mesh::new(positions, triangles).unwrap().is_closed());
}

#[test]
fn closedness_is_about_places_not_numbers() {
    let (positions, triangles) = tetrahedron();
    let soup =
        triangles.iter().flatten().map(|&i| positions[i as usize].map(|x| if x == 0.0 { -x } else { x })).collect();
    let numbers = (0..4).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    assert!(Mesh::new(soup, numbers).unwrap().is_closed());
}

#[test]
fn unused_vertices_keep_their_numbers_and_stay_out_of_the_box() {
    let (mut positions, mut triangles) = tetrahedron();
    positions.insert(0, p(100., 0., 0.));
    triangles.iter_mut().flatten().for_each(|i| *i += 1);
    let mesh = Mesh::new(positions, triangles).unwrap();
    assert_eq!(mesh.positions().len(), 5);
    assert_eq!(mesh.bounds().max, p(1., 2., 3.));
}

#[test]
fn degenerate_triangles_stay_and_are_counted() {
    let (mut positions, mut triangles) = tetrahedron();
    positions.push(p(2., 0., 0.));
    triangles.extend([[0, 1, 4], [2, 2, 3], [1, 1, 1]]);
    let mesh = Mesh::new(positions, triangles).unwrap();
    assert_eq!((mesh.triangles().len(), mesh.degenerate_triangles()), (7, 3));
}

#[test]
fn very_small_triangles_have_area() {
    let positions = vec![p(0., 0., 0.), p(1e-200, 0., 0.), p(0., 1e-200, 0.)];
    let mesh = Mesh::new(positions, vec![[0, 1, 2]]).unwrap();
    assert_eq!(mesh.clone().to_f32_representable(), Err(MeshError::NoArea));
}

#[test]
fn each_fault_has_its_error() {
    let (good, triangles) = tetrahedron();
    let with = |x: f64| {
        let mut positions = good.clone();
        positions[2].y = x;
        Mesh::new(positions, triangles.clone()).unwrap_err()
    };
    assert_eq!(Mesh::new(good.clone(), vec![]), Err(MeshError::NoTriangles));
    assert_eq!(with(f64::NAN), MeshError::NotFinite { vertex: 2 });
    assert_eq!(with(f64::INFINITY), MeshError::NotFinite { vertex: 2 });
    assert_eq!(with(1e39), MeshError::TooFar { vertex: 2 });
    let error = Mesh::new(good.clone(), vec![[0, 1, 2], [1, 2, 4]]).unwrap_err();
    assert_eq!(error, MeshError::IndexOutOfRange { triangle: 1, index: 4, vertices: 4 });
    assert_eq!(error.to_string(), "triangle 1 refers to vertex 4, but the vertices are 0 to 3; correct the index");
    assert_eq!(Mesh::new(good, vec![[0, 0, 1], [2, 2, 2]]), Err(MeshError::NoArea));
}

#[test]
fn rounding_to_single_precision_happens_once() {
    let (positions, triangles) = tetrahedron();
    let third = Mesh::new(positions.iter().map(|p| p / 3.0).collect(), triangles).unwrap();
    let once = third.to_f32_representable().unwrap();
    assert_eq!(once.positions()[1].x, f64::from(1f32 / 3f32));
    assert_eq!(once.clone().to_f32_representable().unwrap(), once);
}

#[test]
fn the_hash_is_over_little_endian_numbers() {
    let mesh = Mesh::new(vec![p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)], vec![[0, 1, 2]]).unwrap();
    let mut bytes = [0f64, 0., 0., 1., 0., 0., 0., 1., 0.].map(f64::to_le_bytes).concat();
    bytes.extend([0u32, 1, 2].map(u32::to_le_bytes).concat());
    let expected: String = Sha256::digest(&bytes).iter().map(|b| format!("{b:02x}")).collect();
    assert_eq!(mesh.sha256(), expected);
}

#[test]
fn a_small_object_far_from_the_origin_is_no_object_of_single_precision() {
    let far = |size: f64| {
        let positions = tetrahedron().0.iter().map(|q| p(q.x * size + 1e6, q.y * size, q.z * size + 1e6)).collect();
        Mesh::new(positions, tetrahedron().1).unwrap()
    };
    assert!(far(1.0).is_f32_representable() && !far(0.01).is_f32_representable());
    assert_eq!(far(0.01).to_f32_representable(), Err(MeshError::NoArea));
}
