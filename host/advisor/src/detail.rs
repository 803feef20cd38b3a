//! Where on the objects detail is needed: the coarsest level that would have been enough, at each vertex.

use ocb_advice::{Detail, Question, Watch};
use ocb_core::configuration::Placed;
use ocb_core::heatmap::VertexMap;
use ocb_core::statistics::{Outliers, Statistic};
use rayon::prelude::*;

use crate::choice::Ladders;

/// For both objects; `None` when it was stopped. The levels are those where both objects are at the same step.
pub(crate) fn detail(
    ladders: &Ladders,
    question: Question,
    sample: &[Placed],
    watch: &dyn Watch,
) -> Option<[Detail; 2]> {
    let diagonal = ladders.diagonal();
    let enough = |placed: &Placed| {
        let coarsest = diagonal.iter().rev().find(|levels| ladders.suffice(**levels, question, placed));
        (!watch.stopped()).then(|| *coarsest.unwrap_or(&[0, 0]))
    };
    let enough: Vec<[usize; 2]> = sample.par_iter().map(enough).collect::<Option<_>>()?;
    let side = |side: usize| {
        let levels = [ladders.a, ladders.b][side];
        let witness = |placed: &Placed| [placed.truth.witness.triangle_a, placed.truth.witness.triangle_b][side];
        let map = VertexMap::new(&levels[0].mesh, &sample.iter().map(witness).collect::<Vec<_>>());
        let values: Vec<f64> = enough.iter().map(|at| levels[at[side]].mesh.triangles().len() as f64).collect();
        let found = map.aggregate(&values, Statistic::Max, Outliers::Keep);
        Detail { triangles: found.values, counts: found.counts }
    };
    Some([side(0), side(1)])
}
