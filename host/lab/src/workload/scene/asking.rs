//! What one algorithm is asked about a scene, and which objects it loads for that.

use std::sync::Arc;

use ocb_core::configuration::Configuration;
use ocb_core::mesh::Mesh;
use ocb_core::oracle::Shape;
use ocb_core::validation::Precision;

use crate::algorithm::Algorithm;
use crate::configurations::specks;
use crate::measure;
use crate::pairing::rounding;
use crate::workload::{PairPart, Solid};

/// No number.
const NONE: u32 = u32::MAX;

/// The objects of a scene, in the numbers of each precision.
pub struct Objects {
    exact: Vec<Arc<Mesh>>,
    /// Nothing where rounding leaves no triangle with area.
    rounded: Vec<Option<Arc<Mesh>>>,
    shapes: Vec<Shape>,
}

impl Objects {
    /// Of a scene.
    pub fn new(solids: &[Solid]) -> Self {
        let exact: Vec<Arc<Mesh>> = solids.iter().map(|solid| solid.outer.clone()).collect();
        let rounded = |mesh: &Arc<Mesh>| if mesh.is_f32_representable() { Some(mesh.clone()) } else { rounding(mesh) };
        let (rounded, shapes) = (exact.iter().map(rounded).collect(), exact.iter().cloned().map(Shape::new).collect());
        Self { exact, rounded, shapes }
    }

    fn seen_in(&self, precision: Precision, place: u32) -> Option<&Arc<Mesh>> {
        let place = place as usize;
        if precision == Precision::Single { self.rounded[place].as_ref() } else { Some(&self.exact[place]) }
    }
}

/// What one algorithm is asked.
pub struct Asking {
    /// The algorithm.
    pub algorithm: Arc<Algorithm>,
    /// Part and place in it of every query, in the order of the recording.
    pub order: Vec<[u32; 2]>,
    /// The objects that it loads, in the order of the scene: those that it is asked about.
    pub meshes: Vec<Arc<Mesh>>,
    /// Which of these an object of the scene is.
    loaded: Vec<u32>,
    /// The place of each row of the recording in `order`.
    numbers: Vec<u32>,
}

impl Asking {
    /// All queries that the algorithm answers, as the pairs are asked: without those about specks, and about objects that its
    /// precision makes flat.
    pub fn of(algorithm: &Arc<Algorithm>, parts: &[PairPart], objects: &Objects) -> Self {
        let precision = measure::precision(&algorithm.info);
        let mut order: Vec<(u32, [u32; 2])> = Vec::new();
        for (part, number) in parts.iter().zip(0..) {
            let seen = part.objects.map(|place| objects.seen_in(precision, place));
            if !algorithm.info.queries.contains(&part.query) || seen.contains(&None) {
                continue;
            }
            let [a, b] = part.objects.map(|place| &objects.shapes[place as usize]);
            let speck = specks(a, b);
            let rows = part.rows.iter().zip(&part.configurations).zip(0..);
            order.extend(rows.filter(|((_, asked), _)| !speck(asked)).map(|((row, _), at)| (*row, [number, at])));
        }
        order.sort_unstable();
        let mut numbers = vec![NONE; order.last().map_or(0, |(row, _)| *row as usize + 1)];
        let mut named = vec![false; objects.exact.len()];
        for ((row, [part, _]), number) in order.iter().zip(0..) {
            numbers[*row as usize] = number;
            parts[*part as usize].objects.iter().for_each(|place| named[*place as usize] = true);
        }
        let (mut loaded, mut meshes) = (vec![NONE; named.len()], Vec::new());
        for (place, _) in (0..).zip(&named).filter(|(_, named)| **named) {
            if let Some(mesh) = objects.seen_in(precision, place) {
                loaded[place as usize] = meshes.len() as u32;
                meshes.push(mesh.clone());
            }
        }
        let order = order.into_iter().map(|(_, at)| at).collect();
        Self { algorithm: algorithm.clone(), order, meshes, loaded, numbers }
    }

    /// Its part, its poses, and the loaded objects that it names.
    pub fn question<'p>(&self, parts: &'p [PairPart], number: u32) -> (&'p PairPart, &'p Configuration, [u32; 2]) {
        let [part, at] = self.order[number as usize];
        let part = &parts[part as usize];
        (part, &part.configurations[at as usize], part.objects.map(|place| self.loaded[place as usize]))
    }

    /// The place of a row of the recording in the order; nothing where it is not asked.
    pub fn number(&self, row: u32) -> Option<usize> {
        self.numbers.get(row as usize).filter(|number| **number != NONE).map(|number| *number as usize)
    }
}
