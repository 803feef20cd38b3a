//! A visitor's question as the advisor gets it, and what of the advice can be taken away.

use std::sync::Arc;

use ocb_advice::{Advice, Paper, Question, usual_distances};
use ocb_core::mesh::Mesh;

use super::{Advised, Level, Request};
use crate::model::Asked;

/// The advice and, of A and of B, what can be taken away: reduced meshes with their certificates, the coarsest first.
pub type Found = (Advice, [Vec<(Paper, Arc<Mesh>)>; 2]);

impl Request {
    /// A question about shares of A's longest side, over so many configurations, and so many held out.
    pub fn of(question: Asked, names: [String; 2], meshes: [Arc<Mesh>; 2], counts: [u32; 2]) -> Self {
        let side = meshes[0].longest_side();
        let question = match question {
            Asked::Distance { tolerance } => Question::Distance { tolerance: tolerance * side },
            Asked::Clearance { clearance } => Question::Clearance { clearance: clearance * side },
        };
        let distances = usual_distances(question, side);
        Self { names, meshes, question, distances, counts, seed: 0 }
    }
}

impl Advised {
    /// What somebody gets who asked about objects of these names.
    pub fn found(self, names: &[String; 2]) -> Found {
        let Self { advice, ladders } = self;
        let papers = [0, 1].map(|side| papers_of(side, &names[side], &ladders[side], &advice));
        (advice, papers)
    }
}

fn papers_of(side: usize, name: &str, levels: &[Level], advice: &Advice) -> Vec<(Paper, Arc<Mesh>)> {
    let level = |stage: &[usize; 2]| {
        let level = &levels[stage[side]];
        let file = format!("{}-{}.obj", ["a", "b"][side], level.mesh.triangles().len());
        let paper = Paper { object_file: name.to_owned(), file, certificate: level.certificate.clone()? };
        Some((paper, level.mesh.clone()))
    };
    advice.stages.iter().filter_map(level).collect()
}
