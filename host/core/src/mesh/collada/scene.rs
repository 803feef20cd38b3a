//! The nodes of the visual scene, from its roots down, and the geometries that they place.

use std::collections::HashMap;

use nalgebra::{Matrix4, Vector3};
use roxmltree::{Node, NodeId};

use super::geometry::{self, Geometry};
use super::xml::{File, is, words};
use crate::mesh::read::placing::Placing;
use crate::mesh::read::surface::Surface;
use crate::mesh::read::words::shown;
use crate::mesh::read::{Contents, Place, ReadError};

/// Most nodes of a scene, counted once for each instance: nodes may contain each other.
const MOST_NODES: usize = 1_000_000;

/// The scene that the file shows, or its first visual scene.
pub fn flatten(file: &File<'_>) -> Result<Contents, ReadError> {
    let shown = match file.child(file.root(), "scene")? {
        Some(scene) => file.child(scene, "instance_visual_scene")?,
        None => None,
    };
    let scene = match shown {
        Some(instance) => file.referred(instance, "url")?,
        None => file.root().descendants().find(|n| is(*n, "visual_scene")).ok_or_else(|| {
            ReadError::Whole("the COLLADA file has no visual scene; export the object with its scene".into())
        })?,
    };
    let mut flat =
        Flat { file, geometries: HashMap::new(), surface: Surface::default(), nodes: 0, skins: 0, flat: 0, lines: 0 };
    flat.walk(scene)?;
    flat.finish()
}

struct Flat<'a, 'f> {
    file: &'f File<'a>,
    geometries: HashMap<NodeId, Geometry>,
    surface: Surface,
    /// Nodes so far.
    nodes: usize,
    skins: usize,
    flat: usize,
    lines: usize,
}

/// A node that is still to be read.
#[derive(Clone, Copy)]
struct Open<'a> {
    node: Node<'a, 'a>,
    parent: Placing,
    /// A transform above that is not read. A camera may have one; a mesh hardly does, and would be misplaced.
    odd: Option<Node<'a, 'a>>,
}

impl<'a> Flat<'a, '_> {
    fn walk(&mut self, scene: Node<'a, 'a>) -> Result<(), ReadError> {
        let mut open = vec![Open { node: scene, parent: Placing::none(), odd: None }];
        while let Some(Open { node, parent, odd }) = open.pop() {
            let elements = self.file.elements(node)?;
            let placing = self.placing(&elements, parent)?;
            let odd = odd.or_else(|| elements.iter().copied().find(|n| is(*n, "skew") || is(*n, "lookat")));
            let below = open.len();
            for element in elements {
                let inner = match element.tag_name().name() {
                    "node" => element,
                    "instance_node" => self.file.referred(element, "url")?,
                    "instance_geometry" | "instance_controller" if odd.is_some() => {
                        return Err(self.misplaced(odd.unwrap_or(element)));
                    }
                    "instance_geometry" => {
                        self.place(self.file.referred(element, "url")?, &placing)?;
                        continue;
                    }
                    "instance_controller" => {
                        self.skins += 1;
                        self.place(self.bound(element)?, &placing)?;
                        continue;
                    }
                    _ => continue,
                };
                self.nodes += 1;
                if self.nodes > MOST_NODES {
                    return Err(Place::Line(self.file.line(element)).has(format!(
                        "the scene has more than {MOST_NODES} nodes, or a node contains itself; export the object again"
                    )));
                }
                open.push(Open { node: inner, parent: placing, odd });
            }
            // In the order of the file.
            open[below..].reverse();
        }
        Ok(())
    }

    fn misplaced(&self, transform: Node<'a, 'a>) -> ReadError {
        let name = transform.tag_name().name();
        Place::Line(self.file.line(transform))
            .has(format!("a transform '{name}' of a mesh is not read; export transforms as matrices"))
    }

    /// The geometry that a controller (skin or morph) deforms.
    fn bound(&self, instance: Node<'a, 'a>) -> Result<Node<'a, 'a>, ReadError> {
        let mut controller = self.file.referred(instance, "url")?;
        // A skin over a morph has a second controller between.
        for _ in 0..2 {
            let deforms = match self.file.child(controller, "skin")? {
                Some(skin) => Some(skin),
                None => self.file.child(controller, "morph")?,
            };
            let Some(deforms) = deforms else { break };
            controller = self.file.referred(deforms, "source")?;
        }
        Ok(controller)
    }

    fn place(&mut self, geometry: Node<'a, 'a>, placing: &Placing) -> Result<(), ReadError> {
        let at = || Place::Line(self.file.line(geometry));
        let read = match self.geometries.entry(geometry.id()) {
            std::collections::hash_map::Entry::Occupied(known) => known.into_mut(),
            std::collections::hash_map::Entry::Vacant(new) => {
                let read = geometry::read(self.file, geometry)?;
                self.flat += read.flat;
                self.lines += read.lines;
                new.insert(read)
            }
        };
        let first =
            placing.vertices(read.positions.iter().copied(), &mut self.surface).map_err(|fault| at().has(fault))?;
        let mut rest = &read.corners[..];
        let mut face = Vec::new();
        for &length in &read.lengths {
            let (corners, tail) = rest.split_at(length as usize);
            rest = tail;
            face.clear();
            face.extend(corners.iter().map(|i| first + i));
            placing.face(&mut face, &mut self.surface).map_err(|fault| at().has(fault))?;
        }
        Ok(())
    }

    /// Where a node with these elements is: its transforms apply from the last to the first.
    fn placing(&self, elements: &[Node<'a, 'a>], parent: Placing) -> Result<Placing, ReadError> {
        let mut placing = parent;
        for &element in elements {
            let local = match element.tag_name().name() {
                "matrix" => Matrix4::from_row_slice(&self.numbers::<16>(element)?),
                "translate" => Matrix4::new_translation(&Vector3::from(self.numbers::<3>(element)?)),
                "scale" => Matrix4::new_nonuniform_scaling(&Vector3::from(self.numbers::<3>(element)?)),
                "rotate" => rotation(self.numbers::<4>(element)?),
                _ => continue,
            };
            placing = placing.within(&local);
        }
        Ok(placing)
    }

    fn numbers<const N: usize>(&self, element: Node<'a, 'a>) -> Result<[f64; N], ReadError> {
        let mut numbers = [0.0; N];
        let mut count = 0;
        for (piece, word) in words(element).take(N + 1) {
            let number = word.parse().ok().filter(|x: &f64| x.is_finite());
            let number = number.ok_or_else(|| {
                Place::Line(self.file.line_of_word(piece, word))
                    .has(format!("'{}' is not a finite number; export the object again", shown(word)))
            })?;
            if let Some(place) = numbers.get_mut(count) {
                *place = number;
            }
            count += 1;
        }
        if count == N {
            return Ok(numbers);
        }
        let name = element.tag_name().name();
        Err(Place::Line(self.file.line(element))
            .has(format!("'{name}' needs {N} numbers, and here are fewer or more; export the object again")))
    }

    fn finish(self) -> Result<Contents, ReadError> {
        if self.surface.triangles() == 0 {
            return Err(ReadError::Whole(
                "the scene of the COLLADA file shows no faces; export it with its meshes".into(),
            ));
        }
        let mut warnings = Vec::new();
        for (count, what) in [
            (self.flat, "face(s) with fewer than 3 corners"),
            (self.lines, "set(s) of lines: lines are not surfaces"),
            (self.skins, "skin(s) or morph(s): the meshes are in the shape they were bound in"),
        ] {
            if count > 0 {
                warnings.push(format!("Skipped {count} {what}."));
            }
        }
        Ok((self.surface.finish(&mut warnings)?, warnings))
    }
}

/// Around an axis, in degrees. Quarter turns are exact; an axis of length zero turns nothing.
fn rotation([x, y, z, degrees]: [f64; 4]) -> Matrix4<f64> {
    let Some(axis) = Vector3::new(x, y, z).try_normalize(0.0) else { return Matrix4::identity() };
    let (sin, cos) = match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        turn => libm::sincos(turn.to_radians()),
    };
    let (x, y, z, v) = (axis.x, axis.y, axis.z, 1.0 - cos);
    #[rustfmt::skip]
    let rotation = Matrix4::new(
        v * x * x + cos,     v * x * y - sin * z, v * x * z + sin * y, 0.0,
        v * x * y + sin * z, v * y * y + cos,     v * y * z - sin * x, 0.0,
        v * x * z - sin * y, v * y * z + sin * x, v * z * z + cos,     0.0,
        0.0,                 0.0,                 0.0,                 1.0,
    );
    rotation
}
