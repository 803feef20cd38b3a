//! Equivalent instances: the same question in other numbers, with a known effect on the answer.
//!
//! An instance renumbers vertices and triangles, scales everything by a power of two, turns both poses by a common rotation
//! of the cube, and may swap the objects. All of it is exact in floating point: coordinates change their place, their sign
//! or their exponent and nothing else. So the certified truth of the original holds for every instance, an answer
//! translates back without a rounding, and a wrong answer to an instance is a wrong answer.
//!
//! Renumbering and scaling belong to a [`Presentation`], which lasts as long as a process. Scaling by a power of two gives the
//! objects another unit of length. The processes numbered 0 to 3 see the objects smaller and larger ([`OTHER_UNITS`]), so that
//! a tolerance that is an absolute length shows in every run; all other processes see the unit of the files. The rotation
//! differs from question to question, unless the order of the questions is part of what is measured. Only
//! questions whose time does not count are swapped: a method may be faster one way round, and the time shall be that of
//! the question as it was asked.

use nalgebra::{Matrix3, Point3};
use serde::{Deserialize, Serialize};

use crate::configuration::Configuration;
use crate::mesh::Mesh;
use crate::numbers::Numbers;
use crate::pose::Pose;
use crate::query::Answer;

/// Grows when the same seed gives other instances, which a recorded run can then not be asked again as.
pub const VERSION: u32 = 3;
/// The processes 0, 1, 2 and 3 scale everything by two to these powers; all later ones keep the unit of the files.
pub const OTHER_UNITS: [i32; 4] = [-3, 3, -3, 3];
/// Coordinates between these magnitudes can be scaled that far, in single precision as well.
const SCALABLE: std::ops::RangeInclusive<f64> = 1e-30..=1e17;

/// How one process sees its objects: a pair, of which both may be one mesh, or a scene of many.
#[derive(Clone, Debug)]
pub struct Presentation {
    meshes: Vec<Mesh>,
    numbering: Vec<Numbering>,
    scale: f64,
    rotations: Rotations,
}

/// Everything is scaled by two to this power in the process of this number, where the coordinates allow it; absent: the
/// objects as they are.
pub fn exponent(process: Option<u32>) -> i32 {
    process.and_then(|process| OTHER_UNITS.get(process as usize)).copied().unwrap_or(0)
}

/// Which instance of a configuration within one presentation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Instance {
    /// Tells repeats apart.
    pub number: u32,
    /// Its time does not count, so the objects may be swapped.
    pub aside: bool,
}

/// As what a question of a run was put.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AskedAs {
    /// Number of the process, whose presentation follows from the run's seed; absent: the objects as they are.
    pub process: Option<u32>,
    /// Which instance within it.
    pub instance: Instance,
}

/// A question in a presentation's numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Presented {
    /// The poses of the object that stands first and of the one that stands second.
    pub configuration: Configuration,
    /// B stands first.
    pub swapped: bool,
}

/// For every new number of a triangle its number in the original.
#[derive(Clone, Debug)]
struct Numbering(Vec<u32>);

#[derive(Clone, Copy, Debug)]
enum Rotations {
    /// None at all.
    Identity,
    /// One for all questions.
    Constant(u64),
    /// Another one for every question.
    Varying(u64),
}

impl Presentation {
    /// The objects as they are; `b` is absent when both are one.
    pub fn original(a: &Mesh, b: Option<&Mesh>) -> Self {
        let meshes: Vec<Mesh> = std::iter::once(a).chain(b).cloned().collect();
        let same = |mesh: &Mesh| Numbering((0..mesh.triangles().len() as u32).collect());
        let numbering = meshes.iter().map(same).collect();
        Presentation { meshes, numbering, scale: 1.0, rotations: Rotations::Identity }
    }

    /// Drawn by a seed, for the process of this number. `coherent`: all questions are turned alike, so that near
    /// configurations stay near.
    pub fn drawn<'c>(
        a: &Mesh,
        b: Option<&Mesh>,
        mut configurations: impl Iterator<Item = &'c Configuration>,
        coherent: bool,
        seed: u64,
        process: u32,
    ) -> Self {
        let fits = |x: f64| x == 0.0 || SCALABLE.contains(&x.abs());
        let poses = |c: &Configuration| [c.pose_a, c.pose_b].iter().all(|p| p.translation.iter().copied().all(fits));
        let scalable =
            [Some(a), b].into_iter().flatten().all(|mesh| mesh.positions().iter().all(|p| p.iter().copied().all(fits)))
                && configurations.all(poses);
        let scale = if scalable { 2f64.powi(exponent(Some(process))) } else { 1.0 };
        let rotations = if coherent { Rotations::Constant } else { Rotations::Varying };
        Self::renumbered([Some(a), b].into_iter().flatten(), scale, rotations, seed)
    }

    /// A scene of many objects, drawn by a seed, in the unit of the files: all of it is turned alike in every question, so that
    /// near configurations stay near.
    pub fn of_scene<'m>(meshes: impl Iterator<Item = &'m Mesh>, seed: u64) -> Self {
        Self::renumbered(meshes, 1.0, Rotations::Constant, seed)
    }

    fn renumbered<'m>(
        meshes: impl Iterator<Item = &'m Mesh>,
        scale: f64,
        rotations: fn(u64) -> Rotations,
        seed: u64,
    ) -> Self {
        let mut numbers = Numbers::new(seed);
        let (meshes, numbering) = meshes.map(|mesh| renumbered(mesh, scale, &mut numbers)).unzip();
        Presentation { meshes, numbering, scale, rotations: rotations(numbers.bits()) }
    }

    /// All objects.
    pub fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// What all lengths are multiplied by.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Object A.
    pub fn first(&self) -> &Mesh {
        &self.meshes[0]
    }

    /// Object B; absent when both are one.
    pub fn second(&self) -> Option<&Mesh> {
        self.meshes.get(1)
    }

    /// The question in this process's numbers.
    pub fn present(&self, original: &Configuration, configuration: u32, instance: Instance) -> Presented {
        let turn = self.rotation(configuration, instance);
        let move_to =
            |pose: &Pose| Pose { linear: turn * pose.linear, translation: turn * pose.translation * self.scale };
        let [a, b] = [&original.pose_a, &original.pose_b].map(move_to);
        let swapped = self.swapped(configuration, instance);
        let [pose_a, pose_b] = if swapped { [b, a] } else { [a, b] };
        Presented { configuration: Configuration { pose_a, pose_b }, swapped }
    }

    /// The answer in the original's numbers.
    pub fn translate(&self, answer: Answer, configuration: u32, instance: Instance) -> Answer {
        self.translate_of([0, self.meshes.len() - 1], answer, configuration, instance)
    }

    /// The same, about these objects of a scene, A and B of the original.
    pub fn translate_of(&self, objects: [usize; 2], answer: Answer, configuration: u32, instance: Instance) -> Answer {
        let back = self.rotation(configuration, instance).transpose();
        let swapped = self.swapped(configuration, instance);
        let order = |pair: [u32; 2]| {
            let [a, b] = if swapped { [pair[1], pair[0]] } else { pair };
            [self.numbering[objects[0]].original(a), self.numbering[objects[1]].original(b)]
        };
        match answer {
            Answer::Collision { hit, pair } => Answer::Collision { hit, pair: pair.map(order) },
            Answer::Contacts { total, pairs } => {
                Answer::Contacts { total, pairs: pairs.into_iter().map(order).collect() }
            }
            Answer::Distance { distance, points, triangles } => Answer::Distance {
                distance: distance / self.scale,
                points: points.map(|points| {
                    let [a, b] = points.map(|p| Point3::from(back * p.coords / self.scale));
                    if swapped { [b, a] } else { [a, b] }
                }),
                triangles: triangles.map(order),
            },
            silent @ (Answer::GaveUp | Answer::Unsupported) => silent,
        }
    }

    fn swapped(&self, configuration: u32, instance: Instance) -> bool {
        let which = match self.rotations {
            Rotations::Identity => return false,
            Rotations::Constant(seed) => !seed ^ mixed(0, instance),
            Rotations::Varying(seed) => !seed ^ mixed(configuration, instance),
        };
        instance.aside && Numbers::new(which).below(2) == 1
    }

    fn rotation(&self, configuration: u32, instance: Instance) -> Matrix3<f64> {
        let seed = match self.rotations {
            Rotations::Identity => return Matrix3::identity(),
            Rotations::Constant(seed) => seed,
            Rotations::Varying(seed) => seed ^ mixed(configuration, instance),
        };
        cube_rotation(Numbers::new(seed).below(24))
    }
}

fn mixed(configuration: u32, instance: Instance) -> u64 {
    (u64::from(instance.number) << 32) ^ u64::from(configuration)
}

impl Numbering {
    /// A number that does not exist stays one that does not exist.
    fn original(&self, triangle: u32) -> u32 {
        self.0.get(triangle as usize).copied().unwrap_or(triangle)
    }
}

/// Another order of the vertices and of the triangles.
fn renumbered(mesh: &Mesh, scale: f64, numbers: &mut Numbers) -> (Mesh, Numbering) {
    let shuffled = |n: usize, numbers: &mut Numbers| {
        let mut order: Vec<u32> = (0..n as u32).collect();
        numbers.shuffle(&mut order);
        order
    };
    let vertices = shuffled(mesh.positions().len(), numbers);
    let triangles = shuffled(mesh.triangles().len(), numbers);
    let mut now = vec![0; vertices.len()];
    (0u32..).zip(&vertices).for_each(|(new, old)| now[*old as usize] = new);
    let positions = vertices.iter().map(|old| mesh.positions()[*old as usize] * scale).collect();
    let corners = triangles.iter().map(|old| mesh.triangles()[*old as usize].map(|v| now[v as usize])).collect();
    let mesh = Mesh::new(positions, corners).expect("the same mesh in other numbers");
    (mesh, Numbering(triangles))
}

/// One of the 24 rotations of a cube onto itself; numbers from 0.
fn cube_rotation(number: usize) -> Matrix3<f64> {
    const AXES: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    let (axes, signs) = (AXES[number / 4], number % 4);
    let mut rotation = Matrix3::zeros();
    // Two signs are free; the third makes it a rotation, and the last three orders of the axes are odd.
    let [x, y] = [signs & 1, signs >> 1].map(|flip| if flip == 1 { -1.0 } else { 1.0 });
    let z = if number / 4 < 3 { x * y } else { -x * y };
    for (row, sign) in [x, y, z].into_iter().enumerate() {
        rotation[(row, axes[row])] = sign;
    }
    rotation
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::configuration::Placed;
    use crate::oracle::{Pair, Shape};
    use crate::query::{Query, Semantics};
    use crate::record::Verdict;
    use crate::validation::{Precision, Terms, judge};
    use nalgebra::Vector3;
    use std::sync::Arc;

    fn mesh(offset: f64, triangles: usize) -> Mesh {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.25, 0.0], [0.0, 1.0, 0.125], [0.3, 0.2, 1.1], [1.0, 1.0, -0.4]];
        let all = [[0, 1, 2], [1, 2, 3], [2, 3, 0], [0, 3, 1], [1, 4, 2]];
        Mesh::new(corners.map(|c| Point3::from(c) + Vector3::repeat(offset)).to_vec(), all[..triangles].to_vec())
            .unwrap()
    }

    fn configuration(x: f64) -> Configuration {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -1.1, x);
        let pose_b = Pose {
            linear: *turn.matrix(),
            translation: Vector3::new(0.4 + x, 0.0, 0.2) - turn * Vector3::new(0.9, 0.9, 0.6),
        };
        Configuration { pose_a: Pose { translation: Vector3::new(0.01, -0.3, 0.0), ..Pose::identity() }, pose_b }
    }

    #[test]
    fn the_cube_has_24_different_rotations() {
        let all: Vec<Matrix3<f64>> = (0..24).map(cube_rotation).collect();
        for (i, one) in all.iter().enumerate() {
            assert_eq!(one.determinant(), 1.0);
            assert_eq!(one * one.transpose(), Matrix3::identity());
            assert!(all[..i].iter().all(|other| other != one));
        }
    }

    /// The truth of an instance, found anew, translates to the truth of the original, bit for bit.
    #[test]
    fn the_truth_of_an_instance_is_the_truth_of_the_original() {
        let (a, b) = (mesh(0.0, 5), mesh(0.5, 4));
        let [shape_a, shape_b] = [&a, &b].map(|m| Shape::new(Arc::new(m.clone())));
        let pair = Pair::new(&shape_a, &shape_b);
        let all: Vec<Configuration> = (0..24).map(|i| configuration(f64::from(i) * 0.1 - 1.2)).collect();
        let (mut hits, mut swaps, mut scales) = (0, 0, std::collections::BTreeSet::new());
        for seed in 0..20 {
            let shown = Presentation::drawn(&a, Some(&b), all.iter(), false, seed, seed as u32);
            scales.insert(shown.scale.to_bits());
            let meshes = [shown.first(), shown.second().unwrap()].map(|m| Shape::new(Arc::new(m.clone())));
            let [straight, crossed] = [Pair::new(&meshes[0], &meshes[1]), Pair::new(&meshes[1], &meshes[0])];
            let instance = Instance { number: seed as u32, aside: seed % 4 != 0 };
            for (i, original) in (0u32..).zip(&all) {
                let Presented { configuration, swapped } = shown.present(original, i, instance);
                assert!(instance.aside || !swapped);
                swaps += u32::from(swapped);
                let found = if swapped { &crossed } else { &straight }.truth(&configuration);
                let truth = pair.truth(original);
                hits += u32::from(truth.hit);
                assert_eq!((truth.hit, truth.class64, truth.class32), (found.hit, found.class64, found.class32));
                let tau = 1e-14 * shown.scale;
                assert!((found.distance_lo - truth.distance_lo * shown.scale).abs() <= tau);
                let w = found.witness;
                let triangles = Some([w.triangle_a, w.triangle_b]);
                let (query, answer) = if truth.hit {
                    (Query::CollisionFirst, Answer::Collision { hit: true, pair: triangles })
                } else {
                    let points = Some([w.point_a, w.point_b]);
                    let distance = (w.point_a - w.point_b).norm();
                    (Query::Proximity, Answer::Distance { distance, points, triangles })
                };
                let placed = Placed { configuration: *original, truth, rounded: None, root_index: 0, wanted: None };
                let terms = Terms { query, semantics: Semantics::Surface, precision: Precision::Double };
                let translated = shown.translate(answer.clone(), i, instance);
                assert_eq!(judge(&pair, &placed, terms, &translated).verdict, Verdict::Correct, "{seed} {i}");
                // Untranslated it is another object's answer, unless nothing was changed.
                let plain = judge(&pair, &placed, terms, &answer).verdict;
                assert!(plain != Verdict::Correct || truth.hit || shown.scale == 1.0, "{seed} {i}: {plain:?}");
            }
        }
        assert!(hits > 20 && swaps > 20 && scales.len() == 3, "{hits} hits, {swaps} swapped, {} scales", scales.len());
    }

    #[test]
    fn whatever_the_seed_the_first_processes_see_other_units_and_all_others_that_of_the_file() {
        let (a, near) = (mesh(0.0, 5), configuration(1.0));
        for (process, expected) in [(0, 0.125), (1, 8.0), (2, 0.125), (3, 8.0), (4, 1.0), (5, 1.0), (99, 1.0)] {
            let scale = |seed| Presentation::drawn(&a, None, [near].iter(), false, seed, process).scale();
            assert!((0..20).all(|seed| scale(seed) == expected), "process {process}");
            assert_eq!(2f64.powi(exponent(Some(process))), expected);
        }
        assert_eq!(exponent(None), 0);
    }

    #[test]
    fn a_scene_is_turned_as_a_whole_and_each_object_keeps_its_numbers() {
        let meshes = [mesh(0.0, 5), mesh(0.5, 4), mesh(1.5, 3)];
        for seed in 0..10 {
            let shown = Presentation::of_scene(meshes.iter(), seed);
            let near = Presented { swapped: false, ..shown.present(&configuration(0.0), 0, Instance::default()) };
            let turn = near.configuration.pose_b.linear * configuration(0.0).pose_b.linear.transpose();
            for i in 1..20 {
                let original = configuration(f64::from(i) * 0.1);
                let Presented { configuration, swapped } = shown.present(&original, i, Instance::default());
                let turned = (configuration.pose_a.linear - turn * original.pose_a.linear).abs().max();
                assert!(!swapped && turned < 1e-12, "{seed} {i}");
            }
            for objects in [[2, 0], [1, 1], [0, 2]] {
                let answer = Answer::Collision { hit: true, pair: Some([2, 1]) };
                let translated = shown.translate_of(objects, answer, 7, Instance::default());
                let Answer::Collision { pair: Some(pair), .. } = translated else { panic!("{translated:?}") };
                for ((object, now), then) in objects.into_iter().zip([2, 1]).zip(pair) {
                    let corners =
                        |mesh: &Mesh, t: u32| mesh.triangles()[t as usize].map(|v| mesh.positions()[v as usize]);
                    assert_eq!(corners(&shown.meshes()[object], now), corners(&meshes[object], then));
                }
            }
        }
    }

    #[test]
    fn numbers_are_renumbered_and_those_that_do_not_exist_stay_so() {
        let a = mesh(0.0, 5);
        let shown = Presentation::drawn(&a, None, [configuration(1.0)].iter(), true, 3, 3);
        assert!(shown.second().is_none());
        for i in 0..5u32 {
            let answer = Answer::Collision { hit: true, pair: Some([i, u32::MAX]) };
            let translated = shown.translate(answer, 0, Instance::default());
            let Answer::Collision { pair: Some([mine, none]), .. } = translated else { panic!("{translated:?}") };
            assert_eq!(none, u32::MAX);
            let corners = |mesh: &Mesh, t: u32, scale: f64| {
                mesh.triangles()[t as usize].map(|v| mesh.positions()[v as usize].coords.map(|x| x * scale))
            };
            assert_eq!(corners(shown.first(), i, 1.0), corners(&a, mine, shown.scale));
        }
        let nan = Answer::Distance { distance: f64::NAN, points: None, triangles: None };
        assert!(
            matches!(shown.translate(nan, 0, Instance::default()), Answer::Distance { distance, .. } if distance.is_nan())
        );
        // What cannot be scaled exactly is not scaled, and one configuration is turned alike every time.
        let tiny = Configuration {
            pose_b: Pose { translation: Vector3::repeat(1e-305), ..Pose::identity() },
            ..configuration(0.0)
        };
        assert!((0..20).all(|seed| Presentation::drawn(&a, None, [tiny].iter(), true, seed, 0).scale == 1.0));
        let other = Instance { number: 9, aside: false };
        assert_eq!(shown.present(&tiny, 0, Instance::default()), shown.present(&tiny, 7, other));
    }
}
