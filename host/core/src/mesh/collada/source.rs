//! A `<source>` of positions: an array of numbers, and an accessor that says which of them belong to a vertex.

use nalgebra::Point3;
use roxmltree::Node;

use super::xml::{File, words};
use crate::mesh::read::limits::MAX_VERTICES;
use crate::mesh::read::words::coordinate;
use crate::mesh::read::{Fault, Place, ReadError};

/// Most numbers of one array: more than three for each vertex.
const MOST_NUMBERS: usize = 4 * MAX_VERTICES;

/// The positions, read in double precision.
pub fn positions<'a>(file: &File<'a>, source: Node<'a, 'a>) -> Result<Vec<Point3<f64>>, ReadError> {
    let accessor = match file.child(source, "technique_common")? {
        Some(common) => file.child(common, "accessor")?,
        None => None,
    };
    let accessor = accessor
        .ok_or_else(|| Place::Line(file.line(source)).has("a source without an accessor; export the object again"))?;
    let numbers = numbers(file, file.referred(accessor, "source")?)?;

    let (count, offset) = (file.whole(accessor, "count", 0)?, file.whole(accessor, "offset", 0)?);
    let stride = file.whole(accessor, "stride", 1)?;
    let axes = axes(&file.named(accessor, "param")?);
    let furthest = axes.iter().max().map_or(0, |&k| k as u64);
    let at = || Place::Line(file.line(accessor));
    if count > MAX_VERTICES as u64 {
        return Err(at().has(Fault::TooManyVertices));
    }
    if stride <= furthest {
        return Err(
            at().has(format!("a stride of {stride} numbers, but a vertex has 3 coordinates; export the object again"))
        );
    }
    let end = stride
        .checked_mul(count.saturating_sub(1))
        .and_then(|n| n.checked_add(offset))
        .and_then(|n| n.checked_add(furthest + 1));
    if count > 0 && end.is_none_or(|end| end > numbers.len() as u64) {
        return Err(at().has(format!(
            "it needs more numbers than the {} of its array; export or download the file again",
            numbers.len()
        )));
    }
    let position = |i: u64| Point3::from(axes.map(|k| numbers[(offset + stride * i) as usize + k]));
    Ok((0..count).map(position).collect())
}

/// Where x, y and z stand among the numbers of a vertex.
fn axes(params: &[Node<'_, '_>]) -> [usize; 3] {
    let names: Vec<_> = params.iter().map(|param| param.attribute("name")).collect();
    let named = ["X", "Y", "Z"].map(|axis| names.iter().position(|name| *name == Some(axis)));
    match named {
        [Some(x), Some(y), Some(z)] => [x, y, z],
        _ => [0, 1, 2],
    }
}

fn numbers<'a>(file: &File<'a>, array: Node<'a, 'a>) -> Result<Vec<f64>, ReadError> {
    let mut numbers = Vec::new();
    for (piece, word) in words(array) {
        let at = || Place::Line(file.line_of_word(piece, word));
        file.step()?;
        if numbers.len() == MOST_NUMBERS {
            return Err(at().has(Fault::TooManyVertices));
        }
        numbers.push(coordinate(word).map_err(|fault| at().has(fault))?);
    }
    let promised = file.whole(array, "count", numbers.len() as u64)?;
    if promised != numbers.len() as u64 {
        let at = Place::Line(file.line(array));
        return Err(at.has(format!(
            "the array promises {promised} numbers, but holds {}; export or download the file again",
            numbers.len()
        )));
    }
    Ok(numbers)
}
