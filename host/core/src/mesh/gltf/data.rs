//! Buffers, views and accessors of a glTF document.

use std::borrow::Cow;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::DecodePaddingMode;
use base64::engine::general_purpose::{GeneralPurpose, GeneralPurposeConfig};

use super::document::{Accessor, Document, SparsePart};
use crate::mesh::read::words::shown;
use crate::mesh::read::{Fault, Place, ReadError};

/// Padding at the end is optional, since exporters leave it out.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The data of all buffers of a document, each as long as it promises.
pub struct Buffers<'a> {
    document: &'a Document<'a>,
    data: Vec<Cow<'a, [u8]>>,
}

impl<'a> Buffers<'a> {
    /// Opens what is inside the file; a buffer in another file is refused.
    pub fn open(document: &'a Document<'a>, binary: Option<&'a [u8]>) -> Result<Self, ReadError> {
        let mut data = Vec::new();
        for (i, buffer) in document.buffers.iter().enumerate() {
            let at = entry("buffers", i as u32);
            let bytes: Cow<'a, [u8]> = match (&buffer.uri, binary.filter(|_| i == 0)) {
                (Some(uri), _) => Cow::Owned(embedded(uri).map_err(|fault| at.clone().has(fault))?),
                (None, Some(binary)) => Cow::Borrowed(binary),
                (None, None) => return Err(at.has("it has no data; export the object as GLB")),
            };
            if (bytes.len() as u64) < buffer.byte_length {
                return Err(at.has(format!(
                    "it promises {} bytes, but holds {}; export or download the file again",
                    buffer.byte_length,
                    bytes.len()
                )));
            }
            data.push(bytes);
        }
        Ok(Self { document, data })
    }

    /// The elements of an accessor of `N` numbers each; its type must be `kind`, and it has at most `most` elements.
    pub fn elements<const N: usize>(
        &self,
        index: u32,
        kind: &str,
        most: (usize, Fault),
    ) -> Result<Vec<[f64; N]>, ReadError> {
        let at = entry("accessors", index);
        let accessor = self.document.accessors.get(index as usize);
        let accessor = accessor.ok_or_else(|| at.clone().has(MISSING))?;
        if accessor.kind != kind {
            let found = shown(&accessor.kind);
            return Err(at.has(format!("its type is '{found}', but '{kind}' belongs here; export the object again")));
        }
        if accessor.count > most.0 as u64 {
            return Err(at.has(most.1));
        }
        let component = Component::of(accessor.component_type).ok_or_else(|| at.clone().has(NO_COMPONENT))?;
        let count = accessor.count as usize;
        let mut elements = match accessor.buffer_view {
            Some(view) => self.decode(view, accessor.byte_offset, count, component, &at)?,
            // Zeros, of which the sparse ones below are none.
            None if accessor.sparse.is_some() => vec![[0.0; N]; count],
            None => return Err(at.has("it has no data; export the object again")),
        };
        self.overwrite(accessor, component, &mut elements, &at)?;
        if accessor.normalized {
            elements.iter_mut().flatten().for_each(|x| *x = component.normal(*x));
        }
        Ok(elements)
    }

    /// Puts the sparse elements in their places.
    fn overwrite<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
        component: Component,
        elements: &mut [[f64; N]],
        at: &Place,
    ) -> Result<(), ReadError> {
        let Some(sparse) = &accessor.sparse else { return Ok(()) };
        if sparse.count > accessor.count {
            return Err(at.clone().has("it has more sparse elements than elements; export the object again"));
        }
        let whole =
            sparse.indices.component_type.and_then(Component::of).ok_or_else(|| at.clone().has(NO_COMPONENT))?;
        let part = |part: &SparsePart| (part.buffer_view, part.byte_offset, sparse.count as usize);
        let (view, offset, count) = part(&sparse.indices);
        let indices: Vec<[f64; 1]> = self.decode(view, offset, count, whole, at)?;
        let (view, offset, count) = part(&sparse.values);
        let values: Vec<[f64; N]> = self.decode(view, offset, count, component, at)?;
        for ([index], value) in indices.into_iter().zip(values) {
            let element = elements.get_mut(index as usize);
            *element.ok_or_else(|| {
                at.clone().has("a sparse element is beyond the last element; export the object again")
            })? = value;
        }
        Ok(())
    }

    /// Numbers out of a view, all of which lie inside it.
    fn decode<const N: usize>(
        &self,
        view: u32,
        offset: u64,
        count: usize,
        component: Component,
        at: &Place,
    ) -> Result<Vec<[f64; N]>, ReadError> {
        let in_view = entry("bufferViews", view);
        let view = self.document.buffer_views.get(view as usize).ok_or_else(|| in_view.clone().has(MISSING))?;
        if view.extensions.meshopt.is_some() {
            return Err(
                in_view.has("it is compressed by meshopt, which is not read; export the object without compression")
            );
        }
        let buffer = self.data.get(view.buffer as usize).ok_or_else(|| entry("buffers", view.buffer).has(MISSING))?;
        let end = view.byte_offset.checked_add(view.byte_length).filter(|&end| end <= buffer.len() as u64);
        let end =
            end.ok_or_else(|| in_view.clone().has("it ends behind its buffer; export or download the file again"))?;
        let bytes = &buffer[view.byte_offset as usize..end as usize];
        let size = (N * component.bytes()) as u64;
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size {
            return Err(
                in_view.has(format!("a stride of {stride} bytes, but elements have {size}; export the object again"))
            );
        }
        let Some(last) = (count as u64).checked_sub(1) else { return Ok(Vec::new()) };
        let end = stride.checked_mul(last).and_then(|n| n.checked_add(offset)).and_then(|n| n.checked_add(size));
        if end.is_none_or(|end| end > bytes.len() as u64) {
            return Err(at.clone().has(format!(
                "its {count} elements end behind its view of {} bytes; export or download the file again",
                bytes.len()
            )));
        }
        let element = |i: usize| {
            let start = offset as usize + stride as usize * i;
            std::array::from_fn(|k| component.number(&bytes[start + k * component.bytes()..]))
        };
        Ok((0..count).map(element).collect())
    }
}

const MISSING: &str = "it is named, but not there; export the object again";
const NO_COMPONENT: &str = "its component type is none of glTF; export the object again";

/// An entry of a list of the document.
pub fn entry(list: &str, index: u32) -> Place {
    Place::Entry(format!("{list}[{index}]"))
}

/// The data in a `data:` address.
fn embedded(uri: &str) -> Result<Vec<u8>, Fault> {
    let Some(inside) = uri.strip_prefix("data:") else {
        let other = shown(uri);
        return Err(
            format!("its data is in another file ('{other}'), which is not opened; export the object as GLB").into()
        );
    };
    let payload = inside.split_once(',').filter(|(head, _)| head.ends_with(";base64"));
    let (_, payload) = payload.ok_or("its data is not in base64; export the object as GLB")?;
    BASE64.decode(payload).map_err(|_| "its base64 is damaged; export or download the file again".into())
}

/// The types of numbers, by their OpenGL numbers.
#[derive(Clone, Copy)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(number: u32) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The little-endian number at the beginning of these bytes.
    fn number(self, bytes: &[u8]) -> f64 {
        match *bytes {
            [a, ..] if matches!(self, Self::I8) => f64::from(a as i8),
            [a, ..] if matches!(self, Self::U8) => f64::from(a),
            [a, b, ..] if matches!(self, Self::I16) => f64::from(i16::from_le_bytes([a, b])),
            [a, b, ..] if matches!(self, Self::U16) => f64::from(u16::from_le_bytes([a, b])),
            [a, b, c, d, ..] if matches!(self, Self::U32) => f64::from(u32::from_le_bytes([a, b, c, d])),
            [a, b, c, d, ..] => f64::from(f32::from_le_bytes([a, b, c, d])),
            // The caller has checked the length.
            _ => f64::NAN,
        }
    }

    /// A whole number as a share of the largest one.
    fn normal(self, number: f64) -> f64 {
        match self {
            Self::I8 => (number / 127.0).max(-1.0),
            Self::U8 => number / 255.0,
            Self::I16 => (number / 32767.0).max(-1.0),
            Self::U16 => number / 65535.0,
            Self::U32 | Self::F32 => number,
        }
    }
}
