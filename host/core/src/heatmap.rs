//! Measured values on the vertices of an object [OpenCollBench 2020, 3.2].
//!
//! Each configuration has a witness point on a triangle of the object. Its value is assigned to the vertices of that
//! triangle, and a vertex shows a statistic of the values assigned to it; the mean is the paper's "divided by the number
//! of assignments".

use crate::mesh::Mesh;
use crate::statistics::{Fence, Outliers, Statistic, iqr_fence};

/// A vertex needs this many values before a fence of its own removes any.
pub const MIN_VALUES_FOR_FENCE: usize = 8;

/// Which configurations each vertex of one object hears of. Built once per object and configuration set; every measure
/// and statistic is then one pass over it.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexMap {
    /// Compressed rows: the configurations of vertex v are `members[starts[v]..starts[v + 1]]`, ascending.
    starts: Vec<u32>,
    members: Vec<u32>,
    configurations: usize,
}

/// One number per vertex, in the object's vertex order, and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexValues {
    /// The statistic; `None` where no value is assigned.
    pub values: Vec<Option<f64>>,
    /// How many values went in.
    pub counts: Vec<u32>,
    /// How many values outlier removal took.
    pub dropped: Vec<u32>,
}

impl VertexValues {
    /// Smallest and largest value; `None` when no vertex has one.
    pub fn range(&self) -> Option<[f64; 2]> {
        self.values.iter().flatten().fold(None, |range, &x| match range {
            None => Some([x, x]),
            Some([lo, hi]) => Some([lo.min(x), hi.max(x)]),
        })
    }

    /// These values minus those of another map of the same object. A vertex has a value where both have one; its count is
    /// the smaller of the two. `None` when the other map has another number of vertices.
    pub fn minus(&self, other: &Self) -> Option<Self> {
        let both = |(x, y): (&Option<f64>, &Option<f64>)| x.zip(*y).map(|(x, y)| x - y);
        (self.values.len() == other.values.len()).then(|| Self {
            values: self.values.iter().zip(&other.values).map(both).collect(),
            counts: self.counts.iter().zip(&other.counts).map(|(x, y)| *x.min(y)).collect(),
            dropped: self.dropped.iter().zip(&other.dropped).map(|(x, y)| x + y).collect(),
        })
    }
}

impl VertexMap {
    /// `triangle_of[i]` is the triangle of `mesh` that holds the witness point of configuration i.
    ///
    /// A triangle that names a vertex twice assigns its value to that vertex once. Panics when a triangle is out of
    /// range: witness triangles come from the oracle, never from an algorithm.
    pub fn new(mesh: &Mesh, triangle_of: &[u32]) -> Self {
        let configurations = u32::try_from(triangle_of.len()).expect("configuration numbers are 32-bit");
        let mut starts = vec![0u32; mesh.positions().len() + 1];
        for &t in triangle_of {
            for v in distinct(mesh.triangles()[t as usize]) {
                starts[v as usize + 1] += 1;
            }
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut next = starts.clone();
        let mut members = vec![0u32; *starts.last().expect("one more than vertices") as usize];
        for (i, &t) in (0..configurations).zip(triangle_of) {
            for v in distinct(mesh.triangles()[t as usize]) {
                members[next[v as usize] as usize] = i;
                next[v as usize] += 1;
            }
        }
        Self { starts, members, configurations: triangle_of.len() }
    }

    /// Number of vertices of the object.
    pub fn vertices(&self) -> usize {
        self.starts.len() - 1
    }

    /// The configurations whose value vertex `v` gets, ascending.
    pub fn configurations_of(&self, v: usize) -> &[u32] {
        &self.members[self.starts[v] as usize..self.starts[v + 1] as usize]
    }

    /// The statistic of the values at each vertex.
    ///
    /// `values[i]` belongs to configuration i. A value that is not finite means "not measured" and is nowhere counted.
    /// With [`Outliers::Global`] the fence is that of all measured configurations, each counted once. Panics unless
    /// there is one value per configuration.
    pub fn aggregate(&self, values: &[f64], statistic: Statistic, outliers: Outliers) -> VertexValues {
        assert_eq!(values.len(), self.configurations, "one value per configuration");
        let global = (outliers == Outliers::Global).then(|| {
            let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
            sorted.sort_unstable_by(f64::total_cmp);
            iqr_fence(&sorted)
        });
        let n = self.vertices();
        let mut result = VertexValues {
            values: Vec::with_capacity(n),
            counts: Vec::with_capacity(n),
            dropped: Vec::with_capacity(n),
        };
        let mut here = Vec::new();
        for v in 0..n {
            here.clear();
            here.extend(self.configurations_of(v).iter().map(|&i| values[i as usize]).filter(|x| x.is_finite()));
            let assigned = here.len();
            if let Some(fence) = global.or_else(|| own_fence(&mut here, outliers)) {
                here.retain(|&x| fence.contains(x));
            }
            result.values.push(statistic.of(&mut here));
            result.counts.push(here.len() as u32);
            result.dropped.push((assigned - here.len()) as u32);
        }
        result
    }

    /// Density: how many of the chosen configurations (of all, where nothing is chosen) have their witness point on a
    /// triangle of the vertex. 0 is a value here, so every vertex has one; nothing is dropped.
    pub fn density(&self, chosen: Option<&[bool]>) -> VertexValues {
        let counted = |i: &&u32| chosen.is_none_or(|chosen| chosen[**i as usize]);
        let count = |v| self.configurations_of(v).iter().filter(counted).count() as u32;
        let counts: Vec<u32> = (0..self.vertices()).map(count).collect();
        VertexValues {
            values: counts.iter().map(|&c| Some(f64::from(c))).collect(),
            dropped: vec![0; counts.len()],
            counts,
        }
    }
}

fn own_fence(values: &mut [f64], outliers: Outliers) -> Option<Fence> {
    (outliers == Outliers::PerVertex && values.len() >= MIN_VALUES_FOR_FENCE).then(|| {
        values.sort_unstable_by(f64::total_cmp);
        iqr_fence(values)
    })
}

/// The vertices of a triangle, each once.
fn distinct([a, b, c]: [u32; 3]) -> impl Iterator<Item = u32> {
    [Some(a), (b != a).then_some(b), (c != a && c != b).then_some(c)].into_iter().flatten()
}

#[cfg(test)]
mod tests;
