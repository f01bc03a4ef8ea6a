//! ParaView's files, parsed as XML and decoded.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use roxmltree::{Document, Node};
use tempfile::tempdir;
use tg_report::{ReportError, write_vtk};

use crate::sample;

fn find<'a>(node: Node<'a, 'a>, key: &str, value: &str) -> Node<'a, 'a> {
    node.descendants().find(|n| n.has_tag_name(value) || n.attribute(key) == Some(value)).unwrap()
}

fn bytes(array: Node) -> Vec<u8> {
    // VTK reads the length and the content as one stream.
    let all = STANDARD.decode(array.text().unwrap()).unwrap();
    let (length, content) = all.split_first_chunk::<8>().unwrap();
    assert_eq!(u64::from_le_bytes(*length), content.len() as u64);
    content.to_vec()
}

fn doubles(array: Node) -> Vec<f64> {
    assert_eq!(array.attribute("type"), Some("Float64"));
    bytes(array).as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b)).collect()
}

fn integers(array: Node) -> Vec<i64> {
    match array.attribute("type") {
        Some("Int64") => bytes(array).as_chunks::<8>().0.iter().map(|b| i64::from_le_bytes(*b)).collect(),
        Some("Int32") => {
            bytes(array).as_chunks::<4>().0.iter().map(|b| i32::from_le_bytes(*b).into()).collect()
        }
        _ => bytes(array).into_iter().map(Into::into).collect(),
    }
}

#[test]
fn a_time_series_has_the_frames() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a & b.pvd");
    let (outline, frames) = (sample::outline(), sample::frames(30));
    write_vtk(&path, &outline, &frames).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let pvd = Document::parse(&text).unwrap();
    let sets: Vec<_> = pvd.descendants().filter(|n| n.has_tag_name("DataSet")).collect();
    assert_eq!(sets.len(), frames.len());
    for (set, frame) in sets.iter().zip(&frames) {
        assert_eq!(set.attribute("timestep").unwrap().parse(), Ok(frame.time));
        let text = std::fs::read_to_string(folder.path().join(set.attribute("file").unwrap())).unwrap();
        let vtp = Document::parse(&text).unwrap();
        let piece = find(vtp.root(), "", "Piece");
        let count = |name: &str| piece.attribute(name).unwrap().parse::<usize>().unwrap();
        // 2 + 2 + 4 + 1 vertices and 6 ends of cables; 1 + 1 + 6 edges and 3 cables.
        let counts = ["NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfPolys"].map(count);
        assert_eq!(counts, [15, 1, 11, 4]);
        let points = doubles(find(piece, "Name", "points"));
        assert_eq!(points[..3], frame.poses[0].apply([0.0, 0.0, -0.5]));
        assert_eq!(points[42..], frame.cables[2].ends[1]);
        let mut cells = 0;
        for (tag, size) in [("Verts", 1), ("Lines", 2), ("Polys", 3)] {
            let of_kind = find(piece, "", tag);
            let offsets = integers(find(of_kind, "Name", "offsets"));
            let connectivity = integers(find(of_kind, "Name", "connectivity"));
            assert!(offsets.iter().enumerate().all(|(k, &o)| o == size * (k as i64 + 1)));
            assert_eq!(connectivity.len() as i64, *offsets.last().unwrap());
            assert!(connectivity.iter().all(|i| (0..15).contains(i)));
            cells += offsets.len();
        }
        let [kind, part, slack] = ["kind", "part", "slack"].map(|name| integers(find(piece, "Name", name)));
        let tension = doubles(find(piece, "Name", "tension"));
        assert!([kind.len(), part.len(), slack.len(), tension.len()].iter().all(|&n| n == cells));
        for (k, cable) in frame.cables.iter().enumerate() {
            let cell = 1 + 8 + k;
            assert_eq!((kind[cell], part[cell], slack[cell]), (3, k as i64, cable.slack.into()));
            assert_eq!(tension[cell], cable.tension);
        }
        assert_eq!((kind[0], part[0], tension[0]), (2, 3, 0.0));
    }
    assert!(frames.iter().any(|f| f.cables.iter().any(|c| c.slack)), "the sample has slack cables");
    assert!(matches!(write_vtk(&path, &outline, &[]), Err(ReportError::Empty { .. })));
}
