//! Results of tensegrity mechanics as tables, data and pictures. It knows results only, no mechanics: plain data in, files
//! out.

mod canvas;
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
};
pub use frame::{CableFrame, Frame, ModeSet, ModeShape, Placement, Shape};
pub use gltf::{glb, write_glb};
pub use outline::{CableOutline, MemberKind, MemberOutline, Outline};
pub use picture::{Picture, Projection, png, strip_png, strip_svg, svg};
pub use plot::{Axis, Plot, PlotKind, Series};
pub use table::{Channel, Table};
pub use view::{VIEW_FRAMES, VIEW_POINTS, View, evenly};
pub use vtk::write_vtk;
