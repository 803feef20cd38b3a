//! The objects that a viewer finds, and adding one.

use std::sync::Arc;

use ocb_core::mesh::Mesh;

use crate::engine::Engine;
use crate::model::{ObjectInfo, Page, Part};
use crate::quotas::has_room_for_a_file;
use crate::{Result, boxed};

impl Engine {
    /// Stock objects in front of the first part, then those that the viewer added and the public ones of others, newest
    /// first.
    #[boxed]
    pub async fn objects(&self, viewer: Option<&str>, page: &Page) -> Result<Part<ObjectInfo>> {
        self.inner.objects.list(viewer, page).await
    }

    /// One object by id (`stock:NAME@TRIANGLES`, `stock:bunny`, `stock:dragon` or a UUID).
    #[boxed]
    pub async fn object(&self, id: &str, viewer: Option<&str>) -> Result<ObjectInfo> {
        self.inner.objects.info_for(id, viewer).await
    }

    /// Reads a file in any of [`ocb_core::mesh::FORMATS`] and keeps its mesh; the same mesh of the same owner is kept once.
    /// Nothing is kept on error.
    #[boxed]
    pub async fn add_object(&self, name: &str, bytes: Vec<u8>, owner: Option<&str>) -> Result<ObjectInfo> {
        has_room_for_a_file(&self.inner.store, owner, bytes.len()).await?;
        self.inner.objects.add(name, bytes, owner).await
    }

    /// The mesh of an object.
    #[boxed]
    pub async fn mesh(&self, id: &str) -> Result<Arc<Mesh>> {
        self.inner.objects.mesh(id).await
    }
}
