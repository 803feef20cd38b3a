//! Where the previous query ended.

use crate::polyhedron::Feature;

/// The latest pair of features, and the objects that they belong to.
#[derive(Debug, Default)]
pub struct Memory(Option<([u32; 2], [Feature; 2])>);

impl Memory {
    /// The features of these objects, if they were asked about last, in either order.
    pub fn of(&self, objects: [u32; 2]) -> Option<[Feature; 2]> {
        let (known, [a, b]) = self.0?;
        let [first, second] = known;
        if known == objects { Some([a, b]) } else { ([second, first] == objects).then_some([b, a]) }
    }

    /// Remembers features.
    pub fn keep(&mut self, objects: [u32; 2], features: [Feature; 2]) {
        self.0 = Some((objects, features));
    }
}
