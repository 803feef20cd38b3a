//! The faces of a `<mesh>`.

use std::collections::HashMap;

use nalgebra::Point3;
use roxmltree::Node;

use super::source;
use super::xml::{File, words};
use crate::mesh::read::limits::{MAX_CORNERS, MAX_TRIANGLES, MAX_VERTICES};
use crate::mesh::read::words::shown;
use crate::mesh::read::{Fault, Place, ReadError};

/// A geometry as it is read once, however often the scene places it.
#[derive(Default)]
pub struct Geometry {
    pub positions: Vec<Point3<f64>>,
    /// Corners of all faces, each at least three, one face after the other.
    pub corners: Vec<u32>,
    /// How many corners each face has.
    pub lengths: Vec<u32>,
    /// Faces with fewer than three corners.
    pub flat: usize,
    /// Lines, which are not surfaces.
    pub lines: usize,
}

/// Reads a `<geometry>`.
pub fn read<'a>(file: &File<'a>, geometry: Node<'a, 'a>) -> Result<Geometry, ReadError> {
    let mesh = match file.child(geometry, "mesh")? {
        Some(mesh) => Some(mesh),
        None => file.child(geometry, "convex_mesh")?,
    };
    let mesh = mesh.ok_or_else(|| {
        Place::Line(file.line(geometry)).has("a geometry without a mesh; export it as a polygon mesh")
    })?;
    let mut read = Geometry::default();
    let mut first_of = HashMap::new();
    for element in file.elements(mesh)? {
        match element.tag_name().name() {
            "lines" | "linestrips" => read.lines += 1,
            name @ ("triangles" | "polylist" | "polygons" | "tristrips" | "trifans") => {
                let Some(primitive) = Primitive::of(file, element, &mut read, &mut first_of)? else { continue };
                primitive.read(name, &mut read)?;
            }
            _ => {}
        }
    }
    Ok(read)
}

/// One element of faces.
struct Primitive<'a, 'f> {
    file: &'f File<'a>,
    element: Node<'a, 'a>,
    /// Each corner has so many numbers, the vertex at this place among them.
    stride: u64,
    offset: u64,
    /// The vertices that it names, among those of the geometry.
    first: u32,
    vertices: usize,
}

impl<'a, 'f> Primitive<'a, 'f> {
    /// None where the element has no vertices, and so no faces.
    fn of(
        file: &'f File<'a>,
        element: Node<'a, 'a>,
        read: &mut Geometry,
        first_of: &mut HashMap<roxmltree::NodeId, (u32, usize)>,
    ) -> Result<Option<Self>, ReadError> {
        let (mut stride, mut vertex) = (0, None);
        for input in file.named(element, "input")? {
            let offset = file.whole(input, "offset", 0)?;
            stride = stride.max(offset.saturating_add(1));
            if input.attribute("semantic") == Some("VERTEX") {
                vertex = Some((input, offset));
            }
        }
        let Some((input, offset)) = vertex else { return Ok(None) };
        let vertices = file.referred(input, "source")?;
        let mut inputs = file.named(vertices, "input")?.into_iter();
        let position = inputs.find(|n| n.attribute("semantic") == Some("POSITION")).ok_or_else(|| {
            Place::Line(file.line(vertices)).has("vertices without positions; export the object again")
        })?;
        let source = file.referred(position, "source")?;
        let (first, vertices) = match first_of.get(&source.id()) {
            Some(&known) => known,
            None => {
                let new = source::positions(file, source)?;
                let first = read.positions.len() as u32;
                read.positions.extend(&new);
                if read.positions.len() > MAX_VERTICES {
                    return Err(Place::Line(file.line(source)).has(Fault::TooManyVertices));
                }
                *first_of.entry(source.id()).insert_entry((first, new.len())).get()
            }
        };
        Ok(Some(Self { file, element, stride, offset, first, vertices }))
    }

    fn read(&self, kind: &str, read: &mut Geometry) -> Result<(), ReadError> {
        let lists = self.file.named(self.element, "p")?.into_iter();
        match kind {
            "triangles" => self.polygons(lists, &mut std::iter::repeat(Ok(3)), read),
            "polylist" => {
                let mut counts =
                    self.file.named(self.element, "vcount")?.into_iter().flat_map(words).map(|(piece, word)| {
                        let count = word.parse::<usize>();
                        count.map_err(|_| {
                            self.at_word(piece, word)
                                .has(format!("'{}' is not a number of corners; export the object again", shown(word)))
                        })
                    });
                self.polygons(lists, &mut counts, read)?;
                // What is left may only be faces without corners.
                match counts.find(|count| !matches!(count, Ok(0))) {
                    None => Ok(()),
                    Some(left) => left.and_then(|_| Err(self.odd())),
                }
            }
            "polygons" => {
                if let Some(hole) = self.file.child(self.element, "ph")? {
                    return Err(Place::Line(self.file.line(hole))
                        .has("a polygon with holes; cut it into triangles before exporting"));
                }
                lists.into_iter().try_for_each(|list| {
                    let corners = self.corners(list).collect::<Result<Vec<_>, _>>()?;
                    self.face(list, &corners, read)
                })
            }
            _ => lists.into_iter().try_for_each(|list| {
                let corners = self.corners(list).collect::<Result<Vec<_>, _>>()?;
                (2..corners.len()).try_for_each(|i| {
                    let triangle = match kind {
                        "trifans" => [corners[0], corners[i - 1], corners[i]],
                        _ if i % 2 == 0 => [corners[i - 2], corners[i - 1], corners[i]],
                        _ => [corners[i - 1], corners[i - 2], corners[i]],
                    };
                    self.face(list, &triangle, read)
                })
            }),
        }
    }

    /// Faces of so many corners each, cut from the lists.
    fn polygons(
        &self,
        lists: impl Iterator<Item = Node<'a, 'a>>,
        counts: &mut impl Iterator<Item = Result<usize, ReadError>>,
        read: &mut Geometry,
    ) -> Result<(), ReadError> {
        let at = || Place::Line(self.file.line(self.element));
        let mut face = Vec::new();
        let mut wanted = 0;
        for list in lists {
            for corner in self.corners(list) {
                // A face without corners takes none.
                while wanted == 0 {
                    wanted = counts.next().ok_or_else(|| self.odd())??;
                    if wanted > MAX_CORNERS {
                        return Err(at().has(Fault::TooManyCorners(wanted)));
                    }
                    read.flat += usize::from(wanted == 0);
                }
                face.push(corner?);
                if face.len() == wanted {
                    self.face(list, &face, read)?;
                    face.clear();
                    wanted = 0;
                }
            }
        }
        if face.is_empty() { Ok(()) } else { Err(self.odd()) }
    }

    fn odd(&self) -> ReadError {
        Place::Line(self.file.line(self.element))
            .has("the vertex numbers end inside a face, or are more than the faces need; export the object again")
    }

    /// The vertices that a list of numbers names, each within those of the geometry.
    fn corners(&self, list: Node<'a, 'a>) -> impl Iterator<Item = Result<u32, ReadError>> {
        let own = words(list).zip(0u64..).filter(|&(_, k)| k % self.stride == self.offset).map(|(word, _)| word);
        own.map(|(piece, word)| {
            let index: i64 = word.parse().map_err(|_| {
                self.at_word(piece, word)
                    .has(format!("'{}' is not a vertex number; export the object again", shown(word)))
            })?;
            let known = u32::try_from(index).ok().filter(|&i| (i as usize) < self.vertices);
            let fault = Fault::NoSuchVertex { index, vertices: self.vertices };
            known.map(|i| self.first + i).ok_or_else(|| self.at_word(piece, word).has(fault))
        })
    }

    fn face(&self, list: Node<'a, 'a>, corners: &[u32], read: &mut Geometry) -> Result<(), ReadError> {
        let at = || Place::Line(self.file.line(list));
        if corners.len() > MAX_CORNERS {
            return Err(at().has(Fault::TooManyCorners(corners.len())));
        }
        if corners.len() < 3 {
            read.flat += 1;
            return Ok(());
        }
        read.corners.extend(corners);
        read.lengths.push(corners.len() as u32);
        if read.corners.len() - 2 * read.lengths.len() > MAX_TRIANGLES {
            return Err(at().has(Fault::TooManyTriangles));
        }
        Ok(())
    }

    fn at_word(&self, piece: Node<'_, '_>, word: &str) -> Place {
        Place::Line(self.file.line_of_word(piece, word))
    }
}
