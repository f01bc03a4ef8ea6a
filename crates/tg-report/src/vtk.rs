//! Time series for ParaView: a `.pvd` file and one `.vtp` file for each frame.

use std::fmt::Write;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::error::ReportError;
use crate::folder::write_file;
use crate::frame::Frame;
use crate::outline::{MemberKind, Outline};
use crate::view::escaped;

/// Writes `path`, a `.pvd` file, and beside it a folder of its name with `00000.vtp`, ...
///
/// Members are polygons and lines, particles points, cables lines. Data of cells: `kind` (0 bar, 1 body, 2 particle,
/// 3 cable), `part` (number of the member or of the cable, from 0), `tension` \[N\] and `slack` (0 for members).
///
/// # Errors
/// There is no frame, one does not fit the outline, or a file cannot be written.
pub fn write_vtk(path: &Path, outline: &Outline, frames: &[Frame]) -> Result<(), ReportError> {
    outline.check()?;
    frames.iter().try_for_each(|f| f.check(outline))?;
    if frames.is_empty() {
        return Err(ReportError::Empty {
            what: "the time series".into(),
            reason: "there is no frame".into(),
        });
    }
    let folder = path.with_extension("");
    std::fs::create_dir_all(&folder).map_err(ReportError::io("make", &folder))?;
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut list = String::new();
    for (k, frame) in frames.iter().enumerate() {
        let file = folder.join(format!("{k:05}.vtp"));
        write_file(&file, poly_data(outline, frame).as_bytes())?;
        let time = frame.time;
        let name = escaped(&name);
        let _ = writeln!(
            list,
            "    <DataSet timestep=\"{time:e}\" group=\"\" part=\"0\" file=\"{name}/{k:05}.vtp\"/>"
        );
    }
    let pvd = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  \
         <Collection>\n{list}  </Collection>\n</VTKFile>\n"
    );
    write_file(path, pvd.as_bytes())
}

/// Cells of one kind, as VTK wants them.
#[derive(Default)]
struct Cells {
    connectivity: Vec<i64>,
    offsets: Vec<i64>,
    data: Vec<CellData>,
}

#[derive(Clone, Copy)]
struct CellData {
    kind: i32,
    part: i32,
    tension: f64,
    slack: u8,
}

impl Cells {
    fn push(&mut self, points: impl IntoIterator<Item = usize>, data: CellData) {
        self.connectivity.extend(points.into_iter().map(|i| i as i64));
        self.offsets.push(self.connectivity.len() as i64);
        self.data.push(data);
    }

    fn xml(&self, tag: &str) -> String {
        let connectivity =
            array("Int64", "connectivity", 1, self.connectivity.iter().map(|i| i.to_le_bytes()));
        let offsets = array("Int64", "offsets", 1, self.offsets.iter().map(|i| i.to_le_bytes()));
        format!("      <{tag}>\n{connectivity}{offsets}      </{tag}>\n")
    }
}

fn poly_data(outline: &Outline, frame: &Frame) -> String {
    let mut points: Vec<[f64; 3]> = Vec::new();
    let (mut verts, mut lines, mut polys) = (Cells::default(), Cells::default(), Cells::default());
    for (part, (member, pose)) in outline.members.iter().zip(&frame.poses).enumerate() {
        let base = points.len();
        points.extend(member.vertices.iter().map(|&v| pose.apply(v)));
        let kind = match member.kind {
            MemberKind::Bar => 0,
            MemberKind::Body => 1,
            MemberKind::Particle => 2,
        };
        let data = CellData { kind, part: part as i32, tension: 0.0, slack: 0 };
        let used = |i: usize| {
            member.edges.iter().any(|e| e.contains(&i)) || member.faces.iter().any(|f| f.contains(&i))
        };
        for i in (0..member.vertices.len()).filter(|&i| !used(i)) {
            verts.push([base + i], data);
        }
        member.edges.iter().for_each(|e| lines.push(e.map(|i| base + i), data));
        member.faces.iter().for_each(|f| polys.push(f.map(|i| base + i), data));
    }
    for (part, cable) in frame.cables.iter().enumerate() {
        let base = points.len();
        points.extend(cable.ends);
        let tension = if cable.tension.is_finite() { cable.tension } else { 0.0 };
        let data = CellData { kind: 3, part: part as i32, tension, slack: cable.slack.into() };
        lines.push([base, base + 1], data);
    }
    let cells = || verts.data.iter().chain(&lines.data).chain(&polys.data);
    [
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n  <PolyData>\n",
        &format!(
            "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"{}\">\n",
            points.len(),
            verts.offsets.len(),
            lines.offsets.len(),
            polys.offsets.len()
        ),
        "      <CellData Scalars=\"tension\">\n",
        &array("Int32", "kind", 1, cells().map(|c| c.kind.to_le_bytes())),
        &array("Int32", "part", 1, cells().map(|c| c.part.to_le_bytes())),
        &array("Float64", "tension", 1, cells().map(|c| c.tension.to_le_bytes())),
        &array("UInt8", "slack", 1, cells().map(|c| [c.slack])),
        "      </CellData>\n      <Points>\n",
        &array("Float64", "points", 3, points.iter().flatten().map(|x| x.to_le_bytes())),
        "      </Points>\n",
        &verts.xml("Verts"),
        &lines.xml("Lines"),
        &polys.xml("Polys"),
        "    </Piece>\n  </PolyData>\n</VTKFile>\n",
    ]
    .concat()
}

/// An inline array: base64 of its length in bytes and its content, as one stream.
fn array<const N: usize>(
    kind: &str,
    name: &str,
    components: usize,
    values: impl Iterator<Item = [u8; N]>,
) -> String {
    let mut bytes = vec![0; 8];
    bytes.extend(values.flatten());
    let length = bytes.len() as u64 - 8;
    bytes[..8].copy_from_slice(&length.to_le_bytes());
    let content = STANDARD.encode(bytes);
    format!(
        "        <DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
         format=\"binary\">{content}</DataArray>\n"
    )
}
