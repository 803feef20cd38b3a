//! Where the previous query about each pair of objects ended.

use std::collections::HashMap;

use crate::polyhedron::Feature;

/// The latest pair of features of each pair of objects.
#[derive(Debug, Default)]
pub struct Memory {
    /// Of the pair that was asked about last, which is often asked about again.
    latest: Option<([u32; 2], [Feature; 2])>,
    /// Of the other pairs, the smaller object first.
    others: HashMap<[u32; 2], [Feature; 2]>,
}

impl Memory {
    /// The features of these objects, in either order.
    pub fn of(&mut self, objects: [u32; 2]) -> Option<[Feature; 2]> {
        let (known, features) = self.latest?;
        if known == objects {
            return Some(features);
        }
        if swapped(known) == objects {
            return Some(swapped(features));
        }
        self.another(objects)
    }

    /// The pair is not the latest, which makes room for it.
    #[cold]
    fn another(&mut self, objects: [u32; 2]) -> Option<[Feature; 2]> {
        if let Some((known, features)) = self.latest.take() {
            let in_order = known.is_sorted();
            self.others.insert(
                if in_order { known } else { swapped(known) },
                if in_order { features } else { swapped(features) },
            );
        }
        if objects.is_sorted() {
            self.others.get(&objects).copied()
        } else {
            self.others.get(&swapped(objects)).copied().map(swapped)
        }
    }

    /// Remembers features.
    pub fn keep(&mut self, objects: [u32; 2], features: [Feature; 2]) {
        self.latest = Some((objects, features));
    }
}

fn swapped<T>([a, b]: [T; 2]) -> [T; 2] {
    [b, a]
}
