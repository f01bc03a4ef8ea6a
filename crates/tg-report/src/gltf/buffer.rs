//! Numbers of a glTF file and the file itself.

use serde_json::{Value, json};

use crate::error::ReportError;

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The binary part, with the views and accessors that name its pieces. All numbers have four bytes, so that every piece is
/// aligned.
#[derive(Default)]
pub(super) struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Positions of vertices, with the bounds that the format demands.
    pub(super) fn positions(&mut self, points: &[[f32; 3]]) -> usize {
        let fold = |f: fn(f32, f32) -> f32| {
            points.iter().copied().reduce(|a, b| std::array::from_fn(|k| f(a[k], b[k]))).unwrap_or_default()
        };
        let (least, greatest) = (fold(f32::min), fold(f32::max));
        let accessor = self.floats(points, Some(ARRAY_BUFFER), "VEC3");
        self.accessors[accessor]["min"] = json!(least.map(f64::from));
        self.accessors[accessor]["max"] = json!(greatest.map(f64::from));
        accessor
    }

    /// Normals of vertices.
    pub(super) fn directions(&mut self, directions: &[[f32; 3]]) -> usize {
        self.floats(directions, Some(ARRAY_BUFFER), "VEC3")
    }

    /// Corners of triangles.
    pub(super) fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let view = self.view(triangles.iter().flatten().map(|i| i.to_le_bytes()), Some(ELEMENT_ARRAY_BUFFER));
        let count = 3 * triangles.len();
        self.accessor(
            json!({"bufferView": view, "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR"}),
        )
    }

    /// Values of an animation: vectors or quaternions.
    pub(super) fn keys<const N: usize>(&mut self, keys: &[[f32; N]]) -> usize {
        self.floats(keys, None, if N == 3 { "VEC3" } else { "VEC4" })
    }

    /// Times of an animation, ascending.
    pub(super) fn times(&mut self, times: &[f32]) -> usize {
        let keys: Vec<[f32; 1]> = times.iter().map(|&t| [t]).collect();
        let accessor = self.floats(&keys, None, "SCALAR");
        let ends = [times.first(), times.last()].map(|t| f64::from(t.copied().unwrap_or(0.0)));
        self.accessors[accessor]["min"] = json!([ends[0]]);
        self.accessors[accessor]["max"] = json!([ends[1]]);
        accessor
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], target: Option<u32>, kind: &str) -> usize {
        let view = self.view(values.iter().flatten().map(|x| x.to_le_bytes()), target);
        let count = values.len();
        self.accessor(json!({"bufferView": view, "componentType": FLOAT, "count": count, "type": kind}))
    }

    fn view(&mut self, values: impl Iterator<Item = [u8; 4]>, target: Option<u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(values.flatten());
        let length = self.bytes.len() - start;
        let mut view = json!({"buffer": 0, "byteOffset": start, "byteLength": length});
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// The file: a header, a chunk of JSON, a chunk of numbers.
    pub(super) fn write(self, mut file: Value) -> Result<Vec<u8>, ReportError> {
        if !self.bytes.is_empty() {
            file["buffers"] = json!([{"byteLength": self.bytes.len()}]);
            file["bufferViews"] = self.views.into();
            file["accessors"] = self.accessors.into();
        }
        let mut json = serde_json::to_vec(&file).map_err(ReportError::json("glTF".as_ref()))?;
        json.resize(json.len().next_multiple_of(4), b' ');
        let numbers = if self.bytes.is_empty() { 0 } else { 8 + self.bytes.len() };
        let total = 12 + 8 + json.len() + numbers;
        let size = |n: usize| {
            u32::try_from(n).map_err(|_| ReportError::Drawing {
                what: "the animation".into(),
                reason: format!("{n} bytes are more than a file of this format can hold; take fewer frames"),
            })
        };
        let mut out = Vec::with_capacity(total);
        out.extend(b"glTF");
        out.extend(2_u32.to_le_bytes());
        out.extend(size(total)?.to_le_bytes());
        out.extend(size(json.len())?.to_le_bytes());
        out.extend(b"JSON");
        out.extend(json);
        if numbers > 0 {
            out.extend(size(self.bytes.len())?.to_le_bytes());
            out.extend(b"BIN\0");
            out.extend(self.bytes);
        }
        Ok(out)
    }
}
