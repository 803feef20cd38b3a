//! A pose in files: the upper three rows of its matrix, row-major, as recordings have it.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::pose::Pose;

pub fn serialize<S: Serializer>(pose: &Pose, to: S) -> Result<S::Ok, S::Error> {
    pose.to_row_major()[..12].serialize(to)
}

pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Pose, D::Error> {
    let rows = <[f64; 12]>::deserialize(from)?;
    let mut matrix = Pose::identity().to_row_major();
    matrix[..12].copy_from_slice(&rows);
    Pose::from_row_major(&matrix).map_err(Error::custom)
}
