//! The further questions of a relation.

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};
use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::pose::Pose;

use super::{Relation, Said};
use crate::Posed;
use crate::draw::Draw;
use crate::shapes::Soup;

pub fn derive(relation: Relation, base: &Posed, said: &Said, at: f64, draw: &mut Draw) -> Vec<Posed> {
    let Configuration { pose_a, pose_b } = base.configuration;
    let both = |change: &dyn Fn(&Pose) -> Pose| Posed {
        configuration: Configuration { pose_a: change(&pose_a), pose_b: change(&pose_b) },
        ..base.clone()
    };
    let moved = |by: Vector3<f64>| {
        let mut posed = base.clone();
        posed.configuration.pose_b.translation += by;
        posed
    };
    let remade = |a: Option<Arc<Mesh>>, b: Option<Arc<Mesh>>| match (a, b) {
        (Some(a), Some(b)) => vec![base.with(a, b)],
        _ => Vec::new(),
    };
    // From A's nearest point to B's.
    let line = said.points.map(|[p, q]| q - p).filter(|line| line.norm() > 0.0).map(|line| line.normalize());
    match relation {
        Relation::Swap => vec![Posed {
            a: base.b.clone(),
            b: base.a.clone(),
            configuration: Configuration { pose_a: pose_b, pose_b: pose_a },
        }],
        Relation::Unit => {
            let factor = 2f64.powi(at as i32);
            let times = |mesh: &Mesh| Soup::from_mesh(mesh).map(|p| p * factor).exact().ok();
            let poses = both(&|pose| Pose { translation: pose.translation * factor, ..*pose });
            match (times(&base.a), times(&base.b)) {
                (Some(a), Some(b)) => vec![poses.with(a, b)],
                _ => Vec::new(),
            }
        }
        Relation::Axes => {
            let map = signed_axes(draw);
            vec![both(&|pose| Pose { linear: map * pose.linear, translation: map * pose.translation })]
        }
        Relation::Translation => {
            let by = draw.direction().map(|x| (x * at).round());
            vec![both(&|pose| Pose { translation: pose.translation + by, ..*pose })]
        }
        Relation::Rotation => {
            let turn = draw.rotation();
            vec![both(&|pose| Pose { linear: turn * pose.linear, translation: turn * pose.translation })]
        }
        Relation::Numbering => {
            let (a, b) = (renumbered(&base.a, draw), renumbered(&base.b, draw));
            remade(a, b)
        }
        Relation::Subset => {
            let half = parts(&base.a).swap_remove(0);
            remade(half, Some(base.b.clone()))
        }
        Relation::Union => {
            let halves: Option<Vec<Arc<Mesh>>> = parts(&base.a).into_iter().collect();
            let halves = halves.unwrap_or_default();
            halves.into_iter().map(|half| base.with(half, base.b.clone())).collect()
        }
        Relation::Moved => vec![moved(draw.direction() * at)],
        Relation::Turned => {
            let (sine, cosine) = libm::sincos(at);
            let turn = Matrix3::new(cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0);
            let mut posed = base.clone();
            posed.configuration.pose_b.linear = turn * pose_b.linear;
            vec![posed]
        }
        Relation::Away => line.map(|line| moved(line * at)).into_iter().collect(),
        Relation::Approach => {
            let way = said.distance.unwrap_or(0.0) * at;
            line.map(|line| moved(-line * way)).into_iter().collect()
        }
        Relation::Subdivision => {
            let cut = |mesh: &Mesh| Soup::from_mesh(mesh).subdivided().exact().ok();
            remade(cut(&base.a), cut(&base.b))
        }
        Relation::Again => vec![base.clone()],
        Relation::Consistency | Relation::FirstAndAll | Relation::Witness => Vec::new(),
    }
}

/// One of the 24 turns of the cube but the one that does nothing.
fn signed_axes(draw: &mut Draw) -> Matrix3<f64> {
    loop {
        let mut order = [0, 1, 2];
        draw.shuffle(&mut order);
        let signs = [(); 3].map(|()| if draw.coin() { 1.0 } else { -1.0 });
        let map = Matrix3::from_fn(|i, j| if order[i] == j { signs[i] } else { 0.0 });
        if map.determinant() > 0.0 && map != Matrix3::identity() {
            return map;
        }
    }
}

fn renumbered(mesh: &Mesh, draw: &mut Draw) -> Option<Arc<Mesh>> {
    let soup = Soup::from_mesh(mesh);
    let mut order: Vec<u32> = (0..soup.positions.len() as u32).collect();
    draw.shuffle(&mut order);
    let mut positions = soup.positions.clone();
    order.iter().zip(&soup.positions).for_each(|(&to, p)| positions[to as usize] = *p);
    let mut triangles: Vec<[u32; 3]> = soup.triangles.iter().map(|t| t.map(|i| order[i as usize])).collect();
    let twice: Vec<[u32; 3]> = triangles.iter().copied().filter(|_| draw.below(4) == 0).collect();
    triangles.extend(twice);
    triangles.iter_mut().for_each(|t| draw.shuffle(t));
    draw.shuffle(&mut triangles);
    Soup { positions, triangles }.exact().ok()
}

/// Two halves; either may be no mesh.
fn parts(mesh: &Mesh) -> Vec<Option<Arc<Mesh>>> {
    let (first, second) = mesh.triangles().split_at(mesh.triangles().len() / 2);
    let part = |triangles: &[[u32; 3]]| Mesh::new(mesh.positions().to_vec(), triangles.to_vec()).ok().map(Arc::new);
    vec![part(first), part(second)]
}
