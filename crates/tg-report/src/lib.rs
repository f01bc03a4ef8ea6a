//! Results of tensegrity mechanics as tables, data and pictures. It knows results only, no mechanics: plain data in, files
//! out.

mod error;
mod folder;
mod frame;
mod outline;
mod plot;
mod table;
mod view;

pub use error::ReportError;
pub use folder::{
    Existing, Formats, Kind, Manifest, PART_ROWS, PART_SECONDS, PART_VALUES, Results, ResultsWriter, Scene,
};
pub use frame::{CableFrame, Frame, ModeSet, ModeShape, Placement, Shape};
pub use outline::{CableOutline, MemberKind, MemberOutline, Outline};
pub use plot::{Axis, Plot, PlotKind, Series};
pub use table::{Channel, Table};
pub use view::{VIEW_FRAMES, VIEW_POINTS, View, evenly};
