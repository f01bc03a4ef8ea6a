//! Results of tensegrity mechanics as tables, data and pictures. The crate knows results only, no mechanics: plain data
//! in, files out. Lengths in m, forces in N, times in s, angles in rad; tension is positive.
//!
//! ```
//! use tg_report::*;
//!
//! let mut outline = Outline::new(2);
//! outline.members.push(MemberOutline::bar("mast", [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]], 0.02));
//! outline.cables.push(CableOutline { name: "guy".into(), group: None });
//! let mut manifest = Manifest::new(Kind::Run, "A mast with a guy");
//! manifest.channels = vec![Channel::time(), Channel::new("guy.tension", "N", "tension")];
//! manifest.outline = Some(outline);
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("out");
//! // let path = Path::new("out");
//! let mut writer = ResultsWriter::create(&path, manifest, Formats::default(), Existing::Keep)?;
//! for step in 0..100 {
//!     let time = 0.01 * f64::from(step);
//!     let mast = Placement::plane([0.0, 1.0], 0.1 * time.sin());
//!     let ends = [[1.0, 0.0, 0.0], mast.apply([0.0, 1.0, 0.0])];
//!     let guy = CableFrame { ends, tension: 50.0 + time, length: 2.2, rest: 2.1, slack: false };
//!     writer.row(&[time, guy.tension])?; // on disk when it returns
//!     writer.frame(&Frame { time, poses: vec![mast], cables: vec![guy] })?;
//! }
//! writer.finish(|manifest| manifest.warnings.push("the mast is imaginary".into()))?;
//!
//! let results = Results::open(&path)?;
//! assert_eq!(results.table()?.column("guy.tension").map(|t| t[99]), Some(50.99));
//! write_file(&path.join("view.html"), View::of(&results)?.html()?.as_bytes())?;
//! let (outline, frames) = (results.manifest.outline.clone().unwrap_or(Outline::new(2)), results.frames()?);
//! write_file(&path.join("end.svg"), svg(&outline, &frames[99], &Picture::default())?.as_bytes())?;
//! write_file(&path.join("tension.png"), &Plot::standard(&results.table()?)[0].png([900.0, 480.0], 2.0)?)?;
//! write_glb(&path.join("motion.glb"), &outline, &frames)?; // Blender, slides, browsers
//! write_vtk(&path.join("motion.pvd"), &outline, &frames)?; // ParaView
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Other programs read the folder as it is:
//!
//! ```text
//! pandas.read_parquet("out/trajectory")              # Python; columns by name: table["guy.tension"]
//! polars.read_parquet("out/trajectory/*.parquet")
//! pyarrow.parquet.read_table("out/trajectory").schema.metadata[b"tg.channels"]    # units and groups, JSON
//! numpy.load("out/trajectory.npy")["time"]           # with Formats { npy: true, .. }
//! pandas.read_csv("out/trajectory.csv")              # with Formats { csv: true, .. }; names with units: "time [s]"
//! ```
//!
//! | what | item |
//! |---|---|
//! | a structure's looks, where it is, its modes and equilibria | [`Outline`], [`Frame`], [`ModeSet`], [`Shape`] |
//! | a folder of results that survives a killed program | [`ResultsWriter`], [`Results`], [`Manifest`] |
//! | columns of numbers: Parquet, CSV, NPY | [`Table`], [`Channel`] |
//! | a page with motion, modes, equilibria and plots | [`View`] |
//! | pictures of a structure: SVG, PNG | [`svg`], [`strip_svg`], [`png`], [`strip_png`], [`Picture`] |
//! | plots: SVG, PNG | [`Plot`] |
//! | animations | [`write_glb`], [`write_vtk`] |
//!
//! The same input gives the same bytes. Texts in PNG files are set in DejaVu Sans, which programs with this crate contain:
//! `LICENSE-DejaVu` goes with them.

mod canvas;
mod checksum;
mod colour;
mod error;
mod folder;
mod frame;
mod gltf;
mod outline;
mod picture;
mod plot;
mod table;
mod ticks;
mod vector;
mod view;
mod vtk;

pub use error::ReportError;
pub use folder::{
    Existing, Formats, Kind, Manifest, PART_ROWS, PART_SECONDS, PART_VALUES, Results, ResultsWriter, Scene,
    write_file,
};
pub use frame::{CableFrame, Frame, ModeSet, ModeShape, Placement, Shape};
pub use gltf::{glb, write_glb};
pub use outline::{CableOutline, MemberKind, MemberOutline, Outline};
pub use picture::{Picture, Projection, png, strip_png, strip_svg, svg};
pub use plot::{Axis, Plot, PlotKind, Series};
pub use table::{Channel, Table};
pub use view::{VIEW_FRAMES, VIEW_POINTS, View, evenly};
pub use vtk::write_vtk;
