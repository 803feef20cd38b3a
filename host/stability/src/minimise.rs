//! As few triangles as still fail: delta debugging (Zeller and Hildebrandt 2002) on both objects in turn.

use std::sync::Arc;

use ocb_core::mesh::Mesh;
use ocb_core::reduce::reduce;

use crate::Posed;

/// Removes triangles as long as `fails` says that what is left still fails, and stops after so many attempts. The result is the last
/// that failed; `None` if not even the whole does. The first error ends the search.
pub fn minimise<E>(
    whole: &Posed,
    attempts: u32,
    mut fails: impl FnMut(&Posed) -> Result<bool, E>,
) -> Result<Option<Posed>, E> {
    if !fails(whole)? {
        return Ok(None);
    }
    let mut error = None;
    let mut fails = |posed: &Posed| {
        error.is_none()
            && fails(posed).unwrap_or_else(|e| {
                error = Some(e);
                false
            })
    };
    let (mut best, mut left) = (whole.clone(), attempts);
    loop {
        let before = size(&best);
        best.a = smaller(&best.a, &mut left, |a| fails(&best.with(a.clone(), best.b.clone())));
        best.b = smaller(&best.b, &mut left, |b| fails(&best.with(best.a.clone(), b.clone())));
        if left == 0 || size(&best) == before {
            return error.map_or(Ok(Some(best)), Err);
        }
    }
}

fn size(posed: &Posed) -> usize {
    posed.a.triangles().len() + posed.b.triangles().len()
}

/// One object, with as few of its triangles as still fail.
fn smaller(mesh: &Arc<Mesh>, left: &mut u32, mut fails: impl FnMut(&Arc<Mesh>) -> bool) -> Arc<Mesh> {
    let tries = *left as usize;
    let kept = reduce(mesh.triangles().len(), tries, |kept| {
        *left -= 1;
        keep(mesh, kept).is_some_and(|candidate| fails(&candidate))
    });
    let all = kept.len() == mesh.triangles().len();
    if all { mesh.clone() } else { keep(mesh, &kept).expect("triangles that were asked about") }
}

/// Some of the triangles, with the vertices that they use; `None` when that is no mesh.
fn keep(mesh: &Mesh, which: &[usize]) -> Option<Arc<Mesh>> {
    let mut numbers = vec![u32::MAX; mesh.positions().len()];
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for t in which.iter().map(|i| mesh.triangles()[*i]) {
        triangles.push(t.map(|i| {
            let number = &mut numbers[i as usize];
            if *number == u32::MAX {
                *number = positions.len() as u32;
                positions.push(mesh.positions()[i as usize]);
            }
            *number
        }));
    }
    Mesh::new(positions, triangles).ok().map(Arc::new)
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use nalgebra::Point3;
    use ocb_core::pose::Pose;
    use proptest::prelude::*;

    use super::*;
    use crate::shapes::ball;

    proptest! {
        #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

        /// A failure that needs certain triangles keeps exactly those.
        #[test]
        fn what_is_needed_stays_alone(needed in prop::collection::btree_set(0usize..128, 1..4), other in 0usize..32) {
            let (a, b) = (ball(2).mesh().unwrap(), ball(1).mesh().unwrap());
            let centre = |m: &Mesh, i: usize| {
                let [p, q, r] = m.corners(i as u32);
                p.coords + q.coords + r.coords
            };
            let wanted: Vec<_> = needed.iter().map(|&i| centre(&a, i)).collect();
            let wanted_b = centre(&b, other);
            let has = |m: &Mesh, c| (0..m.triangles().len()).any(|i| centre(m, i) == c);
            let small = minimise(&Posed::new(&a, &b, Pose::identity()), 2000, |posed| {
                Ok::<_, Infallible>(wanted.iter().all(|c| has(&posed.a, *c)) && has(&posed.b, wanted_b))
            });
            let small = small.unwrap().unwrap();
            prop_assert_eq!(small.a.triangles().len(), needed.len());
            prop_assert_eq!(small.b.triangles().len(), 1);
            prop_assert!(small.a.positions().iter().all(|p| *p != Point3::origin()));
        }
    }

    #[test]
    fn attempts_are_counted() {
        let a = ball(2).mesh().unwrap();
        let posed = Posed::new(&a, &a, Pose::identity());
        let mut asked = 0;
        let whole = |posed: &Posed| posed.a.triangles().len() == a.triangles().len();
        let small = minimise(&posed, 7, |posed| {
            asked += 1;
            Ok::<_, Infallible>(asked == 1 && whole(posed))
        });
        assert_eq!((small, asked), (Ok(Some(posed.clone())), 8));
        assert_eq!(minimise(&posed, 7, |_| Ok::<_, Infallible>(false)), Ok(None));
        assert_eq!(
            minimise(&posed, 7, |posed| if whole(posed) { Ok(true) } else { Err("the jail broke") }),
            Err("the jail broke")
        );
    }
}
