//! Faces with more than three corners become triangles.

use earcut::Earcut;
use earcut::utils3d::project3d_to_2d;
use nalgebra::Point3;

/// Cuts faces into triangles, reusing its buffers.
#[derive(Default)]
pub struct Cutter {
    earcut: Earcut<f64>,
    spatial: Vec<[f64; 3]>,
    planar: Vec<[f64; 2]>,
    ears: Vec<u32>,
    kept: Vec<bool>,
}

/// Relative difference between the area of a face and that of its triangles from which on the cut counts as a guess.
const AREA_TOLERANCE: f64 = 1e-6;

impl Cutter {
    /// Appends the n-2 triangles of a face with n >= 3 corners, wound as the face is. False when the face is no simple
    /// polygon and the triangles are only a guess.
    pub fn cut(&mut self, positions: &[Point3<f64>], face: &[u32], triangles: &mut Vec<[u32; 3]>) -> bool {
        if let &[a, b, c] = face {
            triangles.push([a, b, c]);
            return true;
        }
        let clean = self.clip_ears(positions, face) && self.restore_dropped(face.len());
        if !clean {
            // A fan: no corner is lost, and a face without area stays a set of segments.
            self.ears.clear();
            self.ears.extend((1..face.len() as u32 - 1).flat_map(|i| [0, i, i + 1]));
        }
        triangles.extend(self.ears.chunks_exact(3).map(|t| [0, 1, 2].map(|k| face[t[k] as usize])));
        clean
    }

    /// Ear clipping in the plane of the face's mean normal; `ears` then holds corner numbers within the face.
    fn clip_ears(&mut self, positions: &[Point3<f64>], face: &[u32]) -> bool {
        // Relative to the first corner and to the size of the face: very large and very small objects alike stay clear
        // of overflow, underflow and cancellation.
        let origin = positions[face[0] as usize];
        let size = face.iter().map(|&i| (positions[i as usize] - origin).amax()).fold(0.0, f64::max);
        if size == 0.0 {
            return false;
        }
        self.spatial.clear();
        self.spatial.extend(face.iter().map(|&i| <[f64; 3]>::from((positions[i as usize] - origin) / size)));
        if !project3d_to_2d(&self.spatial, face.len(), &mut self.planar) {
            return false;
        }
        self.earcut.earcut_slice(&self.planar, &[], &mut self.ears);
        if earcut::deviation(self.planar.iter().copied(), &[], &self.ears) > AREA_TOLERANCE {
            return false;
        }
        // In corner order around the face, which is the face's own winding.
        self.ears.chunks_exact_mut(3).for_each(<[u32]>::sort_unstable);
        true
    }

    /// earcut leaves out corners on a straight line between their neighbours. They belong to the neighbouring faces
    /// too, so without them a closed mesh would open: each is put back by splitting the triangle on that line.
    fn restore_dropped(&mut self, n: usize) -> bool {
        self.kept.clear();
        self.kept.resize(n, false);
        for &i in &self.ears {
            self.kept[i as usize] = true;
        }
        let Some(first) = self.kept.iter().position(|&k| k) else {
            return false;
        };
        let mut before = first;
        while self.ears.len() < 3 * (n - 2) {
            let next = (1..=n).map(|step| (before + step) % n).find(|&i| self.kept[i]).unwrap_or(before);
            let between = (next + n - before) % n;
            if between > 1 {
                let edge = (before as u32, next as u32);
                let found =
                    self.ears.chunks_exact(3).position(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])].contains(&edge));
                let Some(at) = found.map(|t| 3 * t) else {
                    return false;
                };
                let apex = self.ears[at..at + 3].iter().copied().find(|&i| i != edge.0 && i != edge.1);
                let Some(apex) = apex else {
                    return false;
                };
                let corner = |step: usize| ((before + step) % n) as u32;
                self.ears[at..at + 3].copy_from_slice(&[corner(0), corner(1), apex]);
                for step in 1..between {
                    self.ears.extend([corner(step), corner(step + 1), apex]);
                }
            }
            before = next;
            if before == first {
                break;
            }
        }
        self.ears.len() == 3 * (n - 2)
    }
}
