//! A plugin in Rust: every triangle of A against every triangle of B. Correct, and slow.
//!
//! Replace `Object`, `load_mesh` and `collide` by your own, and `ABOUT` by your name. The rest of the interface
//! (distances, all contacts, counting, parameters) is optional: implement the trait and name it in `export!`.
#![forbid(unsafe_code)]

use opencollbench_plugin::{About, Algorithm, Answer, Collision, Count, Mesh, Placed, Pose};

type Vector = [f64; 3];
type Triangle = [Vector; 3];

#[derive(Default)]
struct MyAlgorithm;

opencollbench_plugin::export!(MyAlgorithm);

impl Algorithm for MyAlgorithm {
    const ABOUT: About = About {
        id: c"my-algorithm-rust",
        name: c"My algorithm",
        authors: c"Me",
        license: c"MIT OR Apache-2.0",
        ..About::new()
    };

    /// Your data structure, made from one mesh.
    type Object = Vec<Triangle>;

    fn load_mesh(&mut self, mesh: Mesh<'_>) -> Answer<Vec<Triangle>> {
        Ok((0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle)).collect())
    }

    fn collide(&mut self, a: Placed<'_, Self>, b: Placed<'_, Self>, _work: &mut impl Count) -> Answer<Collision> {
        for (i, mine) in a.object.iter().enumerate() {
            let mine = place(a.pose, mine);
            for (j, other) in b.object.iter().enumerate() {
                if meet(&mine, &place(b.pose, other)) {
                    return Ok(Collision::Pair(i as u32, j as u32));
                }
            }
        }
        Ok(Collision::Apart)
    }
}

/// From the object's frame to the world.
fn place(pose: &Pose, triangle: &Triangle) -> Triangle {
    let (rotation, translation) = (pose.rotation(), pose.translation());
    triangle.map(|p| [0, 1, 2].map(|row| dot(rotation[row], p) + translation[row]))
}

/// Two convex sets are apart if and only if some direction separates them. For two triangles it is enough to try their
/// normals, the products of an edge of each, and, when they lie in one plane, the normals of the edges in that plane. The
/// directions made of `between` are for triangles without area, which are segments or points. Touching triangles meet.
fn meet(a: &Triangle, b: &Triangle) -> bool {
    let edges = |t: &Triangle| [sub(t[1], t[0]), sub(t[2], t[1]), sub(t[0], t[2])];
    let (edges_a, edges_b, between) = (edges(a), edges(b), sub(b[0], a[0]));
    let (normal_a, normal_b) = (cross(edges_a[0], edges_a[1]), cross(edges_b[0], edges_b[1]));
    let beside = |e: Vector| [cross(normal_a, e), cross(normal_b, e), cross(cross(e, between), e)];
    let mut axes = [normal_a, normal_b, between]
        .into_iter()
        .chain(edges_a.into_iter().chain(edges_b).flat_map(beside))
        .chain(edges_a.into_iter().flat_map(|e| edges_b.map(|f| cross(e, f))));
    !axes.any(|axis| separates(axis, a, b))
}

/// Whether a plane orthogonal to `axis` has all of a on one side and all of b on the other.
fn separates(axis: Vector, a: &Triangle, b: &Triangle) -> bool {
    let [in_a, in_b] = [a, b].map(|t| t.map(|p| dot(axis, sub(p, b[0]))));
    let min = |x: Vector| x[0].min(x[1]).min(x[2]);
    let max = |x: Vector| x[0].max(x[1]).max(x[2]);
    max(in_a) < min(in_b) || max(in_b) < min(in_a)
}

fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
