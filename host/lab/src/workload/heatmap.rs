//! Where on an object of a recording an algorithm is slow or wrong, from the table of the replayed queries.
//!
//! As in the heatmap of a run, the value of a query goes to the vertices of the triangle on which the objects collide or are
//! closest, by the oracle, and a vertex shows a statistic of its values.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use ocb_core::colormap::{Colormap, Scale};
use ocb_core::export::{Legend, glb, ply};
use ocb_core::heatmap::{VertexMap, VertexValues};
use ocb_core::mesh::Mesh;
use ocb_core::statistics::{Outliers, Statistic};

use super::table::{Row, each_row, name};
use crate::model::{ObjectHeatmap, ObjectHeatmapRequest, ObjectMeasure};
use crate::{LabError, Result};

/// Values on the vertices of an object, whose triangles are `mesh`, from all queries of the
/// [table](super::workload_parquet) that it takes part in.
///
/// # Errors
/// `Invalid` for a table of another recording or of a version that kept no triangles, and for an algorithm that it does not hold.
pub fn object_heatmap(table: &[u8], mesh: &Mesh, object: u32, request: &ObjectHeatmapRequest) -> Result<ObjectHeatmap> {
    let asked = Asked::read(table, object, request)?;
    let triangles = mesh.triangles().len();
    if asked.triangles.iter().any(|triangle| *triangle as usize >= triangles) {
        return Err(LabError::Invalid(format!(
            "The table of queries belongs to another recording: object {object} has only {triangles} triangles here."
        )));
    }
    let map = VertexMap::new(mesh, &asked.triangles);
    let VertexValues { mut values, counts, .. } = map.aggregate(&asked.values, Statistic::Mean, Outliers::Keep);
    if request.measure == ObjectMeasure::Queries {
        values = counts.iter().map(|&count| (count > 0).then(|| f64::from(count))).collect();
    }
    let values = VertexValues { dropped: vec![0; counts.len()], values, counts };
    Ok(ObjectHeatmap {
        object,
        request: request.clone(),
        unit: request.measure.unit().to_owned(),
        range: values.range(),
        values: values.values,
        counts: values.counts,
        n: asked.n,
    })
}

/// What was asked about an object.
#[derive(Default)]
struct Asked {
    /// One entry per query and side on which the object stands.
    triangles: Vec<u32>,
    values: Vec<f64>,
    n: u64,
}

impl Asked {
    fn read(table: &[u8], object: u32, request: &ObjectHeatmapRequest) -> Result<Self> {
        let mut asked = Self::default();
        let (mut others, mut measured, mut unplaced) = (BTreeSet::new(), false, false);
        each_row(table, |row| {
            if row.algorithm != request.algorithm || row.track != request.order {
                if row.track == request.order && !others.contains(row.algorithm) {
                    others.insert(row.algorithm.to_owned());
                }
                return;
            }
            measured = true;
            unplaced |= row.triangles.is_none();
            if request.stretch().contains(row.sequence) {
                asked.count(&row, object, request.measure);
            }
        })?;
        if !measured {
            let others = others.into_iter().collect::<Vec<_>>().join(", ");
            return Err(LabError::Invalid(format!(
                "The algorithm {:?} answered no query in this order; those that did: {}.",
                request.algorithm,
                if others.is_empty() { "none" } else { &others }
            )));
        }
        if unplaced {
            return Err(LabError::Invalid(
                "This replay is of a version that did not keep where objects are closest; replay the recording again to get \
                 heatmaps."
                    .into(),
            ));
        }
        Ok(asked)
    }

    fn count(&mut self, row: &Row, object: u32, measure: ObjectMeasure) {
        let value = match measure {
            ObjectMeasure::Wrong if row.verdict.is_silent() => return,
            ObjectMeasure::Wrong => f64::from(u8::from(row.verdict.is_wrong())),
            ObjectMeasure::Time | ObjectMeasure::Queries => row.time_ns,
        };
        let on = |side: usize| row.triangles.filter(|_| row.objects[side] == object).map(|both| both[side]);
        let before = self.triangles.len();
        self.triangles.extend([0, 1].into_iter().filter_map(on));
        self.values.resize(self.triangles.len(), value);
        self.n += u64::from(self.triangles.len() > before);
    }
}

/// A heatmap of an object on its way into a file.
pub struct HeatmapFile<'a> {
    /// The values.
    pub heatmap: &'a ObjectHeatmap,
    /// The object.
    pub mesh: &'a Mesh,
    /// Name of the recording's file.
    pub recording: &'a str,
    /// Colours.
    pub colormap: Colormap,
    /// How values become colours.
    pub scale: Scale,
}

/// Formats of heatmaps for other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatmapFormat {
    /// Binary glTF with colours and values.
    Glb,
    /// Binary PLY with colours and values.
    Ply,
    /// The values alone.
    Csv,
}

impl HeatmapFile<'_> {
    /// Its bytes.
    pub fn bytes(&self, format: HeatmapFormat) -> Vec<u8> {
        match format {
            HeatmapFormat::Glb => glb::heatmap(self.mesh, &self.values(), &self.legend()),
            HeatmapFormat::Ply => ply::heatmap(self.mesh, &self.values(), &self.legend()),
            HeatmapFormat::Csv => self.csv().into_bytes(),
        }
    }

    /// One line per vertex; an empty value is one that is not there.
    fn csv(&self) -> String {
        let mut text = format!("vertex,value_{},count\n", self.heatmap.unit);
        for (vertex, (value, count)) in self.heatmap.values.iter().zip(&self.heatmap.counts).enumerate() {
            let value = value.map_or_else(String::new, |value| value.to_string());
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{vertex},{value},{count}");
        }
        text
    }

    fn values(&self) -> VertexValues {
        let ObjectHeatmap { values, counts, .. } = self.heatmap.clone();
        VertexValues { values, dropped: vec![0; counts.len()], counts }
    }

    fn legend(&self) -> Legend {
        let ObjectHeatmap { object, request, unit, n, range, .. } = self.heatmap;
        let [lo, hi] = range.unwrap_or([0.0, 0.0]);
        let stretch = match (request.from, request.to) {
            (None, None) => String::new(),
            (from, to) => {
                format!("sequence in [{}, {})", from.unwrap_or(0), to.map_or("end".into(), |to| to.to_string()))
            }
        };
        Legend {
            run: format!("{}, object {object}, order {}", self.recording, name(request.order)),
            algorithm: request.algorithm.clone(),
            against: None,
            selection: Some(stretch).filter(|stretch| !stretch.is_empty()),
            measure: request.measure.name().to_owned(),
            statistic: if request.measure == ObjectMeasure::Queries { String::new() } else { "mean".into() },
            outliers: "keep".into(),
            unit: unit.clone(),
            // A share begins at 0, whatever its smallest value is.
            range: if request.measure == ObjectMeasure::Wrong { [0.0, hi] } else { [lo, hi] },
            scale: self.scale,
            colormap: self.colormap,
            n: *n,
        }
    }
}

#[cfg(test)]
mod tests;
