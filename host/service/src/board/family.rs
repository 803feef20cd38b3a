//! What the hierarchy of a known algorithm is made of: its kind shares shape, colour and dash in a chart.

/// The families; the place in this list is the style.
const FAMILIES: [(&str, &[&str]); 8] = [
    (
        "axis-aligned boxes",
        &["box-tree", "restricted-box-tree", "parry", "parry-f32", "bullet", "ode", "cgal", "embree", "solid"],
    ),
    ("oriented boxes", &["obb-tree", "ocb-fast", "rapid", "v-collide", "fcl", "coal"]),
    ("swept spheres", &["rss-tree", "pqp"]),
    ("k-DOPs", &["dop-tree", "simdop"]),
    ("spheres", &["sphere-tree", "inner-spheres"]),
    ("convex bodies", &["convex", "convex-parts", "v-clip"]),
    ("fields and voxels", &["distance-field", "voxmap-pointshell"]),
    ("others", &[]),
];

/// The id without its settings: what different settings have in common.
pub fn base(algorithm: &str) -> &str {
    algorithm.split(':').next().unwrap_or(algorithm)
}

/// Style and name of an algorithm's family; what is not known here is among the others.
pub fn family(algorithm: &str) -> (u8, &'static str) {
    let base = base(algorithm);
    let place = FAMILIES.iter().position(|(_, members)| members.contains(&base)).unwrap_or(FAMILIES.len() - 1);
    (place as u8, FAMILIES[place].0)
}
