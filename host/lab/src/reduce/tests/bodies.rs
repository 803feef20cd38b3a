//! Bodies that have to contain what they stand for: levels that grow, and hulls of parts.

use super::*;

/// An object that is asked about at these places of a small ball: along x, in the unit of the object.
fn beside(object: Mesh, places: &[f64], kind: Kind) -> Recording {
    let mut recording = recording(queries(&[kind]));
    let mut meshes = HashMap::new();
    let geometry = SceneFile::keep(&mut meshes, object);
    recording.scene.meshes = meshes;
    recording.scene.scene.objects.truncate(2);
    recording.scene.scene.objects[0].geometry = geometry;
    recording.scene.scene.objects[1].geometry = Geometry::Sphere { radius: 0.01 };
    recording.queries.truncate(places.len());
    for (query, x) in recording.queries.iter_mut().zip(places) {
        query.objects = [0, 1];
        query.configuration.pose_b = Pose { translation: Vector3::x() * *x, ..Pose::identity() };
    }
    recording
}

/// Everything that stands for the first object contains it, and its distances are right within the tolerance.
fn holds(before: &Recording, after: &Reduced, terms: ReduceTerms) {
    let own = body::Body::surface(mesh_of(before, 0).expect("a mesh"));
    assert!(after.stand_ins[0].body.surrounds(&own));
    for (own, reduced) in truths(before).into_iter().zip(truths(&after.recording)) {
        assert!(reduced.distance_lo <= own.distance_hi + 1e-9);
        assert!(own.distance_lo - reduced.distance_hi <= terms.tolerance, "{own:?} {reduced:?}");
    }
}

#[test]
fn a_level_grows_until_it_contains_its_object() {
    let whole = ring(75, 40);
    let side = whole.longest_side();
    let levels = |_: &str, _: &Arc<Mesh>| {
        let levels = [ring(50, 30), ring(35, 20)].map(Arc::new);
        Ok(Some(Simplified { levels: levels.into(), ..Simplified::default() }))
    };
    for kind in [Kind::Distance, Kind::Collide] {
        // In the hole, where no convex body leaves room.
        let before = beside(whole.clone(), &[0.0, 0.05 * side], kind);
        let terms = ReduceTerms { tolerance: 0.05 * side, near: 0.0, outside_only: true, frontier: false };
        let after = done(&before, terms, &levels);
        assert_eq!(after.reduction.objects[0].body, BodyKind::Level, "{:?}", after.reduction.objects[0]);
        assert!(after.reduction.objects[0].after < 1000, "{:?}", after.reduction.objects[0]);
        holds(&before, &after, terms);
    }
    // Of an open object nothing says what its level contains.
    let open = Mesh::new(whole.positions().to_vec(), whole.triangles()[1..].to_vec()).expect("a mesh");
    let levels = |_: &str, object: &Arc<Mesh>| {
        let fewer = Mesh::new(object.positions().to_vec(), object.triangles()[2..].to_vec()).expect("a mesh");
        Ok(Some(Simplified { levels: vec![Arc::new(fewer)], ..Simplified::default() }))
    };
    let terms = ReduceTerms { tolerance: 0.05 * side, near: 0.0, outside_only: true, frontier: false };
    let after = done(&beside(open, &[0.0], Kind::Distance), terms, &levels);
    assert_eq!(after.reduction.objects[0].body, BodyKind::Object);
}

#[test]
fn hulls_of_parts_stand_for_what_no_single_body_fits() {
    let ball = stock::generate("sphere", 1000).expect("a sphere");
    let radius = ball.longest_side() / 2.0;
    let moved = |mesh: &Mesh, x: f64| -> Vec<Point3<f64>> {
        mesh.positions().iter().map(|p| p + Vector3::x() * x * radius).collect()
    };
    // Two balls, of which either is in a box, and a place between them.
    let number = ball.positions().len() as u32;
    let triangles =
        [ball.triangles().to_vec(), ball.triangles().iter().map(|t| t.map(|v| v + number)).collect()].concat();
    let balls = Mesh::new([moved(&ball, -3.0), moved(&ball, 3.0)].concat(), triangles).expect("a mesh");
    let cuboid = tessellate::outside(&Geometry::Box { size: [2.01 * radius; 3] }, 0.0).expect("a box");
    let in_boxes = |number: usize| {
        let cuboid = |x| Arc::new(Mesh::new(moved(&cuboid, x), cuboid.triangles().to_vec()).expect("a mesh"));
        let all = [-3.0, 3.0].map(cuboid);
        move |_: &str, _: &Arc<Mesh>| {
            Ok(Some(Simplified { parts: vec![all[..number].to_vec()], ..Simplified::default() }))
        }
    };
    let before = beside(balls, &[0.0, 0.5 * radius, 4.5 * radius], Kind::Distance);
    for outside_only in [true, false] {
        let terms = ReduceTerms { tolerance: 0.1 * radius, near: 0.0, outside_only, frontier: false };
        let after = done(&before, terms, &in_boxes(2));
        let body = &after.reduction.objects[0];
        assert_eq!((body.body, body.after), (BodyKind::Hulls, 24), "{body:?}");
        assert_eq!(after.stand_ins[0].hulls.len(), 2);
        holds(&before, &after, terms);
        // One of them leaves half of the object out.
        assert_eq!(done(&before, terms, &in_boxes(1)).reduction.objects[0].body, BodyKind::Object);
    }
}
