//! glTF files, checked against the specification piece by piece.

use serde_json::Value;
use tg_report::{Frame, Outline, ReportError, glb};

use crate::sample;

struct File {
    json: Value,
    bytes: Vec<u8>,
}

impl File {
    fn parse(glb: &[u8]) -> Self {
        let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap());
        assert_eq!((&glb[..4], word(4), word(8) as usize), (&b"glTF"[..], 2, glb.len()));
        let length = word(12) as usize;
        assert_eq!((&glb[16..20], length % 4), (&b"JSON"[..], 0));
        let json: Value = serde_json::from_slice(&glb[20..20 + length]).unwrap();
        let at = 20 + length;
        let bytes = if at < glb.len() {
            assert_eq!((word(at) as usize, &glb[at + 4..at + 8]), (glb.len() - at - 8, &b"BIN\0"[..]));
            assert_eq!(json["buffers"][0]["byteLength"], glb.len() - at - 8);
            glb[at + 8..].to_vec()
        } else {
            Vec::new()
        };
        Self { json, bytes }
    }

    fn list(&self, name: &str) -> &[Value] {
        self.json[name].as_array().map_or(&[], Vec::as_slice)
    }

    /// Values of an accessor, one row each; checks bounds, alignment, and min and max.
    fn rows(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let accessor = &self.list("accessors")[accessor.as_u64().unwrap() as usize];
        let view = &self.list("bufferViews")[accessor["bufferView"].as_u64().unwrap() as usize];
        let number = |value: &Value| value.as_u64().unwrap() as usize;
        let (start, length) = (number(&view["byteOffset"]), number(&view["byteLength"]));
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            other => panic!("{other}"),
        };
        assert!(start % 4 == 0 && start + length <= self.bytes.len());
        assert_eq!(number(&accessor["count"]) * width * 4, length);
        let values: Vec<f64> = self.bytes[start..start + length]
            .as_chunks::<4>()
            .0
            .iter()
            .map(|b| match accessor["componentType"].as_u64() {
                Some(5126) => f64::from(f32::from_le_bytes(*b)),
                Some(5125) => f64::from(u32::from_le_bytes(*b)),
                other => panic!("{other:?}"),
            })
            .collect();
        assert!(values.iter().all(|x| x.is_finite()));
        let rows: Vec<Vec<f64>> = values.chunks(width).map(<[f64]>::to_vec).collect();
        for (key, pick) in [("min", f64::min as fn(f64, f64) -> f64), ("max", f64::max)] {
            if let Some(declared) = accessor[key].as_array() {
                for (k, declared) in declared.iter().enumerate() {
                    let actual = rows.iter().map(|row| row[k]).reduce(pick).unwrap();
                    assert_eq!(declared.as_f64().unwrap(), actual);
                }
            }
        }
        rows
    }
}

fn length(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn an_animation_follows_the_specification() {
    let frames = sample::frames(200); // turns by 20 rad: quaternions pass both signs
    let file = File::parse(&glb(&sample::outline(), &frames).unwrap());
    assert_eq!(file.json["asset"]["version"], "2.0");
    let nodes = file.list("nodes");
    assert_eq!(nodes.len(), 1 + 4 + 3);
    assert_eq!(nodes[0]["children"].as_array().unwrap().len(), 7);
    assert_eq!(nodes[2]["name"], "bar <2> & \"last\"");
    for mesh in file.list("meshes") {
        let primitive = &mesh["primitives"][0];
        assert!((primitive["material"].as_u64().unwrap() as usize) < file.list("materials").len());
        let position =
            &file.list("accessors")[primitive["attributes"]["POSITION"].as_u64().unwrap() as usize];
        assert!(position["min"].is_array() && position["max"].is_array());
        let positions = file.rows(&primitive["attributes"]["POSITION"]);
        let normals = file.rows(&primitive["attributes"]["NORMAL"]);
        assert_eq!(positions.len(), normals.len());
        assert!(normals.iter().all(|n| (length(n) - 1.0).abs() < 1e-6));
        let corners = file.rows(&primitive["indices"]);
        assert!(corners.len().is_multiple_of(3) && corners.iter().all(|i| (i[0] as usize) < positions.len()));
        outwards(&positions, &normals, &corners);
    }
    let animation = &file.list("animations")[0];
    let samplers = animation["samplers"].as_array().unwrap();
    let channels = animation["channels"].as_array().unwrap();
    assert_eq!(samplers.len(), channels.len());
    let mut targets: Vec<_> = channels.iter().map(|c| c["target"].to_string()).collect();
    targets.sort();
    targets.dedup();
    assert_eq!(targets.len(), channels.len(), "one channel for each property");
    for channel in channels {
        let sampler = &samplers[channel["sampler"].as_u64().unwrap() as usize];
        let times = file.rows(&sampler["input"]);
        assert!(times.len() == 200 && times[0][0] == 0.0 && times.is_sorted());
        let keys = file.rows(&sampler["output"]);
        assert_eq!(keys.len(), times.len());
        if channel["target"]["path"] == "rotation" {
            assert!(keys.iter().all(|q| (length(q) - 1.0).abs() < 1e-6));
            let near = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() > 0.9;
            assert!(keys.windows(2).all(|pair| near(&pair[0], &pair[1])));
        }
    }
    cables_end_where_they_should(&file, &frames);
}

/// A triangle's corners run counter-clockwise seen from where its normals point.
fn outwards(positions: &[Vec<f64>], normals: &[Vec<f64>], corners: &[Vec<f64>]) {
    for triangle in corners.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|k| triangle[k][0] as usize);
        let edge = |i: usize, j: usize| [0, 1, 2].map(|k| positions[j][k] - positions[i][k]);
        let (u, v) = (edge(a, b), edge(a, c));
        let area = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let side: f64 = [a, b, c].iter().flat_map(|&i| (0..3).map(move |k| normals[i][k] * area[k])).sum();
        assert!(side > 0.0, "{side}");
    }
}

fn cables_end_where_they_should(file: &File, frames: &[Frame]) {
    let animation = &file.list("animations")[0];
    let keys = |node: usize, path: &str| -> Vec<Vec<f64>> {
        let channels = animation["channels"].as_array().unwrap();
        let channel = channels.iter().find(|c| c["target"]["node"] == node && c["target"]["path"] == path);
        match channel {
            Some(c) => file.rows(&animation["samplers"][c["sampler"].as_u64().unwrap() as usize]["output"]),
            None => {
                vec![serde_json::from_value(file.list("nodes")[node][path].clone()).unwrap(); frames.len()]
            }
        }
    };
    for cable in 0..3 {
        let node = 1 + 4 + cable;
        let [at, turn, stretch] = ["translation", "rotation", "scale"].map(|path| keys(node, path));
        for (k, frame) in frames.iter().enumerate() {
            let position = [at[k][0], at[k][1], at[k][2]];
            let rotation = [turn[k][0], turn[k][1], turn[k][2], turn[k][3]];
            let end = tg_report::Placement { position, rotation }.apply([0.0, 0.0, stretch[k][2]]);
            for (got, expected) in
                [(position, frame.cables[cable].ends[0]), (end, frame.cables[cable].ends[1])]
            {
                assert!((0..3).all(|i| (got[i] - expected[i]).abs() < 1e-5), "{got:?} {expected:?}");
            }
        }
    }
}

#[test]
fn one_frame_is_a_still_picture_and_odd_frames_are_left_out() {
    let outline = sample::outline();
    let still = File::parse(&glb(&outline, &sample::frames(1)).unwrap());
    assert!(still.json.get("animations").is_none());
    let mut frames = sample::frames(5);
    frames[1].time = 0.0;
    frames[3].poses[0].position[1] = f64::NAN;
    let file = File::parse(&glb(&outline, &frames).unwrap());
    let input = &file.json["animations"][0]["samplers"][0]["input"];
    assert_eq!(file.rows(input).len(), 3);
    assert!(matches!(glb(&outline, &frames[3..4]), Err(ReportError::Empty { .. })));
    let nothing = Frame { time: 0.0, poses: Vec::new(), cables: Vec::new() };
    let file = File::parse(&glb(&Outline::new(3), &[nothing]).unwrap());
    assert!(file.bytes.is_empty() && file.json.get("buffers").is_none());
}
