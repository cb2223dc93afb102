//! Accessors of glTF: reading, picking elements, writing.

use serde_json::{Value, json};

use super::document::Document;
use super::error::CliError;

const FLOAT: u64 = 5126;
const UNSIGNED_SHORT: u64 = 5123;
const UNSIGNED_INT: u64 = 5125;

/// The elements of an accessor, tightly packed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Elements {
    /// The accessor itself without what says where its data is.
    template: Value,
    /// Bytes of one element.
    size: usize,
    bytes: Vec<u8>,
}

impl Elements {
    /// Reads an accessor, sparse or not.
    pub fn read(document: &Document, accessor: usize) -> Result<Self, CliError> {
        let damaged = || CliError::new(format!("damaged: accessor {accessor} cannot be read; export the scene again"));
        Self::try_read(document, accessor).ok_or_else(damaged)
    }

    fn try_read(document: &Document, index: usize) -> Option<Self> {
        let accessor = document.list("accessors").get(index)?;
        let (size, count) = (element_size(accessor)?, accessor["count"].as_u64()? as usize);
        let mut bytes = vec![0; size.checked_mul(count)?];
        if let Some(view) = accessor["bufferView"].as_u64() {
            let stride = document.list("bufferViews").get(view as usize)?["byteStride"].as_u64();
            let source = document.view(view as usize)?.get(offset(accessor)..)?;
            let stride = stride.map_or(size, |stride| stride as usize);
            for (element, at) in bytes.chunks_exact_mut(size).zip((0..).step_by(stride)) {
                element.copy_from_slice(source.get(at..at + size)?);
            }
        }
        if let Some(sparse) = accessor.get("sparse") {
            let replaced = sparse["count"].as_u64()? as usize;
            let places = &sparse["indices"];
            let width = component_size(places["componentType"].as_u64()?)?;
            let places = document.view(places["bufferView"].as_u64()? as usize)?.get(offset(places)..)?;
            let values = &sparse["values"];
            let values = document.view(values["bufferView"].as_u64()? as usize)?.get(offset(values)..)?;
            for (place, element) in places.chunks_exact(width).zip(values.chunks_exact(size)).take(replaced) {
                let at = unsigned(place) as usize * size;
                bytes.get_mut(at..at + size)?.copy_from_slice(element);
            }
        }
        let mut template = accessor.clone();
        for key in ["bufferView", "byteOffset", "count", "sparse"] {
            template.as_object_mut()?.remove(key);
        }
        Some(Self { template, size, bytes })
    }

    /// Pairs of floats.
    pub fn vec2(values: &[[f32; 2]]) -> Self {
        let bytes = values.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
        Self { template: json!({ "componentType": FLOAT, "type": "VEC2" }), size: 8, bytes }
    }

    /// Vectors of floats.
    pub fn vec3(values: &[[f32; 3]]) -> Self {
        let bytes = values.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
        let template = json!({ "componentType": FLOAT, "type": "VEC3", "min": [], "max": [] });
        Self { template, size: 12, bytes }
    }

    /// Indices, in 16 bits each where they fit. 65535 is left out, which restarts a strip.
    pub fn indices(values: &[u32]) -> Self {
        let short = values.iter().all(|&index| index < 0xFFFF);
        let (component, size) = if short { (UNSIGNED_SHORT, 2) } else { (UNSIGNED_INT, 4) };
        let bytes = values.iter().flat_map(|value| value.to_le_bytes().into_iter().take(size)).collect();
        Self { template: json!({ "componentType": component, "type": "SCALAR" }), size, bytes }
    }

    /// How many elements there are.
    pub fn count(&self) -> usize {
        self.bytes.len() / self.size
    }

    /// Each element as an unsigned number, for indices.
    pub fn unsigned(&self) -> Vec<u32> {
        self.bytes.chunks_exact(self.size).map(unsigned).collect()
    }

    /// The elements with these numbers, in this order.
    pub fn pick(&self, elements: &[u32]) -> Self {
        let element = |&index: &u32| &self.bytes[index as usize * self.size..][..self.size];
        Self { bytes: elements.iter().flat_map(element).copied().collect(), ..self.clone() }
    }

    /// The same numbers as floats, normalized ones divided as glTF says.
    pub fn to_floats(&self) -> Self {
        let component = self.component();
        let scale = match (component, self.template["normalized"] == json!(true)) {
            (5120, true) => 127.0,
            (5121, true) => 255.0,
            (5122, true) => 32767.0,
            (UNSIGNED_SHORT, true) => 65535.0,
            _ => 1.0,
        };
        let numbers = self.bytes.chunks_exact(self.size / self.width()).map(|bytes| number(component, bytes));
        let floats = numbers.map(|number| (number / scale).max(if scale > 1.0 { -1.0 } else { f64::MIN }) as f32);
        let bytes = floats.flat_map(f32::to_le_bytes).collect();
        let mut template = self.template.clone();
        template["componentType"] = json!(FLOAT);
        template["normalized"] = json!(false);
        Self { size: 4 * self.width(), template, bytes }
    }

    /// Appends the elements to a document as vertices or indices and returns the index of their accessor.
    ///
    /// Elements of vertices start at multiples of 4 bytes, as glTF wants it.
    pub fn write(&self, document: &mut Document, vertices: bool) -> usize {
        let stride = if vertices { self.size.next_multiple_of(4) } else { self.size };
        let mut bytes = vec![0; stride * self.count()];
        for (padded, element) in bytes.chunks_exact_mut(stride).zip(self.bytes.chunks_exact(self.size)) {
            padded[..self.size].copy_from_slice(element);
        }
        let view = document.push_view(&bytes);
        if stride != self.size {
            document.list_mut("bufferViews")[view]["byteStride"] = json!(stride);
        }
        let mut accessor = self.template.clone();
        accessor["bufferView"] = json!(view);
        accessor["count"] = json!(self.count());
        if accessor.get("min").is_some() && accessor.get("max").is_some() {
            let (min, max) = self.bounds();
            accessor["min"] = json!(min);
            accessor["max"] = json!(max);
        }
        let accessors = document.list_mut("accessors");
        accessors.push(accessor);
        accessors.len() - 1
    }

    /// Smallest and largest value of each component.
    pub fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        let (width, component) = (self.width(), self.component());
        let mut bounds = (vec![f64::INFINITY; width], vec![f64::NEG_INFINITY; width]);
        for element in self.bytes.chunks_exact(self.size) {
            for (index, bytes) in element.chunks_exact(self.size / width).enumerate() {
                let number = number(component, bytes);
                bounds.0[index] = bounds.0[index].min(number);
                bounds.1[index] = bounds.1[index].max(number);
            }
        }
        // JSON has no infinity, which only remains where all numbers are NaN.
        let finite = |list: Vec<f64>| list.into_iter().map(|n| if n.is_finite() { n } else { 0.0 }).collect();
        (finite(bounds.0), finite(bounds.1))
    }

    fn component(&self) -> u64 {
        self.template["componentType"].as_u64().unwrap_or(FLOAT)
    }

    /// Components of one element.
    fn width(&self) -> usize {
        component_size(self.component()).map_or(1, |size| (self.size / size).max(1))
    }
}

/// Bytes of one element of an accessor without padding; none for matrices of small components and unknown types.
pub(super) fn element_size(accessor: &Value) -> Option<usize> {
    let size = component_size(accessor["componentType"].as_u64()?)?;
    let components = match accessor["type"].as_str()? {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        // Columns start at multiples of four bytes, so smaller components would be padded.
        "MAT2" => 8_usize.max(4 * size) / size,
        "MAT3" => (if size == 4 { 36 } else { 12 * size }) / size,
        "MAT4" => 16,
        _ => return None,
    };
    Some(size * components)
}

fn component_size(component: u64) -> Option<usize> {
    match component {
        5120 | 5121 => Some(1),
        5122 | UNSIGNED_SHORT => Some(2),
        UNSIGNED_INT | FLOAT => Some(4),
        _ => None,
    }
}

fn offset(value: &Value) -> usize {
    value["byteOffset"].as_u64().unwrap_or(0) as usize
}

fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
}

fn number(component: u64, bytes: &[u8]) -> f64 {
    let bits = unsigned(bytes);
    match component {
        5120 => f64::from(bits as u8 as i8),
        5122 => f64::from(bits as u16 as i16),
        FLOAT => f64::from(f32::from_bits(bits)),
        _ => f64::from(bits),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(accessor: Value, buffer: &[u8]) -> Document {
        let mut document = Document { json: json!({}), buffer: Vec::new() };
        document.push_view(buffer);
        document.json["accessors"] = json!([accessor]);
        document
    }

    #[test]
    fn strides_are_packed() {
        let accessor = json!({ "bufferView": 0, "componentType": 5121, "type": "VEC3", "count": 2, "byteOffset": 1 });
        let mut document = document(accessor, &[9, 1, 2, 3, 9, 4, 5, 6]);
        document.list_mut("bufferViews")[0]["byteStride"] = json!(4);
        let elements = Elements::read(&document, 0).unwrap();
        assert_eq!(elements.bytes, [1, 2, 3, 4, 5, 6]);
        assert_eq!(elements.pick(&[1, 0, 1]).bytes, [4, 5, 6, 1, 2, 3, 4, 5, 6]);
    }

    /// Sparse values replace those of the base, which is zero where there is none.
    #[test]
    fn sparse_accessors_are_resolved() {
        let accessor = json!({ "componentType": 5123, "type": "SCALAR", "count": 3, "sparse": { "count": 1,
            "indices": { "bufferView": 0, "componentType": 5121 },
            "values": { "bufferView": 0, "byteOffset": 2 } } });
        let document = document(accessor, &[1, 0, 0x34, 0x12]);
        assert_eq!(Elements::read(&document, 0).unwrap().unsigned(), [0, 0x1234, 0]);
    }

    /// What is written reads back, with padding that glTF wants and bounds that are true.
    #[test]
    fn written_vertices_read_back() {
        let accessor = json!({ "bufferView": 0, "componentType": 5122, "type": "VEC3", "count": 2, "normalized": true,
            "min": [0, 0, 0], "max": [0, 0, 0] });
        let shorts = [-32767_i16, 2, 3, 4, 5, 32767];
        let bytes: Vec<u8> = shorts.iter().flat_map(|short| short.to_le_bytes()).collect();
        let mut document = document(accessor, &bytes);
        let elements = Elements::read(&document, 0).unwrap();
        let written = elements.write(&mut document, true);
        assert_eq!(Elements::read(&document, written).unwrap().bytes, bytes);
        assert_eq!(document.list("bufferViews")[1]["byteStride"], 8);
        assert_eq!(document.list("accessors")[written]["min"], json!([-32767.0, 2.0, 3.0]));
        let floats = elements.to_floats().bounds();
        assert_eq!((floats.0[0], floats.1[2]), (-1.0, 1.0));
    }

    #[test]
    fn indices_take_as_few_bytes_as_they_can() {
        assert_eq!(Elements::indices(&[0, 65534]).bytes.len(), 4);
        assert_eq!(Elements::indices(&[0, 65535]).unsigned(), [0, 65535]);
        assert_eq!(Elements::indices(&[0, 65535]).bytes.len(), 8);
    }
}
