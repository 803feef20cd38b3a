//! The files of `ocb advise --out`.

use std::path::{Path, PathBuf};

use ocb_advice::{Detail, Paper};
use ocb_core::colormap::{Colormap, Scale};
use ocb_core::export::{Legend, ply};
use ocb_core::heatmap::VertexValues;
use ocb_core::mesh::{Mesh, obj};
use ocb_service::advising::Advised;

use crate::failure::{Failure, Result};
use crate::output;

/// Writes everything; the paths.
pub fn write(folder: &Path, names: [&String; 2], advised: &Advised) -> Result<Vec<PathBuf>> {
    let mut written = Vec::new();
    let mut put = |name: String, bytes: &[u8]| -> Result<()> {
        let path = folder.join(name);
        std::fs::write(&path, bytes).map_err(|e| Failure::file("write", &path, &e))?;
        written.push(path);
        Ok(())
    };
    let Advised { advice, ladders } = advised;
    for (side, letter) in ["a", "b"].into_iter().enumerate() {
        for level in advice.stages.iter().map(|stage| &ladders[side][stage[side]]) {
            let Some(certificate) = level.certificate.clone() else { continue };
            let file = format!("{letter}-{}.obj", level.mesh.triangles().len());
            put(file.clone(), obj::write(&level.mesh).as_bytes())?;
            let paper = Paper { object_file: names[side].clone(), file, certificate };
            let name = format!("{letter}-{}.certificate.json", level.mesh.triangles().len());
            put(name, output::to_json(&paper)?.as_bytes())?;
        }
        let mesh = &ladders[side][0].mesh;
        put(format!("{letter}-detail.ply"), &coloured(mesh, &advice.detail[side], advice.configurations))?;
    }
    put("advice.json".to_owned(), output::to_json(advice)?.as_bytes())?;
    Ok(written)
}

/// Where on an object detail is needed, as colours.
fn coloured(mesh: &Mesh, detail: &Detail, configurations: u32) -> Vec<u8> {
    let dropped = vec![0; detail.counts.len()];
    let values = VertexValues { values: detail.triangles.clone(), counts: detail.counts.clone(), dropped };
    let legend = Legend {
        run: "advice".to_owned(),
        algorithm: String::new(),
        against: None,
        selection: None,
        measure: "level that is enough".to_owned(),
        statistic: "max".to_owned(),
        outliers: "keep".to_owned(),
        unit: "triangles".to_owned(),
        range: values.range().unwrap_or([0.0, 1.0]),
        scale: Scale::Log,
        colormap: Colormap::Viridis,
        n: u64::from(configurations),
    };
    ply::heatmap(mesh, &values, &legend)
}
