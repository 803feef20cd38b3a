//! Heatmaps of the objects of a replayed recording, as values and as files.

use std::sync::Arc;

use ocb_core::colormap::{Colormap, Scale};
use ocb_core::mesh::Mesh;
use ocb_lab::workload::{HeatmapFile, HeatmapFormat, object_heatmap};

use crate::blocking::blocking;
use crate::engine::Engine;
use crate::model::{ObjectHeatmap, ObjectHeatmapRequest};
use crate::{Result, boxed};

impl Engine {
    /// Values on the vertices of an object, from all queries that it takes part in.
    ///
    /// # Errors
    /// `NotFound` before the end; `Invalid` for an object or an algorithm that there is not, and for the replay of a version that
    /// did not keep where objects are closest.
    #[boxed]
    pub async fn workload_heatmap(
        &self,
        id: &str,
        object: u32,
        request: ObjectHeatmapRequest,
    ) -> Result<ObjectHeatmap> {
        Ok(self.heatmap_with_mesh(id, object, request).await?.0)
    }

    /// The same as a file in this format.
    #[boxed]
    pub async fn workload_heatmap_file(
        &self,
        id: &str,
        object: u32,
        request: ObjectHeatmapRequest,
        colours: (Colormap, Scale),
        format: HeatmapFormat,
    ) -> Result<Vec<u8>> {
        let recording = self.inner.store.workload_row(id).await?.recording.file;
        let (heatmap, mesh) = self.heatmap_with_mesh(id, object, request).await?;
        let (colormap, scale) = colours;
        blocking(move || {
            Ok(HeatmapFile { heatmap: &heatmap, mesh: &mesh, recording: &recording, colormap, scale }.bytes(format))
        })
        .await
    }

    async fn heatmap_with_mesh(
        &self,
        id: &str,
        object: u32,
        request: ObjectHeatmapRequest,
    ) -> Result<(ObjectHeatmap, Arc<Mesh>)> {
        let table = self.workload_queries(id).await?;
        let mesh = self.workload_mesh(id, object as usize).await?;
        blocking(move || Ok((object_heatmap(&table, &mesh, object, &request)?, mesh))).await
    }
}
