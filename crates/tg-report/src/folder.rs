//! A results folder: everything that a computation found, readable while it runs and after it was cut off.
//!
//! | file | what it holds |
//! |---|---|
//! | `run.json` | the [`Manifest`]: what was computed, from what, how it ended |
//! | `trajectory/part-00000.parquet`, ... | rows of the table, each part a complete Parquet file |
//! | `parts.json` | the list of the parts, with their checksums |
//! | `journal.bin` | rows that are in no part yet |
//! | `frames.ndjson` | one [`Frame`](crate::Frame) a line, for pictures |
//! | `trajectory.csv`, `trajectory.npy` | the table again, where [`Formats`] asks for it; made at the end |
//! | `checkpoint.json` | where a computation goes on |
//! | `modes.json`, `shapes.json`, ... | documents |
//!
//! A part is closed when it has [`PART_VALUES`] numbers or [`PART_ROWS`] rows, or is [`PART_SECONDS`] old. Each row goes
//! to the journal in one write before [`ResultsWriter::row`] returns: a killed program loses no row, and where the power
//! fails what the operating system had not yet written is lost, at most what is later than the checkpoint. A part is renamed
//! into place after it is complete, entered in the list, then the journal is emptied; the journal says which part it belongs
//! to, so that no row counts twice. [`Results::table`] reads parts and journal; for programs that know only the parts,
//! [`Results::recover`] makes a part of what a killed program left.
//!
//! Rows, parts, frames, list, checkpoint and manifest have checksums: what was cut off at an end is left out, what is damaged
//! or has vanished is refused. Documents, which are made again in no time, have none.

mod checkpoint;
mod document;
mod files;
mod frames;
mod journal;
mod manifest;
mod parts;
mod reader;
mod recovery;
mod sealed;
mod writer;

pub(crate) use files::NewFile;
pub use files::write_file;
pub(crate) use files::write_json;
pub use manifest::{Kind, Manifest, Scene};
pub use parts::{PART_ROWS, PART_SECONDS, PART_VALUES};
pub use reader::Results;
pub use writer::{Existing, Formats, ResultsWriter};
