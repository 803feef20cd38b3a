//! Lengths that belong to the triangles, carried up the hierarchy: how far beyond a box its triangles may reach.

use super::wide_node::{LANES, Slot};
use super::{Frame, Tree};

impl Tree {
    /// The largest of the triangles' lengths below every slot, in tree coordinates and rounded up; by slot number.
    ///
    /// `lengths` are the object's own and not negative.
    pub(crate) fn reach(&self, lengths: &[f64]) -> Vec<f32> {
        let mut most = vec![0.0f32; self.nodes.len() * LANES];
        // A node stands behind the one that refers to it.
        for (number, node) in self.nodes.iter().enumerate().rev() {
            for lane in 0..node.len() {
                most[number * LANES + lane] = match node.triangle(lane) {
                    Some(triangle) => (lengths[triangle as usize] / self.unit) as f32,
                    None => {
                        let below = node.node(lane) as usize * LANES;
                        most[below..below + LANES].iter().copied().fold(0.0, f32::max)
                    }
                };
            }
        }
        most.into_iter().map(|x| if x > 0.0 { x.next_up() } else { 0.0 }).collect()
    }
}

impl Frame<'_> {
    /// A lower bound of two boxes' distance that stays true when what is in them reaches further by these lengths (in
    /// tree coordinates), also where the poses stretch lengths as much as a frame allows.
    pub(crate) fn less(&self, bound: f32, [a, b]: [f32; 2]) -> f32 {
        let reach = (a * self.scale_a + b * self.scale_b) * (1.0 + 1e-5) + f32::MIN_POSITIVE;
        (bound - reach).next_down().max(0.0)
    }
}

impl Slot {
    /// The value of this slot among those of [`Tree::reach`]; 0 when there are none.
    pub(crate) fn of(self, values: &[f32]) -> f32 {
        values.get(self.number()).copied().unwrap_or(0.0)
    }
}
