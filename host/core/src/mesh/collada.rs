//! COLLADA 1.4 and 1.5: the visual scene, its nodes and instances flattened with their transforms.
//!
//! The faces may be triangles, polylists, polygons, strips or fans. A skinned mesh is read as it was bound. Coordinates
//! stay in the unit and the axes of the file: neither `<unit>` nor `<up_axis>` is applied.

mod geometry;
mod scene;
mod source;
#[cfg(test)]
mod tests;
mod xml;

use super::read::words::shown;
use super::read::{Contents, LengthUnit, Place, ReadError, without_mark};
use xml::File;

/// Reads a file whose root element is `COLLADA`, and the unit of its coordinates.
pub fn read(bytes: &[u8]) -> Result<(LengthUnit, Contents), ReadError> {
    // Names may be in Latin-1; what is not ASCII in a number is refused there.
    let text = String::from_utf8_lossy(without_mark(bytes));
    let document = xml::parse(&text)?;
    let file = File::new(&document);
    let unit = unit(&file)?;
    Ok((unit, scene::flatten(&file)?))
}

/// The unit that the file states; metres where it states none, as the specification has it.
fn unit(file: &File<'_>) -> Result<LengthUnit, ReadError> {
    let Some(asset) = file.child(file.root(), "asset")? else { return Ok(LengthUnit::metre()) };
    let Some(stated) = file.child(asset, "unit")? else { return Ok(LengthUnit::metre()) };
    let name = stated.attribute("name").map_or_else(|| "meter".to_owned(), shown);
    let Some(word) = stated.attribute("meter") else { return Ok(LengthUnit { name, metres: 1.0 }) };
    let metres = word.trim().parse().ok().filter(|m: &f64| m.is_finite() && *m > 0.0);
    let metres = metres.ok_or_else(|| {
        Place::Line(file.line(stated)).has(format!("a unit of '{}' metres; write a number above 0", shown(word)))
    })?;
    Ok(LengthUnit { name, metres })
}
