//! Data that several tests read.
#![allow(dead_code, reason = "each test binary uses its own part")]

use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::Point3;
use ocb_core::configuration::Configuration;
use ocb_core::mesh::{Mesh, obj};
use ocb_core::pose::Pose;

pub mod families;
pub mod random;
pub mod reference;

/// A file of the data shared by the project's checkouts.
pub fn shared(file: &str) -> Vec<u8> {
    let folder = std::env::var_os("OCB_SHARED")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")), PathBuf::from);
    assert!(folder.join("meshes").is_dir(), "not run: objects missing, set OCB_SHARED");
    let path = folder.join(file);
    std::fs::read(&path).unwrap_or_else(|e| {
        panic!("{}: {e}; set OCB_SHARED to the folder with meshes/, stability/ and configurations/", path.display())
    })
}

/// One of the shared meshes, with the f32 coordinates for which distances are known.
pub fn mesh(name: &str) -> Arc<Mesh> {
    let read = obj::read(&shared(&format!("meshes/{name}.obj"))).expect("a shared mesh is valid");
    Arc::new(read.mesh.to_f32_representable().expect("a shared mesh fits into f32"))
}

/// Little-endian f64 numbers.
pub fn floats(file: &str) -> Vec<f64> {
    shared(file).as_chunks::<8>().0.iter().map(|&b| f64::from_le_bytes(b)).collect()
}

/// 4x4 matrices that place B in A's frame.
pub fn configurations(file: &str) -> Vec<Configuration> {
    let poses = floats(file);
    let poses = poses.as_chunks::<16>().0.iter().map(|m| Pose::from_row_major(m).expect("a valid pose"));
    poses.map(|pose_b| Configuration { pose_a: Pose::identity(), pose_b }).collect()
}

/// B moves, A does not.
pub fn placed(pose_b: Pose) -> Configuration {
    Configuration { pose_a: Pose::identity(), pose_b }
}

/// A decimal number or a C99 hexadecimal one.
pub fn number(text: &str) -> f64 {
    let (sign, digits) = text.strip_prefix('-').map_or((1.0, text), |rest| (-1.0, rest));
    let Some(hex) = digits.strip_prefix("0x") else { return text.parse().expect("a number") };
    let (mantissa, exponent) = hex.split_once('p').expect("a binary exponent");
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let value = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("hexadecimal digits");
    let exponent = exponent.parse::<i32>().expect("an exponent") - 4 * fraction.len() as i32;
    sign * value as f64 * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}

/// Nine numbers per triangle.
pub fn triangles(numbers: &[f64]) -> Vec<families::Triangle> {
    let points: Vec<Point3<f64>> = numbers.as_chunks::<3>().0.iter().map(|&p| Point3::from(p)).collect();
    points.as_chunks::<3>().0.to_vec()
}
