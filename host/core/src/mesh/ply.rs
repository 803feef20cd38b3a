//! PLY, as text and binary in either byte order.
//!
//! Read are the properties `x`, `y` and `z` of the element `vertex`, and the list `vertex_indices` (or `vertex_index`) of
//! the element `face`, numbered from 0. Other elements and properties are skipped. A coordinate has the precision that
//! the header declares: `float` is rounded to single precision, as the program meant that wrote it.

mod body;
mod header;
#[cfg(test)]
mod tests;
pub mod write;

use nalgebra::Point3;

use super::read::limits::{MAX_CORNERS, MAX_TRIANGLES, MAX_VERTICES};
use super::read::surface::Surface;
use super::read::words::{bounded, shown};
use super::read::{Contents, Fault, Place, ReadError};
use body::Body;
use header::{Element, Header, Kind};

/// So many skipped elements are named in warnings.
const MOST_NAMED: usize = 8;

/// Reads a file that begins with `ply`.
pub fn read(bytes: &[u8]) -> Result<Contents, ReadError> {
    let header = Header::read(bytes)?;
    let (vertex, face) = (header.element("vertex"), header.element("face"));
    let no_faces =
        "the PLY file has no faces (an element 'face' with a list 'vertex_indices'); export a surface, not points";
    let (Some(vertex), Some(face)) = (vertex, face) else { return Err(ReadError::Whole(no_faces.into())) };
    if header.elements[face].count == 0 {
        return Err(ReadError::Whole(no_faces.into()));
    }
    if face < vertex {
        let at = Place::Line(header.elements[face].line);
        return Err(at.has("the faces come before the vertices; export the object from another program"));
    }
    let vertices = Vertices::of(&header.elements[vertex])?;
    let list = corner_list(&header.elements[face])?;

    let mut body = Body::new(bytes, &header);
    let mut surface = Surface::default();
    let mut warnings = Vec::new();
    // Behind the faces there is nothing to read.
    for (i, element) in header.elements[..=face].iter().enumerate() {
        if i == vertex {
            vertices.read(element, &mut body, &mut surface)?;
        } else if i == face {
            faces(element, list, &mut body, &mut surface)?;
        } else {
            body.skip(element)?;
        }
    }
    let others = header.elements.iter().enumerate().filter(|&(i, e)| i != vertex && i != face && e.count > 0);
    for (_, element) in others.take(MOST_NAMED) {
        warnings.push(format!("Skipped the element '{}': only vertices and faces are read.", shown(&element.name)));
    }
    Ok((surface.finish(&mut warnings)?, warnings))
}

/// Where the coordinates stand among the properties of a vertex.
struct Vertices {
    axes: [usize; 3],
}

impl Vertices {
    fn of(element: &Element) -> Result<Self, ReadError> {
        let at = Place::Line(element.line);
        if element.count > MAX_VERTICES as u64 {
            return Err(at.has(Fault::TooManyVertices));
        }
        let mut axes = [0; 3];
        for (axis, name) in axes.iter_mut().zip(["x", "y", "z"]) {
            let found = element.properties.iter().position(|p| p.name == name && p.length.is_none());
            *axis = found.ok_or_else(|| {
                at.clone().has(format!("the vertices have no coordinate '{name}'; export x, y and z of each vertex"))
            })?;
        }
        Ok(Self { axes })
    }

    fn read(&self, element: &Element, body: &mut Body<'_>, surface: &mut Surface) -> Result<(), ReadError> {
        for i in 0..element.count {
            body.begin(element, i)?;
            let mut position = Point3::origin();
            for (k, property) in element.properties.iter().enumerate() {
                let Some(axis) = self.axes.iter().position(|&axis| axis == k) else {
                    body.skip_property(property)?;
                    continue;
                };
                let at = body.place();
                let number = body.number(property.kind)?;
                position[axis] = bounded(number, || format!("{number:e}")).map_err(|fault| at.has(fault))?;
            }
            let at = body.place();
            body.end()?;
            surface.vertex(position).map_err(|fault| at.has(fault))?;
        }
        Ok(())
    }
}

/// Which property of a face lists its corners.
fn corner_list(element: &Element) -> Result<usize, ReadError> {
    let at = Place::Line(element.line);
    if element.count > MAX_TRIANGLES as u64 {
        return Err(at.has(Fault::TooManyTriangles));
    }
    let named = |p: &header::Property| matches!(p.name.as_str(), "vertex_indices" | "vertex_index");
    let found = element.properties.iter().position(|p| named(p) && p.length.is_some());
    let list = found
        .ok_or_else(|| at.clone().has("the faces have no list 'vertex_indices'; export the corners of each face"))?;
    if matches!(element.properties[list].kind, Kind::F32 | Kind::F64) {
        return Err(at.has("vertex numbers must be whole numbers, but the list has type float; export them as int"));
    }
    Ok(list)
}

fn faces(element: &Element, list: usize, body: &mut Body<'_>, surface: &mut Surface) -> Result<(), ReadError> {
    let mut corners = Vec::new();
    for i in 0..element.count {
        body.begin(element, i)?;
        let at = body.place();
        for (k, property) in element.properties.iter().enumerate() {
            let Some(length) = property.length.filter(|_| k == list) else {
                body.skip_property(property)?;
                continue;
            };
            let count = body.length(length)?;
            if count > MAX_CORNERS as u64 {
                return Err(at.has(Fault::TooManyCorners(count.try_into().unwrap_or(usize::MAX))));
            }
            corners.clear();
            for _ in 0..count {
                let at = body.place();
                let index = body.whole(property.kind)?;
                let vertices = surface.vertices();
                corners.push(u32::try_from(index).map_err(|_| at.has(Fault::NoSuchVertex { index, vertices }))?);
            }
        }
        body.end()?;
        surface.face(&corners).map_err(|fault| at.has(fault))?;
    }
    Ok(())
}
